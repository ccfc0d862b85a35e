// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lighting/spectrum.h"

namespace clerestory::lighting {

/// Clear glazing: transmittance of the whole unit at normal incidence [0 … 1], applied once.
struct Glazing {
  double transmittance_normal = 0.70;
  int panes = 1;
};

/// A surface that shines with Lambert's law. Exactly one of the two is set.
struct Emission {
  std::optional<double> flux_lm;  ///< of each connected surface of the material
  std::optional<double> luminance_cd_m2;
  std::string group{};  ///< whose light may be told apart (lighting/channels.h); none: named after the material
};

/// What one side of a surface does to light. Where nothing is said of the reflectance, the orientation of the side decides
/// (up 0.2, down 0.7, vertical 0.5, outdoors 0.2).
struct SideMaterial {
  std::optional<Spectrum> reflectance;  ///< diffuse, of one band or of each [0 … 1)
  std::optional<Emission> emission;
};

/// A material by the model's name for it.
struct Material {
  std::string name;
  SideMaterial front;
  SideMaterial back;
  std::optional<Glazing> glazing;  ///< both sides; excludes reflectance and emission
  bool opening = false;            ///< an air polygon: blocks nothing, guides the sampling of what lies beyond
  /// What it became and why, in words: "reflectance 0.50 (study)", "glazing 0.70 (named like glass)".
  std::string became;
  std::string why;
};

}  // namespace clerestory::lighting
