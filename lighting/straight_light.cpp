// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/straight_light.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <utility>

#include "lighting/form_factor.h"
#include "lighting/light_paths.h"
#include "lighting/opening_sampler.h"
#include "lighting/point_light.h"
#include "lighting/sampling.h"
#include "mesh/hash.h"
#include "mesh/seen_parts.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// Towards openings that hardly matter.
constexpr std::uint32_t kFewRays = 4;
/// Where more stand before a lamp, rays are quicker than clipping.
constexpr std::size_t kMostBlockers = 32;
/// The same random numbers serve at all points: differences between these are then the light's own.
constexpr std::uint64_t kSeed = 0x57A1;

/// Adds up the light of rays, channel by channel.
struct Collector {
  const Solution* solution;
  bool surfaces_count = true;
  double weight = 1.0;
  std::vector<double>* lux;

  void surface(const SurfacePoint& seen, float passed, bool with_emission) {
    if (!surfaces_count) return;
    const ElementId e = solution->element_at(seen.side, seen.region, seen.at);
    if (!e.valid()) return;
    for (std::size_t c = 0; c < lux->size(); ++c) {
      (*lux)[c] += weight * passed * solution->radiosity_at(e, seen.at, c, with_emission);
    }
  }
  void sky(const Vector& direction, float passed, bool) {
    const double sent = std::numbers::pi * sky_luminance(solution->scene().sky, direction);
    for (double& l : *lux) l += weight * passed * sent;
  }
};

LinearValue moved(const LinearValue& line, const Vector& d, const mesh::Frame& axes) {
  return {line.value + line.slope_u * static_cast<float>(dot(d, axes.u)) +
              line.slope_v * static_cast<float>(dot(d, axes.v)),
          line.slope_u, line.slope_v};
}

}  // namespace

StraightLight::StraightLight(const Solution& solution, DirectLight direct, std::span<const Link> links,
                             std::uint32_t rays)
    : solution_(solution),
      nodes_(std::move(direct.nodes)),
      node_at_(solution.tree().size(), kNone),
      straight_(solution.tree().size() * solution.channels()),
      rays_(rays) {
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    node_at_[nodes_[i].node.index()] = i;
    for (std::size_t c = 0; c < solution.channels(); ++c) {
      straight_[nodes_[i].node.index() * solution.channels() + c] = nodes_[i].received;
    }
  }
  for (const Link& link : direct.links) add_link(link);
  for (const Link& link : links) {
    if (link.by_rays) continue;
    add_emitter(link);
    if (link.mutual) add_emitter(reversed(link, solution.tree()));
  }
  std::stable_sort(emitters_.begin(), emitters_.end(),
                   [](const Emitter& a, const Emitter& b) { return a.receiver < b.receiver; });
}

void StraightLight::add_link(const Link& link) {
  for (std::size_t c = 0; c < solution_.channels(); ++c) {
    const Solution::Sent sent = solution_.sent(link.source.element(), c);
    LinearValue& sum = straight_[link.receiver.index() * solution_.channels() + c];
    sum.value += link.factor * sent.value + link.moment_u * sent.moments.u + link.moment_v * sent.moments.v;
    sum.slope_u += link.slope_u * sent.value;
    sum.slope_v += link.slope_v * sent.value;
  }
}

/// Bundles of lamps far away stay as the solution has them.
void StraightLight::add_emitter(const Link& link) {
  if (link.source.is_cluster()) return;
  const ElementId source = link.source.element();
  if (!solution_.scene().shines(solution_.tree().face_side(source))) return;
  add_link(link);
  emitters_.push_back({link.receiver, source, link.visibility == mesh::Visibility::kVisible});
}

double StraightLight::in_solution(ElementId element, const Point& point, std::size_t channel) const {
  const mesh::ElementTree& tree = solution_.tree();
  double sum = 0.0;
  for (ElementId up = element; up.valid(); up = tree.parent(up)) {
    const LinearValue& line = straight_[up.index() * solution_.channels() + channel];
    sum += moved(line, point - tree.centroid(up), tree.axes(up)).value;
  }
  return sum;
}

std::optional<std::vector<double>> StraightLight::at(ElementId element, const Point& point) const {
  if (!(solution_.closing(element) == LinearValue{1.0F, 0.0F, 0.0F})) return std::nullopt;
  const mesh::ElementTree& tree = solution_.tree();
  const Scene& scene = solution_.scene();
  const Vector& normal = tree.normal(element);
  const Point from = point + scene.rays->offset_m() * normal;
  std::vector<double> lux(solution_.channels(), point_source_illuminance(scene, from, normal));
  for (ElementId up = element; up.valid(); up = tree.parent(up)) {
    if (const std::uint32_t i = node_at_[up.index()]; i != kNone) {
      for (const std::uint32_t k : nodes_[i].openings) through_opening(k, rays_, from, normal, lux);
      for (const std::uint32_t k : nodes_[i].minor) through_opening(k, kFewRays, from, normal, lux);
      if (nodes_[i].open_sky) from_open_sky(from, normal, lux);
    }
    const auto [first, last] =
        std::equal_range(emitters_.begin(), emitters_.end(), Emitter{up, {}, false},
                         [](const Emitter& a, const Emitter& b) { return a.receiver < b.receiver; });
    for (auto emitter = first; emitter != last; ++emitter) from_emitter(*emitter, from, normal, lux);
  }
  return lux;
}

