// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/ifc_building.h"

// Private to io/.
namespace clerestory::io {

/// The transparency of a style from which it is taken for glass.
inline constexpr double kTransparent = 0.3;

/// Marks what of the building's windows is glass. Of each window and curtain wall, with the parts of it, the first that there is: items
/// that are transparent or named like glass; plates among its parts; thin plates among the connected pieces of its bodies, which become
/// items of their own; a rectangle in the opening that it fills, with a share for the frame
/// where the window has no body. Transparent items of other elements are
/// glass too, except members. Notices tell what was guessed.
void find_panes(IfcBuilding& building);

}  // namespace clerestory::io
