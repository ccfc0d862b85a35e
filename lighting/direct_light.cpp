// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/direct_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "lighting/light_paths.h"
#include "lighting/linear_fit.h"
#include "lighting/opening_sampler.h"
#include "lighting/parallel.h"
#include "lighting/sampling.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::FaceSide;
using mesh::Point;
using mesh::Vector;

namespace {

constexpr std::uint32_t kPoints = 8;        ///< places on a node
constexpr std::uint32_t kDirections = 16;   ///< from each place towards each opening, and into the open hemisphere
constexpr std::uint32_t kProbes = 4;        ///< of them, enough to see that a place sees no sky at all
constexpr double kSmallest = 0.02;          ///< nodes of a smaller radius are not opened [m]
constexpr double kBeyondGuess = 0.4;        ///< outdoor surfaces receive some 40 % of the open sky's light
/// A node whose importance lies this unevenly is not trusted by what a few places on it show.
constexpr double kUneven = 0.3;
constexpr float kLeastReflectance = 0.05F;  ///< black surfaces are still shown with their illuminance

/// A surface seen through an opening.
struct SeenBeyond {
  FaceSide side;
  Point at;
  float factor = 0.0F;
};

struct Candidate {
  ElementId node;
  std::vector<std::uint32_t> openings;  ///< those that may be seen
  bool open_sky = true;                 ///< may see the sky by no opening
};

struct Estimate {
  LinearFit fit;           ///< of sky and point sources and the guess of what is beyond
  double received = 0.0;   ///< sky and point sources alone, mean [lux]
  double total = 0.0;      ///< with the guess of what is beyond
  std::vector<SeenBeyond> beyond;
  Candidate below;         ///< what the children need to look at
};

/// Adds up what rays from a node end on.
struct Collector {
  const Scene* scene;
  bool surfaces_count;
  double sky_lux = 0.0;
  double guess_lux = 0.0;
  std::vector<SeenBeyond>* beyond = nullptr;

  void surface(FaceSide side, const Point& at, float weight, bool) {
    if (!surfaces_count) return;
    beyond->push_back({side, at, weight});
    const float rho = luminance(scene->side_reflectance(side), scene->channel_weights);
    const float own = luminance(scene->side_exitance(side), scene->channel_weights);
    guess_lux += weight * (own + rho * kBeyondGuess * scene->sky.horizontal_illuminance_lux);
  }
  void sky(const Vector& direction, float weight) {
    sky_lux += weight * std::numbers::pi * sky_luminance(scene->sky, direction);
  }
};

class NodeSampler {
 public:
  NodeSampler(const Solution& solution, std::uint64_t seed) : solution_(solution), seed_(seed) {
    for (const Opening& opening : scene().openings) ends_.push_back(shaft_end(opening));
  }

  [[nodiscard]] Estimate estimate(const Candidate& candidate) const {
    const mesh::ElementTree& tree = solution_.tree();
    const ElementId e = candidate.node;
    Estimate result;
    result.below.open_sky = false;
    const std::uint64_t key = mesh::hash(seed_, tree.key(e));
    std::array<PlaneSample, kPoints> samples;
    const SobolPoints places(key);
    for (std::uint32_t i = 0; i < kPoints; ++i) {
      const Point p = tree.sample(e, places.at(i, 0), places.at(i, 1));
      const Vector d = p - tree.centroid(e);
      samples[i] = {dot(d, tree.axes(e).u), dot(d, tree.axes(e).v), 0.0, 1.0 / kPoints};
      points_on_node_[i] = p + scene().rays->offset_m() * tree.normal(e);
    }
    for (const std::uint32_t k : candidate.openings) {
      if (!may_see(e, k)) continue;
      if (through_opening(e, k, mesh::hash(key, k), samples, result)) result.below.openings.push_back(k);
    }
    if (candidate.open_sky && scene().has_sky()) open_sky(e, mesh::hash(key, 0xFFFF), samples, result);
    point_sources(e, samples, result);
    result.fit = fit_line(samples, true);
    return result;
  }

