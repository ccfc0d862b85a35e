// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/point_light.h"

#include <algorithm>
#include <cmath>

#include "lighting/light_paths.h"

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

/// What passes from a point towards another, up to the first meeting with `until` (not counted) where that is given.
struct Way {
  float passed = 1.0F;
  bool met = false;
  Point at;  ///< where `until` was met
  mesh::Hit hit;
};

Way way(const Scene& scene, Point from, const Point& to, mesh::FaceId until) {
  Way result;
  const Vector direction = normalized(to - from);
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
    if (scene.passable[hit.face.index()] == 0) break;
    result.passed *= glazing_share(scene, hit, direction, &GlazingCurves::transmittance);
    from = at + scene.rays->offset_m() * direction;
  }
  result.passed = 0.0F;
  return result;
}

double straight(const Scene& scene, const PointSource& source, const Point& at, const Vector& normal) {
  const double lux = point_illuminance(source, at, normal);
  return lux > 0.0 ? lux * way(scene, at, source.at, {}).passed : 0.0;
}

/// By one reflection in the pane of a face.
double mirrored(const Scene& scene, const PointSource& source, mesh::FaceId face, const Point& at,
                const Vector& normal) {
  const mesh::Face& pane = scene.faces.faces[face.index()];
  const mesh::Vector& w = pane.frame.w;
  const double source_height = dot(source.at - pane.origin, w);
  const double height = dot(at - pane.origin, w);
  if (source_height * height <= 0.0) return 0.0;
  const PointSource image{.at = source.at - 2.0 * source_height * w,
                          .aim = source.aim - 2.0 * dot(source.aim, w) * w,
                          .intensity_cd = source.intensity_cd,
                          .lambertian = source.lambertian};
  const double lux = point_illuminance(image, at, normal);
  if (lux <= 0.0) return 0.0;
  const Way to_pane = way(scene, at, image.at, face);
  if (!to_pane.met) return 0.0;
  const float share =
      glazing_share(scene, to_pane.hit, normalized(image.at - at), &GlazingCurves::reflectance) * to_pane.passed;
  if (share <= kLeastWeight) return 0.0;
  const Vector back = (height > 0.0 ? 1.0 : -1.0) * w;
  return lux * share * way(scene, to_pane.at + scene.rays->offset_m() * back, source.at, {}).passed;
}

}  // namespace

double point_illuminance(const PointSource& source, const Point& at, const Vector& normal) {
  const Vector d = source.at - at;
  const double distance2 = dot(d, d);
  const double cosine = dot(d, normal);
  if (cosine <= 0.0 || distance2 <= 0.0) return 0.0;
  const double distance = std::sqrt(distance2);
  const double towards = source.lambertian ? std::max(0.0, -dot(d, source.aim) / distance) : 1.0;
  return source.intensity_cd * towards * cosine / (distance2 * distance);
}

double point_source_illuminance(const Scene& scene, const Point& at, const Vector& normal) {
  double sum = 0.0;
  for (const PointSource& source : scene.point_sources) {
    sum += straight(scene, source, at, normal);
    for (std::size_t f = 0; f < scene.faces.count(); ++f) {
      if (scene.glazing_of[f] >= 0) sum += mirrored(scene, source, mesh::FaceId(f), at, normal);
    }
  }
  return sum;
}

}  // namespace clerestory::lighting
