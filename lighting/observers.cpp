// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/observers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lighting/emitters.h"
#include "lighting/gather.h"
#include "lighting/lamp_bodies.h"
#include "lighting/luminaire_light.h"
#include "lighting/opening_sampler.h"
#include "lighting/sampling.h"

namespace clerestory::lighting {

using mesh::Point;
using mesh::Vector;

namespace {

/// Rays to each surface that shines, and to each facet of a lamp body.
constexpr std::uint32_t kRays = 256;
constexpr std::uint32_t kRaysOfFacet = 4;
/// What CIE 117 is made for [sr].
constexpr double kLeastSolidAngle = 0.0003;
constexpr double kMostSolidAngle = 0.1;
/// Of a line of sight that is all but upright, the head leans towards +y.
constexpr double kUpright = 0.999;
/// Less of a source than this is a rounding of its edge.
constexpr double kLeastShare = 1e-6;

View view_of(const Observer& observer, const Vector& origin) {
  View view{.eye = observer.eye - origin, .direction = observer.look};
  if (std::abs(observer.look.z) > kUpright) view.up = {0.0, 1.0, 0.0};
  return view;
}

void count(double solid_angle_sr, ObserverResult& counts) {
  if (solid_angle_sr <= 0.0) return;
  ++counts.glaring;
  if (solid_angle_sr < kLeastSolidAngle) ++counts.small;
  if (solid_angle_sr > kMostSolidAngle) ++counts.large;
}

void add_luminaire(const Scene& scene, std::size_t k, const View& view, ObserverResult& counts,
                   std::vector<GlareSource>& sources) {
  const Luminaire& luminaire = scene.luminaires[k];
  const Vector to = luminaire.at - view.eye;
  if (dot(to, view.direction) <= 0.0) return;
  const Vector direction = normalized(to);
  const double intensity_cd = luminaire.intensity_cd(-direction);
  if (intensity_cd <= 0.0) return;
  const double area_m2 = luminaire.opening.projected_area_m2(luminaire.to_own(-direction));
  if (!luminaire.opening.has_area() || area_m2 <= 0.0) {
    ++counts.without_area;
    return;
  }
  const double share = seen_share(scene, k, view.eye);
  if (share <= kLeastShare) return;
  const double solid_angle_sr = share * area_m2 / dot(to, to);
  count(solid_angle_sr, counts);
  sources.push_back({direction, intensity_cd / area_m2, solid_angle_sr});
}

/// Its visible parts as a source each, since a large surface has another position index here than there. Returns the solid angle seen [sr].
double add_emitter(const Solution& solution, const Emitter& emitter, const View& view, std::uint32_t rays,
                   std::vector<GlareSource>& sources) {
  const Scene& scene = solution.scene();
  const auto triangles = solution.tree().triangles(emitter.root);
  const Vector& normal = emitter.end.normal;
  const double height = dot(view.eye - triangles.front()[0], normal);
  if (height <= 0.0) return 0.0;
  const OpeningSampler sampler(view.eye, triangles);
  const SobolPoints points(emitter.root.index());
  double seen_sr = 0.0;
  for (std::uint32_t i = 0; i < rays; ++i) {
    const SolidAngleSample ray = sampler.sample(points.at(i, 0), points.at(i, 1));
    const double fall = -dot(ray.direction, normal);
    if (ray.solid_angle_sr <= 0.0 || fall <= 0.0 || dot(ray.direction, view.direction) <= 0.0) continue;
    const Point end = view.eye + height / fall * ray.direction + scene.rays->offset_m() * normal;
    const mesh::Segment segment{view.eye, end};
    float passed = 0.0F;
    scene.rays->transmittance({&segment, 1}, {&passed, 1});
    if (passed <= 0.0F) continue;
    const double part_sr = passed * ray.solid_angle_sr / rays;
    seen_sr += part_sr;
    sources.push_back({ray.direction, emitter.exitance / std::numbers::pi, part_sr});
  }
  return seen_sr;
}

/// The luminaires and surfaces that shine as an eye sees them, past what stands before them, with the counts of ObserverResult.
/// A luminaire's luminance is its intensity towards the eye by the area that its luminous opening shows there; what is hidden of it takes
/// its share off the solid angle. Surfaces that shine are seen by rays, even in solid angle.
/// @param view  local coordinates
std::vector<GlareSource> glare_sources(const Solution& solution, std::span<const Emitter> lamps,
                                       const LampBodies& bodies, const View& view, ObserverResult& counts) {
  std::vector<GlareSource> sources;
  const Scene& scene = solution.scene();
  for (std::size_t k = 0; k < scene.luminaires.size(); ++k) add_luminaire(scene, k, view, counts, sources);
  for (const std::uint32_t i : bodies.others()) count(add_emitter(solution, lamps[i], view, kRays, sources), counts);
  for (const LampBody& body : bodies.bodies()) {
    double seen_sr = 0.0;
    for (const BodyFacet& facet : body.facets)
      seen_sr += add_emitter(solution, lamps[facet.emitter], view, kRaysOfFacet, sources);
    count(seen_sr, counts);
  }
  return sources;
}

}  // namespace

std::vector<ObserverResult> observe(const Solution& solution, const SolutionErrors& errors,
                                    std::span<const Observer> observers, double accuracy, std::uint64_t seed,
                                    Progress& progress) {
  const Scene& scene = solution.scene();
  std::vector<Point> eyes;
  std::vector<Vector> looks;
  for (const Observer& observer : observers) {
    eyes.push_back(observer.eye - scene.faces.origin);
    looks.push_back(observer.look);
  }
  const Gathered gathered = gather(solution, errors, {eyes, looks}, accuracy, seed, progress);
  const std::vector<Emitter> lamps = emitters(solution);
  const LampBodies bodies(solution, lamps);
  std::vector<ObserverResult> results;
  for (std::size_t i = 0; i < observers.size(); ++i) {
    ObserverResult result;
    result.observer = observers[i];
    const std::uint32_t room = mesh::room_at(scene.rooms, *scene.rays, eyes[i]);
    if (room != mesh::kNoRoom) result.room = room;
    const View view = view_of(observers[i], scene.faces.origin);
    const std::vector<GlareSource> sources = glare_sources(solution, lamps, bodies, view, result);
    result.indirect_lux = gathered.indirect_lux[i];
    result.background_cd_m2 = result.indirect_lux / std::numbers::pi;
    result.ugr = unified_glare_rating(view, sources, result.background_cd_m2);
    // Of a logarithm: dUGR = 8 / ln 10 · dL_b / L_b.
    if (std::isfinite(result.ugr))
      result.ugr_error = 8.0 / std::numbers::ln10 * gathered.indirect_error_lux[i] / result.indirect_lux;
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace clerestory::lighting
