// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "lighting/luminous_opening.h"

namespace clerestory::io {

/// The luminous opening that an IES file means by its three dimensions [m], of which zeros and signs tell the shape. The length lies along C0.
/// Nothing where the signs mean no shape.
/// @param year  of the standard: from 2002 on, and before, some signs mean other shapes
/// Source: ANSI/IESNA LM-63-02, table 1; LM-63-1995, table 1.
std::optional<lighting::LuminousOpening> ies_opening(double width_m, double length_m, double height_m, int year);

}  // namespace clerestory::io
