// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/direct_sampler.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "lighting/light_paths.h"
#include "lighting/opening_sampler.h"
#include "lighting/openings.h"
#include "lighting/replicates.h"
#include "lighting/sampling.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;

namespace {

constexpr std::uint32_t kPoints = 8;      ///< places on a node, to see how light changes over it
constexpr std::uint32_t kDirections = 8;  ///< from each place towards each opening, and into the open hemisphere
/// Where a node looks at many openings, from each place so many towards all of them, but no fewer than this towards each: errors of many parts
/// even out.
constexpr std::size_t kAllDirections = 16;
constexpr std::size_t kLeastDirections = 2;
/// Rays that must all fail before an opening, or the open sky, counts as unseen by a node and all its parts; each with a place and a
/// direction of its own, stratified in all four dimensions. When n of them have failed, up to 3/n may be seen with 95 % confidence
/// [Hanley, Lippman-Hand 1983]: so many that this does not matter, within bounds.
constexpr std::uint32_t kLeastProbes = 32;
constexpr std::uint32_t kMostProbes = 256;
constexpr std::uint32_t kBatches = 4;     ///< independent scramblings that tell the noise of a node's mean
constexpr std::uint32_t kFirstRays = 32;  ///< a batch and opening, to begin with; fewer where a node looks at many
constexpr std::uint32_t kLeastRays = 8;
constexpr std::uint32_t kMostRays = 1024;  ///< a batch and opening
/// Twice the rays take no more off a variance than this leaves: few batches that agree by chance would end the sampling too early.
constexpr double kLeastLeft = 0.25;
constexpr double kNoiseShare = 0.5;     ///< of the tolerance, what light may be unsure by that is measured with fewer
constexpr std::size_t kLeastMinor = 4;  ///< openings that hardly matter: so many at least, and at most, stand for all
constexpr std::size_t kMostMinor = 16;
constexpr double kBeyondGuess = 0.4;        ///< outdoor surfaces receive some 40 % of the open sky's light
constexpr float kLeastReflectance = 0.05F;  ///< black surfaces are still shown with their illuminance

/// Stands for the sky seen through no opening, where an opening's number is asked for.
constexpr std::int32_t kOpenSky = -1;

/// Adds up what rays from a node end on.
struct Collector {
  const Solution* solution;
  bool surfaces_count = false;
  std::vector<SeenSurface>* beyond = nullptr;  ///< where asked for
  GroupSums* groups = nullptr;                 ///< where asked for
  double share = 1.0;                          ///< that the ray has of what groups are given
  std::span<double> moments{};                 ///< where asked for, of each moment's sky [lux]
  double sky_lux = 0.0;
  double guess_lux = 0.0;

