// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/mtl.h"
#include "lighting/material.h"

namespace clerestory::io {

/// Whether a material's name says that it is clear glass: one of its words is glass, glazing, window, skylight or such, in English,
/// German, French, Italian or Spanish, and none says that it is something else (frame, sill, wool, fibre …). Words end at
/// blanks, punctuation, digits and at a capital behind a small letter.
bool is_named_like_glass(std::string_view name);

/// What was assumed of materials that the study does not name, to be told once for all.
class MaterialAssumptions {
 public:
  /// Decides what the study leaves open of a material: name like glass, MTL, orientation, in that order.
  void decide(const SourceMaterial& mtl, lighting::Material& material);

  /// The MTL's diffuse colour as reflectance where the study leaves that open. Nothing where there is none.
  std::optional<lighting::Spectrum> diffuse_reflectance(const SourceMaterial& mtl);

  /// One sentence each.
  [[nodiscard]] std::vector<std::string> sentences() const;

 private:
  std::vector<std::string> named_like_glass_;
  std::vector<std::string> transparent_;
  std::vector<std::string> by_colour_;
  std::vector<std::string> clamped_;
  std::vector<std::string> textured_;
  std::vector<std::string> by_orientation_;
  std::vector<std::string> shining_;
};

/// "0.50", or "0.50, 0.40, 0.30 (red, green, blue)".
std::string reflectance_words(const lighting::Spectrum& reflectance);

}  // namespace clerestory::io
