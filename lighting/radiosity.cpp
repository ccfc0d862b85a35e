// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/radiosity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "lighting/hemisphere_links.h"
#include "lighting/linker.h"
#include "lighting/mirror_links.h"
#include "lighting/parallel.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Visibility;

namespace {

/// Tolerances of the passes, as multiples of the last.
constexpr std::array<double, 3> kPasses{16.0, 4.0, 1.0};
/// Iterations cost next to nothing beside links: they go on until what is missing is this share of the accuracy.
constexpr double kConverged = 1e-3;
/// What a node sees by rays: what most surfaces receive, in terms of the mean at the sensors, and how far single rays differ from it.
constexpr double kBrightness = 2.0;
constexpr double kSpread = 0.7;
constexpr std::uint32_t kLooks = 32;
constexpr std::uint32_t kMostLooks = 128;
/// No closed scene of reflectance under 0.99 needs as many.
constexpr std::size_t kMostIterations = 5000;

class Solver {
 public:
  Solver(Solution& solution, const Importance& importance, DirectLight direct, const SolveOptions& options)
      : solution_(solution),
        importance_(importance),
        opening_links_(std::move(direct.links)),
        scale_lux_(direct.scale_lux),
        options_(options),
        clusters_(solution.scene(), solution.tree()) {}

  Transport run(Progress& progress) {
    progress.phase("linking");
    solution_.push_pull();
    clusters_.pull(solution_);
    std::vector<LinkCandidate> start = begin();
    for (std::size_t pass = 0; pass < kPasses.size(); ++pass) {
      const Linker linker(solution_, clusters_, importance_,
                          kPasses[pass] * options_.link_share * options_.accuracy * scale_lux_, options_.seed);
      if (pass > 0) start = reopen(linker);
      refine(linker, std::move(start));
      sort_links();
      iterate();
      progress.advance(static_cast<double>(pass + 1) / kPasses.size());
    }
    see_mirrors();
    iterate();
    add_errors();
    return {std::move(all_), std::move(clusters_), iterations_, convergence_};
  }

 private:
  /// A root that looks around by rays, for all that does not shine by itself.
  struct Looker {
    ElementId root;
    HemisphereView view;
  };

  /// Parts the roots in those that look around by rays and those that link to what surrounds them, and gives the links to begin with.
  std::vector<LinkCandidate> begin() {
    const auto roots = solution_.tree().roots();
    std::vector<HemisphereView> views(roots.size());
    parallel_for(roots.size(), [&](std::size_t i) { views[i] = look(roots[i]); });
    std::vector<LinkCandidate> start;
    for (std::size_t i = 0; i < roots.size(); ++i) {
      const bool looks = views[i].rays > 0;
      if (looks) {
        for (LinearValue& direct : solution_.direct(roots[i]))
          direct.value += static_cast<float>(views[i].mirrored_sky_lux);
        lookers_.push_back({roots[i], std::move(views[i])});
      }
      for (const std::uint32_t top : clusters_.tops()) {
        if (!looks || clusters_.kind(top) == Clusters::Kind::kShining)
          start.push_back({roots[i], source_of(top), Visibility::kPartial});
      }
    }
    return start;
  }

  /// What a root sees by rays: nothing where so many rays would be needed, or where it matters so much how light changes over it, that links
  /// serve better.
  [[nodiscard]] HemisphereView look(ElementId root) const {
    const double goal = options_.node_share * options_.accuracy * scale_lux_;
    const Scene& scene = solution_.scene();
    const double rho = luminance(scene.side_reflectance(solution_.tree().face_side(root)), scene.channel_weights);
    const double lit = rho * kBrightness * scale_lux_;
    if (lit * importance_.uneven(root) > goal) return {};
    const double rays = std::pow(kSpread * lit * importance_.of(solution_.tree(), root) / goal, 2.0);
    if (rays > kMostLooks) return {};
    return look_around(solution_, root, rays > kLooks ? kMostLooks : kLooks, options_.seed);
  }

  [[nodiscard]] LinkSource source_of(std::uint32_t cluster) const {
    return clusters_.is_leaf(cluster) ? LinkSource::element(clusters_.root(cluster)) : LinkSource::cluster(cluster);
  }

