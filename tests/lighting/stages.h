// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "lighting/direct_light.h"
#include "lighting/importance.h"
#include "lighting/radiosity.h"
#include "lighting/scene.h"
#include "lighting/solution.h"
#include "lighting/study.h"

/// The solver's stages one by one, as run() calls them.
namespace clerestory::lighting::test {

/// A study up to the start of the solution: one element a region of a face side.
struct Stage {
  explicit Stage(const Study& study);
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  [[nodiscard]] mesh::Point local(const mesh::Point& p) const { return p - scene.faces.origin; }
  /// From its sensors.
  [[nodiscard]] std::vector<SensorWalk> walks(std::uint64_t seed) const {
    return walk_from_sensors(scene, positions, normals, seed);
  }
  /// The first root on a side of the first face of a material.
  [[nodiscard]] mesh::ElementId root(const std::string& material, mesh::Side side = mesh::Side::kFront) const;
  /// All roots on a side of all faces of a material.
  [[nodiscard]] std::vector<mesh::ElementId> roots(const std::string& material,
                                                   mesh::Side side = mesh::Side::kFront) const;

  Scene scene;
  Solution solution;
  /// Sensors of the study's grids of given points, local coordinates.
  std::vector<mesh::Point> positions;
  std::vector<mesh::Vector> normals;
};

/// A study solved at its accuracy. Its grids' given points are the sensors.
struct Solved : Stage {
  explicit Solved(const Study& study);

  /// Area mean of the illuminance of some nodes [lux, channel].
  [[nodiscard]] double mean_illuminance(const std::vector<mesh::ElementId>& nodes, std::size_t channel = 0) const;

  Importance importance;
  Transport transport;
};

/// The model's materials with one reflectance each on both sides, in a study without light that has one sensor, looking up.
Study study_of(mesh::Model model, double reflectance, const mesh::Point& sensor);

/// The material of that name; throws std::out_of_range where there is none.
Material& material(Study& study, const std::string& name);

/// Lets the front of a material shine [lm/m²].
void shine(Material& material, double exitance_lm_m2);

/// Makes a material clear glass, or an air polygon.
void glaze(Material& material, double transmittance_normal = 0.70);
void leave_open(Material& material);

/// A room of 4 m × 4 m × 3 m with a table, a lamp and a glass roof below an overcast sky, and two sensors; asked for 8 %.
Study furnished_room_study();

}  // namespace clerestory::lighting::test
