// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/linker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lighting/form_factor.h"
#include "lighting/linear_fit.h"
#include "lighting/sampling.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::OutlineEdge;
using mesh::Point;
using mesh::Vector;
using mesh::Visibility;

namespace {

constexpr std::size_t kPlaces = 16;        ///< on a piece, at most
constexpr std::size_t kRays = 24;          ///< or a little more, from all places to a source of partial visibility
constexpr std::size_t kClusterRays = 16;
constexpr double kSmallest = 0.015;        ///< elements of a smaller radius are not split [m]
constexpr float kLeastReflectance = 0.02F;  ///< black receivers get links too, but few
/// Products of outlines up to this are integrated exactly; beyond it the mean of the places does.
constexpr std::size_t kExactPairs = 64;
constexpr double kInFront = 1e-9;          ///< a corner this far in front of a plane counts as in front [m]

/// How a convex hull lies to a plane.
struct Lie {
  bool any_in_front = false;
  bool all_in_front = true;
};

Lie lie_of(const mesh::ShaftEnd& hull, const Point& origin, const Vector& normal) {
  Lie lie;
  for (std::size_t i = 0; i < hull.count; ++i) {
    const double h = dot(hull.corners[i] - origin, normal);
    lie.any_in_front = lie.any_in_front || h > kInFront;
    lie.all_in_front = lie.all_in_front && h > -kInFront;
  }
  return lie;
}

mesh::ShaftEnd end_of(const mesh::ElementTree& tree, ElementId e) {
  mesh::ShaftEnd end;
  end.count = tree.hull(e, end.corners);
  end.normal = tree.normal(e);
  return end;
}

/// Places on a piece with weights that add up to 1: the same in all links, so that what several sources add up to is consistent.
struct Places {
  std::array<Point, kPlaces> at;
  std::array<double, kPlaces> weight{};
  std::size_t count = 0;

  void add(const Point& p, double w) {
    at[count] = p;
    weight[count++] = w;
  }
};

/// The rule of degree 5 on a triangle. Source: Radon 1948; Stroud, Approximate Calculation of Multiple Integrals, T2:5-1.
void add_triangle(const std::array<Point, 3>& c, const Point& centre, double share, Places& places) {
  constexpr double kNear = 0.4701420641051151;  // barycentric coordinates (1 - 2a, a, a)
  constexpr double kFar = 0.1012865073234563;
  constexpr double kNearWeight = 0.1323941527885062;
  constexpr double kFarWeight = 0.1259391805448271;
  places.add(centre, 0.225 * share);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector out = c[i] - centre;
    places.add(centre + (1.0 - 3.0 * kNear) * out, kNearWeight * share);
    places.add(centre + (1.0 - 3.0 * kFar) * out, kFarWeight * share);
  }
}

/// Triangles, and groups of two of them, get the rule of degree 5; larger groups stratified places.
Places places_on(const mesh::ElementTree& tree, ElementId e) {
  Places places;
  if (tree.is_triangle(e)) {
    add_triangle(tree.corners(e), tree.centroid(e), 1.0, places);
  } else if (tree.start_triangle_count(e) == 2) {
    for (std::size_t k = 0; k < 2; ++k) {
      const ElementId child(tree.first_child(e).index() + k);
      add_triangle(tree.corners(child), tree.centroid(child), tree.area(child) / tree.area(e), places);
    }
  } else {
    const SobolPoints points(tree.key(e));
    for (std::uint32_t i = 0; i < kPlaces; ++i) {
      places.add(tree.sample(e, points.at(i, 0), points.at(i, 1)), 1.0 / kPlaces);
    }
  }
  return places;
}

