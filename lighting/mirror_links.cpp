// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/mirror_links.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lighting/light_paths.h"
#include "lighting/opening_sampler.h"
#include "lighting/parallel.h"
#include "lighting/replicates.h"
#include "lighting/sampling.h"
#include "lighting/seen_surfaces.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;

namespace {

/// Independently scrambled sets of rays, which tell the noise.
constexpr std::uint32_t kSets = 4;
/// A pane mirrors some tenth of the light, so that a few rays a link do, as a rule.
constexpr std::uint32_t kFewRays = 4;
constexpr std::uint32_t kRays = 16;
constexpr std::uint32_t kMostRays = 512;
/// How far single rays differ from what the pane shows on the mean, in terms of the mean: a lamp may fill a small part of it.
constexpr double kSpread = 2.0;

/// What the rays of one link to a pane end on.
struct Reflections {
  std::vector<SeenSurface> seen;
  double sky_lux = 0.0;
  std::vector<GroupLight> groups;  ///< that the sky's light is of
  double factor = 0.0;             ///< of the pane itself by the same rays
  double noise_lux = 0.0;

  void scale(double by) {
    for (SeenSurface& s : seen) s.factor *= static_cast<float>(by);
    sky_lux *= by;
    for (GroupLight& light : groups) light.lux *= by;
    noise_lux *= by;
  }
};

struct Collector {
  const Solution* solution;
  Reflections* into;
  GroupSums* groups;
  /// Of the ray; weights are shares of it, so that small elements' rays are not dropped for their smallness.
  double factor;

  void surface(const SurfacePoint& point, float weight, bool) {
    into->seen.push_back(seen_surface(*solution, point, static_cast<float>(factor) * weight));
  }
  void sky(const Vector& direction, float weight, bool) {
    const double per_luminance = factor * weight * std::numbers::pi;
    const double lux = per_luminance * sky_luminance(solution->scene().sky, direction);
    into->sky_lux += lux;
    add_sky_light(solution->scene(), direction, lux, per_luminance, *groups);
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
  Follower(const Solution& solution, const Clusters& clusters, const std::function<double(ElementId)>& tolerance_lux,
           std::uint64_t seed, const Progress& progress)
      : solution_(solution),
        clusters_(clusters),
        tolerance_lux_(tolerance_lux),
        seed_(mesh::hash(seed, 9)),
        progress_(progress) {}

  [[nodiscard]] Reflections follow_link(const Link& link) const {
    const mesh::ElementTree& tree = solution_.tree();
    const bool cluster = link.source.is_cluster();
    const std::uint64_t other = cluster ? link.source.cluster() : tree.key(link.source.element());
    const std::uint64_t key = mesh::hash(mesh::hash(tree.key(link.receiver), other), seed_);
    const std::uint32_t rays = rays_for(link);
    std::vector<std::array<Point, 3>> pane;
    if (!cluster) pane = tree.triangles(link.source.element());
    Reflections result;
    GroupSums groups(scene().groups);
    std::array<double, kSets> lux{};
    for (std::uint32_t set = 0; set < kSets; ++set) {
      const SobolPoints numbers(mesh::hash(key, set));
      const std::size_t first = result.seen.size();
      const double sky_before = result.sky_lux;
      for (std::uint32_t i = 0; i < rays / kSets; ++i) {
        const Aim aim = cluster ? at_cluster(link, numbers, i) : at_element(link, pane, numbers, i);
        if (aim.factor > 0.0) reflect(aim, aim.factor / rays, result, groups);
      }
      lux[set] =
          kSets * (result.sky_lux - sky_before + illuminance_by(solution_, std::span(result.seen).subspan(first)));
    }
    result.groups = groups.lit();
    result.noise_lux = mean_of_replicates(lux).standard_error();
    // The link knows the pane's form factor better than these rays do.
    if (!cluster && result.factor > 0.0) result.scale(link.factor / result.factor);
    return result;
  }

 private:
  [[nodiscard]] const Scene& scene() const { return solution_.scene(); }

  /// By what the pane sends as a matt surface.
  [[nodiscard]] std::uint32_t rays_for(const Link& link) const {
    const double bright = link.source.is_cluster() ? clusters_.radiosity_mean(link.source.cluster())
                                                   : solution_.radiosity_mean(link.source.element());
    const double wanted = std::pow(kSpread * link.factor * bright / tolerance_lux_(link.receiver), 2.0);
    if (progress_.should_finish()) return kFewRays;
    std::uint32_t rays = link.rough ? kFewRays : kRays;
    while (rays < wanted && rays < kMostRays) rays *= 2;
    return rays;
  }

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

  void reflect(const Aim& aim, double factor, Reflections& result, GroupSums& groups) const {
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
    Collector collector{&solution_, &result, &groups, factor};
    follow(scene(), before, onwards, passed * mirrored, PathRule{PathRule::Part::kAll, -1, true}, collector, 1);
  }

  const Solution& solution_;
  const Clusters& clusters_;
  const std::function<double(ElementId)>& tolerance_lux_;
  std::uint64_t seed_;
  const Progress& progress_;
};

}  // namespace

MirroredLight follow_mirrors(const Solution& solution, const Clusters& clusters, std::span<const Link> to_panes,
                             const std::function<double(ElementId)>& tolerance_lux, std::uint64_t seed,
                             const Progress& progress) {
  const Follower follower(solution, clusters, tolerance_lux, seed, progress);
  std::vector<Reflections> reflections(to_panes.size());
  parallel_for(to_panes.size(), [&](std::size_t i) { reflections[i] = follower.follow_link(to_panes[i]); });
  MirroredLight result;
  for (std::size_t i = 0; i < to_panes.size(); ++i) {
    const Link& link = to_panes[i];
    LinearValue slope{1.0F, 0.0F, 0.0F};
    if (link.factor > 0.0F) slope = {1.0F, link.slope_u / link.factor, link.slope_v / link.factor};
    const std::vector<Link> links = links_to_seen(solution, link.receiver, reflections[i].seen, slope);
    result.links.insert(result.links.end(), links.begin(), links.end());
    result.noise.push_back({link.receiver, reflections[i].noise_lux});
    const auto sky = static_cast<float>(reflections[i].sky_lux);
    if (sky > 0.0F) result.sky.push_back({link.receiver, {sky, sky * slope.slope_u, sky * slope.slope_v}});
    for (const GroupLight& light : reflections[i].groups) {
      const auto lux = static_cast<float>(light.lux);
      result.groups.push_back({link.receiver, light.group, {lux, lux * slope.slope_u, lux * slope.slope_v}});
    }
  }
  return result;
}

}  // namespace clerestory::lighting
