// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lighting/region_graph.h"

namespace clerestory::lighting {

/// One connected surface that sensors stand on, in its own frame: x and y along the main directions of its outline, z the way the
/// sensors look. A place has the coordinates (p·u, p·v, p·w) of its local coordinates p. Private to the placing of sensors.
struct GridSurface {
  mesh::Frame frame;
  std::vector<std::array<mesh::Point, 3>> triangles;
  /// Outer loops counter-clockwise, holes clockwise. Holes that furniture and columns make are left out: the surface goes on
  /// below them, and whether a sensor there lies inside of them is asked of each.
  std::vector<std::vector<mesh::Point>> loops;
  mesh::Box box;  ///< of the loops

  [[nodiscard]] mesh::Point to_local(const mesh::Point& p) const;
  [[nodiscard]] mesh::Point to_frame(const mesh::Point& p) const;
  /// Elevation of the surface at a place in the plane, extended evenly beyond its edges [m].
  [[nodiscard]] double elevation(double x, double y) const;
  /// Whether a place in the plane lies inside the loops.
  [[nodiscard]] bool contains(double x, double y) const;
  /// How far a place lies from the nearest loop [m].
  [[nodiscard]] double distance_to_outline(double x, double y) const;
  [[nodiscard]] double smaller_width_m() const { return std::min(box.size().x, box.size().y); }
};

/// Makes the surface that the given regions are together.
/// @param regions   connected; all look the same way
/// @param height_m  of the sensors, at which holes are told apart
GridSurface make_grid_surface(const GridSite& site, const RegionGraph& graph, std::span<const std::uint32_t> regions,
                              const mesh::Vector& look, double height_m);

/// Area of a loop in the x-y plane of its frame, negative when it runs clockwise [m²].
double signed_area(const std::vector<mesh::Point>& loop);

}  // namespace clerestory::lighting
