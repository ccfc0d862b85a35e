// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "mesh/geometry.h"

namespace clerestory::lighting {

/// Where someone looks.
struct View {
  mesh::Point eye;
  mesh::Vector direction;  ///< the line of sight, of unit length
  mesh::Vector up{0.0, 0.0, 1.0};
};

/// A source of glare as an eye sees it.
struct GlareSource {
  mesh::Vector direction;  ///< from the eye, of unit length
  double luminance_cd_m2 = 0.0;
  double solid_angle_sr = 0.0;
};

/// How much less a source glares for not standing in the line of sight: Guth's position index.
/// Source: Levin, Position Index in VCP Calculations, JIES 4 (1975); the angles are τ from the vertical plane of sight and σ from the line of
/// sight. Below the line of sight it is taken as above.
double position_index(const View& view, const mesh::Vector& direction);

/// The Unified Glare Rating; minus infinity where nothing glares. Sources behind the observer are left out.
/// @param background_cd_m2  E_i/π, E_i the vertical illuminance at the eye without the sources' own light
/// Source: CIE 117:1995, (4.1).
double unified_glare_rating(const View& view, std::span<const GlareSource> sources, double background_cd_m2);

}  // namespace clerestory::lighting