  void surface(const SurfacePoint& seen, float weight, bool) {
    if (!surfaces_count) return;
    if (beyond != nullptr) beyond->push_back(seen_surface(*solution, seen, weight));
    const Scene& scene = solution->scene();
    const float rho = luminance(scene.side_reflectance(seen.side), scene.channel_weights);
    const float own = luminance(scene.side_exitance(seen.side), scene.channel_weights);
    guess_lux += weight * (own + rho * kBeyondGuess * scene.sky.ground_illuminance_lux());
  }
  void sky(const Vector& direction, float weight, bool) {
    const double lux = weight * std::numbers::pi * sky_luminance(solution->scene().sky, direction);
    sky_lux += lux;
    const Scene& scene = solution->scene();
    const double per_luminance = weight * std::numbers::pi;
    if (groups != nullptr) add_sky_light(scene, direction, share * lux, share * per_luminance, *groups);
    for (std::size_t m = 0; m < moments.size(); ++m)
      moments[m] += per_luminance * sky_luminance(scene.sky.parts[m], direction);
  }
};

/// What a node sees of the sky in panes comes by links that follow the mirrors; what it sees through an opening, mirrors
/// outdoors included, by the opening's rays.
PathRule rule_of(std::int32_t opening) {
  if (opening == kOpenSky) return {PathRule::Part::kGather, -1, false};
  return {PathRule::Part::kOpening, opening, true};
}

/// Of light that lies between 0 and a bound, the mean of n independent rays has a standard error of bound/(2√n) at most: so many
/// make it no more than is allowed.
double enough_rays(double bound, double allowed) { return bound * bound / (4.0 * allowed * allowed); }

/// Errors of many parts, each a small share of the light, even out.
std::uint32_t first_rays(std::size_t parts) {
  const std::size_t share = 2 * kFirstRays / std::max<std::size_t>(1, parts);
  return std::clamp(static_cast<std::uint32_t>(std::bit_floor(share)), kLeastRays, kFirstRays);
}

/// Where a survey looks from each place, as points of the unit square.
using Directions = std::array<std::array<double, 2>, kDirections>;

Directions directions_of(std::uint64_t key) {
  const SobolPoints numbers(key);
  Directions directions{};
  for (std::uint32_t j = 0; j < kDirections; ++j) directions[j] = numbers.point<2>(j);
  return directions;
}

/// The place of an opening that belongs to (a, b) in the unit square, about uniform by area.
Point point_of(const Opening& opening, double a, double b) {
  const double n = a * static_cast<double>(opening.triangles.size());
  const auto i = std::min(static_cast<std::size_t>(n), opening.triangles.size() - 1);
  const auto& t = opening.triangles[i];
  const double r = std::sqrt(n - static_cast<double>(i));
  return t[0] + (r * (1.0 - b) * (t[1] - t[0]) + r * b * (t[2] - t[0]));
}

/// Errors of sources seen at places of their own are independent.
void add(const LinearFit& fit, LinearFit& sum) {
  sum.line.value += fit.line.value;
  sum.line.slope_u += fit.line.slope_u;
  sum.line.slope_v += fit.line.slope_v;
  sum.residual = std::hypot(sum.residual, fit.residual);
}

/// Slopes by a mean.
LinearValue relative(const LinearValue& line, double mean) {
  if (mean <= 0.0) return {1.0F, 0.0F, 0.0F};
  return {1.0F, static_cast<float>(line.slope_u / mean), static_cast<float>(line.slope_v / mean)};
}

}  // namespace

double DirectSurvey::sunless_residual() const {
  return std::sqrt(std::max(0.0, fit.residual * fit.residual - sun_residual * sun_residual));
}

/// A shadow ray that tells whether an opening, or the open sky, can be seen.
struct DirectSampler::Probe {
  mesh::Segment segment;
  Vector direction;
  bool possible = false;
};

struct DirectSampler::Places {
  std::array<PlaneSample, kPoints> samples;
  std::array<Point, kPoints> lifted;
  std::vector<std::array<double, kPoints>> moments;  ///< of each moment's sky [lux]
  double total = 0.0;                                ///< the mean of all places [lux]
};

/// What a node sees through one opening, or of the open sky: sums over the rays of all batches.
struct DirectSampler::Part {
  Part(std::int32_t of, const SourceGroups& all) : opening(of), groups(all) {}

  /// What the rays' sums are to be multiplied by.
  [[nodiscard]] double share() const { return 1.0 / (static_cast<double>(rays) * kBatches); }
  [[nodiscard]] ReplicateMean lux() const {
    std::array<double, kBatches> means = sums;
    for (double& mean : means) mean /= rays;
    ReplicateMean mean = mean_of_replicates(means);
    mean.variance = std::max(mean.variance, kLeastLeft * variance_before);
    return mean;
  }
  /// Of what it adds, that of having been drawn for others included [Horvitz, Thompson 1952].
  [[nodiscard]] double variance() const {
    const ReplicateMean own = lux();
    return weight * weight * own.variance + weight * (weight - 1.0) * own.mean * own.mean;
  }
  void add_to(DirectMeasurement& result, GroupSums& of_all) const {
    result.received += weight * share() * received;
    result.total += weight * lux().mean;
    for (const GroupLight& light : groups.lit()) of_all.add(light.group, weight * share() * light.lux);
    for (SeenSurface seen : beyond) {
      seen.factor *= static_cast<float>(weight * share());
      result.beyond.push_back(seen);
    }
  }

