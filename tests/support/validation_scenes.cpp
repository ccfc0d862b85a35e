// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/validation_scenes.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/support/places.h"

namespace clerestory::test {

namespace {

/// Ground beyond the model in the scenes with a sky (their README).
constexpr double kGroundReflectance = 0.2;

std::ifstream opened(const std::string& scene, const std::string& file) {
  const std::filesystem::path path = validation_dir() / scene / file;
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  return in;
}

nlohmann::ordered_json read_materials(const std::string& name) {
  auto in = opened(name, "materials.json");
  return nlohmann::ordered_json::parse(in);
}

bool anything_shines(const nlohmann::ordered_json& materials) {
  return std::any_of(materials.begin(), materials.end(), [](const auto& m) { return m.at("type") == "emitter"; });
}

mesh::MaterialId material_of(mesh::Model& model, const std::string& name) {
  auto& names = model.material_names;
  const auto at = std::find(names.begin(), names.end(), name);
  const auto index = static_cast<std::size_t>(at - names.begin());
  if (at == names.end()) names.push_back(name);
  return mesh::MaterialId(index);
}

/// Vertices, triangles and usemtl: all that these files hold.
mesh::Model read_model(const std::string& name) {
  auto in = opened(name, "scene.obj");
  mesh::Model model;
  model.part_names = {name};
  mesh::MaterialId material;
  std::uint32_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      mesh::Point& p = model.vertices.emplace_back();
      words >> p.x >> p.y >> p.z;
    } else if (word == "usemtl") {
      words >> word;
      material = material_of(model, word);
    } else if (word == "f") {
      std::vector<std::uint32_t> corners;
      for (std::uint32_t corner = 0; words >> corner; words.ignore(64, ' ')) corners.push_back(corner - 1);
      model.begin_polygon(material, mesh::PartId(0U), number);
      model.add_loop(corners);
    }
  }
  return model;
}

lighting::Material material_from(const std::string& name, const nlohmann::ordered_json& values) {
  lighting::Material material;
  material.name = name;
  if (values.at("type") == "glass") {
    material.glazing = lighting::Glazing{.transmittance_normal = values.at("tau_normal"), .panes = 1};
    return material;
  }
  material.front.reflectance = lighting::Spectrum{values.at("reflectance").get<float>()};
  material.back = material.front;
  if (values.at("type") == "emitter")
    material.front.emission = lighting::Emission{.flux_lm = values.at("flux_lm").get<double>(), .luminance_cd_m2 = {}};
  return material;
}

lighting::GridRequest read_sensors(const std::string& name) {
  auto in = opened(name, "sensors.pts");
  lighting::GridRequest grid;
  grid.points_file = (validation_dir() / name / "sensors.pts").string();
  mesh::Point p;
  mesh::Vector n;
  while (in >> p.x >> p.y >> p.z >> n.x >> n.y >> n.z) {
    grid.points.push_back(p);
    grid.normals.push_back(n);
  }
  return grid;
}

std::string material_as_toml(const std::string& name, const nlohmann::ordered_json& values) {
  std::string text = fmt::format("[materials.\"{}\"]\n", name);
  if (values.at("type") == "glass")
    return text + fmt::format("glazing = {{ transmittance = {}, panes = 1 }}\n", values.at("tau_normal").get<double>());
  text += fmt::format("reflectance = {}\n", values.at("reflectance").get<double>());
  if (values.at("type") == "emitter")
    text += fmt::format("emission = {{ flux_lm = {:.1f} }}\n", values.at("flux_lm").get<double>());
  return text;
}

}  // namespace

lighting::Study validation_study(const std::string& name) {
  const auto materials = read_materials(name);
  lighting::Study study;
  study.name = name;
  study.model = read_model(name);
  for (const std::string& used : study.model.material_names)
    study.materials.push_back(material_from(used, materials.at(used)));
  study.kind = anything_shines(materials) ? lighting::Study::Kind::kIlluminance : lighting::Study::Kind::kDaylight;
  study.sky.type = anything_shines(materials) ? lighting::Sky::Type::kNone : lighting::Sky::Type::kCieOvercast;
  study.sky.ground_reflectance = kGroundReflectance;
  study.grids.push_back(read_sensors(name));
  return study;
}

Reference validation_reference(const std::string& name) {
  auto in = opened(name, "reference.csv");
  std::string line;
  std::getline(in, line);
  const bool has_errors = line.find("standard_error_lux") != std::string::npos;
  Reference reference;
  while (std::getline(in, line)) {
    std::vector<double> values;  // id,x,y,z,illuminance_lux[,standard_error_lux…]
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) values.push_back(std::stod(field));
    reference.illuminance_lux.push_back(values.at(4));
    reference.standard_error_lux.push_back(has_errors ? values.at(5) : 0.0);
  }
  return reference;
}

std::filesystem::path write_validation_study(const std::string& name, const std::filesystem::path& folder,
                                             double accuracy) {
  const auto materials = read_materials(name);
  const std::filesystem::path scene = std::filesystem::absolute(validation_dir() / name);
  std::string text = fmt::format("[model]\nfile = '{}'\nunits = \"m\"\n", (scene / "scene.obj").string());
  for (const auto& [material, values] : materials.items()) text += material_as_toml(material, values);
  text += fmt::format("[sky]\ntype = \"{}\"\nhorizontal_illuminance = 10000.0\nground_reflectance = {}\n",
                      anything_shines(materials) ? "none" : "cie-overcast", kGroundReflectance);
  text += fmt::format("[[grids]]\nname = \"workplane\"\npoints = '{}'\n", (scene / "sensors.pts").string());
  text += fmt::format("[accuracy]\ntarget = {}\n", accuracy);
  std::filesystem::create_directories(folder);
  const std::filesystem::path path = folder / (name + ".toml");
  std::ofstream out(path);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
  return path;
}

}  // namespace clerestory::test
