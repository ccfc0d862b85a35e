// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/linker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "lighting/form_factor.h"
#include "lighting/linear_fit.h"
#include "lighting/relaxation.h"
#include "lighting/sampling.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::OutlineEdge;
using mesh::Point;
using mesh::Vector;
using mesh::Visibility;

namespace {

constexpr std::size_t kPlaces = 16;  ///< on a piece, at most
constexpr std::size_t kRays = 24;    ///< or a little more, from all places to a source of partial visibility
constexpr std::uint32_t kClusterRays = 16;
constexpr std::uint32_t kFewRays = 4;  ///< to what cannot matter
constexpr double kSmallest = 0.015;    ///< elements of a smaller radius are not split [m]
/// Black receivers reflect nothing, but what they take is shown and belongs to the balance: they count as dark ones.
constexpr float kLeastReflectance = 0.2F;
/// Products of outlines up to this are integrated exactly; beyond it the mean of the places does.
constexpr std::size_t kExactPairs = 512;
/// Mean squares between places over those within them from which on places differ: by chance, 7 places of 4 rays come to it once in a
/// hundred times (the F distribution of 6 and 21 degrees of freedom).
constexpr double kDiffer = 3.81;
constexpr double kInFront = 1e-7;  ///< a corner this far in front of a plane counts as in front [m]

/// Streams of random numbers, beside the one of links between elements.
constexpr std::uint64_t kJudging = 1;  ///< of clusters, by whose points they are judged
constexpr std::uint64_t kRough = 2;    ///< of elements that cannot matter
constexpr std::uint64_t kKeeping = 3;  ///< of clusters that are kept

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

/// One piece as seen from another: form factors from its places, and how they run over it.
struct View {
  LinearFit fit;            ///< of the factors, visibility included where it was sampled
  double unoccluded = 0.0;  ///< mean factor without occluders
  double rays = 0.0;
  double passing = 0.0;
  double between = 0.0;  ///< mean square of the places' shares about the mean of all, by their rays
  double within = 0.0;   ///< of the rays of one place about its share

  /// Whether what is seen differs more from place to place than from ray to ray of one place: then parts of this piece see more evenly,
  /// and parts of the other one do not [the analysis of variance: Fisher 1925].
  [[nodiscard]] bool places_differ() const { return between > kDiffer * within; }
  [[nodiscard]] double seen_share() const { return unoccluded > 0.0 ? fit.line.value / unoccluded : 0.0; }
};

/// Sums of squares over the rays of all places.
class SeenShares {
 public:
  void add(std::span<const float> passed) {
    double sum = 0.0;
    double squares = 0.0;
    for (const float p : passed) {
      sum += p;
      squares += double{p} * p;
    }
    const auto n = static_cast<double>(passed.size());
    places_ += 1.0;
    rays_ += n;
    sum_ += sum;
    squares_of_places_ += sum * sum / n;
    within_ += squares - sum * sum / n;
  }
  void tell(View& view) const {
    if (places_ < 2.0) return;
    view.between = (squares_of_places_ - sum_ * sum_ / rays_) / (places_ - 1.0);
    view.within = within_ / std::max(1.0, rays_ - places_);
  }

 private:
  double places_ = 0.0;
  double rays_ = 0.0;
  double sum_ = 0.0;
  double squares_of_places_ = 0.0;
  double within_ = 0.0;
};

/// Which of two pieces is the smaller; by their keys where they are alike, so that both directions agree.
bool is_smaller(const mesh::ElementTree& tree, ElementId a, ElementId b) {
  return tree.area(a) != tree.area(b) ? tree.area(a) < tree.area(b) : tree.key(a) < tree.key(b);
}

/// Whether rays are cast between the pieces, and which of them receives: openings are crossed by rays from the receiver.
enum class RaysFrom { kNobody, kHere, kThere };

/// A place on a piece that a ray from elsewhere goes to, and its share of the form factor, but for a factor that all share.
struct Aim {
  Point at;
  double kernel = 0.0;
};

/// Aims at a piece: at places even by area where the piece is far, so that all count about alike; else in directions of a cosine-weighted hemisphere that hit
/// it, as most of the form factor may belong to a small part of it, which few places even by area would miss and others, hidden, stand for.
class Aimer {
 public:
  Aimer(const mesh::ElementTree& tree, ElementId at) : tree_(tree), at_(at) {}