  std::int32_t opening;
  double weight = 1.0;                  ///< of its light: above 1 where it stands for other openings
  std::uint32_t rays = 0;               ///< a batch
  double variance_before = 0.0;         ///< by half of the rays; 0 of the first ones
  std::array<double, kBatches> sums{};  ///< with the guess of what lies beyond
  double received = 0.0;                ///< from the sky
  GroupSums groups;
  std::vector<SeenSurface> beyond;
};

struct DirectSampler::Start {
  Point at;
  Vector direction;
  double weight = 0.0;  ///< share of the cosine-weighted hemisphere that the ray stands for
};

DirectSampler::DirectSampler(const Solution& solution, const Importance& importance, double tolerance,
                             std::uint64_t seed)
    : solution_(solution),
      importance_(importance),
      tolerance_lux_(tolerance * importance.mean_lux()),
      seed_(seed),
      brightest_(sky_luminance_bound(solution.scene().sky)),
      luminaires_(solution, seed, tolerance * luminaire_flux(solution.scene())) {
  scene().sky.for_suns([&](const Sun& sun) {
    suns_.emplace_back(solution, sun, suns_.empty() ? seed : mesh::hash(seed, suns_.size()));
  });
  for (const Opening& opening : scene().openings) ends_.push_back(shaft_end(opening));
}

double DirectSampler::reflectance(ElementId e) const {
  return std::max(kLeastReflectance,
                  luminance(scene().side_reflectance(solution_.tree().face_side(e)), scene().channel_weights));
}

/// What a node's illuminance may be wrong by [lux].
double DirectSampler::tolerance(ElementId e) const {
  return tolerance_lux_ / (reflectance(e) * importance_.of(solution_.tree(), e));
}

DirectSampler::Places DirectSampler::places_on(ElementId e, std::uint64_t key) const {
  const mesh::ElementTree& tree = solution_.tree();
  const SobolPoints numbers(key);
  Places places;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const auto [a, b] = numbers.point<2>(i);
    const Point p = tree.sample(e, a, b);
    const Vector d = p - tree.centroid(e);
    places.samples[i] = {dot(d, tree.axes(e).u), dot(d, tree.axes(e).v), 0.0, 1.0 / kPoints};
    places.lifted[i] = p + scene().rays->offset_m() * tree.normal(e);
  }
  places.moments.resize(scene().sky.parts.size());
  return places;
}

DirectSurvey DirectSampler::survey(const DirectCandidate& candidate, bool roughly) const {
  const ElementId e = candidate.node;
  const double allowed = roughly ? std::numeric_limits<double>::infinity() : tolerance(e);
  const std::uint64_t key = mesh::hash(seed_, solution_.tree().key(e));
  DirectSurvey result;
  result.below.node = e;
  result.below.open_sky = false;
  result.below.minor = candidate.minor;
  const mesh::ShaftEnd own = mesh::shaft_end(solution_.tree(), e);
  for (const std::uint32_t k : candidate.openings) {
    if (!in_view(e, own, k)) continue;
    if (most_light() * most_seen(e, k) <= allowed) {
      result.below.minor.push_back({k});
      continue;
    }
    if (scene().shafts->classify(own, ends_[k]) == mesh::Visibility::kHidden) continue;
    if (sees(e, static_cast<std::int32_t>(k), allowed)) result.below.openings.push_back(k);
  }
  keep_few(e, allowed, key, result.below.minor);
  if (candidate.open_sky && scene().has_sky()) {
    result.below.minor_sky = most_light() <= allowed;
    result.below.open_sky = result.below.minor_sky || sees(e, kOpenSky, allowed);
  }
  const Places places = look_out(result.below, key);
  result.fit = fit_line(places.samples);
  result.total = places.total;
  add_suns(candidate, result);
  add_luminaires(candidate, result);
  return result;
}

