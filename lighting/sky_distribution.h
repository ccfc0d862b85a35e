// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/geometry.h"

namespace clerestory::lighting {

/// How the luminance of a sky changes with direction: gradation times indicatrix,
///   l = (1 + a·exp(b / cos Z)) · (1 + c·(exp(d·χ) − k) + e·cos²χ),
/// Z the angle from the zenith, χ the angle from the sun, k = exp(d·π/2) for the CIE's skies and 0 for those of Perez. Negative values
/// count as none.
/// Sources: ISO 15469:2004 (CIE S 011); Perez, Seals, Michalsky 1993.
struct SkyDistribution {
  double a = 0.0;
  double b = -1.0;
  double c = 0.0;
  double d = -1.0;
  double e = 0.0;
  double k = 0.0;
  mesh::Vector towards_sun{0.0, 0.0, 1.0};  ///< unit vector
};

/// The CIE standard general sky of a type from 1 to 15 [ISO 15469:2004, table 1], the sun in this direction, which may lie under the
/// horizon.
SkyDistribution cie_general_sky(int type, const mesh::Vector& towards_sun);

/// l in a unit direction that does not point downwards.
double relative_luminance(const SkyDistribution& sky, const mesh::Vector& direction);

/// No direction of the sky has a larger l.
double relative_luminance_bound(const SkyDistribution& sky);

/// ∫ l cos Z dω over the sky: its horizontal illuminance over its luminance per unit of l, to 1e-6 of its value for the CIE's skies.
double relative_horizontal_illuminance(const SkyDistribution& sky);

}  // namespace clerestory::lighting
