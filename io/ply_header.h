// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/model_builder.h"

namespace clerestory::io {

enum class PlyEncoding { kText, kLittleEndian, kBigEndian };
enum class PlyScalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

/// A property of an element: one number, or a list of them.
struct PlyProperty {
  std::string name;
  PlyScalar type = PlyScalar::kFloat32;
  std::optional<PlyScalar> count_type;  ///< of a list; a whole number
};

/// An element and how many of it follow, as the header promises.
struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  std::uint64_t line = 0;  ///< of the header
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kText;
  std::vector<PlyElement> elements;
  std::optional<ToldUnit> unit;  ///< where a comment names one
  /// Of the numbers that faces have as `part` and `material`, where comments name them as write_model() does: "comment part 0 desk".
  std::vector<std::string> part_names;
  std::vector<std::string> material_names;
  std::uint64_t lines = 0;  ///< of the header, end_header included
  std::uint64_t bytes = 0;  ///< where the data begin
};

/// Reads the header of a PLY file, at most 1 MiB.
/// Throws InputError with the line for: a word of no meaning, a type or an encoding that PLY does not have, a count that is no whole
/// number, an element without properties, a header that does not end.
PlyHeader read_ply_header(const std::filesystem::path& path);

}  // namespace clerestory::io