/// The light at places all over a node through the openings that matter to it, and from the open sky.
DirectSampler::Places DirectSampler::look_out(const DirectCandidate& node, std::uint64_t key) const {
  Places places = places_on(node.node, key);
  const std::size_t share = kAllDirections / std::max<std::size_t>(1, node.openings.size());
  const std::size_t each = std::clamp<std::size_t>(std::bit_floor(share), kLeastDirections, kDirections);
  for (const std::uint32_t k : node.openings) {
    const Directions directions = directions_of(mesh::hash(key, k));
    survey_opening(node.node, k, std::span(directions).first(each), places);
  }
  if (node.open_sky && !node.minor_sky) survey_sky(node.node, mesh::hash(key, 0xFFFF), places);
  return places;
}

double DirectSampler::effect(const DirectSurvey& survey) const {
  const ElementId e = survey.below.node;
  // Where importance lies on a part of the node, a few places all over it do not tell what matters.
  return reflectance(e) *
         (importance_.of(solution_.tree(), e) * survey.fit.residual + importance_.uneven(e) * survey.total);
}

DirectMeasurement DirectSampler::measure(const DirectSurvey& survey, bool roughly) const {
  const ElementId e = survey.below.node;
  DirectMeasurement result;
  GroupSums groups(scene().groups);
  std::vector<Part> parts;
  for (const std::uint32_t k : survey.below.openings) parts.emplace_back(static_cast<std::int32_t>(k), scene().groups);
  if (survey.below.open_sky && !survey.below.minor_sky) parts.emplace_back(kOpenSky, scene().groups);
  for (Part& part : parts) {
    const std::uint32_t first = rays_to_begin(e, part.opening, parts.size());
    if (first > 1) extend(e, first / 2, part);
    extend(e, first, part);
  }
  if (!roughly) improve(e, parts);
  measure_minor(survey.below, parts);
  for (const Part& part : parts) {
    result.noise += part.variance();
    part.add_to(result, groups);
  }
  result.noise = std::sqrt(result.noise);
  const double allowed = roughly ? std::numeric_limits<double>::infinity() : tolerance(e);
  const ReplicateMean by_luminaires = luminaires_.mean(e, survey.below.luminaires, allowed, groups);
  result.by_luminaires = by_luminaires.mean;
  result.received += by_luminaires.mean;
  result.total += by_luminaires.mean;
  result.noise = std::hypot(result.noise, by_luminaires.standard_error());
  for (std::size_t k = 0; k < suns_.size(); ++k) {
    const ReplicateMean by_sun = suns_[k].mean(e, survey.below.suns[k], allowed);
    if (scene().sky.parts.empty()) groups.add(scene().groups.of_sun(), by_sun.mean);
    result.received += by_sun.mean;
    result.total += by_sun.mean;
    result.by_suns.mean += by_sun.mean;
    result.by_suns.variance += by_sun.variance;
  }
  result.groups = groups.lit();
  find_slopes(survey, result);
  return result;
}

/// From directions of their own: a node is accepted because its survey has found light even on it, and the slopes of that survey are too
/// small on the average.
void DirectSampler::find_slopes(const DirectSurvey& survey, DirectMeasurement& result) const {
  const ElementId e = survey.below.node;
  Places places = look_out(survey.below, mesh::hash(mesh::hash(seed_, solution_.tree().key(e)), 0x51095));
  LinearFit fit = fit_line(places.samples);
  add(survey.sources, fit);
  result.slope = relative(fit.line, result.total);
  for (const auto& lux : places.moments) {
    for (std::uint32_t i = 0; i < kPoints; ++i) places.samples[i].value = lux[i];
    result.moment_slopes.push_back(fit_line(places.samples).line);
  }
}

/// Few rays for what hardly matters.
void DirectSampler::measure_minor(const DirectCandidate& node, std::vector<Part>& parts) const {
  const mesh::ShaftEnd own = mesh::shaft_end(solution_.tree(), node.node);
  for (const MinorOpening& minor : node.minor) {
    if (!in_view(node.node, own, minor.opening)) continue;
    Part& part = parts.emplace_back(static_cast<std::int32_t>(minor.opening), scene().groups);
    part.weight = minor.weight;
    extend(node.node, 1, part);
  }
  if (node.minor_sky) extend(node.node, kLeastRays, parts.emplace_back(kOpenSky, scene().groups));
}

