// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/luminaire_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lighting/light_paths.h"
#include "lighting/luminaire_mounting.h"
#include "lighting/luminaire_view.h"

namespace clerestory::lighting {

using mesh::Point;
using mesh::Vector;

namespace {

/// The cosine of incidence of a ray on the side of a face that it meets.
double incidence(const Scene& scene, const mesh::Hit& hit, const Vector& direction) {
  return std::abs(dot(direction, scene.faces.faces[hit.face.index()].frame.w));
}

float glazing_share(const Scene& scene, const mesh::Hit& hit, const Vector& direction,
                    mesh::TransmittanceCurve GlazingCurves::*curve) {
  const std::int32_t glazing = scene.glazing_of[hit.face.index()];
  if (glazing < 0) return curve == &GlazingCurves::transmittance ? 1.0F : 0.0F;
  return mesh::transmittance_at(scene.glazings[static_cast<std::size_t>(glazing)].*curve,
                                static_cast<float>(incidence(scene, hit, direction)));
}

/// A luminaire that does not black itself out.
struct Lit {
  const Scene& scene;
  const Luminaire& luminaire;
  const std::vector<mesh::FaceId>& flush;

  /// Whether an opaque face that is met between two points of a ray is part of the luminaire, or what it is mounted in.
  [[nodiscard]] bool is_own(const mesh::Hit& hit, const Point& at, const Point& from) const {
    if (std::find(flush.begin(), flush.end(), hit.face) != flush.end()) return dot(from - at, luminaire.axes.w) < 0.0;
    const Vector own = luminaire.to_own(at - luminaire.at);
    const LuminousOpening& o = luminaire.opening;
    return std::abs(own.x) <= 0.5 * o.x_m + kHousingM && std::abs(own.y) <= 0.5 * o.y_m + kHousingM &&
           std::abs(own.z) <= 0.5 * o.z_m + kHousingM;
  }
};

/// What passes from a point towards another, up to the first meeting with `until` (not counted) where that is given.
struct Way {
  float passed = 1.0F;
  bool met = false;
  Point at;  ///< where `until` was met
  mesh::Hit hit;
};

Way way(const Lit& lit, const Point& start, const Point& to, mesh::FaceId until) {
  Way result;
  const Scene& scene = lit.scene;
  const Vector direction = normalized(to - start);
  Point from = start;
  for (int panes = 0; panes < kMostPanes; ++panes) {
    const double left = norm(to - from);
    const mesh::Hit hit = scene.rays->first_hit({from, direction});
    if (!hit.face.valid() || hit.distance >= left) return result;
    const Point at = from + hit.distance * direction;
    if (until.valid() && hit.face == until) {
      result.met = true;
      result.at = at;
      result.hit = hit;
      return result;
    }
    if (scene.passable[hit.face.index()] != 0) {
      result.passed *= glazing_share(scene, hit, direction, &GlazingCurves::transmittance);
    } else if (!lit.is_own(hit, at, start)) {
      break;
    }
    from = at + scene.rays->offset_m() * direction;
    if (dot(to - from, direction) <= 0.0) return result;
  }
  result.passed = 0.0F;
  return result;
}

/// Illuminance by one place of a luminous opening, as if all of the luminaire's light came from there.
double from_place(const Luminaire& luminaire, const Point& place, const Point& at, const Receiver& receiver) {
  const Vector d = place - at;
  const double distance2 = dot(d, d);
  const double kernel = receiver.kernel(d);
  if (kernel <= 0.0 || distance2 <= 0.0) return 0.0;
  const double distance = std::sqrt(distance2);
  return luminaire.intensity_cd(-d / distance) * kernel / (distance2 * distance);
}

/// Whether a luminaire is near enough for its opening to be more than a point.
bool is_near(const Luminaire& luminaire, const Point& at) {
  return norm(luminaire.at - at) < kFarInSizes * luminaire.opening.size_m();
}

AreaMean straight(const Lit& lit, const LuminaireView& view, const Point& at, const Receiver& receiver,
                  double tolerance) {
  const auto open = [&](const Point& place) { return from_place(lit.luminaire, place, at, receiver); };
  if (is_near(lit.luminaire, at)) {
    const auto parts = view.known ? seen_opening(lit.luminaire, view.before, at)
                                  : seen_opening(lit.scene, lit.luminaire, lit.flush, at);
    if (parts) return MeanOverParts(lit.luminaire, open, tolerance).mean(*parts);
  }
  if (view.clear()) return mean_over_opening(lit.luminaire, at, open, tolerance);
  return mean_over_opening(
      lit.luminaire, at,
      [&](const Point& place) {
        const double lux = from_place(lit.luminaire, place, at, receiver);
        return lux > 0.0 ? lux * way(lit, at, place, {}).passed : 0.0;
      },
      tolerance);
}

/// The mirror image of points and directions in a plane.
struct Mirror {
  Point origin;
  Vector w;  ///< unit normal