 private:
  [[nodiscard]] const Scene& scene() const { return solution_.scene(); }

  static mesh::ShaftEnd shaft_end(const Opening& opening);
  [[nodiscard]] bool may_see(ElementId e, std::uint32_t k) const;
  bool through_opening(ElementId e, std::uint32_t k, std::uint64_t key, std::span<PlaneSample> samples,
                       Estimate& result) const;
  void open_sky(ElementId e, std::uint64_t key, std::span<PlaneSample> samples, Estimate& result) const;
  void point_sources(ElementId e, std::span<PlaneSample> samples, Estimate& result) const;

  const Solution& solution_;
  std::uint64_t seed_;
  std::vector<mesh::ShaftEnd> ends_;
  static thread_local std::array<Point, kPoints> points_on_node_;
};

thread_local std::array<Point, kPoints> NodeSampler::points_on_node_;

mesh::ShaftEnd NodeSampler::shaft_end(const Opening& opening) {
  // The bounding rectangle in the opening's plane.
  const mesh::Frame frame = mesh::frame_around(-opening.outward);
  const Point& origin = opening.triangles[0][0];
  std::array<double, 4> box{0.0, 0.0, 0.0, 0.0};
  for (const auto& t : opening.triangles) {
    for (const Point& p : t) {
      const double u = dot(p - origin, frame.u);
      const double v = dot(p - origin, frame.v);
      box = {std::min(box[0], u), std::min(box[1], v), std::max(box[2], u), std::max(box[3], v)};
    }
  }
  const auto corner = [&](double u, double v) { return origin + (u * frame.u + v * frame.v); };
  return {.corners = {corner(box[0], box[1]), corner(box[2], box[1]), corner(box[2], box[3]), corner(box[0], box[3])},
          .count = 4,
          .normal = frame.w};
}

bool NodeSampler::may_see(ElementId e, std::uint32_t k) const {
  const mesh::ElementTree& tree = solution_.tree();
  if (tree.face_side(e).face == scene().openings[k].face) return false;
  mesh::ShaftEnd own;
  own.count = tree.hull(e, own.corners);
  own.normal = tree.normal(e);
  const mesh::ShaftEnd& end = ends_[k];
  const auto in_front = [](const mesh::ShaftEnd& of, const mesh::ShaftEnd& other) {
    for (std::size_t i = 0; i < other.count; ++i) {
      if (dot(other.corners[i] - of.corners[0], of.normal) > 1e-9) return true;
    }
    return false;
  };
  if (!in_front(own, end) || !in_front(end, own)) return false;
  return scene().shafts->classify(own, end) != mesh::Visibility::kHidden;
}

bool NodeSampler::through_opening(ElementId e, std::uint32_t k, std::uint64_t key, std::span<PlaneSample> samples,
                                  Estimate& result) const {
  const Vector& normal = solution_.tree().normal(e);
  // The same numbers at every place: differences between places are then the light's own.
  const SobolPoints numbers(key);
  bool seen = false;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const Point& at = points_on_node_[i];
    const OpeningSampler sampler(at, scene().openings[k].triangles);
    for (std::uint32_t j = 0; j < kDirections; ++j) {
      const SolidAngleSample s = sampler.sample(numbers.at(j, 0), numbers.at(j, 1));
      const double cosine = dot(s.direction, normal);
      if (s.solid_angle_sr <= 0.0 || cosine <= 0.0) continue;
      // Weights are shares of the cosine-weighted hemisphere; over the places they average to the node's factor.
      const double weight = s.solid_angle_sr * cosine / (std::numbers::pi * kDirections);
      Collector collector{&scene(), true, 0.0, 0.0, &result.beyond};
      const std::size_t first = result.beyond.size();
      follow(scene(), at, s.direction, 1.0F,
             PathRule{PathRule::Part::kOpening, static_cast<std::int32_t>(k), false}, collector);
      for (std::size_t b = first; b < result.beyond.size(); ++b) {
        result.beyond[b].factor *= static_cast<float>(weight / kPoints);
      }
      const double lux = weight * (collector.sky_lux + collector.guess_lux);
      seen = seen || lux > 0.0 || result.beyond.size() > first;
      samples[i].value += lux;
      result.received += weight * collector.sky_lux / kPoints;
      result.total += lux / kPoints;
    }
  }
  return seen;
}

