// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace clerestory::io {

/// What the <asset> of a COLLADA document says of its coordinates.
struct ColladaAsset {
  std::optional<double> metres_per_unit;
  char up = 'Y';  ///< X, Y or Z; the standard's default is Y
  std::uint64_t unit_line = 0;
};

/// Takes unit and up axis out of a document, so that the importer, which would apply them in single precision, finds none. What
/// belongs to other assets, further down, stays. Bytes keep their places.
/// @param file  for the message. Throws InputError for a unit that is no positive number.
ColladaAsset take_asset(std::string& document, const std::string& file);

/// Moves blanks from the beginning of each element's text to its end: the importer refuses numbers after blanks, which are sound XML.
/// Tags, comments and attributes keep their places.
void move_blanks_back(std::string& document);

/// The name of the material that add_stand_in_material() adds.
inline constexpr const char* kStandInMaterial = "clerestory:no-material";

/// Adds a material before all others, for faces without one: the importer gives them the first that it finds. Lines keep their numbers.
void add_stand_in_material(std::string& document);

/// The 1-based line in which the first element of that name begins; nothing for none.
std::optional<std::uint64_t> line_of_element(const std::string& document, const std::string& name);

}  // namespace clerestory::io
