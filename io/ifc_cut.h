// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/ifc_building.h"

// Private to io/.
namespace clerestory::io {

/// An opening of an element, as it was cut.
struct IfcCut {
  std::size_t element = 0;
  std::size_t opening = 0;
  mesh::Solid tool;  ///< in the element's coordinates, lengthened where its ends meet the element's faces
  /// The direction in which it goes through the element from one face to the other, so that light passes [element's coordinates].
  std::optional<mesh::Vector> way;
  bool failed = false;  ///< could not be cut
};

/// Cuts the openings of each element from its bodies. Notices say what could not be cut.
std::vector<IfcCut> cut_openings(IfcBuilding& building);

}  // namespace clerestory::io