/// Where a node cannot matter much through many openings, a few of them stand for all: else each of n rooms would look for light
/// through the windows of n.
void DirectSampler::keep_few(ElementId e, double allowed, std::uint64_t key, std::vector<MinorOpening>& minor) const {
  if (minor.size() <= kLeastMinor) return;
  std::vector<double> sizes;
  double all = 0.0;
  for (const MinorOpening& m : minor) all += sizes.emplace_back(m.weight * most_seen(e, m.opening));
  const double enough = std::clamp<double>(enough_rays(most_light() * all, allowed), kLeastMinor, kMostMinor);
  draw_openings(sizes, static_cast<std::size_t>(std::ceil(enough)), SobolPoints(mesh::hash(key, 0xFEFE)).at(0, 0),
                minor);
}

/// A bound on the illuminance of a node that sees nothing but sky and ground [lux].
double DirectSampler::most_light() const { return std::numbers::pi * brightest_; }

/// A bound on the form factor of an opening.
double DirectSampler::most_seen(ElementId e, std::uint32_t k) const {
  const mesh::ElementTree& tree = solution_.tree();
  const mesh::ShaftEnd& end = ends_[k];
  const Point centre = midpoint(end.corners[0], end.corners[2]);
  const double reach = tree.radius(e) + norm(end.corners[0] - centre);
  const double distance = norm(tree.centroid(e) - centre) - reach;
  if (distance <= 0.0) return 1.0;
  return std::min(1.0, scene().openings[k].area_m2 / (std::numbers::pi * distance * distance));
}

/// A bound on what an opening, or the open sky, gives.
double DirectSampler::most_lux(ElementId e, std::int32_t opening) const {
  return most_light() * (opening == kOpenSky ? 1.0 : most_seen(e, static_cast<std::uint32_t>(opening)));
}

/// A batch: as many as are enough for what it gives at most, and no more than the share of one part.
std::uint32_t DirectSampler::rays_to_begin(ElementId e, std::int32_t opening, std::size_t parts) const {
  const double enough = enough_rays(most_lux(e, opening), kNoiseShare * tolerance(e)) / kBatches;
  return std::bit_ceil(static_cast<std::uint32_t>(std::clamp<double>(enough, 1.0, first_rays(parts))));
}

/// Whether some part of the node lies inside of the opening's plane, and some of the opening in front of the node.
/// @param own  shaft_end() of the node
bool DirectSampler::in_view(ElementId e, const mesh::ShaftEnd& own, std::uint32_t k) const {
  if (solution_.tree().face_side(e).face == scene().openings[k].face) return false;
  const auto in_front = [](const mesh::ShaftEnd& of, const mesh::ShaftEnd& other) {
    for (std::size_t i = 0; i < other.count; ++i) {
      if (dot(other.corners[i] - of.corners[0], of.normal) > 1e-9) return true;
    }
    return false;
  };
  return in_front(own, ends_[k]) && in_front(ends_[k], own);
}

/// @param directions  points of the unit square
void DirectSampler::survey_opening(ElementId e, std::uint32_t k, std::span<const std::array<double, 2>> directions,
                                   Places& places) const {
  const Vector& normal = solution_.tree().normal(e);
  std::vector<double> moments(places.moments.size());
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const OpeningSampler sampler(places.lifted[i], scene().openings[k].triangles);
    for (const auto& [a, b] : directions) {
      const SolidAngleSample s = sampler.sample(a, b);
      const double cosine = dot(s.direction, normal);
      if (s.solid_angle_sr <= 0.0 || cosine <= 0.0) continue;
      const double weight = s.solid_angle_sr * cosine / (std::numbers::pi * static_cast<double>(directions.size()));
      Collector collector{&solution_, true};
      collector.moments = moments;
      std::fill(moments.begin(), moments.end(), 0.0);
      follow(scene(), places.lifted[i], s.direction, 1.0F, rule_of(static_cast<std::int32_t>(k)), collector);
      const double lux = weight * (collector.sky_lux + collector.guess_lux);
      places.samples[i].value += lux;
      places.total += lux / kPoints;
      for (std::size_t m = 0; m < moments.size(); ++m) places.moments[m][i] += weight * moments[m];
    }
  }
}

