// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "lighting/linear_fit.h"
#include "lighting/replicates.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// How the sun falls on a node.
enum class SunView : std::uint8_t {
  kUnknown,
  kNone,   ///< nowhere, on its parts neither
  kWhole,  ///< everywhere
  kPartly,
};

/// How the sun's light changes over a node.
struct SunSurvey {
  SunView view = SunView::kNone;
  double mean_lux = 0.0;
  LinearFit fit;
};

/// Looks from nodes at a sun. Its light has hard edges: a few rays tell nothing of a patch that they miss, so that a node counts as lit
/// nowhere or everywhere only when a ray from every square decimetre of it says so.
class SunSampler {
 public:
  SunSampler(const Solution& solution, const Sun& sun, std::uint64_t seed)
      : solution_(solution), sun_(sun), seed_(seed) {}

  /// @param known  of the node that it is a part of
  [[nodiscard]] SunSurvey survey(mesh::ElementId e, SunView known) const;
  /// The mean over a node, sampled until its standard error is under the tolerance or the most rays are spent [lux].
  [[nodiscard]] ReplicateMean mean(mesh::ElementId e, SunView view, double tolerance_lux) const;

 private:
  [[nodiscard]] double lux(mesh::ElementId e, const mesh::Point& p, double a, double b) const;

  const Solution& solution_;
  Sun sun_;
  std::uint64_t seed_;
};

}  // namespace clerestory::lighting
