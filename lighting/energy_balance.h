// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace clerestory::lighting {

/// Fluxes of the energy balance [lm]: emitted + from sky = absorbed + left, but for `residual`.
struct EnergyBalance {
  double emitted_lm = 0.0;   ///< by surfaces and luminaires
  double received_lm = 0.0;  ///< on surfaces directly from sky and sun
  double absorbed_lm = 0.0;
  double left_lm =
      0.0;  ///< of what surfaces and luminaires send out, leaves the model or is absorbed in glass; measured by rays
  double residual = 0.0;  ///< (emitted + received - absorbed - left) / (emitted + received)
  double reciprocity =
      0.0;               ///< sum of |A_r F_rs - A_s F_sr| over pairs linked both ways, as a share of what they exchange
  double closure = 0.0;  ///< flux-weighted mean sum of form factors, less the share of rays that land on surfaces
};

}  // namespace clerestory::lighting
