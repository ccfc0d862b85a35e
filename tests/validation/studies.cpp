// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/validation/studies.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace clerestory::test {

lighting::Study grey_study(mesh::Model model, double reflectance) {
  lighting::Study study;
  study.name = "test";
  for (const std::string& name : model.material_names) {
    lighting::Material& added = study.materials.emplace_back();
    added.name = name;
    added.front.reflectance = added.back.reflectance = lighting::Spectrum{static_cast<float>(reflectance)};
  }
  study.model = std::move(model);
  study.sky.type = lighting::Sky::Type::kNone;
  return study;
}

lighting::Material& material(lighting::Study& study, const std::string& name) {
  const auto found = std::find_if(study.materials.begin(), study.materials.end(),
                                  [&](const lighting::Material& m) { return m.name == name; });
  if (found == study.materials.end()) throw std::out_of_range("no material '" + name + "'");
  return *found;
}

void shine(lighting::Material& material, double emission_lm_m2) {
  material.front.emission = lighting::Emission{.flux_lm = {}, .luminance_cd_m2 = emission_lm_m2 / std::numbers::pi};
}

void add_sensors(lighting::Study& study, std::span<const mesh::Point> points, const mesh::Vector& normal) {
  if (study.grids.empty()) study.grids.emplace_back().name = "sensors";
  lighting::GridRequest& grid = study.grids.front();
  grid.points.insert(grid.points.end(), points.begin(), points.end());
  grid.normals.insert(grid.normals.end(), points.size(), normal);
}

std::vector<mesh::Point> cell_centres(const mesh::Point& low, double width_m, double depth_m, int count) {
  std::vector<mesh::Point> points;
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i)
      points.push_back(low + mesh::Vector{width_m * (i + 0.5) / count, depth_m * (j + 0.5) / count, 0.0});
  return points;
}

}  // namespace clerestory::test
