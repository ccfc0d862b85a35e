// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clerestory::io {

/// What a primitive of a Radiance scene is to us.
enum class RadianceKind { kSurface, kInstance, kSource, kMaterial, kPattern, kTexture, kMixture, kAlias };

/// A primitive as it stands in the file; numbers in the file's unit.
struct RadiancePrimitive {
  std::string modifier;
  std::string_view type;  ///< a word of Radiance's own: "polygon", "plastic", …
  RadianceKind kind = RadianceKind::kSurface;
  std::string identifier;
  std::vector<std::string> strings;  ///< of an alias its target
  std::vector<double> reals;
  std::uint64_t line = 0;  ///< of the modifier
};

/// A primitive, or a command line without its "!".
struct RadianceStatement {
  std::optional<std::string> command;
  RadiancePrimitive primitive;  ///< where it is no command
  std::uint64_t line = 0;
};

/// One file of a scene.
struct RadianceFile {
  std::filesystem::path path;
  std::string name;  ///< as the user named it, for messages
  std::vector<RadianceStatement> statements;
};

/// What was survived or left out, counted by kind, with the first place of each.
class RadianceNotices {
 public:
  /// @param what  in words that a count follows: "Octree instances were left out"
  void add(const std::string& what, const std::string& identifier, const std::string& file, std::uint64_t line);

  /// One sentence a kind: "… were left out: 3, the first is 'tree' in garden.rad:17."
  [[nodiscard]] std::vector<std::string> sentences() const;

 private:
  struct Entry {
    std::size_t count = 0;
    std::string first;
  };
  std::map<std::string, Entry> entries_;
};

/// Reads the statements of one file, without following its commands. A count of numbers that disagrees with the numbers that stand
/// there is survived, and noticed: the numbers count.
/// Throws InputError with file and line for an unknown type of primitive, a word where a number should be, numbers that are not
/// finite, a file that ends inside a primitive, and where LineReader does.
/// Source: Ward and others, The RADIANCE 5.1 Synthetic Imaging System, section 2.1, "Scene Description".
RadianceFile read_radiance_file(const std::filesystem::path& path, RadianceNotices& notices);

/// Whether the first bytes of a file can only be a Radiance scene: a command, or a primitive of a known type with its counts.
bool looks_like_radiance(std::string_view head);

}  // namespace clerestory::io
