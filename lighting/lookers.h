// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lighting/hemisphere_links.h"
#include "lighting/importance.h"
#include "lighting/solution.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// A node that looks around by rays, for all that does not shine by itself.
struct Looker {
  mesh::ElementId node;
  HemisphereView view;
};

/// Who receives reflected light how: each root is in one of the two, as it is or by its parts.
struct Receivers {
  std::vector<Looker> lookers;
  std::vector<mesh::ElementId> linking;  ///< roots that link to what surrounds them
};

struct LookOptions {
  double scale_lux = 0.0;  ///< mean illuminance at the sensors by all light
  double goal_lux = 0.0;   ///< error at the sensors that the noise of one root's rays may cause
  std::uint64_t seed = 0;
};

/// Parts the roots in those that look around by rays and those that link. Single rays differ from the mean by a known share of what surfaces
/// receive on the whole, so that reflectance and importance tell how many keep to the goal. Links of a root cost what all other roots are;
/// where the rays of its parts cost less, it is opened until each part needs few, at a finer goal, and matters all alike. Else it looks
/// around as it is, if that keeps to the goal, or links.
Receivers find_receivers(Solution& solution, const Importance& importance, const LookOptions& options,
                         Progress& progress);

}  // namespace clerestory::lighting
