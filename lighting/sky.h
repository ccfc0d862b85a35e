// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "lighting/sky_distribution.h"
#include "mesh/geometry.h"

namespace clerestory::lighting {

/// The sun's direct light.
struct Sun {
  mesh::Vector towards{0.0, 0.0,
                       1.0};  ///< unit vector in model coordinates; under the horizon there is no light from it
  double normal_illuminance_lux = 0.0;  ///< of a surface that faces it; 0: left out
  bool disc = false;                    ///< a disc of 0.533°, with penumbras; else a point

  [[nodiscard]] bool shines() const { return normal_illuminance_lux > 0.0 && towards.z > 0.0; }
};

/// The sky, the sun and the ground as the study asks for them.
struct Sky {
  enum class Type { kNone, kUniform, kCieOvercast, kDistribution, kSum };

  Type type = Type::kCieOvercast;
  double horizontal_illuminance_lux = 10'000.0;  ///< unobstructed, from the sky without the sun
  double ground_reflectance = 0.2;               ///< of the ground beyond the model
  SkyDistribution distribution{};                ///< for kDistribution
  std::string name = "sky";                      ///< for kDistribution: what it is called, for texts
  double luminance_scale = 0.0;                  ///< for kDistribution: luminance [cd/m²] over relative luminance
  Sun sun{};
  std::vector<Sky> parts{};  ///< for kSum: skies, with their suns and grounds, whose light adds up
  std::string moment{};      ///< of a part of a sum: what it is called in columns
  double share = 1.0;        ///< of a part of a sum: how much of its own light it stands for there

  /// Unobstructed, from the sky without the sun: nothing of no sky [lux].
  [[nodiscard]] double diffuse_illuminance_lux() const {
    return type == Type::kNone ? 0.0 : horizontal_illuminance_lux;
  }
  /// The sun, or those of the parts of a sum.
  template <class Body>
  void for_suns(const Body& body) const {
    if (type != Type::kSum) body(sun);
    for (const Sky& part : parts) body(part.sun);
  }
  /// Whether any sun does.
  [[nodiscard]] bool has_sun() const;
  /// Unobstructed, from the sky and the sun [lux].
  [[nodiscard]] double ground_illuminance_lux() const;
};

/// A sky of a distribution and a horizontal illuminance [lux], with the default ground and without the sun.
Sky sky_of(const SkyDistribution& distribution, double horizontal_illuminance_lux);

/// Skies whose light adds up to the mean over moments in which each has the same share: each stands in it by the inverse of the light that it
/// gives the open ground. Those without light stand for nothing.
/// @param moments  each with its name
Sky mean_sky(std::vector<Sky> moments);

/// The horizontal illuminance of a sky of this type (and distribution) whose zenith has this luminance [cd/m²].
double horizontal_illuminance_of(const Sky& sky, double zenith_luminance_cd_m2);

/// Luminance of the sky without the sun, or below the horizon of the ground beyond the model [cd/m²], in a unit direction that points away
/// from the observer. CIE traditional overcast sky: L = L_z (1 + 2 sin γ)/3, E_h = 7π/9 L_z [ISO 15469:2004, type 16].
/// Below the horizon: ground_reflectance · E_h / π, E_h with the sun where it shines.
double sky_luminance(const Sky& sky, const mesh::Vector& direction);

/// No direction of sky or ground has a larger luminance [cd/m²].
double sky_luminance_bound(const Sky& sky);

}  // namespace clerestory::lighting
