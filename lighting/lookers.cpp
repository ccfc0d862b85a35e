// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/lookers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lighting/parallel.h"
#include "lighting/spectrum.h"

namespace clerestory::lighting {

using mesh::ElementId;

namespace {

/// Nodes between two signs of life.
constexpr std::size_t kBatch = 1U << 13U;
/// What most surfaces receive, in terms of the mean at the sensors, and how far single rays differ from it.
constexpr double kBrightness = 2.0;
constexpr double kSpread = 0.7;
/// Rays of one node.
constexpr std::uint32_t kLooks = 32;
constexpr std::uint32_t kMostLooks = 128;
/// What the links of one root cost for each root there is, in rays: 40 µs for each pair of elements that is judged, which is about one for two
/// roots, and 1 µs a ray, on the validation scenes.
constexpr double kRaysOfRoot = 20.0;
/// Of a root's goal, that of each of its parts: their errors, of either sign, add up.
constexpr double kGoalOfParts = 0.25;
/// Elements that opening nodes makes for a part that looks around, at most about.
constexpr double kElementsOfPart = 4.0;
/// Nodes of a smaller radius look around as they are [m].
constexpr double kSmallest = 0.25;

class Parting {
 public:
  Parting(Solution& solution, const Importance& importance, const LookOptions& options)
      : solution_(solution), importance_(importance), options_(options) {}

  Receivers run(Progress& progress) {
    std::vector<ElementId> round;
    std::vector<ElementId> whole;
    for (const ElementId root : solution_.tree().roots()) {
      if (is_worth_parting(root))
        round.push_back(root);
      else
        (fits(root, options_.goal_lux) ? whole : result_.linking).push_back(root);
    }
    look(whole, options_.goal_lux, progress);
    const double goal = kGoalOfParts * options_.goal_lux;
    while (!round.empty()) {
      std::vector<ElementId> looking;
      std::vector<ElementId> next;
      for (const ElementId node : round) {
        if (fits(node, goal) || solution_.tree().radius(node) < kSmallest || !solution_.may_open(node))
          looking.push_back(node);
        else
          open(node, next);
      }
      look(looking, goal, progress);
      round = std::move(next);
    }
    return std::move(result_);
  }

 private:
  /// Whether a root's parts would need fewer rays than its links are worth, and no more elements than there may be.
  [[nodiscard]] bool is_worth_parting(ElementId root) const {
    const double goal = kGoalOfParts * options_.goal_lux;
    // Parts have their shares of the importance: n of them need an n-th of the rays together.
    const double parts = std::max({1.0, std::sqrt(rays(root, goal) / kMostLooks), unevenness(root, goal)});
    const double worth = kRaysOfRoot * static_cast<double>(solution_.tree().roots().size());
    return parts * kMostLooks <= worth && kElementsOfPart * parts <= static_cast<double>(solution_.elements_left());
  }

  /// Whether a node may look around as it is for its error at the sensors to keep to a goal [lux].
  [[nodiscard]] bool fits(ElementId node, double goal) const {
    return rays(node, goal) <= kMostLooks && unevenness(node, goal) <= 1.0;
  }

  /// What a node sends on that receives what most do, over a goal.
  [[nodiscard]] double lit(ElementId node, double goal) const {
    const Scene& scene = solution_.scene();
    const float rho = luminance(scene.side_reflectance(solution_.tree().face_side(node)), scene.channel_weights);
    return rho * kBrightness * options_.scale_lux / goal;
  }

  /// Rays that keep the noise of a node's light at the sensors to a goal.
  [[nodiscard]] double rays(ElementId node, double goal) const {
    return std::pow(kSpread * lit(node, goal) * importance_.of(solution_.tree(), node), 2.0);
  }

  /// What one value for all of a node may miss where the node matters unevenly, over a goal.
  [[nodiscard]] double unevenness(ElementId node, double goal) const {
    return lit(node, goal) * importance_.uneven(node);
  }

  void open(ElementId node, std::vector<ElementId>& parts) {
    solution_.open(node);
    for (std::size_t k = 0; k < solution_.tree().child_count(node); ++k)
      parts.emplace_back(solution_.tree().first_child(node).index() + k);
  }

  void look(const std::vector<ElementId>& nodes, double goal, Progress& progress) {
    const std::size_t before = result_.lookers.size();
    result_.lookers.resize(before + nodes.size());
    for (std::size_t first = 0; first < nodes.size(); first += kBatch) {
      parallel_for(std::min(kBatch, nodes.size() - first), [&](std::size_t k) {
        const ElementId node = nodes[first + k];
        const std::uint32_t count = rays(node, goal) > kLooks ? kMostLooks : kLooks;
        result_.lookers[before + first + k] = {node, look_around(solution_, node, count, options_.seed)};
      });
      progress.advance(0.0);
    }
  }

  Solution& solution_;
  const Importance& importance_;
  LookOptions options_;
  Receivers result_;
};

}  // namespace

Receivers find_receivers(Solution& solution, const Importance& importance, const LookOptions& options,
                         Progress& progress) {
  return Parting(solution, importance, options).run(progress);
}

}  // namespace clerestory::lighting
