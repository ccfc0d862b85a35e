// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/importance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lighting/luminaire_light.h"

namespace clerestory::lighting {

using mesh::ElementId;

namespace {

constexpr std::size_t kTellApart = 16;  ///< deposits that make a triangle worth dividing
constexpr double kSmallest = 0.25;      ///< … if its radius is larger than this [m]
constexpr double kOwnShare = 0.5;       ///< the rest of a root's importance is spread over it by area
constexpr double kChance = 0.3;         ///< parts of importance this uneven may be so by chance
/// Where the sensors are darker than this share of what the light of the scene would give all surfaces, the scale of tolerances stays
/// there: a tolerance of next to nothing would split everything to the smallest size.
constexpr double kDarkest = 1e-3;
/// Surfaces that see the sky receive about this share of the horizontal illuminance, for that scale.
constexpr double kSkyShare = 0.1;
constexpr double kAreaShare = 0.01;  ///< so much importance lies on all surfaces by area, seen from sensors or not

/// A grid far darker or brighter than all together counts by no more than this.
constexpr double kLeastWeightOfGrid = 0.2;
constexpr double kMostWeightOfGrid = 5000.0;

/// What the light of the scene would give its surfaces if it spread evenly [lux].
double even_lux(const Scene& scene, const mesh::ElementTree& tree) {
  double flux_lm = 0.0;
  double area_m2 = 0.0;
  for (const ElementId root : tree.roots()) {
    area_m2 += tree.area(root);
    flux_lm += tree.area(root) * luminance(scene.side_exitance(tree.face_side(root)), scene.channel_weights);
  }
  flux_lm += luminaire_flux(scene);
  const double by_sky = scene.has_sky() ? kSkyShare * scene.sky.ground_illuminance_lux() : 0.0;
  return by_sky + (area_m2 > 0.0 ? flux_lm / area_m2 : 0.0);
}

/// Mean illuminance of each grid's sensors as their walks saw it [lux]; zero where none walked.
template <class GridOf>
std::vector<double> means_of_grids(const std::vector<SensorWalk>& walks, GridOf grid_of) {
  std::vector<double> lux;
  std::vector<double> counts;
  for (const SensorWalk& walk : walks) {
    const std::size_t grid = grid_of(walk);
    if (grid >= lux.size()) {
      lux.resize(grid + 1, 0.0);
      counts.resize(grid + 1, 0.0);
    }
    lux[grid] += walk.lux;
    counts[grid] += 1.0;
  }
  for (std::size_t g = 0; g < lux.size(); ++g) lux[g] /= std::max(1.0, counts[g]);
  return lux;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// How much the light of each grid's sensors counts: one over its mean, as a share of the mean of all sensors. Grids darker than most
/// count more still: weak light has come by many links, each with an error of its own.
/// @param mean_lux  of all sensors
std::vector<double> weights_of_grids(const std::vector<double>& means_lux, double mean_lux) {
  if (means_lux.empty() || mean_lux <= 0.0) return std::vector<double>(means_lux.size(), 1.0);
  const double typical = median_of(means_lux);
  std::vector<double> weights;
  for (const double lux : means_lux) {
    const double own = std::max(lux, 1e-9 * mean_lux);
    const double darker = std::max(1.0, typical / own);
    weights.push_back(std::clamp(mean_lux / own * std::sqrt(darker), kLeastWeightOfGrid, kMostWeightOfGrid));
  }
  return weights;
}

/// What walks have left on surfaces, by the triangles that it lies on.
class Deposits {
 public:
  /// @param weights  of the grids
  template <class GridOf>
  Deposits(const mesh::ElementTree& tree, const std::vector<SensorWalk>& walks, const std::vector<double>& weights,
           GridOf grid_of) {
    std::size_t ends = 0;
    for (const SensorWalk& walk : walks) ends += walk.ends.size();
    std::vector<ElementId> nodes;
    std::vector<std::size_t> first(tree.size() + 1, 0);
    nodes.reserve(ends);
    for (const SensorWalk& walk : walks) {
      for (const SensorWalk::End& end : walk.ends) {
        nodes.push_back(tree.find(end.side, end.region, end.at));
        if (nodes.back().valid()) ++first[nodes.back().index() + 1];
      }
    }
    for (std::size_t n = 0; n < tree.size(); ++n) {
      if (first[n + 1] > 0) stacks_.push_back({ElementId(n), first[n], first[n] + first[n + 1]});
      first[n + 1] += first[n];
    }
    deposits_.resize(first.back());
    auto node = nodes.begin();
    for (const SensorWalk& walk : walks) {
      const auto weight = static_cast<float>(weights[grid_of(walk)] / static_cast<double>(walks.size()));
      for (const SensorWalk::End& end : walk.ends) {
        if (node->valid()) deposits_[first[node->index()]++] = {tree.barycentric(*node, end.at), end.weight * weight};
        ++node;
      }
    }
  }

  /// Moves the deposits of crowded triangles down to their parts, which are made for that.
  void divide_crowded(Solution& solution) {
    std::vector<Stack> done;
    for (std::size_t i = 0; i < stacks_.size(); ++i) {
      const Stack stack = stacks_[i];
      if (stack.end - stack.begin < kTellApart || solution.tree().radius(stack.node) < kSmallest) {
        done.push_back(stack);
      } else {
        if (!solution.tree().has_children(stack.node)) solution.divide(stack.node);
        move_down(stack, solution.tree().first_child(stack.node));
      }
    }
    stacks_ = std::move(done);
  }

  /// Weights and numbers of deposits of all nodes, those of their parts included.
  void add_up(const mesh::ElementTree& tree, std::vector<double>& own, std::vector<double>& counts) const {
    for (const Stack& stack : stacks_) {
      counts[stack.node.index()] += static_cast<double>(stack.end - stack.begin);
      for (std::size_t i = stack.begin; i < stack.end; ++i) own[stack.node.index()] += deposits_[i].weight;
    }
    for (std::size_t i = own.size(); i-- > 0;) {  // children come after their parents
      const ElementId parent = tree.parent(ElementId(i));
      if (!parent.valid()) continue;
      own[parent.index()] += own[i];
      counts[parent.index()] += counts[i];
    }
  }

 private:
  struct Deposit {
    mesh::ElementTree::Barycentric at{};  ///< in the triangle that it lies on
    float weight = 0.0F;
  };
  /// The deposits [begin, end) lie on a triangle.
  struct Stack {
    ElementId node;
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  static constexpr std::size_t kParts = mesh::ElementTree::kPartsOfTriangle;

  void move_down(const Stack& stack, ElementId first_child) {
    std::array<std::vector<Deposit>, kParts>& parts = parts_;
    for (std::vector<Deposit>& part : parts) part.clear();
    for (std::size_t i = stack.begin; i < stack.end; ++i) {
      Deposit deposit = deposits_[i];
      const std::uint32_t part = mesh::ElementTree::step_down(deposit.at);
      parts[part].push_back(deposit);
    }
    std::size_t next = stack.begin;
    for (std::size_t k = 0; k < kParts; ++k) {
      if (parts[k].empty()) continue;
      std::copy(parts[k].begin(), parts[k].end(), deposits_.begin() + static_cast<std::ptrdiff_t>(next));
      stacks_.push_back({ElementId(first_child.index() + k), next, next + parts[k].size()});
      next += parts[k].size();
    }
  }

  std::vector<Deposit> deposits_;
  std::vector<Stack> stacks_;
  std::array<std::vector<Deposit>, kParts> parts_;  ///< of a stack
};

}  // namespace

Importance::Importance(Solution& solution, const std::vector<SensorWalk>& walks, std::span<const std::uint32_t> grids) {
  const mesh::ElementTree& tree = solution.tree();
  const std::size_t walkers = walks.size();
  reached_sides_ = sides_reached(solution.scene(), walks);
  const auto grid_of = [&](const SensorWalk& walk) { return grids.empty() ? 0U : grids[walk.sensor]; };
  for (const SensorWalk& walk : walks) mean_lux_ += walk.lux / static_cast<double>(walkers);
  const std::vector<double> weights = weights_of_grids(means_of_grids(walks, grid_of), mean_lux_);
  Deposits deposits(tree, walks, weights, grid_of);
  mean_lux_ = std::max(mean_lux_, (walkers == 0 ? 1.0 : kDarkest) * even_lux(solution.scene(), tree));
  deposits.divide_crowded(solution);
  std::vector<double> own(tree.size(), 0.0);
  std::vector<double> counts(tree.size(), 0.0);
  deposits.add_up(tree, own, counts);
  find_uneven(tree, own, counts);
  spread(tree, own, walkers == 0 ? 1.0 : kAreaShare);
}

void Importance::spread(const mesh::ElementTree& tree, std::span<const double> own, double by_area) {
  double all_area = 0.0;
  for (const ElementId root : tree.roots()) all_area += tree.area(root);
  importance_.resize(tree.size());
  std::vector<double> root_density(tree.size(), 0.0);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const ElementId e(i);
    const ElementId parent = tree.parent(e);
    root_density[i] = parent.valid() ? root_density[parent.index()] : own[i] / tree.area(e);
    importance_[i] = static_cast<float>(kOwnShare * own[i] + (1.0 - kOwnShare) * root_density[i] * tree.area(e) +
                                        by_area * tree.area(e) / all_area);
  }
}

void Importance::forget_sensors(const mesh::ElementTree& tree) {
  double all = 0.0;
  double all_area = 0.0;
  for (const ElementId root : tree.roots()) {
    all += importance_[root.index()];
    all_area += tree.area(root);
  }
  for (std::size_t i = 0; i < importance_.size(); ++i)
    importance_[i] = static_cast<float>(all * tree.area(ElementId(i)) / all_area);
  std::fill(uneven_.begin(), uneven_.end(), 0.0F);
}

void Importance::find_uneven(const mesh::ElementTree& tree, std::span<const double> own,
                             std::span<const double> counts) {
  uneven_.assign(own.size(), 0.0F);
  for (std::size_t i = own.size(); i-- > 0;) {  // children come after their parents
    const ElementId e(i);
    if (!tree.has_children(e) || counts[i] <= 0.0) continue;
    double moved = 0.0;
    double below = 0.0;
    for (std::size_t k = 0; k < tree.child_count(e); ++k) {
      const ElementId child(tree.first_child(e).index() + k);
      moved += 0.5 * std::abs(own[child.index()] - own[i] * tree.area(child) / tree.area(e));
      below += uneven_[child.index()];
    }
    const double chance = (kChance + 1.0 / std::sqrt(counts[i])) * own[i];
    uneven_[i] = static_cast<float>(std::max(below, moved - chance));
  }
}

double Importance::of(const mesh::ElementTree& tree, ElementId e) const {
  if (e.index() < importance_.size()) return importance_[e.index()];
  ElementId known = e;
  while (known.index() >= importance_.size()) known = tree.parent(known);
  return importance_[known.index()] * tree.area(e) / tree.area(known);
}

}  // namespace clerestory::lighting
