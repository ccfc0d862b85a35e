// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/traced_scene.h"

#include <numbers>
#include <stdexcept>
#include <utility>

#include "mesh/clean.h"

namespace clerestory::test {

namespace {

TracedSide traced_side(const lighting::SideMaterial& side, const std::string& name, double area_m2) {
  if (!side.reflectance) throw std::invalid_argument("material '" + name + "' has no reflectance");
  if (side.reflectance->size() != 1) throw std::invalid_argument("material '" + name + "' is not grey");
  TracedSide traced{.reflectance = side.reflectance->front()};
  if (!side.emission) return traced;
  traced.emission_lm_m2 = side.emission->flux_lm ? *side.emission->flux_lm / area_m2
                                                 : std::numbers::pi * side.emission->luminance_cd_m2.value();
  return traced;
}

TracedFace traced_face(const lighting::Material& material, double area_m2) {
  TracedFace face;
  face.opening = material.opening;
  if (material.opening) return face;
  if (material.glazing) {
    face.transmittance_normal = material.glazing->transmittance_normal;
    return face;
  }
  face.front = traced_side(material.front, material.name, area_m2);
  face.back = traced_side(material.back, material.name, area_m2);
  return face;
}

}  // namespace

TracedScene traced_scene(const lighting::Study& study) {
  TracedScene scene;
  scene.faces = mesh::build_faces(mesh::clean(study.model, study.clean));
  scene.rays = std::make_unique<mesh::Rays>(scene.faces);
  std::vector<double> area_m2(study.materials.size(), 0.0);
  for (const mesh::Face& face : scene.faces.faces) area_m2[face.material.index()] += face.area_m2;
  for (const mesh::Face& face : scene.faces.faces) {
    const std::size_t m = face.material.index();
    scene.materials.push_back(traced_face(study.materials[m], area_m2[m]));
  }
  scene.sky = study.sky;
  scene.luminaires = study.luminaires;
  return scene;
}

Reference traced_reference(const lighting::Study& study, std::size_t paths) {
  const lighting::GridRequest& grid = study.grids.front();
  Reference reference;
  for (const Traced& t : trace_illuminance(traced_scene(study), grid.points, grid.normals, {.paths = paths})) {
    reference.illuminance_lux.push_back(t.illuminance_lux);
    reference.standard_error_lux.push_back(t.standard_error_lux);
  }
  return reference;
}

}  // namespace clerestory::test
