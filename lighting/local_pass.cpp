// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/local_pass.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "lighting/form_factor.h"
#include "lighting/light_paths.h"
#include "lighting/luminaire_light.h"
#include "lighting/opening_sampler.h"
#include "lighting/openings.h"
#include "lighting/sun_light.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kSeed = 0x57A1;
/// Rays towards a source from a point, times the accuracy: 32 at 2 %.
constexpr double kSourceRays = 0.64;
/// Towards openings that hardly matter.
constexpr std::uint32_t kFewRays = 8;
/// Rays into the hemisphere: so many at least, and doubled up to so many, times the accuracy: 128 at 2 %.
constexpr std::uint32_t kLeastRays = 32;
constexpr double kMostRays = 2.56;
/// Errors of what surfaces reflect are brought to this many times the accuracy.
constexpr double kGoal = 2.0;
/// Light that rays may have missed is looked into where it would be more than this share of the accuracy.
constexpr double kNeglected = 0.3;
/// Facets of a body that give less of its light than this share of the accuracy are seen or not as their middles are.
constexpr double kSmallFacet = 0.25;
/// Rays to middles of facets of one body.
constexpr std::size_t kMostMiddles = 512;
/// What luminaires that are near give is known to this share of the accuracy.
constexpr double kLampShare = 0.125;
/// Rays come in so many parts, each evenly spread by itself, whose spread tells the error [Owen 1995]: somewhat more than the error of all,
/// which are more evenly spread together.
constexpr std::size_t kParts = 8;

/// Of what is wholly seen, nodes nearer than so many times their radius are taken by their parts.
constexpr double kNear = 2.0;

/// A power of two, so that rays are evenly spread.
std::uint32_t ray_count(double wanted, double least) {
  return std::bit_ceil(static_cast<std::uint32_t>(std::clamp(wanted, least, 1024.0)));
}

/// One of many values that stands for others too.
struct StandIn {
  std::size_t which = 0;
  double weight = 1.0;
};

/// So many of the values at most, at even steps of their sum, whose weights give this sum; all of them where they are no more.
std::vector<StandIn> stand_ins(std::span<const double> values, std::size_t most) {
  std::vector<StandIn> chosen;
  if (values.size() <= most) {
    for (std::size_t i = 0; i < values.size(); ++i) chosen.push_back({i, 1.0});
    return chosen;
  }
  const double step = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(most);
  double before = 0.0;
  double next = 0.5 * step;
  for (std::size_t i = 0; i < values.size(); ++i) {
    before += values[i];
    double steps = 0.0;
    for (; before > next; next += step) steps += 1.0;
    if (steps > 0.0) chosen.push_back({i, steps * step / values[i]});
  }
  return chosen;
}

}  // namespace

/// Adds up the light of rays, channel by channel.
class LocalPass::Sum {
 public:
  Sum(const Solution& solution, const SolutionErrors& errors, double exact_lux)
      : solution_(solution), errors_(errors), lux_(solution.channels(), exact_lux), part_(solution.channels()) {}

  /// What is known without rays [lux per channel], times a factor.
  void add(std::span<const float> lux, double factor) {
    for (std::size_t c = 0; c < lux_.size(); ++c) lux_[c] += factor * lux[c];
  }

  /// Begins with rays of one part of the light.
  void begin() {
    std::fill(part_.begin(), part_.end(), 0.0);
    each_.clear();
    wrong_.fill(0.0);
    wrong_rays_ = 0;
  }
  void begin_ray(double weight, bool with_errors) {
    weight_ = weight;
    with_errors_ = with_errors;
    wrong_rays_ += with_errors ? 1 : 0;
    each_.push_back(0.0);
  }
  /// What a ray meets.
  void surface(const SurfacePoint& seen, float passed, bool with_emission) {
    const ElementId e = solution_.element_at(seen.side, seen.region, seen.at);
    if (!e.valid()) return;
    for (std::size_t c = 0; c < part_.size(); ++c)
      meet(c, weight_ * passed * solution_.radiosity_at(e, seen.at, c, with_emission));
    if (!with_errors_) return;
    const SolutionErrors::Samples samples = errors_.radiosity(solution_, e, seen.at);
    for (std::size_t k = 0; k < samples.size(); ++k) wrong_[k] += weight_ * passed * samples[k];
  }
  void sky(const Vector& direction, float passed, bool) {
    const double sent = std::numbers::pi * sky_luminance(solution_.scene().sky, direction);
    for (std::size_t c = 0; c < part_.size(); ++c) meet(c, weight_ * passed * sent);
  }
  /// Light of the ray in a channel [lux, times the number of rays].
  void meet(std::size_t channel, double lux) {
    part_[channel] += lux;
    each_.back() += solution_.scene().channel_weights[channel] * lux;
  }

