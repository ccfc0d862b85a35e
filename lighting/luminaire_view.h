// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lighting/luminous_area.h"
#include "lighting/scene.h"
#include "mesh/geometry.h"
#include "mesh/seen_parts.h"
#include "mesh/shafts.h"

namespace clerestory::lighting {

/// A luminaire as a piece of surface may see it: what may stand between them is found once for all of its points.
struct LuminaireView {
  std::uint32_t luminaire = 0;  ///< index in the scene's
  bool known = false;           ///< whether `before` is all that may; else each point looks for itself
  std::vector<std::span<const mesh::Point>> before;  ///< opaque convex polygons, of the scene's shafts

  [[nodiscard]] bool clear() const { return known && before.empty(); }
};

/// All luminaires of a scene, of which nothing is known.
std::vector<LuminaireView> any_luminaires(const Scene& scene);

/// Those of luminaires that a piece of surface may see, with what stands before them; such are left out as are proven to be hidden from all of it
/// [Haines, Wallace 1994], or lie behind it.
/// @param known  of a larger piece that holds it
std::vector<LuminaireView> narrowed(const Scene& scene, const mesh::ShaftEnd& piece,
                                    std::span<const LuminaireView> known);

/// The parts of a flat rectangular luminous opening that a point sees past opaque faces but those that the luminaire is mounted in, by
/// clipping. Nothing where that does not tell: the opening has another shape, the point is not before it, or panes, a crowd or what reaches
/// into its housing stand between.
/// @param flush  flush_faces() of it
std::optional<std::vector<mesh::ConvexPiece>> seen_opening(const Scene& scene, const Luminaire& luminaire,
                                                           std::span<const mesh::FaceId> flush, const mesh::Point& at);

/// The same where it is known what may stand between them.
std::optional<std::vector<mesh::ConvexPiece>> seen_opening(const Luminaire& luminaire,
                                                           std::span<const std::span<const mesh::Point>> before,
                                                           const mesh::Point& at);

/// All of a flat rectangular luminous opening; nothing of another.
std::optional<mesh::ConvexPiece> whole_opening(const Luminaire& luminaire);

/// What parts of a flat luminous opening give of the mean over all of it: by quadratures over triangles, which are halved until one of degree five
/// [Radon 1948] agrees with one of degree two, or that, where it is to be rough, with the middle alone.
template <class Function>
class MeanOverParts {
 public:
  /// @param tolerance  share of the mean
  MeanOverParts(const Luminaire& luminaire, const Function& function, double tolerance)
      : area_m2_(luminaire.opening.x_m * luminaire.opening.y_m), function_(function), tolerance_(tolerance) {}

  [[nodiscard]] AreaMean mean(std::span<const mesh::ConvexPiece> parts) const {
    std::vector<Estimate> estimates;
    double whole = 0.0;
    for (const mesh::ConvexPiece& part : parts) {
      for (std::size_t i = 1; i + 1 < part.count; ++i) {
        estimates.push_back(estimate({part.corners[0], part.corners[i], part.corners[i + 1]}));
        whole += estimates.back().value;
      }
    }
    AreaMean result;
    for (const Estimate& e : estimates) add(e, tolerance_ * whole * share(e.corners), kHalvings, result);
    result.error = std::sqrt(result.error);
    return result;
  }

 private:
  using Corners = std::array<mesh::Point, 3>;
  static constexpr int kHalvings = 8;

  /// What a triangle gives.
  struct Estimate {
    Corners corners;
    double value = 0.0;
    double change = 0.0;  ///< from the quadrature of lower degree
  };

  [[nodiscard]] double share(const Corners& c) const { return 0.5 * norm(cross(c[1] - c[0], c[2] - c[0])) / area_m2_; }

  [[nodiscard]] double at(const Corners& c, double a, double b) const {
    return function_(c[0] + a * (c[1] - c[0]) + b * (c[2] - c[0]));
  }
  [[nodiscard]] double middle(const Corners& c) const { return at(c, 1.0 / 3.0, 1.0 / 3.0); }
  /// Sum over the corners of a smaller triangle: barycentric coordinates `near`, `near` and the rest.
  [[nodiscard]] double ring(const Corners& c, double near) const {
    const double rest = 1.0 - 2.0 * near;
    return at(c, near, near) + at(c, rest, near) + at(c, near, rest);
  }

  [[nodiscard]] Estimate estimate(const Corners& c) const {
    const double two = ring(c, 1.0 / 6.0) / 3.0;
    if (tolerance_ >= kRoughMean) return {c, share(c) * two, share(c) * std::abs(two - middle(c))};
    const double root = std::sqrt(15.0);
    const double five = 9.0 / 40.0 * middle(c) + (155.0 - root) / 1200.0 * ring(c, (6.0 - root) / 21.0) +
                        (155.0 + root) / 1200.0 * ring(c, (6.0 + root) / 21.0);
    return {c, share(c) * five, share(c) * std::abs(five - two)};
  }

  /// @param tolerance  of what the triangle gives
  void add(const Estimate& e, double tolerance, int left, AreaMean& result) const {
    if (e.change <= tolerance || left == 0) {
      result.value += e.value;
      result.error += e.change * e.change;
      return;
    }
    const Corners& c = e.corners;
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (norm(c[(k + 1) % 3] - c[k]) > norm(c[(longest + 1) % 3] - c[longest])) longest = k;
    }
    const mesh::Point& a = c[longest];
    const mesh::Point& b = c[(longest + 1) % 3];
    const mesh::Point& apex = c[(longest + 2) % 3];
    add(estimate({a, midpoint(a, b), apex}), 0.5 * tolerance, left - 1, result);
    add(estimate({midpoint(a, b), b, apex}), 0.5 * tolerance, left - 1, result);
  }

  double area_m2_;
  const Function& function_;
  double tolerance_;
};

}  // namespace clerestory::lighting