void StraightLight::through_opening(std::uint32_t opening, std::uint32_t rays, const Point& from, const Vector& normal,
                                    std::vector<double>& lux) const {
  const Scene& scene = solution_.scene();
  const OpeningSampler sampler(from, scene.openings[opening].triangles);
  const SobolPoints numbers(mesh::hash(kSeed, opening));
  for (std::uint32_t i = 0; i < rays; ++i) {
    const SolidAngleSample s = sampler.sample(numbers.at(i, 0), numbers.at(i, 1));
    const double cosine = dot(s.direction, normal);
    if (s.solid_angle_sr <= 0.0 || cosine <= 0.0 || dot(s.direction, scene.openings[opening].outward) <= 0.0) continue;
    Collector collector{&solution_, true, s.solid_angle_sr * cosine / (std::numbers::pi * rays), &lux};
    follow(scene, from, s.direction, 1.0F, {PathRule::Part::kOpening, static_cast<std::int32_t>(opening), true},
           collector);
  }
}

void StraightLight::from_open_sky(const Point& from, const Vector& normal, std::vector<double>& lux) const {
  const mesh::Frame frame = mesh::frame_around(normal);
  const SobolPoints numbers(kSeed);
  for (std::uint32_t i = 0; i < rays_; ++i) {
    Collector collector{&solution_, false, 1.0 / rays_, &lux};
    follow(solution_.scene(), from, cosine_direction(frame, numbers.at(i, 0), numbers.at(i, 1)), 1.0F,
           {PathRule::Part::kGather, -1, false}, collector);
  }
}

void StraightLight::from_emitter(const Emitter& emitter, const Point& from, const Vector& normal,
                                 std::vector<double>& lux) const {
  const mesh::ElementTree& tree = solution_.tree();
  std::array<mesh::OutlineEdge, 3> scratch;
  double factor = point_form_factor(from, normal, tree.outline(emitter.source, scratch), tree.normal(emitter.source));
  if (factor <= 0.0) return;
  if (!emitter.wholly_seen) {
    const auto exact = seen_factor(emitter.source, from, normal);
    factor = exact ? *exact : factor * seen_share(emitter.source, from, normal);
  }
  for (std::size_t c = 0; c < lux.size(); ++c) lux[c] += factor * solution_.radiosity(emitter.source)[c];
}

/// The form factor of what is seen of a surface, triangle by triangle; nothing where panes or a crowd stand before it.
std::optional<double> StraightLight::seen_factor(ElementId source, const Point& from, const Vector& normal) const {
  const mesh::ElementTree& tree = solution_.tree();
  const Vector& facing = tree.normal(source);
  std::array<mesh::OutlineEdge, mesh::ConvexPiece::kMostCorners> scratch;
  double factor = 0.0;
  for (const std::array<Point, 3>& triangle : tree.triangles(source)) {
    const mesh::ShaftEnd eye{.corners = {from}, .count = 1, .normal = {}};
    const mesh::ShaftEnd lamp{
        .corners = {triangle[0], triangle[1], triangle[2]}, .count = triangle.size(), .normal = facing};
    const auto blockers = solution_.scene().shafts->blockers(eye, lamp, kMostBlockers);
    if (!blockers) return std::nullopt;
    const auto parts = mesh::seen_parts(from, triangle, *blockers);
    if (!parts) return std::nullopt;
    for (const mesh::ConvexPiece& part : *parts)
      factor += point_form_factor(from, normal, part.outline(scratch), facing);
  }
  return factor;
}

/// The share of a surface's light that comes through, by rays, each place weighed by what it gives.
double StraightLight::seen_share(ElementId source, const Point& from, const Vector& normal) const {
  const mesh::ElementTree& tree = solution_.tree();
  const Vector& facing = tree.normal(source);
  const double lift = solution_.scene().rays->offset_m();
  const SobolPoints numbers(mesh::hash(kSeed, tree.key(source)));
  std::vector<mesh::Segment> segments(rays_);
  std::vector<double> kernel(rays_);
  std::vector<float> passed(rays_);
  for (std::uint32_t i = 0; i < rays_; ++i) {
    const Point q = tree.sample(source, numbers.at(i, 0), numbers.at(i, 1));
    const Vector to = q - from;
    const double distance2 = dot(to, to);
    kernel[i] = std::max(0.0, dot(to, normal)) * std::max(0.0, -dot(to, facing)) / (distance2 * distance2);
    segments[i] = {from, q + lift * facing};
  }
  solution_.scene().rays->transmittance(segments, passed);
  double seen = 0.0;
  double all = 0.0;
  for (std::uint32_t i = 0; i < rays_; ++i) {
    seen += kernel[i] * passed[i];
    all += kernel[i];
  }
  return all > 0.0 ? seen / all : 0.0;
}

}  // namespace clerestory::lighting