  [[nodiscard]] Vector of(const Vector& v) const { return v - 2.0 * dot(v, w) * w; }
  [[nodiscard]] Point of(const Point& p) const { return p - 2.0 * dot(p - origin, w) * w; }
};

/// Whether a point may see any of a luminaire's image in a pane: the cone to the ball round the image meets the rectangle round the pane.
bool may_mirror(const mesh::Faces& faces, const mesh::Face& pane, const Luminaire& image, const Point& at) {
  const Vector to = image.at - at;
  const double height = dot(pane.origin - at, pane.frame.w);
  const double along = height / dot(to, pane.frame.w);
  const Vector crossing = at + along * to - pane.origin;
  // The cone is cut at a slant.
  const double slant = norm(to) / std::abs(dot(to, pane.frame.w));
  const double radius = 0.5 * image.opening.size_m() * along * slant;
  std::array<double, 4> box{1e300, 1e300, -1e300, -1e300};
  for (const auto& loop : pane.loops) {
    for (const std::uint32_t vertex : loop) {
      const Vector d = faces.shape.vertices[vertex] - pane.origin;
      const double u = dot(d, pane.frame.u);
      const double v = dot(d, pane.frame.v);
      box = {std::min(box[0], u), std::min(box[1], v), std::max(box[2], u), std::max(box[3], v)};
    }
  }
  const double u = dot(crossing, pane.frame.u);
  const double v = dot(crossing, pane.frame.v);
  return u > box[0] - radius && u < box[2] + radius && v > box[1] - radius && v < box[3] + radius;
}

/// By one reflection in the pane of a face.
/// @param little  where all of the image gives less, its middle stands for it [lux]
AreaMean mirrored(const Lit& lit, mesh::FaceId face, const Point& at, const Receiver& receiver, double tolerance,
                  double little) {
  const Scene& scene = lit.scene;
  const mesh::Face& pane = scene.faces.faces[face.index()];
  const Mirror mirror{pane.origin, pane.frame.w};
  const double height = dot(at - pane.origin, mirror.w);
  if (dot(lit.luminaire.at - pane.origin, mirror.w) * height <= 0.0) return {};
  const Vector back = (height > 0.0 ? 1.0 : -1.0) * mirror.w;
  Luminaire image = lit.luminaire;
  image.at = mirror.of(image.at);
  image.axes = {mirror.of(image.axes.u), mirror.of(image.axes.v), mirror.of(image.axes.w)};
  if (!may_mirror(scene.faces, pane, image, at)) return {};
  const auto from = [&](const Point& place) {
    const double lux = from_place(image, place, at, receiver);
    if (lux <= 0.0) return 0.0;
    const Way to_pane = way(lit, at, place, face);
    if (!to_pane.met) return 0.0;
    const float share =
        glazing_share(scene, to_pane.hit, normalized(place - at), &GlazingCurves::reflectance) * to_pane.passed;
    if (share <= kLeastWeight) return 0.0;
    return lux * share * way(lit, to_pane.at + scene.rays->offset_m() * back, mirror.of(place), {}).passed;
  };
  const double cosine = std::abs(dot(normalized(image.at - at), mirror.w));
  const auto& curves = scene.glazings[static_cast<std::size_t>(scene.glazing_of[face.index()])];
  const double most = from_place(image, image.at, at, receiver) *
                      mesh::transmittance_at(curves.reflectance, static_cast<float>(cosine));
  if (most < little) {
    const double middle = from(image.at);
    return {middle, 0.5 * std::max(middle, most)};
  }
  return mean_over_opening(image, at, from, tolerance);
}

void add(const AreaMean& light, AreaMean& sum) {
  sum.value += light.value;
  sum.error = std::hypot(sum.error, light.error);
}

/// About the light of one luminaire, straight from its middle [lux].
double glance(const Scene& scene, std::size_t k, const Point& at, const Vector& normal) {
  const Luminaire& luminaire = scene.luminaires[k];
  const double lux = from_place(luminaire, luminaire.at, at, normal);
  return lux > 0.0 ? lux * way({scene, luminaire, scene.flush_faces[k]}, at, luminaire.at, {}).passed : 0.0;
}

}  // namespace

AreaMean illuminance_by(const Luminaire& luminaire, const Point& at, const Vector& normal) {
  const auto open = [&](const Point& place) { return from_place(luminaire, place, at, normal); };
  const auto whole = whole_opening(luminaire);
  if (whole && is_near(luminaire, at)) return MeanOverParts(luminaire, open, kFineMean).mean({&*whole, 1});
  return mean_over_opening(luminaire, at, open, kFineMean);
}

double luminaire_glance(const Scene& scene, const Point& at, const Vector& normal) {
  double sum = 0.0;
  for (std::size_t k = 0; k < scene.luminaires.size(); ++k) sum += glance(scene, k, at, normal);
  return sum;
}

double luminaire_guess(const Scene& scene, const Point& at, const Vector& normal, double pick) {
  constexpr std::size_t kPicked = 8;
  const std::size_t count = scene.luminaires.size();
  if (count <= kPicked) return luminaire_glance(scene, at, normal);
  const double each = static_cast<double>(count) / kPicked;
  double sum = 0.0;
  for (std::size_t i = 0; i < kPicked; ++i)
    sum += glance(scene, std::min(count - 1, static_cast<std::size_t>((static_cast<double>(i) + pick) * each)), at,
                  normal);
  return each * sum;
}

AreaMean luminaire_illuminance(const Scene& scene, std::span<const LuminaireView> views, const Point& at,
                               const Receiver& receiver, double tolerance) {
  GroupSums none;
  return luminaire_illuminance(scene, views, at, receiver, tolerance, 0.0, none);
}

AreaMean luminaire_illuminance(const Scene& scene, std::span<const LuminaireView> views, const Point& at,
                               const Receiver& receiver, double tolerance, double share, GroupSums& groups) {
  AreaMean sum;
  const auto add_to_group = [&](std::size_t k, const AreaMean& light) {
    add(light, sum);
    groups.add(scene.luminaire_group[k], share * light.value);
  };
  const auto lit = [&](std::size_t k) { return Lit{scene, scene.luminaires[k], scene.flush_faces[k]}; };
  for (const LuminaireView& view : views)
    add_to_group(view.luminaire, straight(lit(view.luminaire), view, at, receiver, tolerance));
  if (scene.luminaires.empty()) return sum;
  const double little = tolerance * sum.value;
  for (const mesh::FaceId pane : scene.panes) {
    for (std::size_t k = 0; k < scene.luminaires.size(); ++k)
      add_to_group(k, mirrored(lit(k), pane, at, receiver, tolerance, little));
  }
  return sum;
}

double seen_share(const Scene& scene, std::size_t luminaire, const Point& at) {
  const Luminaire& own = scene.luminaires[luminaire];
  const Vector towards = normalized(own.at - at);
  const Lit lit{scene, own, scene.flush_faces[luminaire]};
  const auto parts = seen_opening(scene, own, lit.flush, at);
  const auto whole = whole_opening(own);
  const auto open = [&](const Point& place) { return from_place(own, place, at, towards); };
  const MeanOverParts mean(own, open, kFineMean);
  const bool clipped = parts && whole;
  const double all = clipped ? mean.mean({&*whole, 1}).value : illuminance_by(own, at, towards).value;
  if (all <= 0.0) return 0.0;
  const double seen =
      clipped ? mean.mean(*parts).value
              : straight(lit, {static_cast<std::uint32_t>(luminaire), false, {}}, at, towards, kFineMean).value;
  return std::min(1.0, seen / all);
}

}  // namespace clerestory::lighting
