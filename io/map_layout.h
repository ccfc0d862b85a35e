// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "io/map_plan.h"
#include "io/raster.h"

namespace clerestory::io {

/// Where everything on a map's picture goes [pixels].
struct MapLayout {
  int width = 0;
  int height = 0;
  Pixel title;
  PixelRect map;     ///< the plan, its outermost points on the border
  PixelRect legend;  ///< the bar of colours
  Pixel north;       ///< centre of the arrow
  Pixel scale_bar;   ///< upper left corner
  PixelRect footer;
  double pixels_per_metre = 1.0;
  MapPoint origin;  ///< the place on the plan of the map's upper left corner [m]

  [[nodiscard]] Pixel pixel(const MapPoint& p) const {
    return {map.x + (p.x - origin.x) * pixels_per_metre, map.y + (origin.y - p.y) * pixels_per_metre};
  }
  [[nodiscard]] std::vector<Pixel> pixels(std::span<const MapPoint> points) const;
};

MapLayout layout_map(const MapPlan& plan);

/// Which parts of a picture are taken, and by whom, so that labels keep clear of each other and of lines.
class Occupied {
 public:
  using Owner = std::uint8_t;
  static constexpr Owner kNobody = 0;
  static constexpr Owner kSomebody = 255;

  Occupied(int width, int height);

  /// Whether a rectangle lies within the picture and holds nothing yet but what `except` took for itself alone.
  [[nodiscard]] bool free(const PixelRect& rectangle, Owner except = kNobody) const;
  void take(const PixelRect& rectangle);
  /// What two owners take belongs to kSomebody.
  void take(const Mask& mask, Owner owner = kSomebody);

 private:
  int width_;
  int height_;
  std::vector<Owner> owners_;
};

}  // namespace clerestory::io
