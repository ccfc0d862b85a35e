// SPDX-License-Identifier: GPL-3.0-or-later
// The parser is our own: tinyobjloader turns a coordinate that is no number into 0, drops faces without a word,
// and knows no line numbers.
#include "io/obj.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "io/mtl_library.h"
#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

constexpr const char* kUnnamed = "default";  // the material and the part of faces that stand before any name
constexpr double kFarthestCoordinate =
    1e9;  // file units: 1000 km in millimetres; squares and cubes of more mean nothing
constexpr std::size_t kHeaderComments = 100;

/// Keywords that say nothing of polygons, parts or materials.
constexpr std::array<std::string_view, 34> kPassedOver{
    "vt",         "vn",        "vp",    "s",     "l",    "p",      "cstype", "deg",      "bmat",
    "step",       "curv",      "curv2", "surf",  "parm", "trim",   "hole",   "scrv",     "sp",
    "end",        "con",       "mg",    "bevel", "lod",  "maplib", "usemap", "c_interp", "d_interp",
    "shadow_obj", "trace_obj", "ctech", "stech", "call", "csh",    "t"};

/// Ids of names in the order of their first use.
template <class Id>
class Names {
 public:
  Id id(const std::string& name) {
    const auto [at, is_new] = ids_.emplace(name, Id(names_.size()));
    if (is_new) names_.push_back(name);
    return at->second;
  }
  [[nodiscard]] std::vector<std::string> take() { return std::move(names_); }

 private:
  std::unordered_map<std::string, Id> ids_;
  std::vector<std::string> names_;
};

class ObjReader {
 public:
  explicit ObjReader(const std::filesystem::path& path) : path_(path), lines_(path, "model") {}

  ObjFile read(const ModelFormat& format);

 private:
  void read_statement();
  void read_vertex(const std::vector<std::string_view>& words);
  void read_face(const std::vector<std::string_view>& words);
  std::uint32_t corner(std::string_view word) const;
  void read_comment(std::string_view line);
  void pass_over(std::string_view keyword);
  void check_corners() const;
  void drop_unused_vertices();
  void attach_materials(ObjFile& result);
  void choose_unit(const ModelFormat& format, ObjFile& result) const;
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
    throw InputError(lines_.file(), lines_.number(), what, hint);
  }

  std::filesystem::path path_;
  LineReader lines_;
  mesh::Model model_;
  Names<mesh::MaterialId> materials_;
  Names<mesh::PartId> parts_;
  std::string material_ = kUnnamed;
  std::string object_ = kUnnamed;
  std::string part_ = kUnnamed;
  std::vector<MtlReference> mtllibs_;
  std::vector<std::uint32_t> face_corners_;
  std::size_t header_comments_ = 0;
  std::optional<LengthUnit> header_unit_;
  std::uint64_t header_unit_line_ = 0;
  std::size_t unknown_lines_ = 0;
  std::string first_unknown_;
  std::size_t curved_surfaces_ = 0;
};

ObjFile ObjReader::read(const ModelFormat& format) {
  while (lines_.next_continued()) read_statement();
  if (model_.polygon_count() == 0)
    throw InputError(lines_.file(), 0, "there is no face in this model", "export it with its surfaces, as polygons");
  check_corners();
  drop_unused_vertices();

  ObjFile result;
  result.files.push_back(path_);
  model_.material_names = materials_.take();
  model_.part_names = parts_.take();
  attach_materials(result);
  choose_unit(format, result);
  if (curved_surfaces_ > 0)
    result.notices.push_back(
        fmt::format("{} free-form surfaces of the model were left out: only polygons are read.", curved_surfaces_));
  if (unknown_lines_ > 0)
    result.notices.push_back(fmt::format("{} lines of the model were not understood and passed over, the first is {}.",
                                         unknown_lines_, first_unknown_));
  to_metres_z_up(model_, result.unit, format.up);
  result.model = std::move(model_);
  return result;
}

