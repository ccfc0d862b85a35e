// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reveals.h"

#include <algorithm>
#include <cmath>

#include "mesh/regions.h"

namespace clerestory::mesh {

namespace {

/// Walls are no thicker than this on the inner side of a pane [m].
constexpr double kDeepest = 0.6;
constexpr double kStep = 0.05;  ///< [m]
/// The room is wider than its reveal by this at least [m]: more than frames and curtains are.
constexpr double kJamb = 0.15;
/// A pane is as high as the room when its frame alone is between it and the ceiling [m].
constexpr double kFrame = 0.2;
/// Below the top of a pane by this the jambs are looked for: above furniture [m].
constexpr double kBelowTop = 0.03;
/// Panes steeper than this have reveals [cosine to the vertical].
constexpr double kUpright = 0.3;

/// A plan rectangle before a pane.
struct Reveal {
  Point middle;
  Vector inwards;
  Vector along;
  double depth = 0.0;
  double left = 0.0;
  double right = 0.0;

  [[nodiscard]] bool holds(double x, double y) const {
    const Vector d{x - middle.x, y - middle.y, 0.0};
    const double in = dot(d, inwards);
    const double beside = dot(d, along);
    return in > -kStep && in < depth && beside > -left && beside < right;
  }
};

double way(const Rays& rays, const Point& from, const Vector& direction) {
  constexpr double kFar = 1e3;
  const Hit hit = rays.first_hit({from, direction});
  return hit.face.valid() ? std::min(hit.distance, kFar) : kFar;
}

/// The reveal before a pane, of no depth where there is none.
Reveal reveal_before(const Rays& rays, const Point& middle, const Vector& inwards) {
  Reveal reveal{middle, inwards, {-inwards.y, inwards.x, 0.0}};
  const double free = way(rays, middle + rays.offset_m() * inwards, inwards);
  if (free < kDeepest + kStep) return reveal;
  const Point inside = middle + (kDeepest + 0.5 * kStep) * inwards;
  const double room = way(rays, inside, reveal.along) + way(rays, inside, -reveal.along);
  for (double depth = kDeepest - 0.5 * kStep; depth > 0.0; depth -= kStep) {
    const Point at = middle + depth * inwards;
    const double right = way(rays, at, reveal.along);
    const double left = way(rays, at, -reveal.along);
    if (left + right > room - kJamb) continue;
    reveal.depth = depth + 0.5 * kStep;
    reveal.left = left;
    reveal.right = right;
    break;
  }
  return reveal;
}

}  // namespace

void set_reveals_apart(const Faces& faces, const Rays& rays, const RoomSearch& search, const Raster& raster,
                       std::vector<RoomColumn>& columns) {
  if (search.glazing.empty()) return;
  const RoomMap map(raster, columns);
  std::vector<Reveal> reveals;
  for (std::size_t f = 0; f < faces.count(); ++f) {
    const Face& face = faces.faces[f];
    if (search.glazing[f] == 0 || std::abs(face.frame.w.z) > kUpright) continue;
    Box box;
    for (const auto& loop : face.loops) {
      for (const std::uint32_t v : loop) box.add(faces.shape.vertices[v]);
    }
    for (const double sign : {1.0, -1.0}) {
      const Vector inwards = normalized(Vector{sign * face.frame.w.x, sign * face.frame.w.y, 0.0});
      Point middle = box.centre();
      const RoomColumn* column = map.at(middle + kDeepest * inwards);
      if (column == nullptr) continue;
      if (box.low.z > column->ceiling || box.high.z < column->ceiling - kFrame) continue;
      middle.z = std::min<double>(column->ceiling, box.high.z) - kBelowTop;
      const Reveal reveal = reveal_before(rays, middle, inwards);
      if (reveal.depth > 0.0) reveals.push_back(reveal);
    }
  }
  for (RoomColumn& c : columns) {
    const bool in_reveal = std::ranges::any_of(reveals, [&](const Reveal& r) {
      return r.middle.z > c.floor && r.middle.z < c.ceiling && r.holds(raster.x(c.column), raster.y(c.column));
    });
    if (in_reveal && c.kind == RoomColumn::Kind::kWhole) c.kind = RoomColumn::Kind::kNiche;
  }
}

}  // namespace clerestory::mesh
