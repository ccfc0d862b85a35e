// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/luminaire_view.h"

#include <algorithm>

#include "lighting/luminaire_mounting.h"
#include "mesh/shafts.h"

namespace clerestory::lighting {

using mesh::Point;
using mesh::Vector;

namespace {

/// Where more stand before an opening, rays are quicker than clipping.
constexpr std::size_t kMostBlockers = 48;

bool is_flat_rectangle(const LuminousOpening& opening) {
  return opening.shape == LuminousOpening::Shape::kRectangle && opening.x_m > 0.0 && opening.y_m > 0.0 &&
         opening.z_m == 0.0;
}

mesh::ShaftEnd end_of(const Luminaire& luminaire) {
  const auto corner = [&](double u, double v) { return luminaire.place(luminaire.opening.place(u, v, 0.5)); };
  // Counter-clockwise as seen from where it shines.
  return {.corners = {corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)}, .count = 4, .normal = -luminaire.axes.w};
}

/// What a blocker is to a luminaire.
enum class Standing { kBefore, kOwn, kUnclear };

Standing standing(const Luminaire& luminaire, bool mounted, std::span<const Point> polygon) {
  std::size_t inside = 0;
  std::size_t level = 0;
  for (const Point& p : polygon) {
    const Vector own = luminaire.to_own(p - luminaire.at);
    const bool near_plane = std::abs(own.z) <= kHousingM;
    level += near_plane ? 1 : 0;
    inside += near_plane && std::abs(own.x) <= 0.5 * luminaire.opening.x_m + kHousingM &&
                      std::abs(own.y) <= 0.5 * luminaire.opening.y_m + kHousingM
                  ? 1
                  : 0;
  }
  if (inside == polygon.size() || (mounted && level == polygon.size())) return Standing::kOwn;
  return inside > 0 ? Standing::kUnclear : Standing::kBefore;
}

}  // namespace

std::optional<mesh::ConvexPiece> whole_opening(const Luminaire& luminaire) {
  if (!is_flat_rectangle(luminaire.opening)) return std::nullopt;
  const mesh::ShaftEnd end = end_of(luminaire);
  mesh::ConvexPiece piece;
  std::copy(end.corners.begin(), end.corners.end(), piece.corners.begin());
  piece.count = end.count;
  return piece;
}

std::optional<std::vector<mesh::ConvexPiece>> seen_opening(const Scene& scene, const Luminaire& luminaire,
                                                           std::span<const mesh::FaceId> flush, const Point& at) {
  if (!is_flat_rectangle(luminaire.opening)) return std::nullopt;
  if (luminaire.to_own(at - luminaire.at).z >= -kHousingM) return std::nullopt;
  const mesh::ShaftEnd end = end_of(luminaire);
  const mesh::ShaftEnd eye{.corners = {at}, .count = 1, .normal = {}};
  const mesh::Shafts::Blockers found = scene.shafts->blockers(eye, end, kMostBlockers);
  if (!found.all) return std::nullopt;
  std::vector<std::span<const Point>> before;
  for (const std::span<const Point> polygon : found.polygons) {
    const Standing stands = standing(luminaire, !flush.empty(), polygon);
    if (stands == Standing::kUnclear) return std::nullopt;
    if (stands == Standing::kBefore) before.push_back(polygon);
  }
  if (before.empty()) return std::vector{*whole_opening(luminaire)};
  return mesh::seen_parts(at, end.corners, before);
}

}  // namespace clerestory::lighting