/// How the receiver's mean irradiance follows the first moments of the source's radiosity: by reciprocity the slopes of the
/// form factor from the source's points to the receiver, times A_s / A_r. Visibility enters by its mean.
void add_moments(const mesh::ElementTree& tree, const mesh::ShaftEnd& end_r, const mesh::ShaftEnd& end_s, double visible,
                 Link& link) {
  constexpr double kFar = 0.05;  // sources that look this small from the receiver are seen alike all over [rad]
  const ElementId r = link.receiver;
  const ElementId s = link.source.element();
  if (tree.radius(s) < kFar * norm(tree.centroid(s) - tree.centroid(r))) return;
  std::array<OutlineEdge, 3> scratch;
  const auto outline = tree.outline(r, scratch);
  const Places places = places_on(tree, s);
  std::array<PlaneSample, kPlaces> samples;
  for (std::size_t i = 0; i < places.count; ++i) {
    const Vector d = places.at[i] - tree.centroid(s);
    samples[i] = {dot(d, tree.axes(s).u), dot(d, tree.axes(s).v),
                  point_form_factor(places.at[i], end_s.normal, outline, end_r.normal), places.weight[i]};
  }
  const LinearFit fit = fit_line(std::span(samples).first(places.count), false);
  const double ratio = visible * tree.area(s) / tree.area(r);
  link.moment_u = static_cast<float>(ratio * fit.line.slope_u);
  link.moment_v = static_cast<float>(ratio * fit.line.slope_v);
}

/// Standard error of a factor whose visibility was sampled. A few rays that all pass, or all fail, prove nothing: the share that
/// passes is estimated with half a ray added to either outcome [Agresti, Coull 1998].
double visibility_noise(double factor, double rays, double passing) {
  if (rays <= 0.0) return 0.0;
  const double share = (passing + 0.5) / (rays + 1.0);
  return factor * std::sqrt(share * (1.0 - share) / rays);
}

}  // namespace

Linker::Linker(const Solution& solution, const Clusters& clusters, const Importance& importance, double tolerance_lux,
               std::uint64_t seed)
    : solution_(solution), clusters_(clusters), importance_(importance), tolerance_lux_(tolerance_lux), seed_(seed) {}

double Linker::tolerance(ElementId receiver) const {
  const Scene& scene = solution_.scene();
  const mesh::FaceSide side = solution_.tree().face_side(receiver);
  const float rho = std::max(kLeastReflectance, luminance(scene.side_reflectance(side), scene.channel_weights));
  return tolerance_lux_ / (rho * importance_.of(solution_.tree(), receiver));
}

bool Linker::holds(const Link& link) const {
  double mean = 0.0;
  double deviation = 0.0;
  if (link.source.is_cluster()) {
    mean = clusters_.radiosity_mean(link.source.cluster());
    deviation = clusters_.radiosity_deviation(link.source.cluster());
  } else {
    mean = solution_.radiosity_mean(link.source.element());
    deviation = solution_.radiosity_deviation(link.source.element());
  }
  // How much the parts of the source differ, counts as far as the receiver sees them under different factors.
  const mesh::ElementTree& tree = solution_.tree();
  const double radius = link.source.is_cluster() ? clusters_.radius(link.source.cluster())
                                                 : tree.radius(link.source.element());
  const Point& centre = link.source.is_cluster() ? clusters_.centre(link.source.cluster())
                                                 : tree.centroid(link.source.element());
  const double distance = std::max(1e-9, norm(centre - tree.centroid(link.receiver)));
  const double unevenness = link.source.is_cluster() ? 1.0 : std::min(1.0, radius / distance);
  const double error = link.error * mean + link.factor * deviation * unevenness;
  return error <= tolerance(link.receiver);
}

