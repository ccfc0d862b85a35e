// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dxf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "io/dxf_drawing.h"
#include "io/model_builder.h"
#include "io/text_file.h"
#include "io/words.h"
#include "mesh/affine.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

using mesh::Affine;
using mesh::Point;
using mesh::Vector;

/// What blocks may multiply a small file to: some 600 MB.
constexpr std::uint64_t kMostInsertedFaces = 5'000'000;
constexpr std::uint64_t kMostInsertedPoints = 4 * kMostInsertedFaces;
constexpr std::uint64_t kMostInserts = 1'000'000;
constexpr std::size_t kDeepestBlock = 100;

/// The axes that belong to an extrusion direction. Source: Autodesk, DXF Reference, Arbitrary Axis Algorithm.
Affine object_axes(const Vector& extrusion) {
  constexpr double kNearWorldZ = 1.0 / 64.0;
  const Vector z = normalized(extrusion);
  if (norm(z) == 0.0) return {};
  const bool near_z = std::abs(z.x) < kNearWorldZ && std::abs(z.y) < kNearWorldZ;
  const Vector x = normalized(cross(near_z ? Vector{0.0, 1.0, 0.0} : Vector{0.0, 0.0, 1.0}, z));
  return {x, cross(z, x), z, {}};
}

Affine placing_of(const DxfInsert& insert, const Point& base, std::int64_t column, std::int64_t row) {
  const double angle = insert.rotation_deg * std::numbers::pi / 180.0;
  const Affine rotation{
      {std::cos(angle), std::sin(angle), 0.0}, {-std::sin(angle), std::cos(angle), 0.0}, {0.0, 0.0, 1.0}, {}};
  const Vector step{static_cast<double>(column) * insert.column_spacing, static_cast<double>(row) * insert.row_spacing,
                    0.0};
  Affine shift;
  shift.origin = insert.at + rotation.turn(step);
  Affine scale{{insert.scale.x, 0.0, 0.0}, {0.0, insert.scale.y, 0.0}, {0.0, 0.0, insert.scale.z}, {}};
  scale.origin = Point{} - scale.turn(base - Point{});
  return object_axes(insert.extrusion) * shift * rotation * scale;
}

class DxfModel {
 public:
  explicit DxfModel(const std::filesystem::path& path)
      : path_(path), drawing_(read_dxf_drawing(path)), builder_(path.string()) {}

  ModelFile read(const ModelFormat& format);

 private:
  /// How a block, or the model space, is placed.
  struct Context {
    Affine placing;
    std::uint32_t layer = 0;                ///< of what the block has on layer "0"
    std::vector<const DxfContent*> blocks;  ///< that hold it, for blocks that hold themselves
  };

  void place(const DxfContent& content, const Context& context);
  void place_insert(const DxfInsert& insert, const Context& context);
  void count_inserted(const DxfContent& block, std::uint64_t times, std::uint64_t line);
  [[nodiscard]] std::optional<ToldUnit> told_unit(ModelFile& result) const;
  void add_notices(ModelFile& result) const;
  [[nodiscard]] std::string left_out_words() const;

  std::filesystem::path path_;
  DxfDrawing drawing_;
  ModelBuilder builder_;
  std::vector<std::uint32_t> corners_;
  std::uint64_t inserts_ = 0;
  std::uint64_t inserted_faces_ = 0;
  std::uint64_t inserted_points_ = 0;
  std::set<std::string> hidden_layers_;
  std::set<std::string> unknown_blocks_;
};

ModelFile DxfModel::read(const ModelFormat& format) {
  place(drawing_.model_space, {});
  if (builder_.polygon_count() == 0 && !drawing_.left_out.empty())
    throw InputError(path_.string(), 0, fmt::format("there is no face in this drawing, only {}", left_out_words()),
                     "export solids and surfaces as 3D faces or polyface meshes");
  ModelFile result;
  result.files.push_back(path_);
  const auto unit = told_unit(result);
  builder_.finish(result, format, unit);
  add_notices(result);
  return result;
}

void DxfModel::place(const DxfContent& content, const Context& context) {
  const auto first = static_cast<std::uint32_t>(builder_.vertex_count());
  for (const Point& p : content.points) builder_.vertex(context.placing(p));
  const bool mirrors = context.placing.determinant() < 0.0;
  for (std::size_t polygon = 0; polygon < content.polygon_count(); ++polygon) {
    const std::uint32_t own_layer = content.layers[polygon];
    const DxfLayer& layer = drawing_.layers[own_layer == 0 ? context.layer : own_layer];
    if (layer.frozen || layer.off) {
      hidden_layers_.insert(layer.name);
      continue;
    }
    corners_.clear();
    for (std::uint32_t i = content.starts[polygon]; i < content.starts[polygon + 1]; ++i)
      corners_.push_back(first + content.corners[i]);
    if (mirrors) std::reverse(corners_.begin(), corners_.end());  // what was outside stays outside
    builder_.polygon(corners_, builder_.material(layer.name), builder_.part(layer.name), content.lines[polygon]);
  }
  for (const DxfInsert& insert : content.inserts) place_insert(insert, context);
}

