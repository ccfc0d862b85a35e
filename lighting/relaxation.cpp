// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/relaxation.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "lighting/parallel.h"

namespace clerestory::lighting {

using mesh::ElementId;

namespace {

/// Iterations cost next to nothing beside links: they go on, at any accuracy, until what is missing is this share of all flux.
constexpr double kConverged = 1e-6;
/// The same of the elements' light.
constexpr double kElementsConverged = 1e-5;
/// Where the run must end, until it is this share: it counts as an error, and light has got around all the same.
constexpr double kNearlyConverged = 1e-3;
/// No closed scene of reflectance under 0.99 needs as many.
constexpr std::size_t kMostIterations = 5000;

Solution::Sent sent_by(const Solution& solution, const Clusters& clusters, LinkSource source, std::size_t channel) {
  if (!source.is_cluster()) return solution.sent(source.element(), channel);
  return {clusters.radiosity(source.cluster())[channel], {}};
}

void add(const Solution& solution, const Clusters& clusters, const Arrival& arrival, std::span<LinearValue> sums) {
  const float moment_u = arrival.moment_u();
  const float moment_v = arrival.moment_v();
  const float slope_u = arrival.slope_u();
  const float slope_v = arrival.slope_v();
  for (std::size_t c = 0; c < sums.size(); ++c) {
    const Solution::Sent sent = sent_by(solution, clusters, arrival.source(), c);
    sums[c].value += arrival.factor() * sent.mean + moment_u * sent.u + moment_v * sent.v;
    sums[c].slope_u += slope_u * sent.mean;
    sums[c].slope_v += slope_v * sent.mean;
  }
}

void gather(Solution& solution, const Clusters& clusters, const Arrivals& arrivals) {
  parallel_for(
      arrivals.receivers(),
      [&](std::size_t i) {
        const auto sums = solution.gathered(arrivals.receiver(i));
        std::fill(sums.begin(), sums.end(), LinearValue{});
        for (const Arrival& arrival : arrivals.at(i)) add(solution, clusters, arrival, sums);
      },
      64);
}

/// How far elements' radiosities have changed since the last call, as shares of them, on the mean.
class ElementChanges {
 public:
  double since_last(const Solution& solution) {
    const std::vector<ElementId> elements = solution.elements();
    last_.resize(elements.size(), 0.0F);
    double sum = 0.0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const float now = solution.radiosity_mean(elements[i]);
      if (now > 0.0F) sum += std::min(1.0, std::abs(double{now} - last_[i]) / now);
      last_[i] = now;
    }
    return elements.empty() ? 0.0 : sum / static_cast<double>(elements.size());
  }

 private:
  std::vector<float> last_;
};

}  // namespace

Relaxed relax(Solution& solution, Clusters& clusters, const Arrivals& arrivals, const Progress& progress,
              Change measure) {
  const bool by_elements = measure == Change::kOfElements;
  const double converged = by_elements ? kElementsConverged : kConverged;
  ElementChanges changes;
  Relaxed result;
  solution.clear_gathered();
  double last = 0.0;
  while (result.iterations < kMostIterations) {
    clusters.pull(solution);
    gather(solution, clusters, arrivals);
    double change = solution.push_pull();
    if (by_elements) change = changes.since_last(solution);
    ++result.iterations;
    // Changes shrink by a factor q a step: what is still to come is the rest of the geometric series.
    const double q = last > 0.0 ? std::min(0.999, change / last) : 0.5;
    result.missing = change * q / (1.0 - q);
    last = change;
    if (result.missing <= (progress.should_finish() ? kNearlyConverged : converged)) break;
  }
  clusters.pull(solution);
  return result;
}

double mean_of(const Solution& solution, const Clusters& clusters, LinkSource source) {
  return source.is_cluster() ? clusters.radiosity_mean(source.cluster()) : solution.radiosity_mean(source.element());
}

double uneven_light(const mesh::ElementTree& tree, const Link& link, double deviation) {
  if (link.source.is_cluster()) return link.factor * deviation;
  const ElementId s = link.source.element();
  const double distance = std::max(1e-9, norm(tree.centroid(s) - tree.centroid(link.receiver)));
  return link.factor * deviation * std::min(1.0, tree.radius(s) / distance);
}

void add_link_errors(Solution& solution, const Clusters& clusters, const Arrivals& arrivals) {
  for (std::size_t i = 0; i < arrivals.receivers(); ++i) {
    for (std::size_t k = 0; k < arrivals.at(i).size(); ++k) {
      const Link link = arrivals.link(i, k);
      const double mean = mean_of(solution, clusters, link.source);
      const double noise = link.noise * mean;
      const double misfit = (link.error - link.noise) * mean;
      // Clusters' places were weighed by how bright they are.
      const double uneven =
          link.source.is_cluster()
              ? 0.0
              : uneven_light(solution.tree(), link, solution.radiosity_deviation(link.source.element()));
      solution.add_error(link.receiver, noise * noise + uneven * uneven, misfit * misfit);
    }
  }
}

}  // namespace clerestory::lighting