  /// Towards those places of a piece that points give, from n on.
  /// @param factor  form factor of the piece from there
  void aim(const Point& from, const Vector& normal, double factor, const SobolPoints& points, std::uint32_t n,
           std::span<Aim> aims) const {
    const bool near = tree_.radius(at_) > kNear * norm(tree_.centroid(at_) - from);
    if (!near || factor < kLeastShare || !by_cosine(from, normal, points, n, aims))
      by_area(from, normal, points, n, aims);
  }

 private:
  /// Size over distance from which on the kernel is far from even.
  static constexpr double kNear = 0.5;
  /// Of the hemisphere, that a piece must fill for so many directions to hit it, out of kTries.
  static constexpr double kLeastShare = 0.04;
  static constexpr std::uint32_t kTries = 64;
  /// Numbers of the points that stand in for those which lie behind.
  static constexpr std::uint32_t kSpare = 1U << 16U;

  /// In front of the place only: where a piece reaches behind it, what lies there would leave places without a ray that tells anything.
  void by_area(const Point& from, const Vector& normal, const SobolPoints& points, std::uint32_t n,
               std::span<Aim> aims) const {
    std::uint32_t spare = kSpare + kTries * n;
    for (Aim& aim : aims) {
      aim = aim_at(tree_.sample(at_, points.at(n, 0), points.at(n, 1)), from, normal);
      const std::uint32_t end = spare + kTries;
      for (; aim.kernel <= 0.0 && spare < end; ++spare)
        aim = aim_at(tree_.sample(at_, points.at(spare, 0), points.at(spare, 1)), from, normal);
      ++n;
    }
  }

  [[nodiscard]] Aim aim_at(const Point& q, const Point& from, const Vector& normal) const {
    const Vector to = q - from;
    const double distance2 = dot(to, to);
    const double cosines = std::max(0.0, dot(to, normal)) * std::max(0.0, -dot(to, tree_.normal(at_)));
    return {q, cosines / (distance2 * distance2)};
  }

  /// Nothing where too few directions hit the piece.
  bool by_cosine(const Point& from, const Vector& normal, const SobolPoints& points, std::uint32_t n,
                 std::span<Aim> aims) const {
    const mesh::Frame frame = mesh::frame_around(normal);
    const Vector& facing = tree_.normal(at_);
    const double height = dot(tree_.centroid(at_) - from, facing);
    std::size_t found = 0;
    for (std::uint32_t i = kTries * n; i < kTries * (n + aims.size()) && found < aims.size(); ++i) {
      const Vector d = cosine_direction(frame, points.at(i, 2), points.at(i, 3));
      const double along = dot(d, facing);
      if (along >= 0.0) continue;
      const Point q = from + height / along * d;
      if (tree_.holds(at_, q)) aims[found++] = {q, 1.0};
    }
    return found == aims.size();
  }

