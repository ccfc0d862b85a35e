// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lighting/known_light.h"
#include "lighting/radiosity.h"
#include "lighting/solution.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// A solution that is lit anew, as its scene stands, on the links that it has: with other reflectances, dimming, skies without casting a ray,
/// with another sun by that sun's rays alone.
class Relighting {
 public:
  /// @param solution   with the light that the errors of the transport belong to; kept by reference
  /// @param transport  of the solution, links with their errors
  Relighting(Solution& solution, Transport transport, KnownLight known, double accuracy);

  /// Lights the solution by its scene's sky and lamps. Errors by rays are taken to be as large in relation to the light as they were, suns'
  /// apart from all else; those of links follow from the new radiosities. They tell what links too coarse for the new light cost. A sun that has been cast is known from
  /// then on. Throws InputError for a source that is not known.
  const Transport& light(const Progress& progress);

  [[nodiscard]] const Arrivals& arrivals() const { return transport_.arrivals; }
  /// What is left of it when no more is lit.
  [[nodiscard]] Transport take() && { return std::move(transport_); }
  [[nodiscard]] const KnownLight& known() const { return known_; }
  /// Casts a sun as a group that is known by its name and not yet measured, or as a new one.
  void cast(const Sun& sun, const std::string& name);

 private:
  void add_errors(const FittedLight& fitted);

  Solution& solution_;
  Transport transport_;
  KnownLight known_;
  double accuracy_;
  std::vector<Solution::Errors> given_errors_;
  std::uint64_t seed_;
};

}  // namespace clerestory::lighting