void DxfModel::place_insert(const DxfInsert& insert, const Context& context) {
  const std::uint32_t layer = insert.layer == 0 ? context.layer : insert.layer;
  if (drawing_.layers[layer].frozen) {
    hidden_layers_.insert(drawing_.layers[layer].name);
    return;
  }
  const auto block = drawing_.blocks.find(insert.block);
  if (block == drawing_.blocks.end()) {
    unknown_blocks_.insert(insert.block);
    return;
  }
  Context inner = context;
  inner.layer = layer;
  if (std::find(inner.blocks.begin(), inner.blocks.end(), &block->second) != inner.blocks.end())
    throw InputError(path_.string(), insert.line,
                     fmt::format("the block {} holds itself", in_quotes(block->second.name)),
                     "explode one of the inserts");
  if (inner.blocks.size() == kDeepestBlock)
    throw InputError(path_.string(), insert.line, fmt::format("blocks hold blocks over {} deep", kDeepestBlock),
                     "explode some of the inserts");
  inner.blocks.push_back(&block->second);
  count_inserted(block->second, static_cast<std::uint64_t>(insert.rows * insert.columns), insert.line);
  for (std::int64_t row = 0; row < insert.rows; ++row) {
    for (std::int64_t column = 0; column < insert.columns; ++column) {
      inner.placing = context.placing * placing_of(insert, block->second.base, column, row);
      place(block->second, inner);
    }
  }
}

void DxfModel::count_inserted(const DxfContent& block, std::uint64_t times, std::uint64_t line) {
  inserts_ += times;
  inserted_faces_ += times * block.polygon_count();
  inserted_points_ += times * block.points.size();
  if (inserts_ > kMostInserts || inserted_faces_ > kMostInsertedFaces || inserted_points_ > kMostInsertedPoints)
    throw InputError(path_.string(), line,
                     fmt::format("the blocks that are inserted come to over {} faces or {} inserts", kMostInsertedFaces,
                                 kMostInserts),
                     "split the drawing");
}

std::optional<ToldUnit> DxfModel::told_unit(ModelFile& result) const {
  const auto told = [this](LengthUnit unit) {
    return ToldUnit{unit, fmt::format("as $INSUNITS in line {} of the drawing says", drawing_.unit_line)};
  };
  switch (drawing_.unit_code) {
    case 0:
      return std::nullopt;
    case 1:
      return told(LengthUnit::kInch);
    case 2:
      return told(LengthUnit::kFoot);
    case 4:
      return told(LengthUnit::kMillimetre);
    case 5:
      return told(LengthUnit::kCentimetre);
    case 6:
      return told(LengthUnit::kMetre);
    default:
      break;
  }
  result.notices.push_back(
      fmt::format("The drawing's unit ($INSUNITS {}) is none of m, cm, mm, in, ft.", drawing_.unit_code));
  return std::nullopt;
}

std::string DxfModel::left_out_words() const {
  std::vector<std::string> words;
  words.reserve(drawing_.left_out.size());
  for (const auto& [type, count] : drawing_.left_out) words.push_back(fmt::format("{} {}", count, type));
  return list_names(words);
}

void DxfModel::add_notices(ModelFile& result) const {
  const auto add = [&result](const std::string& sentence) { result.notices.push_back(sentence); };
  const auto names = [](const std::set<std::string>& set) {
    std::vector<std::string> quoted;
    for (const std::string& name : set) quoted.push_back(in_quotes(name));
    return list_names(quoted);
  };
  if (!drawing_.left_out.empty())
    add(fmt::format("Left out of the drawing, since only faces and meshes are read: {}.", left_out_words()));
  if (!hidden_layers_.empty())
    add(fmt::format("Left out, since they are off or frozen in the drawing: the layers {}.", names(hidden_layers_)));
  if (!unknown_blocks_.empty())
    add(fmt::format("Left out, since the drawing does not define them: the blocks {}.", names(unknown_blocks_)));
  if (drawing_.faces_without_area > 0)
    add(fmt::format("{} faces of the drawing have under three different corners and were left out.",
                    drawing_.faces_without_area));
  if (drawing_.smooth_meshes > 0)
    add(fmt::format("{} MESH entities are to be smoothed; their control faces were read as they are.",
                    drawing_.smooth_meshes));
}

}  // namespace

bool is_dxf(std::string_view head) {
  if (head.starts_with("AutoCAD Binary DXF")) return true;
  const std::vector<std::string_view> words = split_words(head.substr(0, 100));
  return words.size() >= 2 && words[0] == "0" && words[1] == "SECTION";
}

ModelFile read_dxf(const std::filesystem::path& path, const ModelFormat& format) {
  require_file(path, "model");
  return DxfModel(path).read(format);
}

}  // namespace clerestory::io
