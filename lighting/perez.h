// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/sky.h"
#include "lighting/sky_distribution.h"
#include "mesh/geometry.h"

namespace clerestory::lighting {

/// What a weather station tells of the sun's energy at a moment.
struct Irradiance {
  double direct_normal_w_m2 = 0.0;       ///< of the beam, on a surface that faces it
  double diffuse_horizontal_w_m2 = 0.0;  ///< of the sky without the sun
  double dew_point_c = 11.0;
  int day_of_year = 80;  ///< from 1; for the distance of the sun
};

/// The parameters by which Perez sorts skies.
struct SkyClearness {
  double zenith_rad = 0.0;   ///< of the sun, the horizon at most
  double clearness = 1.0;    ///< ε
  double brightness = 0.01;  ///< Δ
  int bin = 0;               ///< of ε, from 0 (overcast) to 7 (clear)
};

/// ε = ((D_h + I)/D_h + 1.041 Z³) / (1 + 1.041 Z³) and Δ = D_h·m/I_0, m the air mass [Kasten 1966], I_0 = 1367 W/m² by the distance of the sun
/// [Spencer 1971]. Δ is 0.01 at least.
/// Source: Perez, Ineichen, Seals, Michalsky, Stewart 1990.
SkyClearness clearness_of(const Irradiance& irradiance, double sun_zenith_rad);

/// What the eye gets of the energy.
struct DaylightIlluminance {
  double diffuse_horizontal_lux = 0.0;
  double direct_normal_lux = 0.0;
};

/// By the luminous efficacies of diffuse and direct light [Perez et al. 1990, table 4]; none is negative.
DaylightIlluminance illuminance_of(const Irradiance& irradiance, const SkyClearness& sky);

/// The all-weather distribution [Perez, Seals, Michalsky 1993, table 1]. Δ counts as 0.2 at least where 1.065 < ε < 2.8.
SkyDistribution perez_distribution(const SkyClearness& sky, const mesh::Vector& towards_sun);

/// The all-weather sky of these irradiances, the sun in this direction with its beam. A sun under the horizon gives no beam; the sky is then
/// that of a sun on the horizon.
Sky perez_sky(const Irradiance& irradiance, const mesh::Vector& towards_sun);

}  // namespace clerestory::lighting
