// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "lighting/results.h"

namespace clerestory::io {

/// A place on the map [m], to the right and up.
struct MapPoint {
  double x = 0.0;
  double y = 0.0;
};

/// A rectangle on the map [m]; empty until a point is added.
struct MapBox {
  MapPoint low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  MapPoint high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  [[nodiscard]] double width() const { return std::max(0.0, high.x - low.x); }
  [[nodiscard]] double height() const { return std::max(0.0, high.y - low.y); }
  [[nodiscard]] bool contains(const MapPoint& p) const {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
  }
  void add(const MapPoint& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

struct MapOutline {
  std::vector<MapPoint> loop;
  MapBox box;
  bool hole = false;  ///< wound against the largest outline of its plane: furniture or a column within a room
};

/// One plane of sensors: a storey, or one side of a wall.
struct MapPanel {
  std::string caption;  ///< where the plane is, where there are several
  MapBox box;
};

/// A grid laid flat. Sensors that share a plane keep their places to each other; several planes lie side by side.
struct MapPlan {
  std::vector<MapPoint> positions;             ///< of the sensors
  std::vector<std::array<MapPoint, 4>> cells;  ///< of the sensors, or empty
  std::vector<std::uint32_t> zone;   ///< of each sensor: values are smooth inside a zone (one room of one plane)
  std::vector<std::uint8_t> inside;  ///< of each sensor: 1 within an outline
  std::vector<MapOutline> outlines;
  std::vector<std::array<MapPoint, 2>> no_sky;  ///< the longest first
  std::vector<MapPanel> panels;
  MapBox box;
  bool seen_from_above = false;  ///< every plane is level, so that the map has a north
  MapPoint north;                ///< unit vector on the map; where seen_from_above
};

/// Lays a grid flat: level planes as a plan seen from above, walls as seen from where their sensors look to. A long plan that
/// stands on end is turned by 90° to the right.
/// @param north_deg  from +y, counter-clockwise
/// @param no_sky     lines in the planes of the sensors [m, model coordinates]
MapPlan lay_flat(const lighting::Sensors& sensors, double north_deg,
                 std::span<const std::array<mesh::Point, 2>> no_sky = {});

/// Even-odd rule.
bool contains(const MapOutline& outline, const MapPoint& p);

}  // namespace clerestory::io