  /// Of the mean of the part's rays [lux²].
  [[nodiscard]] double part_variance() const {
    const std::size_t rays = each_.size() / kParts;
    double mean = 0.0;
    double square = 0.0;
    for (std::size_t p = 0; p < kParts; ++p) {
      double sum = 0.0;
      for (std::size_t i = p * rays; i < (p + 1) * rays; ++i) sum += each_[i] / static_cast<double>(rays);
      mean += sum / kParts;
      square += sum * sum / kParts;
    }
    return std::max(0.0, square - mean * mean) / (kParts - 1.0);
  }
  /// The part's light, luminance-weighted [lux].
  [[nodiscard]] double part_lux() const {
    double sum = 0.0;
    for (const double e : each_) sum += e / static_cast<double>(each_.size());
    return sum;
  }
  /// @param full_lux  if all that the rays were sent to were seen: of n rays that all miss it, each may stand for what they have missed
  void end(double full_lux = 0.0) {
    const auto rays = static_cast<double>(each_.size());
    for (std::size_t c = 0; c < lux_.size(); ++c) lux_[c] += part_[c] / rays;
    variance_ += part_lux() > 0.0 ? part_variance() : full_lux * full_lux / (rays * rays);
    for (const double w : wrong_) {
      const double mean = wrong_rays_ > 0 ? w / static_cast<double>(wrong_rays_) : 0.0;
      variance_ += mean * mean / static_cast<double>(wrong_.size());
    }
  }

  /// Light that may have been missed.
  void doubt(double lux) { variance_ += lux * lux; }

  [[nodiscard]] double weighted() const { return luminance(lux_, solution_.scene().channel_weights); }
  [[nodiscard]] Light light() && { return {std::move(lux_), std::sqrt(variance_)}; }

 private:
  const Solution& solution_;
  const SolutionErrors& errors_;
  std::vector<double> lux_;
  std::vector<double> part_;
  std::vector<double> each_;  // luminance-weighted light of each ray of the part
  std::array<double, SolutionErrors::kSamples> wrong_{};
  std::size_t wrong_rays_ = 0;
  double variance_ = 0.0;
  double weight_ = 1.0;
  bool with_errors_ = false;
};

LocalPass::LocalPass(const Solution& solution, const Arrivals& arrivals, const SolutionErrors& errors,
                     std::span<const NodeDirect> nodes, double accuracy, double dark_lux)
    : solution_(solution),
      arrivals_(arrivals),
      errors_(errors),
      nodes_(nodes),
      node_at_(solution.tree().size(), kNone),
      emitters_(emitters(solution)),
      bodies_(solution, emitters_),
      luminaires_(any_luminaires(solution.scene())),
      rays_(ray_count(kSourceRays / accuracy, 8.0)),
      most_rays_(ray_count(kMostRays / accuracy, 64.0)),
      accuracy_(accuracy),
      fine_(std::clamp(kLampShare * accuracy, kFineMean, kRoughMean)),
      dark_lux_(dark_lux) {
  const SobolPoints numbers(kSeed);
  for (std::uint32_t i = 0; i < std::max(rays_, most_rays_); ++i) {
    numbers_.push_back(numbers.point<2>(i));
    hemisphere_.push_back(cosine_direction({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, numbers_[i][0], numbers_[i][1]));
  }
  for (const std::uint32_t i : bodies_.others()) all_lamps_.single.push_back({&emitters_[i], false});
  for (const LampBody& body : bodies_.bodies()) all_lamps_.bodies.push_back({&body, false});
  for (const Opening& opening : solution.scene().openings) opening_ends_.push_back(shaft_end(opening));
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) node_at_[nodes_[i].node.index()] = i;
  const std::vector<ElementId> elements = solution.elements();
  if (std::any_of(elements.begin(), elements.end(), [&](ElementId e) { return solution.is_closed(e); })) {
    sent_.resize(solution.tree().size() * solution.channels());
    for (const ElementId root : solution.tree().roots()) pull(root);
  }
}

