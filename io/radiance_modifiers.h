// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/radiance_scene.h"
#include "io/source_material.h"

namespace clerestory::io {

/// The modifiers of a scene: materials, patterns, textures, mixtures, aliases. As in Radiance a name means its latest definition
/// before its use; the first of several different ones keeps the plain name, the others get their file's name behind it.
class RadianceModifiers {
 public:
  /// Takes a definition; the same one again, as copies of a file bring it, changes nothing.
  void define(const RadiancePrimitive& primitive, const std::string& file);

  /// The material of the model for a surface with this modifier: the alias, the mixture, or the material behind patterns and
  /// textures. Nothing where such a surface is none: antimatter, mist.
  std::optional<std::string> material_for(const std::string& modifier);

  /// What the definitions tell, by the names that material_for() gave, and those that no surface uses.
  [[nodiscard]] std::vector<SourceMaterial> told() const;

  /// What was assumed, one sentence each.
  [[nodiscard]] std::vector<std::string> notices() const;

 private:
  /// What a chain of modifiers means.
  struct Meaning {
    std::string name;                     ///< in the model
    std::optional<std::size_t> material;  ///< its definition; none where nothing stands behind the chain
    bool patterned = false;               ///< a pattern lies on it
    bool pictured = false;                ///< a picture is its colour
    bool mixed = false;                   ///< it is a part of a mixture
    bool behind_illum = false;            ///< it is seen in place of an illum
  };
  struct Definition {
    RadiancePrimitive primitive;
    std::string file;
    std::string name;                     ///< in the model
    std::optional<std::size_t> modifier;  ///< an earlier definition
    std::vector<std::size_t> targets;     ///< of aliases, mixtures, illums: earlier definitions
    Meaning meaning;
  };

  [[nodiscard]] std::optional<std::size_t> latest(const std::string& name) const;
  /// @param others  definitions of the name so far
  [[nodiscard]] std::string free_name(const std::string& name, const std::string& file, std::size_t others) const;
  [[nodiscard]] std::vector<std::size_t> targets_of(const RadiancePrimitive& primitive) const;
  [[nodiscard]] Meaning meaning_of(const Definition& definition, std::size_t index) const;
  [[nodiscard]] SourceMaterial tell(const Meaning& meaning) const;
  [[nodiscard]] std::vector<std::string> undefined() const;

  std::vector<Definition> definitions_;
  std::map<std::string, std::vector<std::size_t>> by_identifier_;  ///< the latest last
  std::set<std::string> names_;
  std::map<std::string, Meaning> used_;  ///< by name in the model
  std::set<std::string> undefined_;
};

}  // namespace clerestory::io