  const mesh::ElementTree& tree_;
  ElementId at_;
};

/// Looks from one piece at another. Visibility, where asked for, is the kernel-weighted share of sampled points that each place sees.
View look(const Scene& scene, const mesh::ElementTree& tree, ElementId from, ElementId at, RaysFrom rays,
          std::uint64_t seed) {
  std::array<OutlineEdge, 3> scratch;
  const auto outline = tree.outline(at, scratch);
  const Vector& normal = tree.normal(from);
  const Vector& other_normal = tree.normal(at);
  const Places places = places_on(tree, from);
  const Aimer aimer(tree, at);
  const SobolPoints points(mesh::hash(mesh::hash(tree.key(from), tree.key(at)), seed));
  const double lift = scene.rays->offset_m();
  const std::size_t each = (kRays + places.count - 1) / places.count;
  std::array<PlaneSample, kPlaces> samples;
  SeenShares shares;
  View view;
  for (std::size_t i = 0; i < places.count; ++i) {
    const Point& place = places.at[i];
    const Vector d = place - tree.centroid(from);
    const double factor = point_form_factor(place, normal, outline, other_normal);
    samples[i] = {dot(d, tree.axes(from).u), dot(d, tree.axes(from).v), factor, places.weight[i]};
    view.unoccluded += places.weight[i] * factor;
    if (rays == RaysFrom::kNobody || factor <= 0.0) continue;
    std::array<mesh::Segment, kRays> segments;
    std::array<float, kRays> passed{};
    std::array<Aim, kRays> aims;
    aimer.aim(place, normal, factor, points, static_cast<std::uint32_t>(i * each), std::span(aims).first(each));
    double all = 0.0;
    for (std::size_t j = 0; j < each; ++j) {
      all += aims[j].kernel;
      segments[j] = {place + lift * normal, aims[j].at + lift * other_normal};
      if (rays == RaysFrom::kThere) std::swap(segments[j].from, segments[j].to);
    }
    scene.rays->transmittance(std::span(segments).first(each), std::span(passed).first(each));
    double seen = 0.0;
    for (std::size_t j = 0; j < each; ++j) {
      seen += aims[j].kernel * passed[j];
      view.passing += passed[j] > 0.0F ? 1.0 : 0.0;
    }
    view.rays += static_cast<double>(each);
    samples[i].value *= all > 0.0 ? seen / all : 0.0;
    shares.add(std::span(passed).first(each));
  }
  shares.tell(view);
  view.fit = fit_line(std::span(samples).first(places.count));
  return view;
}

/// Standard error of a factor whose visibility was sampled. A few rays that all pass, or all fail, prove nothing: the share that
/// passes is estimated with half a ray added to either outcome [Agresti, Coull 1998].
double visibility_noise(double factor, double rays, double passing) {
  if (rays <= 0.0) return 0.0;
  const double share = (passing + 0.5) / (rays + 1.0);
  return factor * std::sqrt(share * (1.0 - share) / rays);
}

/// Where nothing shines nothing is tolerated, and nothing is wrong.
double share_of(double error, double most) { return error <= 0.0 ? 0.0 : error / most; }

}  // namespace

Linker::Linker(const Solution& solution, const Clusters& clusters, const ChannelDeviations& channels,
               const Importance& importance, double tolerance_lux, std::uint64_t seed)
    : solution_(solution),
      clusters_(clusters),
      channels_(channels),
      importance_(importance),
      tolerance_lux_(tolerance_lux),
      seed_(seed),
      feet_(solution.scene().faces.count(), solution.scene().slits) {}

double Linker::tolerance(ElementId receiver) const {
  const Scene& scene = solution_.scene();
  const mesh::FaceSide side = solution_.tree().face_side(receiver);
  const float rho = std::max(kLeastReflectance, luminance(scene.side_reflectance(side), scene.channel_weights));
  return tolerance_lux_ / (rho * importance_.of(solution_.tree(), receiver));
}

bool Linker::holds(const Link& link) const {
  return strain(link) <= 1.0 && (!link.mutual || strain(reversed(link, solution_.tree())) <= 1.0);
}

double Linker::worst_strain(const Link& link) const {
  return link.mutual ? std::max(strain(link), strain(reversed(link, solution_.tree()))) : strain(link);
}

double Linker::strain(const Link& link) const {
  const double most = tolerance(link.receiver);
  if (link.rough) return share_of(most_light(link.receiver, link.source), most);
  return share_of(link.error * mean_of(solution_, clusters_, link.source) +
                      uneven_light(solution_.tree(), link, deviation(link.source)),
                  most);
}

LinkDecision::Kind Linker::split_of(const Link& link) const {
  if (!link.mutual) return split_for_receiver(link);
  const Link other = reversed(link, solution_.tree());
  if (strain(link) >= strain(other)) return split_for_receiver(link);
  switch (split_for_receiver(other)) {
    case LinkDecision::Kind::kSplitReceiver:
      return LinkDecision::Kind::kSplitSource;
    case LinkDecision::Kind::kSplitSource:
      return LinkDecision::Kind::kSplitReceiver;
    default:
      return LinkDecision::Kind::kLink;
  }
}