  /// Takes links out that no longer hold, and gives what they are refined into.
  std::vector<LinkCandidate> reopen(const Linker& linker) {
    std::vector<std::uint8_t> good(links_.size());
    parallel_for(
        links_.size(), [&](std::size_t i) { good[i] = linker.holds(links_[i]) ? 1 : 0; }, 256);
    std::vector<LinkCandidate> candidates;
    std::vector<Link> kept;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      // Links to clusters follow how bright their members are, which the last pass has changed.
      if (links_[i].source.is_cluster() || (good[i] == 0 && links_[i].rough)) {
        candidates.push_back({links_[i].receiver, links_[i].source, links_[i].visibility});
        continue;
      }
      const auto kind = good[i] != 0 ? LinkDecision::Kind::kLink : linker.split_of(links_[i]);
      if (kind == LinkDecision::Kind::kLink) {
        kept.push_back(links_[i]);
      } else {
        split({links_[i].receiver, links_[i].source, links_[i].visibility}, kind, candidates);
      }
    }
    links_ = std::move(kept);
    return candidates;
  }

  void refine(const Linker& linker, std::vector<LinkCandidate> candidates) {
    while (!candidates.empty()) {
      std::vector<LinkDecision> decisions(candidates.size());
      parallel_for(
          candidates.size(), [&](std::size_t i) { decisions[i] = linker.decide(candidates[i]); }, 16);
      std::vector<LinkCandidate> next;
      for (std::size_t i = 0; i < candidates.size(); ++i) {
        const LinkDecision& d = decisions[i];
        if (d.kind == LinkDecision::Kind::kLink) links_.push_back(d.link);
        if (d.kind == LinkDecision::Kind::kLink || d.kind == LinkDecision::Kind::kNone) continue;
        split({candidates[i].receiver, candidates[i].source, d.link.visibility}, d.kind, next);
      }
      candidates = std::move(next);
    }
  }

  void split(const LinkCandidate& pair, LinkDecision::Kind kind, std::vector<LinkCandidate>& out) {
    const Visibility proven = pair.visibility == Visibility::kVisible ? Visibility::kVisible : Visibility::kPartial;
    const mesh::ElementTree& tree = solution_.tree();
    if (kind == LinkDecision::Kind::kSplitReceiver) {
      solution_.open(pair.receiver);
      for (std::size_t k = 0; k < tree.child_count(pair.receiver); ++k) {
        out.push_back({ElementId(tree.first_child(pair.receiver).index() + k), pair.source, proven});
      }
    } else if (pair.source.is_cluster()) {
      const std::uint32_t c = pair.source.cluster();
      out.push_back({pair.receiver, source_of(clusters_.left(c)), Visibility::kPartial});
      out.push_back({pair.receiver, source_of(clusters_.right(c)), Visibility::kPartial});
    } else {
      const ElementId s = pair.source.element();
      solution_.open(s);
      for (std::size_t k = 0; k < tree.child_count(s); ++k) {
        out.push_back({pair.receiver, LinkSource::element(ElementId(tree.first_child(s).index() + k)), proven});
      }
    }
  }

  /// Links of all sorts in one list, by receiver.
  void sort_links() {
    all_ = links_;
    all_.insert(all_.end(), opening_links_.begin(), opening_links_.end());
    for (const Looker& looker : lookers_) {
      const std::vector<Link> links = links_to_seen(solution_, looker.root, looker.view.seen, {});
      all_.insert(all_.end(), links.begin(), links.end());
    }
    std::stable_sort(all_.begin(), all_.end(), [](const Link& a, const Link& b) { return a.receiver < b.receiver; });
    starts_ = starts_of(all_);
  }

