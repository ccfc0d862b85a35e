// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/source_material.h"
#include "lighting/material.h"

namespace clerestory::io {

/// Whether a material's name says that it is clear glass: one of its words is glass, glazing, window, skylight or such, in English,
/// German, French, Italian or Spanish, and none says that it is something else (frame, sill, wool, fibre …). Words end at
/// blanks, punctuation, digits and at a capital behind a small letter.
bool is_named_like_glass(std::string_view name);

/// The most that a surface is believed to reflect: fresh snow.
inline constexpr double kMostReflectance = 0.95;

/// What was assumed of materials that the study does not name, to be told once for all.
class MaterialAssumptions {
 public:
  /// Decides what the study leaves open of a material, in this order: a transmittance that the file tells, what it tells in photometric
  /// terms, a name like glass, a transparent colour, a colour, a name like a finish (io/finishes.h); else the orientation of its sides.
  void decide(const SourceMaterial& source, lighting::Material& material);

  /// A reflectance, and what says so.
  struct Reflectance {
    std::optional<lighting::Spectrum> value;
    std::string why;
  };

  /// The reflectance where the study leaves that open: what the file tells, the diffuse and the specular one together, since this version
  /// has no mirrors; else what the name tells. Nothing where neither does.
  Reflectance reflectance(const SourceMaterial& source);

  /// Notes that the specular reflectance of a material joined the diffuse one.
  void join_specular(const std::string& name) {
    if (std::find(specular_.begin(), specular_.end(), name) == specular_.end()) specular_.push_back(name);
  }

  /// Notes of a material that lets light pass diffusely in the model's file that it is opaque here.
  void note_if_translucent(const SourceMaterial& source);

  /// Notes that the study gives more than real surfaces reflect.
  void note_too_bright(const std::string& name) { too_bright_.push_back(name); }

  /// One sentence each.
  [[nodiscard]] std::vector<std::string> sentences() const;

 private:
  using Names = std::vector<std::string>;

  bool decide_glazing(const SourceMaterial& source, lighting::Material& material);
  void decide_sides(const SourceMaterial& source, lighting::Material& material);
  std::optional<lighting::Spectrum> told_reflectance(const SourceMaterial& source);

  std::map<std::string, Names> told_by_;     ///< reflectances, by what tells them
  std::map<std::string, Names> named_like_;  ///< reflectances, by the finish that the name tells
  Names named_like_glass_;
  Names transparent_;
  Names told_glazing_;
  Names implausible_;
  Names too_bright_;
  Names textured_;
  Names by_orientation_;
  Names shining_;
  Names specular_;
  Names translucent_;
};

/// The luminance that a file tells, as emission of the front; nothing where it tells none.
std::optional<lighting::Emission> told_emission(const SourceMaterial& source);

/// "0.50", "0.50, 0.40, 0.30 (red, green, blue)", or "0.10 to 0.60 (9 bands)".
std::string reflectance_words(const lighting::Spectrum& reflectance);

/// "reflectance 0.50, shines with 4000 lm".
std::string side_words(const lighting::SideMaterial& side);

}  // namespace clerestory::io
