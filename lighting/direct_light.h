// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lighting/importance.h"
#include "lighting/links.h"
#include "lighting/luminaire_view.h"
#include "lighting/minor_openings.h"
#include "lighting/received_flux.h"
#include "lighting/solution.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// What a node was given by light_directly(), and what it looked at. The nodes are no parts of each other.
struct NodeDirect {
  mesh::ElementId node;
  std::vector<std::uint32_t> openings;    ///< through which it may be lit
  std::vector<MinorOpening> minor;        ///< others, through which it may be lit so little that it hardly matters
  std::vector<LuminaireView> luminaires;  ///< by which it may be lit
  bool open_sky = false;                  ///< whether it may see the sky by no opening
  LinearValue received;                   ///< [lux]
};

/// Light of one source group that a node receives straight, by panes as mirrors too.
struct GroupDirect {
  mesh::ElementId node;
  std::uint32_t group = 0;
  LinearValue lux;
};

/// Squared errors of what a node receives straight of one source group [lux²], as Solution::add_error() has them.
struct GroupError {
  mesh::ElementId node;
  std::uint32_t group = 0;
  Solution::Errors errors;
};

/// What suns give a node straight, on the mean, and its squared errors [lux²].
struct SunDirect : NodeLux {
  Solution::Errors errors;
};

/// What light_directly() gives besides the direct light that it leaves in the solution.
struct DirectLight {
  std::vector<NodeDirect> nodes;
  /// Factors of the elements that nodes see through openings. They partition with the ordinary links: visibility stops there where a
  /// segment leaves through an opening.
  std::vector<Link> links;
  /// Mean illuminance at the sensors by all light, an estimate [lux]: the scale of tolerances.
  double scale_lux = 0.0;
  double by_luminaires_lm = 0.0;    ///< flux that opaque nodes receive straight from luminaires
  std::vector<GroupDirect> groups;  ///< what the solution's direct light is made of, where groups are told apart
  std::vector<SunDirect>
      suns;  ///< the part of the direct light that is of suns; their errors are not in the solution yet
  bool out_of_elements = false;  ///< whether nodes stay as they are because the solution may have no more elements
};

/// Finds what every node receives straight from sky (by itself or through openings), sun and luminaires, and what it sees through
/// openings. Starts at the roots and opens nodes where a line over the node misses more than tolerance · scale_lux at the sensors, the
/// worst first where the solution's limit of elements leaves no room for all.
DirectLight light_directly(Solution& solution, const Importance& importance, double tolerance, std::uint64_t seed,
                           Progress& progress);

}  // namespace clerestory::lighting