  /// Up to here panes stood in for what they mirror, as diffuse surfaces; from here on it is seen in them.
  void see_mirrors() {
    const auto to_pane =
        std::stable_partition(links_.begin(), links_.end(), [&](const Link& l) { return !is_mirror(l); });
    const Linker linker(solution_, clusters_, importance_, options_.mirror_share * options_.accuracy * scale_lux_,
                        options_.seed);
    const MirroredLight mirrored = follow_mirrors(
        solution_, clusters_, std::span(links_).subspan(to_pane - links_.begin()),
        [&](ElementId receiver) { return linker.tolerance(receiver); }, options_.seed);
    links_.erase(to_pane, links_.end());
    links_.insert(links_.end(), mirrored.links.begin(), mirrored.links.end());
    for (const MirroredLight::FromSky& sky : mirrored.sky) {
      for (LinearValue& direct : solution_.direct(sky.receiver)) {
        direct.value += sky.lux.value;
        direct.slope_u += sky.lux.slope_u;
        direct.slope_v += sky.lux.slope_v;
      }
    }
    for (const MirroredLight::Noise& noise : mirrored.noise) solution_.add_error(noise.receiver, noise.lux * noise.lux);
    sort_links();
  }

  [[nodiscard]] bool is_mirror(const Link& link) const {
    if (link.source.is_cluster()) return clusters_.kind(link.source.cluster()) == Clusters::Kind::kPanes;
    return solution_.scene().is_pane(solution_.tree().face_side(link.source.element()));
  }

  /// Where the links of each receiver begin; the links are sorted.
  static std::vector<std::size_t> starts_of(const std::vector<Link>& links) {
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (i == 0 || links[i].receiver != links[i - 1].receiver) starts.push_back(i);
    }
    starts.push_back(links.size());
    return starts;
  }

  [[nodiscard]] std::span<const float> radiosity_of(LinkSource source) const {
    return source.is_cluster() ? clusters_.radiosity(source.cluster()) : solution_.radiosity(source.element());
  }

  void gather() {
    parallel_for(
        starts_.size() - 1,
        [&](std::size_t run) {
          const auto sums = solution_.gathered(all_[starts_[run]].receiver);
          std::fill(sums.begin(), sums.end(), LinearValue{});
          for (std::size_t i = starts_[run]; i < starts_[run + 1]; ++i) {
            const Link& link = all_[i];
            const auto b = radiosity_of(link.source);
            for (std::size_t c = 0; c < sums.size(); ++c) {
              sums[c].value += link.factor * b[c];
              sums[c].slope_u += link.slope_u * b[c];
              sums[c].slope_v += link.slope_v * b[c];
            }
            if (link.source.is_cluster()) continue;
            const auto m = solution_.moments(link.source.element());
            for (std::size_t c = 0; c < sums.size(); ++c) {
              sums[c].value += link.moment_u * m[c].u + link.moment_v * m[c].v;
            }
          }
        },
        64);
  }

  /// The links' errors at their receivers. Errors of different links are independent.
  void add_errors() {
    for (const Looker& looker : lookers_) {
      const double error = looker.view.estimate(solution_).error_lux;
      solution_.add_error(looker.root, error * error);
    }
    for (const Link& link : all_) {
      const double mean = link.source.is_cluster() ? clusters_.radiosity_mean(link.source.cluster())
                                                   : solution_.radiosity_mean(link.source.element());
      solution_.add_error(link.receiver, link.error * mean * link.error * mean);
    }
  }

  void iterate() {
    solution_.clear_gathered();
    double last = 0.0;
    for (std::size_t i = 0; i < kMostIterations; ++i) {
      clusters_.pull(solution_);
      gather();
      const double change = solution_.push_pull();
      ++iterations_;
      // Changes shrink by a factor q a step: what is still to come is the rest of the geometric series.
      const double q = last > 0.0 ? std::min(0.999, change / last) : 0.5;
      convergence_ = change * q / (1.0 - q);
      last = change;
      if (convergence_ <= kConverged * options_.accuracy) break;
    }
    clusters_.pull(solution_);
  }

  Solution& solution_;
  const Importance& importance_;
  std::vector<Looker> lookers_;
  std::vector<Link> links_;
  std::vector<Link> opening_links_;
  std::vector<Link> all_;
  std::vector<std::size_t> starts_;
  double scale_lux_;
  SolveOptions options_;
  Clusters clusters_;
  std::size_t iterations_ = 0;
  double convergence_ = 0.0;
};

}  // namespace

Transport solve(Solution& solution, const Importance& importance, DirectLight direct, const SolveOptions& options,
                Progress& progress) {
  return Solver(solution, importance, std::move(direct), options).run(progress);
}

}  // namespace clerestory::lighting