void DirectSampler::survey_sky(ElementId e, std::uint64_t key, Places& places) const {
  const mesh::Frame frame = mesh::frame_around(solution_.tree().normal(e));
  const Directions directions = directions_of(key);
  std::vector<double> moments(places.moments.size());
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    for (const auto& [a, b] : directions) {
      const Vector d = cosine_direction(frame, a, b);
      Collector collector{&solution_};
      collector.moments = moments;
      std::fill(moments.begin(), moments.end(), 0.0);
      follow(scene(), places.lifted[i], d, 1.0F, rule_of(kOpenSky), collector);
      places.samples[i].value += collector.sky_lux / kDirections;
      for (std::size_t m = 0; m < moments.size(); ++m) places.moments[m][i] += moments[m] / kDirections;
      places.total += collector.sky_lux / (kDirections * kPoints);
    }
  }
}

/// The edges of the suns' light ask for more places than what is smooth: each is fitted by itself.
void DirectSampler::add_suns(const DirectCandidate& candidate, DirectSurvey& result) const {
  for (std::size_t k = 0; k < suns_.size(); ++k) {
    const SunView known = candidate.suns.empty() ? SunView::kUnknown : candidate.suns[k];
    const SunSurvey sun = suns_[k].survey(candidate.node, known);
    result.below.suns.push_back(sun.view);
    add(sun.fit, result.fit);
    add(sun.fit, result.sources);
    result.sun_residual = std::hypot(result.sun_residual, sun.fit.residual);
    result.total += sun.mean_lux;
  }
}

void DirectSampler::add_luminaires(const DirectCandidate& candidate, DirectSurvey& result) const {
  LuminaireSurvey survey = luminaires_.survey(candidate.node, candidate.luminaires);
  result.below.luminaires = std::move(survey.views);
  add(survey.fit, result.fit);
  add(survey.fit, result.sources);
  result.total += survey.mean_lux;
}

/// A ray from a place of a node towards an opening, or into the open hemisphere.
DirectSampler::Start DirectSampler::start(ElementId e, std::int32_t opening, const SobolPoints& numbers,
                                          std::uint32_t i) const {
  const mesh::ElementTree& tree = solution_.tree();
  const Vector& normal = tree.normal(e);
  const auto [a, b, c, d] = numbers.point<4>(i);
  Start ray;
  ray.at = tree.sample(e, a, b) + scene().rays->offset_m() * normal;
  if (opening == kOpenSky) {
    ray.direction = cosine_direction(tree.axes(e), c, d);
    ray.weight = 1.0;
    return ray;
  }
  const OpeningSampler sampler(ray.at, scene().openings[static_cast<std::size_t>(opening)].triangles);
  const SolidAngleSample s = sampler.sample(c, d);
  ray.direction = s.direction;
  ray.weight = s.solid_angle_sr * std::max(0.0, dot(s.direction, normal)) / std::numbers::pi;
  return ray;
}

/// A probe from a place of a node to a place of an opening, or out of the model.
DirectSampler::Probe DirectSampler::probe(ElementId e, std::int32_t opening, const SobolPoints& numbers,
                                          std::uint32_t i) const {
  const mesh::ElementTree& tree = solution_.tree();
  const Vector& normal = tree.normal(e);
  const auto [a, b, c, d] = numbers.point<4>(i);
  const Point at = tree.sample(e, a, b) + scene().rays->offset_m() * normal;
  if (opening == kOpenSky) {
    const Vector out = cosine_direction(tree.axes(e), c, d);
    return {{at, at + 2.0 * scene().rays->bounds().diagonal() * out}, out, true};
  }
  const Opening& o = scene().openings[static_cast<std::size_t>(opening)];
  const Point inside = point_of(o, c, d) - scene().rays->offset_m() * o.outward;
  const Vector there = inside - at;
  return {{at, inside}, normalized(there), dot(there, normal) > 0.0 && dot(there, o.outward) > 0.0};
}

