// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/radiosity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "lighting/arrivals.h"
#include "lighting/channel_deviations.h"
#include "lighting/channel_solver.h"
#include "lighting/channel_system.h"
#include "lighting/closure.h"
#include "lighting/element_limit.h"
#include "lighting/linker.h"
#include "lighting/lookers.h"
#include "lighting/mirror_links.h"
#include "lighting/parallel.h"
#include "lighting/relaxation.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Visibility;

namespace {

/// Tolerances of the passes, as multiples of the last.
constexpr std::array<double, 3> kPasses{9.0, 3.0, 1.0};
/// Shares of the time of linking at which the passes end, measured on the validation scenes.
constexpr std::array<double, kPasses.size()> kEndOfPass{0.3, 0.5, 0.9};
constexpr double kEndOfMirrors = 0.94;
constexpr double kEndOfClosing = 0.98;
/// Pairs between two signs of life.
constexpr std::size_t kBatch = 1U << 13U;
/// Error of a proven link's factor that parts of its ends may share.
constexpr double kMissed = 0.004;

class Solver {
 public:
  Solver(Solution& solution, const Importance& importance, DirectLight direct, const SolveOptions& options,
         Progress& progress)
      : progress_(progress),
        solution_(solution),
        importance_(importance),
        opening_links_(std::move(direct.links)),
        groups_(std::move(direct.groups)),
        by_luminaires_lm_(direct.by_luminaires_lm),
        suns_(std::move(direct.suns)),
        scale_lux_(direct.scale_lux),
        options_(options),
        clusters_(solution.scene(), solution.tree()) {}

  Transport run() {
    progress_.phase("linking");
    solution_.push_pull();
    clusters_.pull(solution_);
    refine_in_passes();
    progress_.advance(kEndOfPass.back());
    see_mirrors();
    progress_.advance(kEndOfMirrors);
    close_hemispheres(solution_, arrivals_);
    iterate();
    progress_.advance(kEndOfClosing);
    add_errors_of_looks();
    part_given_errors();
    SolutionErrors errors = add_errors_beside_given();
    progress_.advance(1.0);
    if (!options_.keep_link_errors) arrivals_.forget_errors();
    return {std::move(arrivals_), std::move(groups_), by_luminaires_lm_,    std::move(given_errors_),
            std::move(given_lm_), std::move(suns_),   std::move(clusters_), std::move(errors),
            iterations_,          convergence_,       out_of_elements_};
  }

 private:
  /// Each pass is finer than the one before, which has told where light is; the last one is where links are good enough for the sensors.
  void refine_in_passes() {
    std::vector<LinkCandidate> start = begin();
    for (std::size_t pass = 0; pass < kPasses.size(); ++pass) {
      const Linker linker(solution_, clusters_, channels_, importance_,
                          kPasses[pass] * options_.link_share * options_.accuracy * scale_lux_, options_.seed);
      bool last = pass + 1 == kPasses.size();
      if (pass > 0) {
        start = reopen(linker);
        if (start.empty() && !last) continue;
      }
      refine(linker, std::move(start), {pass > 0 ? kEndOfPass[pass - 1] : 0.0, kEndOfPass[pass]});
      remeasure_clusters(linker);
      last = last || progress_.should_finish();
      if (last) hand_down(linker);
      sort_links(!last);
      iterate();
      if (last) break;
      if (is_good_enough()) {
        hand_down(linker);
        break;
      }
      tell_channels_apart();
    }
  }

  /// Lets those who do so look around, and gives the links to begin with: none where nothing shines.
  std::vector<LinkCandidate> begin() {
    if (scale_lux_ <= 0.0) return {};
    const bool few = clusters_.are_few();
    Receivers receivers;
    if (few) {
      receivers.linking.assign(solution_.tree().roots().begin(), solution_.tree().roots().end());
    } else {
      const double goal_lux = options_.node_share * options_.accuracy * scale_lux_;
      receivers = find_receivers(solution_, importance_, {scale_lux_, goal_lux, options_.seed}, progress_);
    }
    lookers_ = std::move(receivers.lookers);
    const std::vector<std::uint32_t> beginnings = options_.clusters && !few ? clusters_.tops() : clusters_.leaves();
    std::vector<LinkCandidate> start;
    for (const Looker& looker : lookers_) {
      take_mirrored_sky(looker);
      for (const std::uint32_t top : beginnings) {
        if (clusters_.kind(top) == Clusters::Kind::kShining)
          start.push_back({looker.node, source_of(top), Visibility::kPartial});
      }
    }
    for (const ElementId root : receivers.linking) {
      for (const std::uint32_t top : beginnings) start.push_back({root, source_of(top), Visibility::kPartial});
    }
    return start;
  }