void LocalPass::pull(ElementId e) {
  const mesh::ElementTree& tree = solution_.tree();
  const std::size_t n = solution_.channels();
  if (!solution_.is_open(e)) {
    for (std::size_t c = 0; c < n; ++c) {
      const Moments& moments = solution_.moments(e)[c];
      sent_[e.index() * n + c] = {solution_.radiosity(e)[c], moments.u, moments.v};
    }
    return;
  }
  for (std::size_t k = 0; k < tree.child_count(e); ++k) {
    const ElementId child(tree.first_child(e).index() + k);
    pull(child);
    const PlaceInParent<float> place(tree, child);
    for (std::size_t c = 0; c < n; ++c) sent_[e.index() * n + c].add_part(sent_[child.index() * n + c], place);
  }
}

/// Errors of many openings, each a small share of the light, even out.
std::uint32_t LocalPass::rays_each(std::size_t openings) const {
  const std::size_t share = 2 * rays_ / std::max<std::size_t>(1, openings);
  return std::clamp(static_cast<std::uint32_t>(std::bit_floor(share)), std::min(kFewRays, rays_), rays_);
}

LocalPass::Lamps LocalPass::lamps_of(ElementId element) const {
  mesh::ShaftEnd from = mesh::shaft_end(solution_.tree(), element);
  for (Point& corner : from.corners) corner = corner + solution_.scene().rays->offset_m() * from.normal;
  Lamps lamps{in_sight(solution_, emitters_, bodies_.others(), from), {}};
  for (const LampBody& body : bodies_.bodies()) {
    const BodySight sight = bodies_.sight(solution_, body, from);
    if (sight != BodySight::kHidden) lamps.bodies.push_back({&body, sight == BodySight::kClear});
  }
  return lamps;
}

LocalPass::Light LocalPass::at(ElementId element, const Point& point, const Lamps& lamps) const {
  const Vector& normal = solution_.tree().normal(element);
  const Receiver receiver{point + solution_.scene().rays->offset_m() * normal, normal, luminaires(element), lamps};
  Light found = solution_.is_closed(element) ? by_links(element, receiver) : light(element, receiver);
  if (is_dark(element)) {
    const double error = errors_.point_error(solution_, element);
    if (luminance(found.lux, solution_.scene().channel_weights) <= std::min(error, accuracy_ * dark_lux_))
      return {std::vector<double>(solution_.channels(), 0.0), error};
  }
  return found;
}

/// Whether nothing at all reaches an element in the solution, as below a solid that stands on it.
bool LocalPass::is_dark(ElementId element) const {
  const std::span<const LinearValue> lux = solution_.irradiance(element);
  return std::all_of(lux.begin(), lux.end(), [](const LinearValue& l) { return l == LinearValue{}; });
}

std::optional<LocalPass::Light> LocalPass::at_limit(ElementId element, const Point& point,
                                                    const mesh::LimitPoint& limit) const {
  if (solution_.is_closed(element)) return std::nullopt;
  const double above = std::max(0.0, dot(limit.at - point, limit.normal));
  const Vector lift = solution_.scene().rays->offset_m() * solution_.tree().normal(element);
  return light(element, {point + above * limit.normal + lift, limit.normal, luminaires_, all_lamps_});
}