LinkDecision::Kind Linker::split_of(const Link& link) const {
  using Kind = LinkDecision::Kind;
  const mesh::ElementTree& tree = solution_.tree();
  const double own = tree.radius(link.receiver);
  if (link.source.is_cluster()) {
    const bool can = own > kSmallest;
    return can && own > 2.0 * clusters_.radius(link.source.cluster()) ? Kind::kSplitReceiver : Kind::kSplitSource;
  }
  const ElementId s = link.source.element();
  const double other = tree.radius(s);
  const bool uneven = solution_.radiosity_deviation(s) > 0.02F * solution_.radiosity_mean(s);
  // A proven view of an even source gains nothing by splitting the source: its factor is exact.
  const bool receiver_first = (link.visibility == Visibility::kVisible && !uneven) || own >= other;
  if (receiver_first && own > kSmallest) return Kind::kSplitReceiver;
  if (other > kSmallest) return Kind::kSplitSource;
  return own > kSmallest ? Kind::kSplitReceiver : Kind::kLink;
}

bool Linker::overlaps(ElementId receiver, std::uint32_t cluster) const {
  const mesh::ElementTree& tree = solution_.tree();
  const mesh::Box& box = clusters_.box(cluster);
  const Point& p = tree.centroid(receiver);
  const Point nearest{std::clamp(p.x, box.low.x, box.high.x), std::clamp(p.y, box.low.y, box.high.y),
                      std::clamp(p.z, box.low.z, box.high.z)};
  return norm(nearest - p) < tree.radius(receiver) + 0.5 * clusters_.radius(cluster);
}

LinkDecision Linker::decide(const LinkCandidate& candidate) const {
  using Kind = LinkDecision::Kind;
  LinkDecision decision;
  std::optional<Link> link;
  if (candidate.source.is_cluster()) {
    if (overlaps(candidate.receiver, candidate.source.cluster())) return {Kind::kSplitSource, {}};
    link = link_cluster(candidate);
  } else {
    link = link_element(candidate);
  }
  if (!link) return decision;
  decision.link = *link;
  decision.kind = holds(*link) ? Kind::kLink : split_of(*link);
  return decision;
}

std::optional<Link> Linker::link_element(const LinkCandidate& candidate) const {
  const Scene& scene = solution_.scene();
  const mesh::ElementTree& tree = solution_.tree();
  const ElementId r = candidate.receiver;
  const ElementId s = candidate.source.element();
  const mesh::ShaftEnd end_r = end_of(tree, r);
  const mesh::ShaftEnd end_s = end_of(tree, s);
  const Lie source_lies = lie_of(end_s, tree.centroid(r), end_r.normal);
  const Lie receiver_lies = lie_of(end_r, tree.centroid(s), end_s.normal);
  if (!source_lies.any_in_front || !receiver_lies.any_in_front) return std::nullopt;

  Link link;
  link.receiver = r;
  link.source = candidate.source;
  link.visibility = candidate.visibility;
  if (link.visibility == Visibility::kPartial) link.visibility = scene.shafts->classify(end_r, end_s);
  if (link.visibility == Visibility::kHidden) return std::nullopt;

  // Point form factors, weighted by the visibility of the source from each place.
  std::array<OutlineEdge, 3> scratch_s;
  const auto outline_s = tree.outline(s, scratch_s);
  const Places places = places_on(tree, r);
  const SobolPoints points(mesh::hash(mesh::hash(tree.key(r), tree.key(s)), seed_));
  const double lift = scene.rays->offset_m();
  std::array<PlaneSample, kPlaces> samples;
  double rays = 0.0;
  double passing = 0.0;
  double unoccluded = 0.0;
  const std::size_t each = (kRays + places.count - 1) / places.count;
  for (std::size_t i = 0; i < places.count; ++i) {
    const Point& place = places.at[i];
    const Vector d = place - tree.centroid(r);
    const double factor = point_form_factor(place, end_r.normal, outline_s, end_s.normal);
    samples[i] = {dot(d, tree.axes(r).u), dot(d, tree.axes(r).v), factor, places.weight[i]};
    unoccluded += places.weight[i] * factor;
    if (link.visibility == Visibility::kVisible || factor <= 0.0) continue;
    std::array<mesh::Segment, kRays> segments;
    std::array<float, kRays> passed{};
    std::array<double, kRays> kernel{};
    double all = 0.0;
    for (std::size_t j = 0; j < each; ++j) {
      const auto n = static_cast<std::uint32_t>(i * each + j);
      const Point q = tree.sample(s, points.at(n, 0), points.at(n, 1));
      const Vector to = q - place;
      const double distance2 = dot(to, to);
      kernel[j] = std::max(0.0, dot(to, end_r.normal)) * std::max(0.0, -dot(to, end_s.normal)) /
                  (distance2 * distance2);
      all += kernel[j];
      segments[j] = {place + lift * end_r.normal, q + lift * end_s.normal};
    }
    scene.rays->transmittance(std::span(segments).first(each), std::span(passed).first(each));
    double seen = 0.0;
    for (std::size_t j = 0; j < each; ++j) {
      seen += kernel[j] * passed[j];
      passing += passed[j] > 0.0F ? 1.0 : 0.0;
    }
    rays += static_cast<double>(each);
    samples[i].value *= all > 0.0 ? seen / all : 0.0;
  }
  if (unoccluded <= 0.0) return std::nullopt;
  const LinearFit fit = fit_line(std::span(samples).first(places.count), link.visibility == Visibility::kPartial);
  double mean = fit.line.value;
  if (link.visibility == Visibility::kVisible && source_lies.all_in_front && receiver_lies.all_in_front) {
    std::array<OutlineEdge, 3> scratch_r;
    const auto outline_r = tree.outline(r, scratch_r);
    if (outline_r.size() * outline_s.size() <= kExactPairs) mean = exchange_area(outline_r, outline_s) / tree.area(r);
  }
  link.factor = static_cast<float>(mean);
  link.slope_u = fit.line.slope_u;
  link.slope_v = fit.line.slope_v;
  link.error = static_cast<float>(fit.residual + visibility_noise(unoccluded, rays, passing));
  add_moments(tree, end_r, end_s, mean / unoccluded, link);
  return link;
}

