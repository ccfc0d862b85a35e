// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/slit_feet.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;

namespace {

std::size_t side_of(const mesh::Slit& slit) { return mesh::FaceSide{slit.foot.face, slit.side}.index(); }

double distance(const Point& p, const std::array<Point, 2>& ends) {
  const Vector along = ends[1] - ends[0];
  const double t = std::clamp(dot(p - ends[0], along) / dot(along, along), 0.0, 1.0);
  return norm(p - (ends[0] + t * along));
}

/// From a segment to a convex outline in its plane; zero where they meet.
double distance(const std::array<Point, 2>& ends, std::span<const Point> corners, const Point& inside) {
  double nearest = std::numeric_limits<double>::infinity();
  double begin = 0.0;  // what is left of the segment inside of the outline, by its parameter
  double end = 1.0;
  const Vector along = ends[1] - ends[0];
  const Vector normal = cross(corners[1] - corners[0], inside - corners[0]);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& a = corners[i];
    const Point& b = corners[(i + 1) % corners.size()];
    for (const Point& p : ends) nearest = std::min(nearest, distance(p, {a, b}));
    nearest = std::min(nearest, distance(a, ends));
    const Vector inward = cross(normal, b - a);
    const double height = dot(ends[0] - a, inward);
    const double slope = dot(along, inward);
    if (slope == 0.0) {
      if (height < 0.0) end = -1.0;
    } else if (slope > 0.0) {
      begin = std::max(begin, -height / slope);
    } else {
      end = std::min(end, -height / slope);
    }
  }
  return begin <= end ? 0.0 : nearest;
}

}  // namespace

SlitFeet::SlitFeet(std::size_t faces, std::span<const mesh::Slit> slits) : slits_(slits.begin(), slits.end()) {
  if (slits_.empty()) return;
  std::stable_sort(slits_.begin(), slits_.end(),
                   [](const mesh::Slit& a, const mesh::Slit& b) { return side_of(a) < side_of(b); });
  starts_.assign(2 * faces + 1, 0);
  for (const mesh::Slit& slit : slits_) ++starts_[side_of(slit) + 1];
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
}

bool SlitFeet::is_coarse(const mesh::ElementTree& tree, ElementId e) const {
  if (starts_.empty()) return false;
  const std::size_t side = tree.face_side(e).index();
  if (starts_[side] == starts_[side + 1]) return false;
  std::array<Point, 4> corners;
  const std::size_t count = tree.hull(e, corners);
  const double radius = tree.radius(e);
  for (std::uint32_t i = starts_[side]; i < starts_[side + 1]; ++i) {
    const mesh::Slit& slit = slits_[i];
    if (radius <= slit.width_m) continue;
    if (distance(slit.foot.ends, std::span(corners).first(count), tree.centroid(e)) < radius) return true;
  }
  return false;
}

}  // namespace clerestory::lighting