void ObjReader::read_statement() {
  const std::string_view line = trim(lines_.line());
  if (line.empty()) return;
  if (line.front() == '#') return read_comment(line);
  const std::vector<std::string_view> words = split_words(line);
  const std::string_view keyword = words[0];
  const std::string rest(trim(line.substr(keyword.size())));
  if (keyword == "v") {
    read_vertex(words);
  } else if (keyword == "f" || keyword == "fo") {
    read_face(words);
  } else if (keyword == "usemtl") {
    material_ = rest.empty() ? kUnnamed : rest;
  } else if (keyword == "o") {
    object_ = rest.empty() ? kUnnamed : rest;
    part_ = object_;
  } else if (keyword == "g") {
    part_ = rest.empty() ? object_ : rest;
  } else if (keyword == "mtllib") {
    mtllibs_.push_back({rest, lines_.number()});
  } else {
    pass_over(keyword);
  }
}

void ObjReader::read_comment(std::string_view line) {
  if (!model_.vertices.empty() || header_unit_ || header_comments_++ >= kHeaderComments) return;
  header_unit_ = unit_in_comment(line.substr(0, 200));
  header_unit_line_ = lines_.number();
}

void ObjReader::pass_over(std::string_view keyword) {
  if (keyword == "surf") ++curved_surfaces_;
  for (const std::string_view known : kPassedOver)
    if (keyword == known) return;
  if (unknown_lines_++ == 0)
    first_unknown_ = fmt::format("{} in line {}", in_quotes(keyword.substr(0, 20)), lines_.number());
}

void ObjReader::read_vertex(const std::vector<std::string_view>& words) {
  if (words.size() < 4)
    fail(fmt::format("a vertex has three coordinates, this line has {}", words.size() - 1),
         "complete the line; was the file cut off?");
  std::array<double, 3> xyz{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto value = parse_number(words[axis + 1]);
    if (!value)
      fail(fmt::format("the coordinate {} is no finite number", in_quotes(words[axis + 1])),
           "correct or remove this vertex");
    if (std::abs(*value) > kFarthestCoordinate)
      fail(fmt::format("the coordinate {} lies beyond any building", in_quotes(words[axis + 1])),
           "correct or remove this vertex");
    xyz[axis] = *value;
  }
  if (model_.vertices.size() >= std::numeric_limits<std::uint32_t>::max() - 1)
    fail("the model has more vertices than 32 bits count", "split it");
  model_.vertices.push_back({xyz[0], xyz[1], xyz[2]});
}

std::uint32_t ObjReader::corner(std::string_view word) const {
  const std::string_view index_text = word.substr(0, word.find('/'));
  const std::string_view others = word.substr(index_text.size());
  std::int64_t index = 0;
  const auto [end, error] = std::from_chars(index_text.data(), index_text.data() + index_text.size(), index);
  const bool whole = error == std::errc{} && end == index_text.data() + index_text.size();
  if (!whole || others.find_first_not_of("0123456789-/") != std::string_view::npos)
    fail(fmt::format("{} is no corner of a face", in_quotes(word)), "write the number of a vertex, or v/vt/vn");
  if (index == 0) fail("the vertex number 0 means nothing: vertices count from 1", "correct or remove this face");
  const auto count = static_cast<std::int64_t>(model_.vertices.size());
  if (index < -count)
    fail(fmt::format("vertex {} does not exist: {} are given so far", index, count), "correct or remove this face");
  if (index > std::numeric_limits<std::uint32_t>::max() - 1)
    fail(fmt::format("vertex {} does not exist", index), "correct or remove this face");
  return static_cast<std::uint32_t>(index < 0 ? count + index : index - 1);
}