LinkDecision::Kind Linker::split_for_receiver(const Link& link) const {
  using Kind = LinkDecision::Kind;
  const mesh::ElementTree& tree = solution_.tree();
  const double own = tree.radius(link.receiver);
  if (link.source.is_cluster()) {
    const bool can = own > kSmallest;
    return can && own > 2.0 * clusters_.radius(link.source.cluster()) ? Kind::kSplitReceiver : Kind::kSplitSource;
  }
  const ElementId s = link.source.element();
  const double other = tree.radius(s);
  const bool uneven = deviation(link.source) > 0.02F * solution_.radiosity_mean(s);
  // A proven view of an even source gains nothing by splitting the source: its factor is exact.
  const bool own_first = link.split_small ? is_smaller(tree, link.receiver, s) : own >= other;
  // Nor does a spot of importance that a line over the receiver may miss.
  const double peak = unseen_peak(link.receiver, link.factor * tree.area(link.receiver), tree.area(s));
  const bool receiver_first =
      (link.visibility == Visibility::kVisible && !uneven) || own_first || 2.0 * peak > link.error;
  if (receiver_first && own > kSmallest) return Kind::kSplitReceiver;
  if (other > kSmallest) return Kind::kSplitSource;
  return own > kSmallest ? Kind::kSplitReceiver : Kind::kLink;
}

double Linker::deviation(LinkSource source) const {
  if (source.is_cluster())
    return std::max(clusters_.radiosity_deviation(source.cluster()), channels_.of_cluster(source.cluster()));
  return std::max(solution_.radiosity_deviation(source.element()), channels_.of(source.element()));
}

bool Linker::overlaps(ElementId receiver, std::uint32_t cluster) const {
  const mesh::ElementTree& tree = solution_.tree();
  const mesh::Box& box = clusters_.box(cluster);
  const Point& p = tree.centroid(receiver);
  const Point nearest{std::clamp(p.x, box.low.x, box.high.x), std::clamp(p.y, box.low.y, box.high.y),
                      std::clamp(p.z, box.low.z, box.high.z)};
  return norm(nearest - p) < tree.radius(receiver) + 0.5 * clusters_.radius(cluster);
}

LinkDecision Linker::settle(const LinkCandidate& candidate) const {
  using Kind = LinkDecision::Kind;
  if (candidate.source.is_cluster() && overlaps(candidate.receiver, candidate.source.cluster()))
    return {Kind::kSplitSource, {}};
  const std::optional<Link> made = link(candidate);
  return made ? LinkDecision{Kind::kLink, *made} : LinkDecision{};
}

LinkDecision Linker::decide(const LinkCandidate& candidate) const {
  LinkDecision decision = settle(candidate);
  if (decision.kind == LinkDecision::Kind::kLink && !holds(decision.link)) decision.kind = split_of(decision.link);
  return decision;
}

std::optional<Link> Linker::link(const LinkCandidate& candidate) const {
  return candidate.source.is_cluster() ? link_cluster(candidate, kJudging) : link_element(candidate);
}

std::optional<Link> Linker::remeasured(const Link& link) const {
  if (!link.source.is_cluster()) return link;
  std::optional<Link> made = link_cluster({link.receiver, link.source, link.visibility, link.mutual}, kKeeping);
  // Points that see nothing tell no better how far they are wrong than those which held.
  if (made && made->factor <= 0.0F) {
    made->error = link.error;
    made->noise = link.noise;
  }
  return made;
}

Visibility Linker::prove(ElementId receiver, ElementId source) const {
  const mesh::ElementTree& tree = solution_.tree();
  return solution_.scene().shafts->classify(mesh::shaft_end(tree, receiver), mesh::shaft_end(tree, source));
}

