// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/mirror_links.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "lighting/light_paths.h"
#include "lighting/opening_sampler.h"
#include "lighting/parallel.h"
#include "lighting/sampling.h"
#include "lighting/seen_surfaces.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;

namespace {

/// A pane mirrors some tenth of the light, so that a few rays a link do; they are as many as visibility gets in links.
constexpr std::uint32_t kRays = 16;
constexpr std::uint32_t kFewRays = 4;

/// What the rays of one link to a pane end on.
struct Reflections {
  std::vector<SeenSurface> seen;
  double sky_lux = 0.0;
  double factor = 0.0;  ///< of the pane itself by the same rays

  void scale(double by) {
    for (SeenSurface& s : seen) s.factor *= static_cast<float>(by);
    sky_lux *= by;
  }
};

struct Collector {
  const Solution* solution;
  Reflections* into;

  void surface(const SurfacePoint& point, float weight, bool) {
    into->seen.push_back(seen_surface(*solution, point, weight));
  }
  void sky(const Vector& direction, float weight, bool) {
    into->sky_lux += weight * std::numbers::pi * sky_luminance(solution->scene().sky, direction);
  }
};

/// A ray from a receiver to a pane.
struct Aim {
  Point from;
  Point at;
  ElementId pane;
  Vector direction;
  double factor = 0.0;  ///< form factor that the ray stands for
};

class Follower {
 public:
  Follower(const Solution& solution, const Clusters& clusters, std::uint64_t seed)
      : solution_(solution), clusters_(clusters), seed_(mesh::hash(seed, 9)) {}

  [[nodiscard]] Reflections follow_link(const Link& link) const {
    const mesh::ElementTree& tree = solution_.tree();
    const bool cluster = link.source.is_cluster();
    const std::uint64_t other = cluster ? link.source.cluster() : tree.key(link.source.element());
    const SobolPoints numbers(mesh::hash(mesh::hash(tree.key(link.receiver), other), seed_));
    const std::uint32_t rays = link.rough ? kFewRays : kRays;
    std::vector<std::array<Point, 3>> pane;
    if (!cluster) pane = tree.triangles(link.source.element());
    Reflections result;
    for (std::uint32_t i = 0; i < rays; ++i) {
      const Aim aim = cluster ? at_cluster(link, numbers, i) : at_element(link, pane, numbers, i);
      if (aim.factor > 0.0) reflect(aim, aim.factor / rays, result);
    }
    // The link knows the pane's form factor better than these rays do.
    if (!cluster && result.factor > 0.0) result.scale(link.factor / result.factor);
    return result;
  }

 private:
  [[nodiscard]] const Scene& scene() const { return solution_.scene(); }

  /// By solid angle, so that panes next to the receiver make no outliers.
  [[nodiscard]] Aim at_element(const Link& link, std::span<const std::array<Point, 3>> pane, const SobolPoints& numbers,
                               std::uint32_t i) const {
    const mesh::ElementTree& tree = solution_.tree();
    const Vector& normal = tree.normal(link.receiver);
    Aim aim;
    aim.pane = link.source.element();
    aim.from = tree.sample(link.receiver, numbers.at(i, 0), numbers.at(i, 1)) + scene().rays->offset_m() * normal;
    const OpeningSampler sampler(aim.from, pane);
    const SolidAngleSample s = sampler.sample(numbers.at(i, 2), numbers.at(i, 3));
    const Vector& facing = tree.normal(aim.pane);
    const double cosine = -dot(s.direction, facing);
    if (s.solid_angle_sr <= 0.0 || cosine <= 0.0) return aim;
    aim.direction = s.direction;
    aim.at = aim.from + (dot(aim.from - tree.centroid(aim.pane), facing) / cosine) * s.direction;
    aim.factor = s.solid_angle_sr * std::max(0.0, dot(s.direction, normal)) / std::numbers::pi;
    return aim;
  }

  [[nodiscard]] Aim at_cluster(const Link& link, const SobolPoints& numbers, std::uint32_t i) const {
    const mesh::ElementTree& tree = solution_.tree();
    const Vector& normal = tree.normal(link.receiver);
    const std::uint32_t c = link.source.cluster();
    Aim aim;
    aim.from = tree.sample(link.receiver, numbers.at(i, 0), numbers.at(i, 1)) + scene().rays->offset_m() * normal;
    const ClusterPoint q = clusters_.sample(tree, c, numbers.at(i, 2), numbers.at(i, 3));
    aim.pane = q.root;
    aim.at = q.at;
    const Vector to = q.at - aim.from;
    const double distance2 = dot(to, to);
    const double cosines = std::max(0.0, dot(to, normal)) * std::max(0.0, -dot(to, q.normal));
    if (cosines <= 0.0) return aim;
    aim.direction = normalized(to);
    aim.factor = clusters_.area(c) * cosines / (std::numbers::pi * distance2 * distance2);
    return aim;
  }

  void reflect(const Aim& aim, double factor, Reflections& result) const {
    const mesh::FaceSide side = solution_.tree().face_side(aim.pane);
    const Vector& facing = solution_.tree().normal(aim.pane);
    const Point before = aim.at + scene().rays->offset_m() * facing;
    const mesh::Segment segment{aim.from, before};
    float passed = 0.0F;
    scene().rays->transmittance({&segment, 1}, {&passed, 1});
    if (passed <= 0.0F) return;
    result.factor += factor * passed;
    const std::int32_t glazing = scene().glazing_of[side.face.index()];
    if (glazing < 0) return;
    const double cosine = -dot(aim.direction, facing);
    const float mirrored = mesh::transmittance_at(scene().glazings[static_cast<std::size_t>(glazing)].reflectance,
                                                  static_cast<float>(cosine));
    const Vector onwards = normalized(aim.direction + (2.0 * cosine) * facing);
    Collector collector{&solution_, &result};
    follow(scene(), before, onwards, static_cast<float>(factor) * passed * mirrored,
           PathRule{PathRule::Part::kAll, -1, true}, collector, 1);
  }

  const Solution& solution_;
  const Clusters& clusters_;
  std::uint64_t seed_;
};

}  // namespace

MirroredLight follow_mirrors(const Solution& solution, const Clusters& clusters, std::span<const Link> to_panes,
                             std::uint64_t seed) {
  const Follower follower(solution, clusters, seed);
  std::vector<Reflections> reflections(to_panes.size());
  parallel_for(to_panes.size(), [&](std::size_t i) { reflections[i] = follower.follow_link(to_panes[i]); });
  MirroredLight result;
  for (std::size_t i = 0; i < to_panes.size(); ++i) {
    const Link& link = to_panes[i];
    LinearValue slope{1.0F, 0.0F, 0.0F};
    if (link.factor > 0.0F) slope = {1.0F, link.slope_u / link.factor, link.slope_v / link.factor};
    const std::vector<Link> links = links_to_seen(solution, link.receiver, reflections[i].seen, slope);
    result.links.insert(result.links.end(), links.begin(), links.end());
    const auto sky = static_cast<float>(reflections[i].sky_lux);
    if (sky > 0.0F) result.sky.push_back({link.receiver, {sky, sky * slope.slope_u, sky * slope.slope_v}});
  }
  return result;
}

}  // namespace clerestory::lighting
