// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace clerestory::io {

/// A material as a model file tells it, or only names it. What it becomes, the study and the rules for materials decide.
struct SourceMaterial {
  std::string name;
  std::string file;        ///< where it is defined; empty where nothing defines it
  std::uint64_t line = 0;  ///< of its definition
  /// What tells its properties, in words for the user: "Kd of the MTL", "the Radiance plastic".
  std::string told_by = "Kd of the MTL";
  /// Told in photometric terms, as Radiance does, and not as a colour to look at: what is told counts before the name.
  bool photometric = false;
  /// Diffuse reflectance, linear, per band red, green, blue; nothing where it is not given or given as a spectral curve.
  std::optional<std::array<double, 3>> diffuse = {};
  /// Specular reflectance at normal incidence, beside the diffuse one.
  std::optional<double> specular = {};
  /// 1 opaque, 0 clear, where the file tells opacity and no transmittance.
  std::optional<double> opacity = {};
  /// Clear glass: transmittance of the whole unit at normal incidence.
  std::optional<double> transmittance_normal = {};
  /// Diffuse transmittance of an opal or translucent sheet.
  std::optional<double> translucent = {};
  /// Shines with Lambert's law from its front side, in photometric terms.
  std::optional<double> luminance_cd_m2 = {};
  bool gamma_removed = false;  ///< `diffuse` was told with the gamma of sRGB, which the reader took off
  bool textured = false;       ///< its colour lies in an image, so that `diffuse` may say nothing
  bool shines = false;         ///< shines in terms that have no photometric meaning
};

}  // namespace clerestory::io