LinkDecision::Kind Linker::split_at_open_ends(const Link& link, double most) const {
  if (!link.mutual) return LinkDecision::Kind::kLink;
  const double here = solution_.is_open(link.receiver) ? link.error : 0.0;
  const double there = solution_.is_open(link.source.element()) ? link.back_error : 0.0;
  if (std::max(here, there) <= most) return LinkDecision::Kind::kLink;
  return here >= there ? LinkDecision::Kind::kSplitReceiver : LinkDecision::Kind::kSplitSource;
}

double Linker::most_light(ElementId receiver, LinkSource source) const {
  const mesh::ElementTree& tree = solution_.tree();
  const bool cluster = source.is_cluster();
  const Point& centre = cluster ? clusters_.centre(source.cluster()) : tree.centroid(source.element());
  const double radius = cluster ? clusters_.radius(source.cluster()) : tree.radius(source.element());
  const double area = cluster ? clusters_.area(source.cluster()) : tree.area(source.element());
  const double nearest = norm(centre - tree.centroid(receiver)) - radius - tree.radius(receiver);
  if (nearest <= 0.0) return std::numeric_limits<double>::infinity();
  const double bright = mean_of(solution_, clusters_, source) + deviation(source);
  return bright * std::min(1.0, area / (std::numbers::pi * nearest * nearest));
}

bool Linker::cannot_matter(ElementId receiver, ElementId source) const {
  constexpr double kApart = 0.3;  // sizes over distance up to which one point form factor stands for the pair
  const mesh::ElementTree& tree = solution_.tree();
  const double distance = norm(tree.centroid(source) - tree.centroid(receiver));
  return tree.radius(source) + tree.radius(receiver) <= kApart * distance &&
         most_light(receiver, LinkSource::element(source)) <= tolerance(receiver);
}

/// A link from the point form factor at the smaller piece's centroid and a few rays: right on the average over many such pairs, and
/// none of them alone can matter.
std::optional<Link> Linker::link_roughly(const LinkCandidate& candidate) const {
  const Scene& scene = solution_.scene();
  const mesh::ElementTree& tree = solution_.tree();
  const ElementId r = candidate.receiver;
  const ElementId s = candidate.source.element();
  const bool receiver_small = is_smaller(tree, r, s);
  const ElementId from = receiver_small ? r : s;
  const ElementId at = receiver_small ? s : r;
  std::array<OutlineEdge, 3> scratch;
  const double factor =
      point_form_factor(tree.centroid(from), tree.normal(from), tree.outline(at, scratch), tree.normal(at));
  if (factor <= kLeastFactor) return std::nullopt;
  // The same rays both ways.
  const SobolPoints points(mesh::hash(mesh::hash(tree.key(from), tree.key(at)), seed_ + kRough));
  const double lift = scene.rays->offset_m();
  std::array<mesh::Segment, kFewRays> segments;
  std::array<float, kFewRays> passed{};
  std::array<double, kFewRays> kernel{};
  for (std::uint32_t i = 0; i < kFewRays; ++i) {
    const Point p = tree.sample(from, points.at(i, 0), points.at(i, 1));
    const Point q = tree.sample(at, points.at(i, 2), points.at(i, 3));
    const Vector to = q - p;
    const double distance2 = dot(to, to);
    kernel[i] = std::max(0.0, dot(to, tree.normal(from))) * std::max(0.0, -dot(to, tree.normal(at))) /
                (std::numbers::pi * distance2 * distance2);
    const mesh::Segment lifted{p + lift * tree.normal(from), q + lift * tree.normal(at)};
    segments[i] = receiver_small ? lifted : mesh::Segment{lifted.to, lifted.from};
  }
  scene.rays->transmittance(segments, passed);
  double share = 0.0;
  double seen = 0.0;  // factor, by the kernel: through a slit rays pass where it is small
  for (std::size_t i = 0; i < kFewRays; ++i) {
    share += passed[i] / kFewRays;
    seen += passed[i] * kernel[i] * tree.area(at) / kFewRays;
  }
  Link link;
  link.receiver = r;
  link.source = candidate.source;
  link.rough = true;
  const double ratio = receiver_small ? 1.0 : tree.area(s) / tree.area(r);
  link.factor = static_cast<float>(seen * ratio);
  link.error = static_cast<float>(factor * ratio);
  link.noise = static_cast<float>(visibility_noise(factor * ratio, kFewRays, kFewRays * share));
  return link;
}

