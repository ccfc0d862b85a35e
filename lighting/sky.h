// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "mesh/geometry.h"

namespace clerestory::lighting {

/// The sky as the study asks for it.
struct Sky {
  enum class Type { kNone, kUniform, kCieOvercast };

  Type type = Type::kCieOvercast;
  double horizontal_illuminance_lux = 10'000.0;  ///< unobstructed, from the sky without the sun
  double ground_reflectance = 0.2;               ///< of the ground beyond the model
};

/// Luminance of the sky, or below the horizon of the ground beyond the model [cd/m²], in a unit direction that points away from
/// the observer. CIE traditional overcast sky: L = L_z (1 + 2 sin γ)/3, E_h = 7π/9 L_z [ISO 15469:2004, type 16].
/// Below the horizon: ground_reflectance · E_h / π.
double sky_luminance(const Sky& sky, const mesh::Vector& direction);

}  // namespace clerestory::lighting
