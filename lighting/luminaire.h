// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "lighting/luminous_opening.h"
#include "lighting/photometric_web.h"
#include "mesh/geometry.h"

namespace clerestory::lighting {

/// A luminaire in its place.
struct Luminaire {
  std::string name;  ///< of what it is, for messages
  std::shared_ptr<const PhotometricWeb> web;
  LuminousOpening opening;
  mesh::Point at;  ///< centre of the luminous opening [m]
  /// Unit axes: u towards C0, v towards C90, w against γ = 0.
  mesh::Frame axes{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  double factor = 1.0;          ///< on the web's intensities: maintenance, dimming, tilt
  double power_w = 0.0;         ///< undimmed; 0 where it is not stated
  std::string group = "lamps";  ///< whose light may be told apart (lighting/channels.h)

  [[nodiscard]] double flux_lm() const { return factor * web->flux_lm(); }
  [[nodiscard]] double peak_cd() const { return factor * web->peak_cd(); }
  /// Towards a direction of unit length in the model [cd].
  [[nodiscard]] double intensity_cd(const mesh::Vector& direction) const;
  /// A place given in the luminaire's own axes.
  [[nodiscard]] mesh::Point place(const mesh::Vector& own) const;
  /// A direction or displacement in the luminaire's own axes.
  [[nodiscard]] mesh::Vector to_own(const mesh::Vector& v) const;
};

/// The axes of a luminaire that aims somewhere: rotated by 0, its C0 half-plane holds +x, or +z where it aims along x. The rotation runs from C0
/// to C90: for one that aims down counter-clockwise in the plan.
/// @param aim  the direction of γ = 0; not zero
mesh::Frame luminaire_axes(const mesh::Vector& aim, double rotate_deg);

}  // namespace clerestory::lighting