void NodeSampler::open_sky(ElementId e, std::uint64_t key, std::span<PlaneSample> samples, Estimate& result) const {
  const mesh::Frame frame = mesh::frame_around(solution_.tree().normal(e));
  const SobolPoints numbers(key);
  std::array<double, kPoints> lux{};
  double all = 0.0;
  std::uint32_t done = 0;
  for (const std::uint32_t until : {kProbes, kDirections}) {
    for (; done < until; ++done) {
      const Vector d = cosine_direction(frame, numbers.at(done, 0), numbers.at(done, 1));
      for (std::uint32_t i = 0; i < kPoints; ++i) {
        Collector collector{&scene(), false, 0.0, 0.0, nullptr};
        follow(scene(), points_on_node_[i], d, 1.0F, PathRule{PathRule::Part::kGather, -1, false}, collector);
        lux[i] += collector.sky_lux;
        all += collector.sky_lux;
      }
    }
    if (all <= 0.0) return;
  }
  result.below.open_sky = true;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    samples[i].value += lux[i] / kDirections;
    result.received += lux[i] / kDirections / kPoints;
    result.total += lux[i] / kDirections / kPoints;
  }
}

void NodeSampler::point_sources(ElementId e, std::span<PlaneSample> samples, Estimate& result) const {
  const Vector& normal = solution_.tree().normal(e);
  for (const PointSource& source : scene().point_sources) {
    std::array<mesh::Segment, kPoints> segments;
    std::array<float, kPoints> passed{};
    for (std::uint32_t i = 0; i < kPoints; ++i) segments[i] = {points_on_node_[i], source.at};
    scene().rays->transmittance(segments, passed);
    for (std::uint32_t i = 0; i < kPoints; ++i) {
      const double lux = passed[i] * point_illuminance(source, points_on_node_[i], normal);
      samples[i].value += lux;
      result.received += lux / kPoints;
      result.total += lux / kPoints;
    }
  }
}

/// Opening links of one node, one a source element, in the order of their ids. Where on the source the rays end, makes the link
/// follow the line of its radiosity.
void add_links(const Solution& solution, ElementId receiver, const Estimate& estimate, std::vector<Link>& links) {
  const mesh::ElementTree& tree = solution.tree();
  struct Sum {
    double factor = 0.0;
    double u = 0.0;
    double v = 0.0;
  };
  std::map<std::uint32_t, Sum> sums;
  for (const SeenBeyond& seen : estimate.beyond) {
    const ElementId source = solution.element_at(seen.side, seen.at);
    if (!source.valid()) continue;
    const Vector d = seen.at - tree.centroid(source);
    Sum& sum = sums[source.value];
    sum.factor += seen.factor;
    sum.u += seen.factor * dot(d, tree.axes(source).u);
    sum.v += seen.factor * dot(d, tree.axes(source).v);
  }
  // Light through openings changes over the node as the sum of it does.
  const double slope = estimate.total > 0.0 ? 1.0 / estimate.total : 0.0;
  for (const auto& [source, sum] : sums) {
    Link link;
    link.receiver = receiver;
    link.source = LinkSource::element(ElementId(source));
    link.factor = static_cast<float>(sum.factor);
    link.slope_u = static_cast<float>(sum.factor * slope * estimate.fit.line.slope_u);
    link.slope_v = static_cast<float>(sum.factor * slope * estimate.fit.line.slope_v);
    const mesh::SecondMoments& area = tree.second_moments(ElementId(source));
    const double determinant = area.uu * area.vv - area.uv * area.uv;
    link.moment_u = static_cast<float>((sum.u * area.vv - sum.v * area.uv) / determinant);
    link.moment_v = static_cast<float>((sum.v * area.uu - sum.u * area.uv) / determinant);
    links.push_back(link);
  }
}

