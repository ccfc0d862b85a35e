// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "lighting/arrivals.h"
#include "lighting/clusters.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// Samples of how wrong a solution may be: what each node received is made wrong by chance, as far as its own errors say, and the
/// light that this adds or takes away is reflected on by the links, as all light is [the parametric bootstrap: Efron, Tibshirani
/// 1993]. So errors of parts that share a source stay together, and those of many small parts average out, with no constant that says
/// how much.
class SolutionErrors {
 public:
  static constexpr std::size_t kSamples = 8;
  using Samples = std::array<float, kSamples>;

  SolutionErrors() = default;
  /// @param arrivals  of the links that the solution was made with
  /// @param clusters  that the links' sources are among
  /// @param missing   share of the light that iterations not made would still bring, everywhere alike
  SolutionErrors(const Solution& solution, const Arrivals& arrivals, const Clusters& clusters, double missing,
                 std::uint64_t seed);

  /// The same, known already.
  /// @param irradiance  [nodes] of elements [lux]
  SolutionErrors(std::vector<Samples> irradiance, std::uint64_t seed)
      : seed_(seed), irradiance_(std::move(irradiance)) {}

  [[nodiscard]] std::uint64_t seed() const { return seed_; }
  /// Errors of what an element receives, on the mean over it [lux].
  [[nodiscard]] const Samples& irradiance(mesh::ElementId e) const { return irradiance_[e.index()]; }
  /// Errors of the reflected radiosity at a point of an element [lm/m²].
  [[nodiscard]] Samples radiosity(const Solution& solution, mesh::ElementId e, const mesh::Point& at) const;
  /// Standard error of what an element receives, on the mean over it and at a point of it [lux].
  [[nodiscard]] double mean_error(mesh::ElementId e) const;
  [[nodiscard]] double point_error(const Solution& solution, mesh::ElementId e) const;

 private:
  std::uint64_t seed_ = 0;
  std::vector<Samples> irradiance_;  ///< [nodes] of elements [lux]
};

}  // namespace clerestory::lighting
