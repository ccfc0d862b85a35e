// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/geometry.h"

namespace clerestory::io {

/// A map of space that keeps angles: rotation, mirror, one scale, shift.
struct RadianceTransform {
  std::array<mesh::Vector, 3> axes{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};  ///< where x, y, z go
  mesh::Vector shift;
  double scale = 1.0;  ///< of lengths; below zero where the map mirrors

  [[nodiscard]] mesh::Point operator()(const mesh::Point& p) const;
  /// This map, and the other one after it.
  [[nodiscard]] RadianceTransform then(const RadianceTransform& next) const;
};

/// One copy of included files.
struct RadianceCopy {
  RadianceTransform transform;
  std::string name;     ///< of -n, outermost first, with the numbers of arrays; empty where not given
  std::string numbers;  ///< of arrays without a name: ".0.2"
  std::optional<std::string> modifier = {};  ///< of -m: that of all surfaces
  bool inverted = false;                     ///< of -I: fronts and backs are swapped
  std::vector<std::string> files;            ///< as written
};

/// What a command line of a scene asks for.
struct RadianceInclude {
  std::vector<RadianceCopy> copies;
  bool makes_sky = false;  ///< gensky and its kin: a sky, and nothing else
};

/// Where a command stands, for messages.
struct RadiancePlace {
  std::string file;
  std::uint64_t line = 0;
};

/// Gives the lines of a file of arguments (xform -f).
using ArgumentLines = std::function<std::vector<std::string>(const std::string& file)>;

/// Copies that one scene may consist of.
inline constexpr std::size_t kMostRadianceCopies = 200000;

/// Understands "xform …" and "cat FILE …", and such commands with "| xform …" behind; nothing is ever run.
/// Throws InputError for any other command, for what a shell would expand or redirect, for options that xform does not have, numbers
/// that are none, and more copies than kMostRadianceCopies.
/// Source: Ward, xform(1), 1999.
RadianceInclude parse_radiance_command(std::string_view command, const RadiancePlace& place,
                                       const ArgumentLines& argument_lines);

}  // namespace clerestory::io