void accept(Solution& solution, ElementId e, const Estimate& estimate) {
  const double share = estimate.total > 0.0 ? estimate.received / estimate.total : 0.0;
  // The line's value stands at the centroid; the mean of the places is what the node receives.
  for (LinearValue& v : solution.direct(e)) {
    v.value = static_cast<float>(estimate.received);
    v.slope_u = static_cast<float>(share * estimate.fit.line.slope_u);
    v.slope_v = static_cast<float>(share * estimate.fit.line.slope_v);
  }
}

double weight_of(const Solution& solution, const Importance& importance, ElementId e) {
  const Scene& scene = solution.scene();
  const FaceSide side = solution.tree().face_side(e);
  const float rho = luminance(scene.side_reflectance(side), scene.channel_weights);
  return std::max(rho, kLeastReflectance) * importance.of(solution.tree(), e);
}

/// Mean illuminance at the sensors: what they see of the sky, and what reaches them of all first reflections and emission.
double scale_of(const Solution& solution, const Importance& importance, std::span<const Candidate> roots,
                std::span<const Estimate> estimates) {
  const Scene& scene = solution.scene();
  double sum = importance.direct_sky_lux();
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const FaceSide side = solution.tree().face_side(roots[i].node);
    const float rho = luminance(scene.side_reflectance(side), scene.channel_weights);
    const float own = luminance(scene.side_exitance(side), scene.channel_weights);
    sum += importance.of(solution.tree(), roots[i].node) * (own + rho * estimates[i].received);
  }
  return sum;
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

DirectLight light_directly(Solution& solution, const Importance& importance, double tolerance, std::uint64_t seed,
                           Progress& progress) {
  DirectLight result;
  std::vector<Candidate> round;
  Candidate all;
  for (std::uint32_t k = 0; k < solution.scene().openings.size(); ++k) all.openings.push_back(k);
  for (const ElementId root : solution.tree().roots()) {
    all.node = root;
    round.push_back(all);
  }
  const NodeSampler sampler(solution, seed);
  std::vector<std::pair<ElementId, Estimate>> accepted;
  const auto first_round = static_cast<double>(round.size());
  for (double done = 0.0; !round.empty();) {
    std::vector<Estimate> estimates(round.size());
    parallel_for(round.size(), [&](std::size_t i) { estimates[i] = sampler.estimate(round[i]); });
    if (done == 0.0) result.scale_lux = scale_of(solution, importance, round, estimates);
    std::vector<Candidate> next;
    for (std::size_t i = 0; i < round.size(); ++i) {
      const ElementId e = round[i].node;
      const double uneven = std::max(0.0, importance.unevenness(solution.tree(), e) - kUneven);
      const double doubt = std::max(estimates[i].fit.residual, uneven * estimates[i].total);
      const double effect = weight_of(solution, importance, e) * doubt;
      if (effect <= tolerance * result.scale_lux || solution.tree().radius(e) < kSmallest) {
        accepted.emplace_back(e, std::move(estimates[i]));
        continue;
      }
      solution.open(e);
      for (std::size_t k = 0; k < solution.tree().child_count(e); ++k) {
        Candidate child = estimates[i].below;
        child.node = ElementId(solution.tree().first_child(e).index() + k);
        next.push_back(std::move(child));
      }
    }
    round = std::move(next);
    done += 1.0;
    progress.advance(1.0 - static_cast<double>(round.size()) / (first_round + static_cast<double>(round.size())));
  }

  for (const auto& [e, estimate] : accepted) {
    accept(solution, e, estimate);
    solution.add_error(e, estimate.fit.residual * estimate.fit.residual);
    add_links(solution, e, estimate, result.links);
  }
  return result;
}

}  // namespace clerestory::lighting