LocalPass::Light LocalPass::light(ElementId element, const Receiver& receiver) const {
  const mesh::ElementTree& tree = solution_.tree();
  const Scene& scene = solution_.scene();
  Sum sum(solution_, errors_, by_luminaires(receiver, fine_) + sun_illuminance(scene, receiver.from, receiver.normal));
  for (const EmitterInSight& lamp : receiver.lamps.single) from_emitter(lamp, receiver, sum);
  for (const BodyInSight& lamp : receiver.lamps.bodies) from_body(lamp, receiver, sum);
  std::vector<Missed> missed;
  for (ElementId up = element; up.valid(); up = tree.parent(up)) {
    const std::uint32_t i = node_at_[up.index()];
    if (i == kNone) continue;
    const std::uint32_t rays = rays_each(nodes_[i].openings.size());
    for (const std::uint32_t k : nodes_[i].openings) {
      if (!through_opening({k}, rays, receiver, sum)) missed.push_back({{k}, rays});
    }
    for (const MinorOpening& minor : nodes_[i].minor) {
      if (!through_opening(minor, kFewRays, receiver, sum)) missed.push_back({minor, kFewRays});
    }
  }
  from_surfaces(receiver, sum);
  add_missed(missed, receiver, sum);
  return std::move(sum).light();
}

std::optional<double> LocalPass::by_lamps(ElementId element, const Point& point, const Lamps& lamps,
                                          double least_lux) const {
  if (solution_.is_closed(element)) return std::nullopt;
  const Vector& normal = solution_.tree().normal(element);
  const Receiver receiver{point + solution_.scene().rays->offset_m() * normal, normal, luminaires(element), lamps};
  double lux = by_luminaires(receiver, kRoughMean);
  lux += sun_illuminance(solution_.scene(), receiver.from, normal);
  bool exact = true;
  const auto clip = [&](const EmitterInSight& lamp) {
    const double full = full_factor(solution_, *lamp.emitter, receiver.from, normal);
    if (!exact || lamp.emitter->exitance * full < least_lux) return;
    const SeenFactor found = seen(lamp, full, receiver);
    exact = found.exact;
    lux += lamp.emitter->exitance * found.factor;
  };
  for (const EmitterInSight& lamp : lamps.single) clip(lamp);
  const auto add = [&](const Emitter& emitter, double factor) { lux += emitter.exitance * factor; };
  for (const BodyInSight& lamp : lamps.bodies) {
    const BodyLight full = full_light(*lamp.body, receiver);
    if (exact && full.lux >= least_lux) see_body(lamp, full, receiver, add, clip);
  }
  return exact ? std::optional(lux) : std::nullopt;
}

/// Links of such an element are proven to see all of their sources, which fill its hemisphere.
LocalPass::Light LocalPass::by_links(ElementId element, const Receiver& receiver) const {
  const mesh::ElementTree& tree = solution_.tree();
  Light light{std::vector<double>(solution_.channels(), by_luminaires(receiver, fine_)),
              errors_.point_error(solution_, element)};
  for (ElementId up = element; up.valid(); up = tree.parent(up)) {
    for (const Arrival& arrival : arrivals_.at(up)) {
      const ElementId source = arrival.source().element();
      if (!add_source(source, receiver, light.lux)) continue;
      // How radiosity and factor run over the source together.
      for (std::size_t c = 0; c < light.lux.size(); ++c) {
        const Solution::Sent& sent = sent_[source.index() * light.lux.size() + c];
        light.lux[c] += arrival.moment_u() * sent.u + arrival.moment_v() * sent.v;
      }
    }
  }
  return light;
}

bool LocalPass::is_near(ElementId source, const Receiver& receiver) const {
  const mesh::ElementTree& tree = solution_.tree();
  return solution_.is_open(source) && norm(tree.centroid(source) - receiver.from) < kNear * tree.radius(source);
}

/// Adds what a node gives to a point that sees all of it, by its parts where it is near. Returns whether it was taken whole.
bool LocalPass::add_source(ElementId source, const Receiver& receiver, std::vector<double>& lux) const {
  const mesh::ElementTree& tree = solution_.tree();
  if (is_near(source, receiver)) {
    for (std::size_t k = 0; k < tree.child_count(source); ++k)
      add_source(ElementId(tree.first_child(source).index() + k), receiver, lux);
    return false;
  }
  std::array<mesh::OutlineEdge, 3> scratch;
  const double factor =
      point_form_factor(receiver.from, receiver.normal, tree.outline(source, scratch), tree.normal(source));
  for (std::size_t c = 0; c < lux.size(); ++c) lux[c] += factor * sent_[source.index() * lux.size() + c].mean;
  return true;
}

