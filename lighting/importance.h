// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lighting/sensor_walks.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// How much each node matters to the sensors [Smits, Arvo, Salesin 1992]: by how much the mean illuminance of the sensors grows
/// for one more lm/m² that the whole node sends out, all later reflections included. Estimated by random walks from the sensors.
class Importance {
 public:
  /// Divides triangles on which many walks ended, so that it is known which of their parts matter.
  /// @param walks  of walk_from_sensors(); may be empty: then every node matters by its area
  /// @param grids  the number of each sensor's grid, from 0; empty: all belong to one. An accuracy is a share of a grid's own light, so
  ///               that what the sensors of a dark grid see matters more than the same light elsewhere.
  Importance(Solution& solution, const std::vector<SensorWalk>& walks, std::span<const std::uint32_t> grids = {});

  /// From here on nodes matter by their area, all together as much as they did: to tell what importance is worth.
  void forget_sensors(const mesh::ElementTree& tree);

  /// Of a node, whether it existed when the walks were made or is a part of one that did.
  [[nodiscard]] double of(const mesh::ElementTree& tree, mesh::ElementId e) const;
  /// The part of a node's importance that does not follow its parts' areas, at any depth, beyond what chance brings about.
  [[nodiscard]] double uneven(mesh::ElementId e) const { return e.index() < uneven_.size() ? uneven_[e.index()] : 0.0; }
  /// Mean illuminance of the sensors as the walks saw it [lux]: the scale of tolerances. Not less than a small share of what the
  /// scene's light would give all surfaces, so that dark rooms need no endless refinement; zero where nothing shines.
  [[nodiscard]] double mean_lux() const { return mean_lux_; }
  /// As sides_reached() tells them.
  [[nodiscard]] const std::vector<std::uint8_t>& reached_sides() const { return reached_sides_; }

 private:
  void find_uneven(const mesh::ElementTree& tree, std::span<const double> own, std::span<const double> counts);
  /// From the nodes' own deposits, those of their roots by area, and a share of all importance by area alone.
  void spread(const mesh::ElementTree& tree, std::span<const double> own, double by_area);

  std::vector<float> importance_;  ///< [nodes at the time of the walks]
  std::vector<float> uneven_;
  std::vector<std::uint8_t> reached_sides_;
  double mean_lux_ = 0.0;
};

}  // namespace clerestory::lighting