std::optional<Link> Linker::link_element(const LinkCandidate& candidate) const {
  const Scene& scene = solution_.scene();
  const mesh::ElementTree& tree = solution_.tree();
  const ElementId r = candidate.receiver;
  const ElementId s = candidate.source.element();
  const mesh::ShaftEnd end_r = mesh::shaft_end(tree, r);
  const mesh::ShaftEnd end_s = mesh::shaft_end(tree, s);
  const Lie source_lies = lie_of(end_s, tree.centroid(r), end_r.normal);
  const Lie receiver_lies = lie_of(end_r, tree.centroid(s), end_s.normal);
  if (!source_lies.any_in_front || !receiver_lies.any_in_front) return std::nullopt;
  if (candidate.visibility == Visibility::kPartial && cannot_matter(r, s)) return link_roughly(candidate);

  Link link;
  link.receiver = r;
  link.source = candidate.source;
  link.visibility = candidate.visibility;
  link.mutual = candidate.mutual;
  if (link.visibility == Visibility::kPartial) link.visibility = scene.shafts->classify(end_r, end_s);
  if (link.visibility == Visibility::kHidden) return std::nullopt;

  // Quadrature is good over the smaller piece: from there the larger one is seen whole, and its point form factor is exact. Over a
  // large receiver it would miss the bright spot next to a small source.
  const bool receiver_small = is_smaller(tree, r, s);
  const RaysFrom rays = link.visibility != Visibility::kPartial ? RaysFrom::kNobody
                        : receiver_small                        ? RaysFrom::kHere
                                                                : RaysFrom::kThere;
  const View small = look(scene, tree, receiver_small ? r : s, receiver_small ? s : r, rays, seed_);
  const View large = look(scene, tree, receiver_small ? s : r, receiver_small ? r : s, RaysFrom::kNobody, seed_);
  double exchange = small.unoccluded * std::min(tree.area(r), tree.area(s));
  if (source_lies.all_in_front && receiver_lies.all_in_front) {
    std::array<OutlineEdge, 3> scratch_r;
    std::array<OutlineEdge, 3> scratch_s;
    const auto outline_r = tree.outline(r, scratch_r);
    const auto outline_s = tree.outline(s, scratch_s);
    if (outline_r.size() * outline_s.size() <= kExactPairs) exchange = exchange_area(outline_r, outline_s);
  }
  if (small.unoccluded <= 0.0 || exchange <= kLeastFactor * std::min(tree.area(r), tree.area(s))) return std::nullopt;

  const double share = small.seen_share();
  const View& own = receiver_small ? small : large;
  const View& sources = receiver_small ? large : small;
  const double own_share = receiver_small ? 1.0 : share;
  const double source_share = (receiver_small ? share : 1.0) * tree.area(s) / tree.area(r);
  link.factor = static_cast<float>(share * exchange / tree.area(r));
  link.slope_u = static_cast<float>(own_share * own.fit.line.slope_u);
  link.slope_v = static_cast<float>(own_share * own.fit.line.slope_v);
  link.moment_u = static_cast<float>(source_share * sources.fit.line.slope_u);
  link.moment_v = static_cast<float>(source_share * sources.fit.line.slope_v);
  link.noise = static_cast<float>(visibility_noise(exchange / tree.area(r), small.rays, small.passing));
  link.split_small = small.places_differ();
  if (link.visibility == Visibility::kPartial) split_at_slits(link);
  // What the line over a piece misses there, by its own places; those of a large piece also miss some of the mean.
  const auto error_over = [&](ElementId piece, double other_area, const View& view, bool is_small) {
    const double unoccluded = exchange / tree.area(piece);
    const double missed = is_small ? 0.0 : share * std::abs(view.unoccluded - unoccluded);
    return (is_small ? 1.0 : share) * view.fit.residual + missed +
           visibility_noise(unoccluded, small.rays, small.passing) + unseen_peak(piece, share * exchange, other_area);
  };
  link.error = static_cast<float>(error_over(r, tree.area(s), own, receiver_small));
  if (link.mutual) link.back_error = static_cast<float>(error_over(s, tree.area(r), sources, !receiver_small));
  return link;
}