  void take_mirrored_sky(const Looker& looker) {
    const auto& [node, view] = looker;
    for (LinearValue& direct : solution_.direct(node)) direct.value += static_cast<float>(view.mirrored_sky_lux);
    for (const GroupLight& light : view.mirrored_groups)
      groups_.push_back({node, light.group, {static_cast<float>(light.lux), 0.0F, 0.0F}});
  }

  [[nodiscard]] LinkSource source_of(std::uint32_t cluster) const {
    return clusters_.is_leaf(cluster) ? LinkSource::element(clusters_.root(cluster)) : LinkSource::cluster(cluster);
  }

  /// Takes links out that no longer hold, and gives what they are refined into.
  std::vector<LinkCandidate> reopen(const Linker& linker) {
    using Kind = LinkDecision::Kind;
    std::vector<std::uint8_t> good(links_.size());
    parallel_for(
        links_.size(), [&](std::size_t i) { good[i] = linker.holds(links_[i]) ? 1 : 0; }, 256);
    // Links to clusters follow how bright their members are, which the last pass has changed.
    const auto is_made_anew = [&](std::size_t i) {
      return links_[i].source.is_cluster() || (good[i] == 0 && links_[i].rough);
    };
    std::vector<Kind> kinds(links_.size(), Kind::kLink);
    Wishes wishes;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (good[i] != 0 || is_made_anew(i)) continue;
      kinds[i] = linker.split_of(links_[i]);
      wish(pair_of(links_[i]), {kinds[i], links_[i]}, wishes);
    }
    grant(linker, wishes);
    std::vector<LinkCandidate> candidates;
    std::vector<Link> kept;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (is_made_anew(i)) {
        candidates.push_back(pair_of(links_[i]));
      } else if (kinds[i] == Kind::kLink || !may_split(pair_of(links_[i]), kinds[i])) {
        kept.push_back(links_[i]);
      } else {
        split(pair_of(links_[i]), kinds[i], candidates);
      }
    }
    links_ = std::move(kept);
    return candidates;
  }

  /// Nodes that links are to be refined at and that are not open yet, and these links.
  struct Wishes {
    std::vector<ElementId> nodes;
    std::vector<Link> links;
  };

  /// The node at which a pair is refined; invalid for a cluster.
  static ElementId refined_end(const LinkCandidate& pair, LinkDecision::Kind kind) {
    if (kind == LinkDecision::Kind::kSplitReceiver) return pair.receiver;
    return pair.source.is_cluster() ? ElementId() : pair.source.element();
  }

  /// Whether a pair may be refined as the limit of elements is.
  [[nodiscard]] bool may_split(const LinkCandidate& pair, LinkDecision::Kind kind) const {
    const ElementId node = refined_end(pair, kind);
    return !node.valid() || solution_.may_open(node);
  }

  void wish(const LinkCandidate& pair, const LinkDecision& decision, Wishes& wishes) const {
    if (decision.kind == LinkDecision::Kind::kLink || decision.kind == LinkDecision::Kind::kNone) return;
    const ElementId node = refined_end(pair, decision.kind);
    if (!node.valid() || solution_.is_open(node)) return;
    wishes.nodes.push_back(node);
    wishes.links.push_back(decision.link);
  }

  /// Opens nodes where the limit of elements leaves no room for all: those whose links cause the largest errors at the sensors.
  void grant(const Linker& linker, const Wishes& wishes) {
    if (!open_worthiest(solution_, wishes.nodes, [&](std::size_t i) { return linker.worst_strain(wishes.links[i]); }))
      out_of_elements_ = true;
  }

  static LinkCandidate pair_of(const Link& link) { return {link.receiver, link.source, link.visibility, link.mutual}; }

  /// How far a pass is: the share of the pairs known so far that are decided, which never falls.
  struct PassProgress {
    double begin = 0.0;
    double end = 1.0;
    double decided = 0.0;
    double share = 0.0;

    void tell(Progress& progress, std::size_t more, std::size_t waiting) {
      decided += static_cast<double>(more);
      share = std::max(share, decided / std::max(1.0, decided + static_cast<double>(waiting)));
      progress.advance(begin + share * (end - begin));
    }
  };

  /// Clusters first, until all that is left are pairs of elements: those that see each other are then refined as one.
  void refine(const Linker& linker, std::vector<LinkCandidate> candidates, PassProgress progress) {
    std::vector<LinkCandidate> elements;
    while (!candidates.empty()) {
      std::vector<LinkCandidate> clusters;
      for (const LinkCandidate& c : candidates) (c.source.is_cluster() ? clusters : elements).push_back(c);
      candidates = refine_once(linker, clusters, elements.size(), progress);
    }
    elements = join(linker, elements, progress);
    while (!elements.empty()) elements = refine_once(linker, elements, 0, progress);
  }

  /// Links what is good enough, and gives what the rest is split into.
  /// @param waiting  pairs known beside the candidates
  std::vector<LinkCandidate> refine_once(const Linker& linker, const std::vector<LinkCandidate>& candidates,
                                         std::size_t waiting, PassProgress& progress) {
    std::vector<LinkCandidate> next;
    for (std::size_t first = 0; first < candidates.size(); first += kBatch) {
      const auto batch = std::span(candidates).subspan(first, std::min(kBatch, candidates.size() - first));
      decide(linker, batch, next);
      progress.tell(progress_, batch.size(), waiting + next.size() + candidates.size() - first - batch.size());
    }
    return next;
  }

  void decide(const Linker& linker, std::span<const LinkCandidate> candidates, std::vector<LinkCandidate>& next) {
    std::vector<LinkDecision> decisions(candidates.size());
    parallel_for(
        candidates.size(),
        [&](std::size_t i) {
          decisions[i] = progress_.should_finish() ? linker.settle(candidates[i]) : linker.decide(candidates[i]);
        },
        16);
    Wishes wishes;
    for (std::size_t i = 0; i < candidates.size(); ++i) wish(candidates[i], decisions[i], wishes);
    grant(linker, wishes);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const LinkDecision& d = decisions[i];
      if (d.kind == LinkDecision::Kind::kNone) continue;
      if (d.kind == LinkDecision::Kind::kLink || !may_split(candidates[i], d.kind)) {
        links_.push_back(d.link);
        continue;
      }
      LinkCandidate pair = candidates[i];
      pair.visibility = d.link.visibility;
      split(pair, d.kind, next);
    }
  }

  /// Measures the links to clusters that refinement has left, by other points than those which told it to.
  void remeasure_clusters(const Linker& linker) {
    links_ = all_found(links_.size(), [&](std::size_t i) { return linker.remeasured(links_[i]); });
  }

  /// The links that find(i) gives for i in [0, count), in order.
  template <class Find>
  static std::vector<Link> all_found(std::size_t count, const Find& find) {
    std::vector<std::optional<Link>> found(count);
    parallel_for(
        count, [&](std::size_t i) { found[i] = find(i); }, 16);
    std::vector<Link> links;
    for (const std::optional<Link>& link : found) {
      if (link) links.push_back(*link);
    }
    return links;
  }

  /// Pairs of which both ways are asked for become mutual where they are proven to see each other. Panes stay apart: links to them are
  /// followed to what they mirror.
  [[nodiscard]] std::vector<LinkCandidate> join(const Linker& linker, const std::vector<LinkCandidate>& pairs,
                                                PassProgress& progress) const {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> known;
    std::vector<std::size_t> other(pairs.size(), pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const std::uint32_t r = pairs[i].receiver.value;
      const std::uint32_t s = pairs[i].source.element().value;
      if (is_pane(pairs[i].receiver) || is_pane(pairs[i].source.element())) continue;
      if (const auto found = known.find({s, r}); found != known.end()) {
        other[found->second] = i;
      } else {
        known[{r, s}] = i;
      }
    }
    std::vector<Visibility> proven(pairs.size(), Visibility::kPartial);
    for (std::size_t first = 0; first < pairs.size(); first += kBatch) {
      parallel_for(std::min(kBatch, pairs.size() - first), [&](std::size_t k) {
        const std::size_t i = first + k;
        if (other[i] < pairs.size()) proven[i] = linker.prove(pairs[i].receiver, pairs[i].source.element());
      });
      progress.tell(progress_, 0, pairs.size());
    }
    std::vector<std::uint8_t> joined(pairs.size(), 0);
    std::vector<LinkCandidate> result;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (joined[i] != 0) continue;
      const bool mutual = proven[i] == Visibility::kVisible;
      if (mutual) joined[other[i]] = 1;
      result.push_back(mutual ? LinkCandidate{pairs[i].receiver, pairs[i].source, proven[i], true} : pairs[i]);
    }
    return result;
  }

  /// Replaces proven links at nodes that others have opened by links of their parts, where the parts would share too much of what the
  /// links' lines miss. Makes no new elements and casts no rays.
  void hand_down(const Linker& linker) {
    std::vector<Link> made = std::move(links_);
    links_.clear();
    while (!made.empty()) {
      std::vector<LinkCandidate> parts;
      for (const Link& link : made) {
        const auto kind = linker.split_at_open_ends(link, kMissed);
        if (kind == LinkDecision::Kind::kLink)
          links_.push_back(link);
        else
          split(pair_of(link), kind, parts);
      }
      made = all_found(parts.size(), [&](std::size_t i) { return linker.link(parts[i]); });
    }
  }

  void split(const LinkCandidate& pair, LinkDecision::Kind kind, std::vector<LinkCandidate>& out) {
    const Visibility proven = pair.visibility == Visibility::kVisible ? Visibility::kVisible : Visibility::kPartial;
    const mesh::ElementTree& tree = solution_.tree();
    if (kind == LinkDecision::Kind::kSplitReceiver) {
      solution_.open(pair.receiver);
      for (std::size_t k = 0; k < tree.child_count(pair.receiver); ++k) {
        const ElementId child(tree.first_child(pair.receiver).index() + k);
        out.push_back({child, pair.source, proven, pair.mutual});
      }
    } else if (pair.source.is_cluster()) {
      const std::uint32_t c = pair.source.cluster();
      out.push_back({pair.receiver, source_of(clusters_.left(c)), Visibility::kPartial});
      out.push_back({pair.receiver, source_of(clusters_.right(c)), Visibility::kPartial});
    } else {
      const ElementId s = pair.source.element();
      solution_.open(s);
      for (std::size_t k = 0; k < tree.child_count(s); ++k) {
        const ElementId child(tree.first_child(s).index() + k);
        out.push_back({pair.receiver, LinkSource::element(child), proven, pair.mutual});
      }
    }
  }

  /// Links of all sorts, by receiver.
  void sort_links(bool with_errors) {
    arrivals_ = {};
    std::vector<Link> looked;
    for (const Looker& looker : lookers_) {
      const LinearValue slope = looker.view.estimate(solution_, looker.node).slope;
      const std::vector<Link> links = links_to_seen(solution_, looker.node, looker.view.seen, slope);
      looked.insert(looked.end(), links.begin(), links.end());
    }
    arrivals_ = Arrivals({links_, opening_links_, looked}, solution_.tree(), with_errors);
  }

  /// Up to here panes stood in for what they mirror, as diffuse surfaces; from here on it is seen in them.
  void see_mirrors() {
    const auto to_pane =
        std::stable_partition(links_.begin(), links_.end(), [&](const Link& l) { return !is_mirror(l); });
    const Linker linker(solution_, clusters_, channels_, importance_,
                        options_.mirror_share * options_.accuracy * scale_lux_, options_.seed);
    const MirroredLight mirrored = follow_mirrors(
        solution_, clusters_, std::span(links_).subspan(to_pane - links_.begin()),
        [&](ElementId receiver) { return linker.tolerance(receiver); }, options_.seed, progress_);
    links_.erase(to_pane, links_.end());
    links_.insert(links_.end(), mirrored.links.begin(), mirrored.links.end());
    for (const MirroredLight::FromSky& sky : mirrored.sky) {
      for (LinearValue& direct : solution_.direct(sky.receiver)) {
        direct.value += sky.lux.value;
        direct.slope_u += sky.lux.slope_u;
        direct.slope_v += sky.lux.slope_v;
      }
    }
    groups_.insert(groups_.end(), mirrored.groups.begin(), mirrored.groups.end());
    for (const MirroredLight::Noise& noise : mirrored.noise)
      solution_.add_error(noise.receiver, noise.lux * noise.lux, 0.0);
    sort_links(true);
    std::vector<Link>().swap(links_);
  }

  [[nodiscard]] bool is_mirror(const Link& link) const {
    if (link.source.is_cluster()) return clusters_.kind(link.source.cluster()) == Clusters::Kind::kPanes;
    return is_pane(link.source.element());
  }

  [[nodiscard]] bool is_pane(ElementId e) const { return solution_.scene().is_pane(solution_.tree().face_side(e)); }

  /// What roots see by rays is wrong by their noise.
  void add_errors_of_looks() {
    for (const Looker& looker : lookers_) {
      const HemisphereView::Estimate e = looker.view.estimate(solution_, looker.node);
      solution_.add_error(looker.node, e.error_lux * e.error_lux, e.line_error_lux * e.line_error_lux);
    }
  }

  /// Errors by rays, those of suns apart from the others: another sun has errors of its own.
  void part_given_errors() {
    given_errors_ = solution_.errors();
    if (options_.keep_link_errors) given_lm_ = sunless_flux(solution_, {suns_.begin(), suns_.end()});
  }

  /// Adds the errors by rays to suns and those of the links, and gives what all errors together make.
  SolutionErrors add_errors_beside_given() {
    for (const SunDirect& sun : suns_) solution_.add_error(sun.node, sun.errors.noise2, sun.errors.misfit2);
    add_link_errors(solution_, clusters_, arrivals_);
    return {solution_, arrivals_, clusters_, convergence_, options_.seed};
  }

  /// Whether what the errors of the solution make at the sensors leaves enough of the accuracy to the sensors' own rays.
  bool is_good_enough() {
    if (!options_.error_at_sensors) return false;
    const std::vector<Solution::Errors> given = solution_.errors();
    add_errors_of_looks();
    const double error = options_.error_at_sensors(add_errors_beside_given());
    solution_.set_errors(given);
    return error <= options_.discretisation_share * options_.accuracy;
  }

  /// How unevenly surfaces shine in bands and in source groups, where these are asked for: refinement follows the worst of them.
  void tell_channels_apart() {
    const Scene& scene = solution_.scene();
    const std::size_t bands = solution_.channels();
    const std::size_t groups = scene.groups.has_columns() ? scene.groups.column_count() : 0;
    if (bands == 1 && groups == 0) return;
    const ChannelSystem system(solution_, arrivals_, clusters_);
    const GroupRadiosity by_group = groups > 0 ? solve_channels(solution_, system, groups_) : GroupRadiosity();
    channels_ = channel_deviations(system, solution_.tree().size(), bands + groups, [&](ElementId e, std::size_t c) {
      return c < bands ? sent_in_band(e, c) : sent_by_group(by_group, e, c - bands);
    });
  }

  /// What an element sends out in a band, by the band's weight [lm/m²].
  [[nodiscard]] LinearValue sent_in_band(ElementId e, std::size_t band) const {
    const Scene& scene = solution_.scene();
    const mesh::FaceSide side = solution_.tree().face_side(e);
    const LinearValue& lux = solution_.irradiance(e)[band];
    const float weight = scene.channel_weights[band];
    const float share = weight * scene.side_reflectance(side)[band];
    return {share * lux.value + weight * scene.side_exitance(side)[band], share * lux.slope_u, share * lux.slope_v};
  }

  /// The same of a column of source groups, in all bands.
  [[nodiscard]] LinearValue sent_by_group(const GroupRadiosity& radiosity, ElementId e, std::size_t column) const {
    const Scene& scene = solution_.scene();
    const mesh::FaceSide side = solution_.tree().face_side(e);
    const std::span<const float> lines = radiosity.lines(e);
    const std::size_t columns = radiosity.groups();
    const bool own = scene.shines(side) && scene.groups.column_of(scene.side_group[side.index()]) == column;
    const float emitted = own ? luminance(scene.side_exitance(side), scene.channel_weights) : 0.0F;
    return {lines[column] + emitted, lines[columns + column], lines[2 * columns + column]};
  }

  void iterate() {
    const Relaxed relaxed = relax(solution_, clusters_, arrivals_, progress_);
    iterations_ += relaxed.iterations;
    convergence_ = relaxed.missing;
  }

  Progress& progress_;
  Solution& solution_;
  const Importance& importance_;
  std::vector<Looker> lookers_;
  std::vector<Link> links_;
  std::vector<Link> opening_links_;
  std::vector<GroupDirect> groups_;
  double by_luminaires_lm_;
  std::vector<SunDirect> suns_;
  Arrivals arrivals_;
  double scale_lux_;
  SolveOptions options_;
  Clusters clusters_;
  ChannelDeviations channels_;
  std::size_t iterations_ = 0;
  double convergence_ = 0.0;
  std::vector<Solution::Errors> given_errors_;
  std::vector<double> given_lm_;
  bool out_of_elements_ = false;
};

}  // namespace

Transport solve(Solution& solution, const Importance& importance, DirectLight direct, const SolveOptions& options,
                Progress& progress) {
  return Solver(solution, importance, std::move(direct), options, progress).run();
}

}  // namespace clerestory::lighting