double LocalPass::by_luminaires(const Receiver& receiver, double tolerance) const {
  return luminaire_illuminance(solution_.scene(), receiver.luminaires, receiver.from, receiver.normal, tolerance).value;
}

/// As points of an element see them.
std::span<const LuminaireView> LocalPass::luminaires(ElementId element) const {
  const mesh::ElementTree& tree = solution_.tree();
  for (ElementId up = element; up.valid(); up = tree.parent(up)) {
    if (node_at_[up.index()] != kNone) return nodes_[node_at_[up.index()]].luminaires;
  }
  return luminaires_;
}

SeenFactor LocalPass::seen(const EmitterInSight& lamp, double full, const Receiver& receiver) const {
  if (lamp.wholly) return {full, true};
  return seen_factor(solution_, *lamp.emitter, full, receiver.from, receiver.normal);
}

/// Where it is neither hidden nor wholly seen, the share that is seen, each place weighed by what it gives.
void LocalPass::from_emitter(const EmitterInSight& lamp, const Receiver& receiver, Sum& sum) const {
  const Emitter& emitter = *lamp.emitter;
  const double full = full_factor(solution_, emitter, receiver.from, receiver.normal);
  const SeenFactor found = seen(lamp, full, receiver);
  const auto exitance = solution_.scene().side_exitance(solution_.tree().face_side(emitter.root));
  if (found.exact) {
    sum.add(exitance, found.factor);
    return;
  }
  std::vector<EmitterSample> samples(rays_);
  double all = 0.0;
  for (std::uint32_t i = 0; i < rays_; ++i) {
    samples[i] = sample(solution_, emitter, receiver.from, receiver.normal, numbers_[i][0], numbers_[i][1]);
    all += samples[i].kernel / rays_;
  }
  if (all <= 0.0) return;
  sum.begin();
  for (const EmitterSample& s : samples) {
    sum.begin_ray(1.0, false);
    for (std::size_t c = 0; c < exitance.size(); ++c) sum.meet(c, full * exitance[c] * s.kernel * s.passed / all);
  }
  sum.end(emitter.exitance * found.factor);
}

LocalPass::BodyLight LocalPass::full_light(const LampBody& body, const Receiver& receiver) const {
  BodyLight light;
  for (const BodyFacet& facet : body.facets) {
    const double factor = full_factor(solution_, emitters_, facet, receiver.from, receiver.normal);
    if (factor <= 0.0) continue;
    light.facets.push_back({&facet, factor});
    light.lux += emitters_[facet.emitter].exitance * factor;
  }
  return light;
}

/// Calls add(emitter, factor) for what is seen of facets, or clip(emitter in sight) for large ones that something may stand before: small ones
/// are seen or not as their middles are. Returns the standard error of that [lux].
template <class Add, class Clip>
double LocalPass::see_body(const BodyInSight& lamp, const BodyLight& full, const Receiver& receiver, const Add& add,
                           const Clip& clip) const {
  const mesh::ShaftEnd eye = mesh::point_end(receiver.from);
  const BodySight sight = lamp.clear ? BodySight::kClear : bodies_.sight(solution_, *lamp.body, eye);
  if (sight == BodySight::kHidden) return 0.0;
  if (sight == BodySight::kClear) {
    for (const FacetLight& light : full.facets) add(emitters_[light.facet->emitter], light.factor);
    return 0.0;
  }
  std::vector<FacetLight> small;
  for (const FacetLight& light : full.facets) {
    const Emitter& emitter = emitters_[light.facet->emitter];
    if (emitter.exitance * light.factor > kSmallFacet * accuracy_ * full.lux)
      clip(EmitterInSight{&emitter, false});
    else
      small.push_back(light);
  }
  return see_middles(small, receiver, add);
}

