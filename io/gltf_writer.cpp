// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/gltf_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "clerestory_version.h"
#include "io/whole_file.h"
#include "io/words.h"
#include "mesh/error.h"
#include "mesh/model_triangles.h"

namespace clerestory::io {

namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

// Numbers of the specification.
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr std::uint32_t kGlbVersion = 2;
/// What GLB counts its bytes with.
constexpr std::uint64_t kMostBytes = 0xffffffffU;
/// As KHR_materials_transmission has it for a dielectric.
constexpr double kDielectricReflectance = 0.04;

using Float3 = std::array<float, 3>;

template <class Number>
void append(std::string& bytes, const Number& number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// A whole number of metres near the model's centre: exact in single precision too.
mesh::Point centre_of(const mesh::Model& model) {
  mesh::Box box;
  for (const mesh::Point& p : model.vertices) box.add(p);
  if (model.vertices.empty()) return {};
  const auto middle = [](double low, double high) { return std::round(0.5 * (low + high)); };
  return {middle(box.low.x, box.high.x), middle(box.low.y, box.high.y), middle(box.low.z, box.high.z)};
}

/// From z up to y up.
Float3 turned(const mesh::Vector& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.z), static_cast<float>(-v.y)};
}

json material_of(const SourceMaterial& source) {
  json material{{"name", one_line(source.name)}, {"doubleSided", true}};
  if (source.diffuse || source.opacity || source.transmittance_normal) {
    const std::array<double, 3> white{1.0, 1.0, 1.0};
    const std::array<double, 3> base = source.transmittance_normal ? white : source.diffuse.value_or(white);
    json& look = material["pbrMetallicRoughness"];
    look["metallicFactor"] = 0.0;
    look["baseColorFactor"] = {base[0], base[1], base[2], source.opacity.value_or(1.0)};
  }
  if (source.opacity && *source.opacity < 1.0) material["alphaMode"] = "BLEND";
  if (source.transmittance_normal)
    material["extensions"]["KHR_materials_transmission"]["transmissionFactor"] =
        std::min(1.0, *source.transmittance_normal / (1.0 - kDielectricReflectance));
  if (source.shines || source.luminance_cd_m2) material["emissiveFactor"] = {1.0, 1.0, 1.0};
  return material;
}

/// Polygons of one part and material, in the order of the model.
struct Group {
  mesh::PartId part;
  mesh::MaterialId material;
  std::vector<std::size_t> polygons;
};

std::vector<Group> groups_of(const mesh::Model& model) {
  std::vector<Group> groups;
  for (const std::size_t polygon : polygons_by_part(model)) {
    const mesh::PartId part = model.polygon_part[polygon];
    const mesh::MaterialId material = model.polygon_material[polygon];
    if (groups.empty() || groups.back().part != part || groups.back().material != material)
      groups.push_back({part, material, {}});
    groups.back().polygons.push_back(polygon);
  }
  return groups;
}

class Document {
 public:
  explicit Document(const WrittenModel& written)
      : triangles_(cut_into_triangles(written.model)), centre_(centre_of(triangles_)) {
    const Float3 place = turned(centre_ - mesh::Point{});
    json_["asset"] = {{"version", "2.0"}, {"generator", std::string("Clerestory ") + kVersion}};
    json_["scene"] = 0;
    json_["scenes"] = json::array({json{{"nodes", json::array({0})}}});
    json_["nodes"] = json::array({json{{"translation", place}, {"children", json::array()}}});
    for (const SourceMaterial& material : written.materials) json_["materials"].push_back(material_of(material));
    const bool transmits = std::any_of(written.materials.begin(), written.materials.end(),
                                       [](const SourceMaterial& m) { return m.transmittance_normal.has_value(); });
    if (transmits) json_["extensionsUsed"] = json::array({"KHR_materials_transmission"});
    for (const Group& group : groups_of(triangles_)) add(group);
  }

