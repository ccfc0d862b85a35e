// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/lighting/stages.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::lighting::test {

namespace {

/// One element a region: the solver splits what it needs.
constexpr double kUnrefined_m = 1e9;
/// Share of the accuracy as run() gives it to direct light.
constexpr double kDirectShare = 0.002;
constexpr std::uint64_t kSeed = 12345;

Transport solve_all(Stage& stage, const Importance& importance, const Study& study) {
  NoProgress nobody;
  const double accuracy = study.accuracy.target;
  DirectLight direct = light_directly(stage.solution, importance, kDirectShare * accuracy, kSeed, nobody);
  return solve(stage.solution, importance, std::move(direct),
               {.accuracy = accuracy, .seed = kSeed, .keep_link_errors = study.keep_solution}, nobody);
}

}  // namespace

Stage::Stage(const Study& study)
    : scene(build_scene(study)),
      solution(scene, mesh::ElementTree(scene.faces, mesh::mesh_faces(scene.faces, {.max_size_m = kUnrefined_m}),
                                        scene.has_elements)) {
  for (const GridRequest& grid : study.grids) {
    for (const mesh::Point& p : grid.points) positions.push_back(local(p));
    normals.insert(normals.end(), grid.normals.begin(), grid.normals.end());
  }
}

std::vector<mesh::ElementId> Stage::roots(const std::string& material, mesh::Side side) const {
  std::vector<mesh::ElementId> found;
  for (const mesh::FaceId face : support::faces_of(scene.faces, material)) {
    const auto of_side = solution.tree().roots_of({face, side});
    found.insert(found.end(), of_side.begin(), of_side.end());
  }
  return found;
}

mesh::ElementId Stage::root(const std::string& material, mesh::Side side) const { return roots(material, side).at(0); }

Solved::Solved(const Study& study)
    : Stage(study), importance(solution, walks(kSeed)), transport(solve_all(*this, importance, study)) {}

double Solved::mean_illuminance(const std::vector<mesh::ElementId>& nodes, std::size_t channel) const {
  double flux = 0.0;
  double area = 0.0;
  std::vector<mesh::ElementId> open = nodes;
  while (!open.empty()) {
    const mesh::ElementId e = open.back();
    open.pop_back();
    if (solution.is_open(e)) {
      for (std::size_t k = 0; k < solution.tree().child_count(e); ++k) {
        open.emplace_back(solution.tree().first_child(e).index() + k);
      }
      continue;
    }
    flux += solution.tree().area(e) * solution.irradiance(e)[channel].value;
    area += solution.tree().area(e);
  }
  return flux / area;
}

Study study_of(mesh::Model model, double reflectance, const mesh::Point& sensor) {
  Study study;
  study.name = "test";
  for (const std::string& name : model.material_names) {
    Material& added = study.materials.emplace_back();
    added.name = name;
    added.front.reflectance = added.back.reflectance = Spectrum{static_cast<float>(reflectance)};
  }
  study.model = std::move(model);
  study.sky.type = Sky::Type::kNone;
  GridRequest& grid = study.grids.emplace_back();
  grid.points = {sensor};
  grid.normals = {{0, 0, 1}};
  return study;
}

Material& material(Study& study, const std::string& name) {
  const auto found =
      std::find_if(study.materials.begin(), study.materials.end(), [&](const Material& m) { return m.name == name; });
  if (found == study.materials.end()) throw std::out_of_range("no material '" + name + "'");
  return *found;
}

void shine(Material& material, double exitance_lm_m2) {
  material.front.emission = Emission{.flux_lm = {}, .luminance_cd_m2 = exitance_lm_m2 / std::numbers::pi};
}

void glaze(Material& material, double transmittance_normal) {
  material.front = material.back = {};
  material.glazing = Glazing{.transmittance_normal = transmittance_normal};
}

void leave_open(Material& material) {
  material.front = material.back = {};
  material.glazing.reset();
  material.opening = true;
}

Study furnished_room_study() {
  mesh::Model model = support::box_room(4, 4, 3);
  support::add_table(model, {1.2, 1.6, 0.0});
  support::add_quad(model, {1.5, 1.5, 2.9}, {1.5, 2.5, 2.9}, {2.5, 2.5, 2.9}, {2.5, 1.5, 2.9}, {"lamp", "lamp"});
  Study study = study_of(std::move(model), 0.5, {1, 1, 0.8});
  shine(material(study, "lamp"), 1000.0);
  study.sky.type = Sky::Type::kCieOvercast;
  Material& roof = material(study, "ceiling");
  roof.front = roof.back = {};
  roof.glazing = Glazing{};
  study.grids[0].points.push_back({3, 3, 0.8});
  study.grids[0].normals.push_back({0, 0, 1});
  study.accuracy.target = 0.08;
  return study;
}

}  // namespace clerestory::lighting::test
