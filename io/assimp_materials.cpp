// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/assimp_materials.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace clerestory::io {

namespace {

/// Luminance of linear red, green and blue. Source: Rec. ITU-R BT.709-6, item 3.2.
constexpr std::array<double, 3> kLuminance{0.2126, 0.7152, 0.0722};
/// Of a dielectric at normal incidence, as the glTF extension KHR_materials_transmission has it (index 1.5).
constexpr double kDielectricReflectance = 0.04;
/// The name that assimp gives to the material of faces without one.
constexpr std::string_view kAddedByAssimp = AI_DEFAULT_MATERIAL_NAME;

using Colour = std::array<double, 3>;

std::optional<float> number(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
  float value = 0.0F;
  if (material.Get(key, type, index, value) != aiReturn_SUCCESS) return std::nullopt;
  return value;
}

std::optional<Colour> colour(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
  aiColor4D value;
  if (material.Get(key, type, index, value) != aiReturn_SUCCESS) return std::nullopt;
  // Assimp's numbers are floats that stand for a few decimals: 0.8f is meant to be 0.8.
  Colour bands{};
  for (unsigned band = 0; band < 3; ++band) bands[band] = std::round(double{value[band]} * 1e6) / 1e6;
  const bool sound = std::all_of(bands.begin(), bands.end(), [](double x) { return x >= 0.0 && x <= 1e6; });
  return sound ? std::optional(bands) : std::nullopt;
}

Colour operator*(double factor, Colour bands) {
  for (double& band : bands) band *= factor;
  return bands;
}

double luminance(const Colour& bands) {
  double sum = 0.0;
  for (std::size_t band = 0; band < 3; ++band) sum += kLuminance[band] * bands[band];
  return sum;
}

double share(std::optional<float> value) { return std::clamp(static_cast<double>(value.value_or(0.0F)), 0.0, 1.0); }

/// glTF's material model: a metal has no diffuse part, what is transmitted is lost to the diffuse part.
/// Sources: Khronos, glTF 2.0, appendix B; KHR_materials_transmission.
void split_base_colour(const aiMaterial& source, SourceMaterial& material) {
  if (!material.diffuse || number(source, AI_MATKEY_GLOSSINESS_FACTOR)) return;
  const Colour base = *material.diffuse;
  const double metallic = share(number(source, AI_MATKEY_METALLIC_FACTOR));
  if (metallic == 1.0 && base == Colour{1.0, 1.0, 1.0}) {
    material.diffuse.reset();  // what a material has that says nothing
    return;
  }
  const double transmission = (1.0 - metallic) * share(number(source, AI_MATKEY_TRANSMISSION_FACTOR));
  if (metallic > 0.0) material.specular = metallic * luminance(base);
  if (transmission > 0.0)
    material.transmittance_normal = transmission * (1.0 - kDielectricReflectance) * luminance(base);
  material.diffuse = (1.0 - metallic - transmission) * base;
}

bool is_textured(const aiMaterial& material) {
  return material.GetTextureCount(aiTextureType_DIFFUSE) > 0 || material.GetTextureCount(aiTextureType_BASE_COLOR) > 0;
}

/// Whether assimp made it: its colour has three numbers where files give four.
bool is_added(const aiMaterial& material) {
  const aiMaterialProperty* diffuse = nullptr;
  if (aiGetMaterialProperty(&material, AI_MATKEY_COLOR_DIFFUSE, &diffuse) != aiReturn_SUCCESS) return false;
  return material.GetName().C_Str() == kAddedByAssimp && diffuse->mDataLength == 3 * sizeof(float);
}

SourceMaterial material_of(const aiMaterial& source, const std::string& file, const SceneConvention& convention) {
  SourceMaterial material;
  const aiString name = source.GetName();
  if (name.length == 0 || name.C_Str() == convention.stand_in || is_added(source)) return material;
  material.name = name.C_Str();
  material.file = file;
  material.told_by = convention.told_by;
  material.diffuse = colour(source, AI_MATKEY_COLOR_DIFFUSE);
  material.textured = is_textured(source);
  split_base_colour(source, material);
  if (convention.opacity != nullptr) material.opacity = convention.opacity(source);
  const auto emissive = colour(source, AI_MATKEY_COLOR_EMISSIVE);
  material.shines = emissive && luminance(*emissive) > 0.0;
  return material;
}

bool tell_the_same(const SourceMaterial& a, const SourceMaterial& b) {
  return a.diffuse == b.diffuse && a.specular == b.specular && a.opacity == b.opacity &&
         a.transmittance_normal == b.transmittance_normal && a.textured == b.textured && a.shines == b.shines;
}

void tell_apart(std::vector<SourceMaterial>& materials) {
  std::unordered_map<std::string, std::vector<std::size_t>> alike;
  for (std::size_t at = 0; at < materials.size(); ++at) {
    std::vector<std::size_t>& others = alike[materials[at].name];
    std::size_t which = 0;
    while (which < others.size() && !tell_the_same(materials[others[which]], materials[at])) ++which;
    if (which == others.size()) others.push_back(at);
    if (which > 0) materials[at].name += fmt::format(" ({})", which + 1);
  }
}

}  // namespace

std::vector<SourceMaterial> materials_of_scene(const aiScene& scene, const std::string& file,
                                               const SceneConvention& convention) {
  std::vector<SourceMaterial> materials;
  for (unsigned at = 0; at < scene.mNumMaterials; ++at)
    materials.push_back(material_of(*scene.mMaterials[at], file, convention));
  tell_apart(materials);
  return materials;
}

}  // namespace clerestory::io
