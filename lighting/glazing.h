// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/rays.h"

namespace clerestory::lighting {

/// What clear glazing does to light, by the cosine of the angle of incidence: one sheet of n = 1.52 with inner reflections whose
/// transmittance at normal incidence is the unit's; more panes are that many sheets in series.
struct GlazingCurves {
  mesh::TransmittanceCurve transmittance;
  mesh::TransmittanceCurve reflectance;
  double hemispherical_transmittance = 0.0;
  double hemispherical_reflectance = 0.0;
};

/// Curves of a glazing unit by Fresnel's formulas [Ward, glass in the Radiance manual; docs/theory/transport.md]. Where sheets of
/// n = 1.52 cannot transmit as much (T_n > 0.918 for one pane), the whole curve of sheets without absorption is scaled.
/// @param transmittance_normal  of the whole unit (0 … 1]
/// @param panes  1 or more
GlazingCurves glazing_curves(double transmittance_normal, int panes);

}  // namespace clerestory::lighting