std::optional<Link> Linker::link_cluster(const LinkCandidate& candidate) const {
  const Scene& scene = solution_.scene();
  const mesh::ElementTree& tree = solution_.tree();
  const ElementId r = candidate.receiver;
  const std::uint32_t c = candidate.source.cluster();
  const Vector& normal = tree.normal(r);
  const SobolPoints points(mesh::hash(mesh::hash(tree.key(r), c), seed_ + 1));
  const double lift = scene.rays->offset_m();
  std::array<mesh::Segment, kClusterRays> segments;
  std::array<float, kClusterRays> passed{};
  std::array<double, kClusterRays> kernel{};
  for (std::uint32_t i = 0; i < kClusterRays; ++i) {
    const Point p = tree.sample(r, points.at(i, 0), points.at(i, 1));
    const ClusterPoint q = clusters_.sample(tree, c, points.at(i, 2), points.at(i, 3));
    const Vector to = q.at - p;
    const double distance2 = dot(to, to);
    kernel[i] = clusters_.area(c) * std::max(0.0, dot(to, normal)) * std::max(0.0, -dot(to, q.normal)) /
                (std::numbers::pi * distance2 * distance2);
    segments[i] = {p + lift * normal, q.at + lift * q.normal};
  }
  scene.rays->transmittance(segments, passed);
  double sum = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < kClusterRays; ++i) {
    const double f = kernel[i] * passed[i];
    sum += f / kClusterRays;
    square += f * f / kClusterRays;
  }
  Link link;
  link.receiver = r;
  link.source = candidate.source;
  link.factor = static_cast<float>(sum);
  link.error = static_cast<float>(std::sqrt(std::max(0.0, square - sum * sum) / (kClusterRays - 1.0)));
  // Sixteen rays that see nothing prove little: what they may have missed counts as error.
  double unseen = 0.0;
  for (const double k : kernel) unseen = std::max(unseen, k);
  link.error = std::max(link.error, static_cast<float>(unseen / (4.0 * kClusterRays)));
  return unseen > 0.0 ? std::optional(link) : std::nullopt;
}

}  // namespace clerestory::lighting