  /// @param uri  of the file with the bytes; empty where they stand in the same
  json finish(const std::string& uri) {
    json_["buffers"] = json::array({json{{"byteLength", bytes_.size()}}});
    if (!uri.empty()) json_["buffers"][0]["uri"] = uri;
    return json_;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  void add(const Group& group);
  void begin_part(mesh::PartId part);
  int accessor(std::size_t begin, std::size_t count, int type, const char* shape);

  mesh::Model triangles_;
  mesh::Point centre_;
  json json_;
  std::string bytes_;
  mesh::PartId part_;
};

int Document::accessor(std::size_t begin, std::size_t count, int type, const char* shape) {
  json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes_.size() - begin}});
  json_["accessors"].push_back(
      {{"bufferView", json_["bufferViews"].size() - 1}, {"componentType", type}, {"count", count}, {"type", shape}});
  return static_cast<int>(json_["accessors"].size() - 1);
}

void Document::begin_part(mesh::PartId part) {
  part_ = part;
  const std::string name = one_line(triangles_.part_names[part.index()]);
  json_["meshes"].push_back({{"name", name}, {"primitives", json::array()}});
  json_["nodes"][0]["children"].push_back(json_["nodes"].size());
  json_["nodes"].push_back({{"name", name}, {"mesh", json_["meshes"].size() - 1}});
}

/// One primitive, with the vertices that it uses.
void Document::add(const Group& group) {
  if (group.part != part_) begin_part(group.part);
  std::unordered_map<std::uint32_t, std::uint32_t> index;
  std::string indices;
  Float3 low{};
  Float3 high{};
  const std::size_t positions_begin = bytes_.size();
  for (const std::size_t polygon : group.polygons) {
    for (const std::uint32_t corner : triangles_.loop(polygon)) {
      const auto [place, fresh] = index.try_emplace(corner, static_cast<std::uint32_t>(index.size()));
      append(indices, place->second);
      if (!fresh) continue;
      const Float3 at = turned(triangles_.vertices[corner] - centre_);
      append(bytes_, at);
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = place->second == 0 ? at[k] : std::min(low[k], at[k]);
        high[k] = place->second == 0 ? at[k] : std::max(high[k], at[k]);
      }
    }
  }
  const int positions = accessor(positions_begin, index.size(), kFloat, "VEC3");
  json_["accessors"].back()["min"] = low;
  json_["accessors"].back()["max"] = high;
  const std::size_t indices_begin = bytes_.size();
  bytes_ += indices;
  json_["meshes"].back()["primitives"].push_back(
      {{"attributes", {{"POSITION", positions}}},
       {"indices", accessor(indices_begin, 3 * group.polygons.size(), kUnsignedInt, "SCALAR")},
       {"material", group.material.index()}});
}

void append_chunk(std::string& glb, std::string chunk, std::string_view type, char padding) {
  chunk.resize((chunk.size() + 3) / 4 * 4, padding);
  append(glb, static_cast<std::uint32_t>(chunk.size()));
  glb += type;
  glb += chunk;
}

std::string glb_of(const std::string& text, const std::string& bytes) {
  std::string chunks;
  append_chunk(chunks, text, "JSON", ' ');
  append_chunk(chunks, bytes, std::string_view("BIN\0", 4), '\0');
  std::string glb = "glTF";
  append(glb, kGlbVersion);
  append(glb, static_cast<std::uint32_t>(glb.size() + sizeof(std::uint32_t) + chunks.size()));
  return glb + chunks;
}

/// Bytes that are no UTF-8 become U+FFFD.
std::string text_of(const json& document) { return document.dump(-1, ' ', false, json::error_handler_t::replace); }

}  // namespace

std::vector<std::filesystem::path> write_gltf(const std::filesystem::path& file, const WrittenModel& written) {
  Document document(written);
  if (document.bytes().size() > kMostBytes / 2)
    throw MachineError(file.string() + ": the model is too large for glTF; choose .obj or .ply");
  if (lower(file.extension().string()) == ".glb") {
    write_whole_file(file, glb_of(text_of(document.finish({})), document.bytes()));
    return {file};
  }
  const std::filesystem::path bin = std::filesystem::path(file).replace_extension(".bin");
  write_whole_file(bin, document.bytes());
  write_whole_file(file, text_of(document.finish(bin.filename().string())));
  return {file, bin};
}

}  // namespace clerestory::io
