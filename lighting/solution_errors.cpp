// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/solution_errors.h"

#include <cmath>

#include "lighting/parallel.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;

namespace {

using Samples = SolutionErrors::Samples;
constexpr std::size_t kSamples = SolutionErrors::kSamples;

/// Errors are known well enough when reflecting them once more changes them by this share.
constexpr double kSettled = 0.01;
constexpr std::size_t kMostRounds = 500;

float sign(std::uint64_t bits, std::size_t bit) { return ((bits >> bit) & 1U) != 0 ? 1.0F : -1.0F; }

void add(Samples& sum, float weight, const Samples& more) {
  for (std::size_t k = 0; k < kSamples; ++k) sum[k] += weight * more[k];
}

/// The error of a node's mean in each sample, in terms of its standard error.
Samples shift(const mesh::ElementTree& tree, ElementId e, std::uint64_t seed) {
  const std::uint64_t bits = mesh::hash(mesh::hash(tree.key(e), seed), 0x5E1);
  Samples s{};
  for (std::size_t k = 0; k < kSamples; ++k) s[k] = sign(bits, k);
  return s;
}

/// What a node's line misses at a point of it: more in one half of it and less in the other, or so in its quarters.
Samples pattern(const mesh::ElementTree& tree, ElementId e, const Point& at, std::uint64_t seed) {
  const Vector d = at - tree.centroid(e);
  const float u = dot(d, tree.axes(e).u) > 0.0 ? 1.0F : -1.0F;
  const float v = dot(d, tree.axes(e).v) > 0.0 ? 1.0F : -1.0F;
  const std::array<float, 3> halves{u, v, u * v};
  const std::uint64_t bits = mesh::hash(mesh::hash(tree.key(e), seed), 0x5E2);
  Samples s{};
  for (std::size_t k = 0; k < kSamples; ++k) s[k] = sign(bits, k) * halves[(bits >> (kSamples + 4 * k)) % 3];
  return s;
}

/// Reflects errors on until they settle.
class Reflections {
 public:
  Reflections(const Solution& solution, const Arrivals& arrivals, const Clusters& clusters, std::uint64_t seed)
      : solution_(solution),
        tree_(solution.tree()),
        arrivals_(arrivals),
        clusters_(clusters),
        seed_(seed),
        irradiance_(tree_.size()),
        gathered_(tree_.size()),
        radiosity_(tree_.size()),
        bundled_(clusters.size()) {}

  std::vector<Samples> run() {
    for (std::size_t round = 0; round < kMostRounds; ++round) {
      parallel_for(tree_.roots().size(), [&](std::size_t i) { push(tree_.roots()[i], Samples{}); });
      if (pulled_change() <= kSettled) break;
      gather();
    }
    return std::move(irradiance_);
  }

 private:
  void push(ElementId e, Samples above) {
    add(above, 1.0F, gathered_[e.index()]);
    add(above, solution_.noise(e), shift(tree_, e, seed_));
    if (!solution_.is_open(e)) {
      irradiance_[e.index()] = above;
      return;
    }
    for (std::size_t k = 0; k < tree_.child_count(e); ++k) {
      const ElementId child(tree_.first_child(e).index() + k);
      Samples here = above;
      add(here, solution_.misfit(e), pattern(tree_, e, tree_.centroid(child), seed_));
      push(child, here);
    }
  }

  /// Hands radiosities up. Returns how much they have changed, as a share of what they are.
  double pulled_change() {
    const auto roots = tree_.roots();
    std::vector<double> change(roots.size());
    std::vector<double> all(roots.size());
    parallel_for(roots.size(), [&](std::size_t i) { pull(roots[i], change[i], all[i]); });
    double changed = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < roots.size(); ++i) {
      changed += change[i];
      sum += all[i];
    }
    pull_clusters();
    return sum > 0.0 ? std::sqrt(changed / sum) : 0.0;
  }

  void pull(ElementId e, double& change, double& all) {
    Samples sum{};
    if (!solution_.is_open(e)) {
      add(sum, solution_.mean_reflectance(e), irradiance_[e.index()]);
      for (std::size_t k = 0; k < kSamples; ++k) {
        const double step = sum[k] - radiosity_[e.index()][k];
        change += tree_.area(e) * step * step;
        all += tree_.area(e) * sum[k] * sum[k];
      }
    } else {
      for (std::size_t k = 0; k < tree_.child_count(e); ++k) {
        const ElementId child(tree_.first_child(e).index() + k);
        pull(child, change, all);
        add(sum, static_cast<float>(tree_.area(child) / tree_.area(e)), radiosity_[child.index()]);
      }
    }
    radiosity_[e.index()] = sum;
  }

  void pull_clusters() {
    for (std::size_t i = bundled_.size(); i-- > 0;) {
      const auto c = static_cast<std::uint32_t>(i);
      if (clusters_.is_leaf(c)) {
        bundled_[i] = radiosity_[clusters_.root(c).index()];
        continue;
      }
      const auto share = static_cast<float>(clusters_.area(clusters_.left(c)) / clusters_.area(c));
      Samples sum{};
      add(sum, share, bundled_[clusters_.left(c)]);
      add(sum, 1.0F - share, bundled_[clusters_.right(c)]);
      bundled_[i] = sum;
    }
  }

  void gather() {
    parallel_for(
        arrivals_.receivers(),
        [&](std::size_t i) {
          Samples sum{};
          for (const Arrival& arrival : arrivals_.at(i)) {
            const LinkSource source = arrival.source();
            add(sum, arrival.factor(),
                source.is_cluster() ? bundled_[source.cluster()] : radiosity_[source.element().index()]);
          }
          gathered_[arrivals_.receiver(i).index()] = sum;
        },
        64);
  }

  const Solution& solution_;
  const mesh::ElementTree& tree_;
  const Arrivals& arrivals_;
  const Clusters& clusters_;
  std::uint64_t seed_;
  std::vector<Samples> irradiance_;  ///< [nodes] of elements
  std::vector<Samples> gathered_;    ///< [nodes]
  std::vector<Samples> radiosity_;   ///< [nodes]
  std::vector<Samples> bundled_;     ///< [clusters]
};

}  // namespace

SolutionErrors::SolutionErrors(const Solution& solution, const Arrivals& arrivals, const Clusters& clusters,
                               double missing, std::uint64_t seed)
    : seed_(seed), irradiance_(Reflections(solution, arrivals, clusters, seed).run()) {
  for (const ElementId e : solution.elements()) {
    const double lux = solution.illuminance_at(e, solution.tree().centroid(e));
    for (float& s : irradiance_[e.index()]) s += static_cast<float>(missing * lux);
  }
}

SolutionErrors::Samples SolutionErrors::radiosity(const Solution& solution, ElementId e, const Point& at) const {
  Samples here = irradiance_[e.index()];
  add(here, solution.misfit(e), pattern(solution.tree(), e, at, seed_));
  for (float& s : here) s *= solution.mean_reflectance(e);
  return here;
}

double SolutionErrors::mean_error(ElementId e) const {
  double square = 0.0;
  for (const float s : irradiance_[e.index()]) square += double{s} * s / kSamples;
  return std::sqrt(square);
}

double SolutionErrors::point_error(const Solution& solution, ElementId e) const {
  return std::hypot(mean_error(e), solution.misfit(e));
}

}  // namespace clerestory::lighting
