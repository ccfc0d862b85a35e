// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/luminaire_view.h"

#include <algorithm>
#include <utility>

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

bool is_flat(const LuminousOpening& opening) { return opening.z_m == 0.0; }

/// The rectangle round a flat luminous opening; one corner of a point.
mesh::ShaftEnd end_of(const Luminaire& luminaire) {
  if (luminaire.opening.size_m() <= 0.0) return mesh::point_end(luminaire.at);
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

/// Whether all of a piece lies before a luminous opening, clear of the housing.
bool is_before(const Luminaire& luminaire, const mesh::ShaftEnd& piece) {
  return std::all_of(piece.corners.begin(), piece.corners.begin() + static_cast<std::ptrdiff_t>(piece.count),
                     [&](const Point& p) { return luminaire.to_own(p - luminaire.at).z < -kHousingM; });
}

/// Whether all of a luminous opening lies behind the plane of a piece.
bool is_behind(const Luminaire& luminaire, const mesh::ShaftEnd& piece) {
  for (const double u : {0.0, 1.0}) {
    for (const double v : {0.0, 1.0}) {
      for (const double w : {0.0, 1.0}) {
        const Point p = luminaire.place(luminaire.opening.place(u, v, w));
        if (dot(p - piece.corners[0], piece.normal) > 0.0) return false;
      }
    }
  }
  return true;
}

/// What stands between a luminaire's flat opening and a piece before it, but for what the luminaire is mounted in.
struct Between {
  bool known = false;
  bool hidden = false;
  std::vector<std::span<const Point>> before;
};

Between between(const Scene& scene, const Luminaire& luminaire, bool mounted, const mesh::ShaftEnd& piece) {
  Between result;
  const mesh::ShaftEnd end = end_of(luminaire);
  const mesh::Shafts::Blockers found = scene.shafts->blockers(piece, end, kMostBlockers);
  bool own = false;
  bool clear = true;
  for (const std::span<const Point> polygon : found.polygons) {
    const Standing stands = standing(luminaire, mounted, polygon);
    own = own || stands == Standing::kOwn;
    clear = clear && stands != Standing::kUnclear;
    if (stands == Standing::kBefore) result.before.push_back(polygon);
  }
  result.known = found.all && clear;
  result.hidden =
      clear && !own && !found.polygons.empty() && scene.shafts->classify(piece, end) == mesh::Visibility::kHidden;
  return result;
}

}  // namespace

std::vector<LuminaireView> any_luminaires(const Scene& scene) {
  std::vector<LuminaireView> all(scene.luminaires.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k].luminaire = static_cast<std::uint32_t>(k);
  return all;
}

std::vector<LuminaireView> narrowed(const Scene& scene, const mesh::ShaftEnd& piece,
                                    std::span<const LuminaireView> known) {
  std::vector<LuminaireView> result;
  for (const LuminaireView& view : known) {
    const Luminaire& luminaire = scene.luminaires[view.luminaire];
    if (is_behind(luminaire, piece)) continue;
    if (view.clear() || !is_flat(luminaire.opening) || !is_before(luminaire, piece)) {
      result.push_back(view);
      continue;
    }
    Between found = between(scene, luminaire, !scene.flush_faces[view.luminaire].empty(), piece);
    if (found.hidden) continue;
    if (!found.known) found.before.clear();
    result.push_back({view.luminaire, found.known, std::move(found.before)});
  }
  return result;
}

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
  const mesh::ShaftEnd eye = mesh::point_end(at);
  const mesh::Shafts::Blockers found = scene.shafts->blockers(eye, end, kMostBlockers);
  if (!found.all) return std::nullopt;
  std::vector<std::span<const Point>> before;
  for (const std::span<const Point> polygon : found.polygons) {
    const Standing stands = standing(luminaire, !flush.empty(), polygon);
    if (stands == Standing::kUnclear) return std::nullopt;
    if (stands == Standing::kBefore) before.push_back(polygon);
  }
  return seen_opening(luminaire, before, at);
}

std::optional<std::vector<mesh::ConvexPiece>> seen_opening(const Luminaire& luminaire,
                                                           std::span<const std::span<const Point>> before,
                                                           const Point& at) {
  const auto whole = whole_opening(luminaire);
  if (!whole) return std::nullopt;
  if (before.empty()) return std::vector{*whole};
  return mesh::seen_parts(at, end_of(luminaire).corners, before);
}

}  // namespace clerestory::lighting