/// Whether anything bright lies where an unobstructed probe leads.
bool DirectSampler::is_lit(const Probe& probe, std::int32_t opening) const {
  if (opening == kOpenSky) return sky_luminance(scene().sky, probe.direction) > 0.0;
  Collector collector{&solution_, true};
  follow(scene(), probe.segment.from, probe.direction, 1.0F, rule_of(opening), collector);
  return collector.sky_lux + collector.guess_lux > 0.0;
}

/// @param allowed  what may be missed [lux]
bool DirectSampler::sees(ElementId e, std::int32_t opening, double allowed) const {
  constexpr std::uint32_t kFirst = 4;  // the first probe of what can be seen tells so as a rule
  constexpr std::uint32_t kBatch = 16;
  const SobolPoints numbers(
      mesh::hash(mesh::hash(seed_, solution_.tree().key(e)), static_cast<std::uint64_t>(opening + 7)));
  std::array<Probe, kBatch> probes;
  std::array<mesh::Segment, kBatch> segments;
  std::array<float, kBatch> passed{};
  const double enough = 3.0 * most_lux(e, opening) / allowed;
  const auto most = static_cast<std::uint32_t>(std::clamp<double>(enough, kLeastProbes, kMostProbes));
  for (std::uint32_t first = 0, end = kFirst; first < most; first = end, end = std::min(end + kBatch, most)) {
    std::size_t count = 0;
    for (std::uint32_t i = first; i < end; ++i) {
      probes[count] = probe(e, opening, numbers, i);
      segments[count] = probes[count].segment;
      count += probes[count].possible ? 1 : 0;
    }
    scene().rays->transmittance(std::span(segments).first(count), std::span(passed).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      if (passed[i] > 0.0F && is_lit(probes[i], opening)) return true;
    }
  }
  return false;
}

/// Casts rays of one part, up to so many a batch.
void DirectSampler::extend(ElementId e, std::uint32_t until, Part& part) const {
  const std::uint64_t key =
      mesh::hash(mesh::hash(seed_, solution_.tree().key(e)), static_cast<std::uint64_t>(part.opening + 0x10000));
  if (part.rays > 0) part.variance_before = part.lux().variance;
  for (std::uint32_t b = 0; b < kBatches; ++b) {
    const SobolPoints numbers(mesh::hash(key, b));
    for (std::uint32_t i = part.rays; i < until; ++i) {
      const Start ray = start(e, part.opening, numbers, i);
      if (ray.weight <= 0.0) continue;
      Collector collector{&solution_, part.opening != kOpenSky, &part.beyond, &part.groups, ray.weight};
      const std::size_t first = part.beyond.size();
      follow(scene(), ray.at, ray.direction, 1.0F, rule_of(part.opening), collector);
      for (std::size_t k = first; k < part.beyond.size(); ++k) part.beyond[k].factor *= static_cast<float>(ray.weight);
      part.received += ray.weight * collector.sky_lux;
      part.sums[b] += ray.weight * (collector.sky_lux + collector.guess_lux);
    }
  }
  part.rays = until;
}

/// Doubles the rays of the part that is least sure, until all together are within the tolerance or have as many as there may be.
void DirectSampler::improve(ElementId e, std::span<Part> parts) const {
  const double allowed = tolerance(e) * tolerance(e);
  while (true) {
    double variance = 0.0;
    double most = 0.0;
    Part* worst = nullptr;
    for (Part& part : parts) {
      const double own = part.lux().variance;
      variance += own;
      if (part.rays >= kMostRays || own / part.rays <= most) continue;
      most = own / part.rays;
      worst = &part;
    }
    if (variance <= allowed || worst == nullptr) return;
    extend(e, 2 * worst->rays, *worst);
  }
}

}  // namespace clerestory::lighting
