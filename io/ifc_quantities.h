// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/ifc_entities.h"

class IfcObject;
class IfcProject;

// Private to the files of the IFC reader that may name the parser's types.
namespace clerestory::io {

/// The file's units of the measures that the reader takes.
struct IfcUnits {
  double metre = 1.0;         ///< of length [m]
  double square_metre = 1.0;  ///< of area [m²]
  double cubic_metre = 1.0;   ///< of volume [m³]
};

/// The units of a project, metres for those that it does not state.
IfcUnits units_of(const std::shared_ptr<IfcProject>& project);

/// The first of the names that a quantity set or property set of the object states as an area [m²].
std::optional<double> stated_area(const IfcObject& object, std::span<const std::string_view> names,
                                  const IfcUnits& units);
/// The first of the names that a quantity set or property set of the object states as a volume [m³].
std::optional<double> stated_volume(const IfcObject& object, std::span<const std::string_view> names,
                                    const IfcUnits& units);

}  // namespace clerestory::io