void ObjReader::read_face(const std::vector<std::string_view>& words) {
  if (words.size() < 4)
    fail(fmt::format("a face has at least 3 corners, this one has {}", words.size() - 1),
         "complete or remove this face; was the file cut off?");
  face_corners_.clear();
  for (std::size_t i = 1; i < words.size(); ++i) face_corners_.push_back(corner(words[i]));
  if (model_.corners.size() + face_corners_.size() >= std::numeric_limits<std::uint32_t>::max())
    fail("the model has more corners than 32 bits count", "split it");
  const auto line =
      static_cast<std::uint32_t>(lines_.number() <= std::numeric_limits<std::uint32_t>::max() ? lines_.number() : 0);
  model_.begin_polygon(materials_.id(material_), parts_.id(part_), line);
  model_.add_loop(face_corners_);
}

/// Faces may stand before their vertices, so that the range is known at the end alone.
void ObjReader::check_corners() const {
  for (std::size_t polygon = 0; polygon < model_.polygon_count(); ++polygon) {
    for (const std::uint32_t vertex : model_.loop(polygon)) {
      if (vertex < model_.vertices.size()) continue;
      throw InputError(
          lines_.file(), model_.polygon_line[polygon],
          fmt::format("vertex {} does not exist: the model has {}", std::uint64_t{vertex} + 1, model_.vertices.size()),
          "correct or remove this face; was the file cut off?");
    }
  }
}

/// Stray vertices would widen the model's box, and with it the guess of its unit.
void ObjReader::drop_unused_vertices() {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> new_index(model_.vertices.size(), kUnused);
  for (const std::uint32_t vertex : model_.corners) new_index[vertex] = 0;
  std::uint32_t kept = 0;
  for (std::size_t vertex = 0; vertex < new_index.size(); ++vertex) {
    if (new_index[vertex] == kUnused) continue;
    model_.vertices[kept] = model_.vertices[vertex];
    new_index[vertex] = kept++;
  }
  model_.vertices.resize(kept);
  for (std::uint32_t& vertex : model_.corners) vertex = new_index[vertex];
}

void ObjReader::attach_materials(ObjFile& result) {
  MtlLibrary library = read_mtl_library(path_, mtllibs_);
  result.files.insert(result.files.end(), library.files.begin(), library.files.end());
  result.notices = std::move(library.notices);
  std::unordered_map<std::string, std::size_t> index;
  for (const std::string& name : model_.material_names) {
    index.emplace(name, result.materials.size());
    result.materials.push_back({.name = name, .file = {}, .diffuse = {}, .opacity = {}});
  }
  for (MtlMaterial& material : library.materials) {
    if (material.name.empty()) material.name = kUnnamed;
    const auto used = index.find(material.name);
    if (used == index.end()) {
      result.unused_materials.push_back(material.name);
    } else {
      result.materials[used->second] = std::move(material);
    }
  }
}

/// "The unit of length is m, as line 1 of the model says: 6 x 8 x 3 m."
void ObjReader::choose_unit(const ModelFormat& format, ObjFile& result) const {
  if (format.unit) {
    result.unit = *format.unit;
    return;
  }
  mesh::Box box;
  for (const mesh::Point& p : model_.vertices) box.add(p);
  const mesh::Vector size = box.size();
  const double height = format.up == UpAxis::kZ ? size.z : size.y;
  const double depth = format.up == UpAxis::kZ ? size.y : size.z;
  result.unit = header_unit_.value_or(guess_unit(height));
  const double scale = metres_per(result.unit);
  const std::string why =
      header_unit_ ? fmt::format("is {}, as line {} of the model says", unit_word(result.unit), header_unit_line_)
                   : fmt::format("was taken as {} from the model's size", unit_word(result.unit));
  result.notices.push_back(
      fmt::format("The unit of length {}: {:.4g} x {:.4g} x {:.4g} m. "
                  "Set model.units where that is wrong.",
                  why, scale * size.x, scale * depth, scale * height));
}

}  // namespace

ObjFile read_obj(const std::filesystem::path& path, const ModelFormat& format) { return ObjReader(path).read(format); }

}  // namespace clerestory::io
