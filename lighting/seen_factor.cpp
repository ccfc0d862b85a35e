// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/seen_factor.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "lighting/form_factor.h"
#include "mesh/seen_parts.h"

namespace clerestory::lighting {

using mesh::Point;
using mesh::Vector;

namespace {

/// Where more stand before a polygon, rays are quicker than clipping.
constexpr std::size_t kMostBlockers = 48;
/// Of a polygon, what is more than rounding.
constexpr double kLeastShare = 1e-6;

/// Large ones leave little to be clipped by others.
void largest_first(std::vector<std::span<const Point>>& polygons) {
  std::vector<std::pair<double, std::span<const Point>>> by_area;
  by_area.reserve(polygons.size());
  for (const auto& polygon : polygons) {
    Vector doubled;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
      doubled = doubled + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    by_area.emplace_back(norm(doubled), polygon);
  }
  std::stable_sort(by_area.begin(), by_area.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t i = 0; i < polygons.size(); ++i) polygons[i] = by_area[i].second;
}

}  // namespace

SeenFactor seen_factor(const mesh::Shafts& shafts, const Point& at, const Receiver& receiver,
                       const mesh::ShaftEnd& polygon) {
  const mesh::ShaftEnd eye = mesh::point_end(at);
  mesh::Shafts::Blockers blockers = shafts.blockers(eye, polygon, kMostBlockers);
  largest_first(blockers.polygons);
  const std::span<const Point> corners(polygon.corners.data(), polygon.count);
  auto parts = mesh::seen_parts(at, corners, blockers.polygons);
  SeenFactor seen;
  seen.exact = blockers.all && parts;
  // Too many pieces: nothing is known of what is hidden.
  if (!parts) parts = mesh::seen_parts(at, corners, {});
  std::array<mesh::OutlineEdge, mesh::ConvexPiece::kMostCorners> scratch;
  for (const mesh::ConvexPiece& part : *parts)
    seen.factor += std::max(0.0, receiver.form_factor(at, part.outline(scratch), polygon.normal));
  if (blockers.polygons.empty()) return seen;
  // What rounding leaves between blockers that share an edge is no sight.
  std::array<mesh::OutlineEdge, 4> edges;
  for (std::size_t i = 0; i < polygon.count; ++i) edges[i] = {corners[i], corners[(i + 1) % polygon.count]};
  const double full = receiver.form_factor(at, std::span(edges).first(polygon.count), polygon.normal);
  if (seen.factor <= kLeastShare * full) return {};
  return seen;
}

}  // namespace clerestory::lighting
