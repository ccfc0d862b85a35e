// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

// Private to io/.
namespace clerestory::io {

/// What a STEP file says at a first look, without regard to what its entities mean. The parser passes over what it cannot read, and
/// succeeds: this is what its result is compared with.
struct StepOutline {
  std::string schema;                  ///< of the header, upper case: "IFC2X3"; empty where there is none
  std::map<int, std::uint64_t> lines;  ///< of each entity #n = …, 1-based
  bool complete = false;               ///< ends as a STEP file must
};

/// Comments and strings are passed over.
StepOutline outline_step(std::string_view text);

}  // namespace clerestory::io
