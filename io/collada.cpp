// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/collada.h"

#include <assimp/material.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/assimp_model.h"
#include "io/child_process.h"
#include "io/collada_text.h"
#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

constexpr std::uint64_t kLongestDocument = std::uint64_t{1} << 30;
/// Units differ by far more.
constexpr double kSameUnit = 1e-6;

std::optional<double> opacity_of(const aiMaterial& material) {
  float opacity = 1.0F;
  if (material.Get(AI_MATKEY_OPACITY, opacity) != aiReturn_SUCCESS) return std::nullopt;
  return std::clamp(static_cast<double>(opacity), 0.0, 1.0);
}

std::optional<LengthUnit> unit_of(double metres) {
  for (const LengthUnit unit :
       {LengthUnit::kMetre, LengthUnit::kCentimetre, LengthUnit::kMillimetre, LengthUnit::kInch, LengthUnit::kFoot})
    if (std::abs(metres / metres_per(unit) - 1.0) < kSameUnit) return unit;
  return std::nullopt;
}

SceneConvention convention_of(const ColladaAsset& asset, const ModelFormat& format) {
  SceneConvention convention;
  convention.told_by = "the diffuse colour of the COLLADA";
  convention.stand_in = kStandInMaterial;
  convention.opacity = &opacity_of;
  convention.up = asset.up == 'Y' ? UpAxis::kY : UpAxis::kZ;
  if (asset.up == 'X' && !format.up) convention.to_file = {{0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {}};
  if (!asset.metres_per_unit || format.unit) return convention;
  const double metres = *asset.metres_per_unit;
  const std::string where = fmt::format("as line {} of the model says", asset.unit_line);
  if (const auto unit = unit_of(metres)) {
    convention.unit = ToldUnit{*unit, where};
    return convention;
  }
  const mesh::Affine scale{{metres, 0.0, 0.0}, {0.0, metres, 0.0}, {0.0, 0.0, metres}, {}};
  convention.to_file = scale * convention.to_file;
  convention.unit = ToldUnit{LengthUnit::kMetre, fmt::format("with its own of {:g} m applied, {}", metres, where)};
  return convention;
}

/// Early exporters wrote how transparent a material is where COLLADA asks how opaque: what is wholly clear shows it.
void turn_transparency(ModelFile& result) {
  const bool turned = std::any_of(result.materials.begin(), result.materials.end(),
                                  [](const SourceMaterial& material) { return material.opacity == 0.0; });
  if (!turned) return;
  for (SourceMaterial& material : result.materials)
    if (material.opacity) material.opacity = 1.0 - *material.opacity;
  result.notices.emplace_back(
      "The model calls materials wholly transparent, as exporters do that mean the opposite: opacity was taken the "
      "other "
      "way round.");
}

}  // namespace

bool is_collada(std::string_view head) { return head.find("<COLLADA") != std::string_view::npos; }

ModelFile import_collada(const std::filesystem::path& path, const ModelFormat& format) {
  std::string document = read_text_file(path, "model", kLongestDocument);
  if (trim(document).empty()) throw InputError(path.string(), 0, "the file is empty", "export the model again");
  const ColladaAsset asset = take_asset(document, path.string());
  add_stand_in_material(document);
  move_blanks_back(document);
  if (const auto line = line_of_element(document, "ph"))
    throw InputError(path.string(), *line, "this polygon has holes, which the importer cannot read",
                     "export the model in triangles");
  AssimpImport import(path, "dae");
  ModelFile result = model_of_scene(import, import.read_text(document), path, format, convention_of(asset, format));
  turn_transparency(result);
  return result;
}

ModelFile read_collada(const std::filesystem::path& path, const ModelFormat& format) {
  return read_in_child(path, format, &import_collada);
}

}  // namespace clerestory::io