void Linker::split_at_slits(Link& link) const {
  const mesh::ElementTree& tree = solution_.tree();
  const ElementId s = link.source.element();
  const bool here = feet_.is_coarse(tree, link.receiver);
  if (here != feet_.is_coarse(tree, s)) link.split_small = is_smaller(tree, link.receiver, s) == here;
}

double Linker::unseen_peak(ElementId receiver, double exchange, double source_area) const {
  const mesh::ElementTree& tree = solution_.tree();
  const double uneven = importance_.uneven(receiver);
  if (uneven <= 0.0) return 0.0;
  return uneven / importance_.of(tree, receiver) * exchange / std::min(source_area, tree.area(receiver));
}

std::optional<Link> Linker::link_cluster(const LinkCandidate& candidate, std::uint64_t stream) const {
  const Scene& scene = solution_.scene();
  const mesh::ElementTree& tree = solution_.tree();
  const ElementId r = candidate.receiver;
  const std::uint32_t c = candidate.source.cluster();
  if (clusters_.is_turned_away(tree, c, r)) return std::nullopt;
  const Vector& normal = tree.normal(r);
  const SobolPoints points(mesh::hash(mesh::hash(tree.key(r), c), seed_ + stream));
  const double lift = scene.rays->offset_m();
  const bool rough = most_light(r, candidate.source) <= tolerance(r);
  const std::uint32_t rays = rough ? kFewRays : kClusterRays;
  std::array<mesh::Segment, kClusterRays> segments;
  std::array<float, kClusterRays> passed{};
  std::array<double, kClusterRays> kernel{};
  std::size_t facing = 0;
  const double mean = clusters_.radiosity_mean(c);
  for (std::uint32_t i = 0; i < rays; ++i) {
    const Point p = tree.sample(r, points.at(i, 0), points.at(i, 1));
    const ClusterPoint q = clusters_.sample(tree, c, points.at(i, 2), points.at(i, 3));
    const Vector to = q.at - p;
    const double distance2 = dot(to, to);
    const double cosines = std::max(0.0, dot(to, normal)) * std::max(0.0, -dot(to, q.normal));
    if (cosines <= 0.0) continue;
    // What is seen counts by how bright it is: a receiver in the dark half of a cluster gets nothing from the lit half's mean.
    const double bright = mean > 0.0 ? solution_.radiosity_mean(q.root) / mean : 1.0;
    kernel[facing] = bright * clusters_.area(c) * cosines / (std::numbers::pi * distance2 * distance2);
    segments[facing++] = {p + lift * normal, q.at + lift * q.normal};
  }
  scene.rays->transmittance(std::span(segments).first(facing), std::span(passed).first(facing));
  double sum = 0.0;
  double square = 0.0;
  // Where no point faces the receiver some still may, up to what the cluster could give were all of it turned to it.
  double unoccluded = facing > 0 || rough ? 0.0 : std::min(1.0, most_light(r, candidate.source) / mean);
  for (std::size_t i = 0; i < facing; ++i) {
    const double f = kernel[i] * passed[i];
    sum += f / rays;
    square += f * f / rays;
    unoccluded = std::max(unoccluded, kernel[i]);
  }
  Link link;
  link.receiver = r;
  link.source = candidate.source;
  link.rough = rough;
  link.factor = static_cast<float>(sum);
  // Few rays that see nothing prove little: what they may have missed counts as error.
  link.error = static_cast<float>(
      std::max(std::sqrt(std::max(0.0, square - sum * sum) / (rays - 1.0)), unoccluded / (4.0 * rays)));
  link.noise = link.error;
  link.error += static_cast<float>(unseen_peak(r, sum * tree.area(r), clusters_.area(c)));
  return link;
}

}  // namespace clerestory::lighting
