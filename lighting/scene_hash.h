// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace clerestory::lighting {

struct Scene;
struct Sky;
struct Sun;

/// What a solution stands on, hashed by kind, so that one can say what has changed. Of one machine type and one version of the program.
struct SceneHash {
  std::uint64_t model = 0;         ///< faces as cleaned, with their contacts and parts
  std::uint64_t materials = 0;     ///< glazing and openings of all faces, bands
  std::uint64_t reflectances = 0;  ///< of all faces
  std::uint64_t sources = 0;       ///< which surfaces shine, and luminaires
  std::uint64_t light = 0;         ///< how bright all of these are; sky and sun

  bool operator==(const SceneHash&) const = default;
};

SceneHash hash_of(const Scene& scene);

/// A hash of all that a sky without its name is, its sun's share in the ground's light included; never 0.
std::uint64_t source_of(const Sky& sky);
/// The same of a sun but for how bright it is.
std::uint64_t source_of(const Sun& sun);

}  // namespace clerestory::lighting