template <class Add>
double LocalPass::see_middles(std::span<const FacetLight> facets, const Receiver& receiver, const Add& add) const {
  std::vector<double> lux;
  for (const FacetLight& light : facets) lux.push_back(emitters_[light.facet->emitter].exitance * light.factor);
  const std::vector<StandIn> chosen = stand_ins(lux, kMostMiddles);
  std::vector<mesh::Segment> segments;
  for (const StandIn& c : chosen) {
    const BodyFacet& facet = *facets[c.which].facet;
    segments.push_back({receiver.from, facet.centre + solution_.scene().rays->offset_m() * facet.normal});
  }
  std::vector<float> passed(segments.size());
  solution_.scene().rays->transmittance(segments, passed);
  double all = 0.0;
  double found = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const auto [which, weight] = chosen[i];
    const double own = weight * lux[which];
    all += own;
    found += own * passed[i];
    squares += own * own;
    add(emitters_[facets[which].facet->emitter], weight * facets[which].factor * passed[i]);
  }
  // Each is seen with the share of all as its probability.
  const double share = all > 0.0 ? std::min(1.0, found / all) : 0.0;
  return std::sqrt(share * (1.0 - share) * squares);
}

void LocalPass::from_body(const BodyInSight& lamp, const Receiver& receiver, Sum& sum) const {
  const auto add = [&](const Emitter& emitter, double factor) {
    sum.add(solution_.scene().side_exitance(solution_.tree().face_side(emitter.root)), factor);
  };
  sum.doubt(see_body(lamp, full_light(*lamp.body, receiver), receiver, add,
                     [&](const EmitterInSight& facet) { from_emitter(facet, receiver, sum); }));
}

/// Returns whether any ray has met light.
bool LocalPass::through_opening(const MinorOpening& drawn, std::uint32_t rays, const Receiver& receiver,
                                Sum& sum) const {
  const Scene& scene = solution_.scene();
  const std::uint32_t opening = drawn.opening;
  const OpeningSampler sampler(receiver.from, scene.openings[opening].triangles);
  const PathRule rule{PathRule::Part::kOpening, static_cast<std::int32_t>(opening), true};
  sum.begin();
  for (std::uint32_t i = 0; i < rays; ++i) {
    const SolidAngleSample s = sampler.sample(numbers_[i][0], numbers_[i][1]);
    const double cosine = dot(s.direction, receiver.normal);
    sum.begin_ray(drawn.weight * s.solid_angle_sr * cosine / std::numbers::pi, false);
    if (s.solid_angle_sr <= 0.0 || cosine <= 0.0 || dot(s.direction, scene.openings[opening].outward) <= 0.0) continue;
    follow(scene, receiver.from, s.direction, 1.0F, rule, sum);
  }
  sum.end();
  return sum.part_lux() > 0.0;
}

/// What openings give at most whose rays have all missed the sky: by clipping, where that may matter beside all other light.
void LocalPass::add_missed(std::span<const Missed> missed, const Receiver& receiver, Sum& sum) const {
  const Scene& scene = solution_.scene();
  const double neglected = kNeglected * accuracy_ * std::max(sum.weighted(), dark_lux_);
  for (const auto& [drawn, rays] : missed) {
    const mesh::ShaftEnd& end = opening_ends_[drawn.opening];
    if (full_through(scene, end, receiver.from, receiver.normal) < rays * neglected) continue;
    sum.doubt(drawn.weight * most_through(scene, end, receiver.from, receiver.normal) / rays);
  }
}

/// What surfaces reflect, and the sky by no opening.
void LocalPass::from_surfaces(const Receiver& receiver, Sum& sum) const {
  const mesh::Frame frame = mesh::frame_around(receiver.normal);
  sum.begin();
  std::uint32_t rays = 0;
  for (std::uint32_t until = kLeastRays;; until *= 2) {
    for (; rays < until; ++rays) {
      sum.begin_ray(1.0, rays < kLeastRays);
      const Vector& local = hemisphere_[rays];
      const Vector d = local.x * frame.u + local.y * frame.v + local.z * frame.w;
      follow(solution_.scene(), receiver.from, d, 1.0F, PathRule{PathRule::Part::kGather, -1, true}, sum);
    }
    const double goal = kGoal * accuracy_ * std::max(sum.weighted() + sum.part_lux(), dark_lux_);
    if (2 * until > most_rays_ || sum.part_variance() <= goal * goal) break;
  }
  sum.end();
}

}  // namespace clerestory::lighting
