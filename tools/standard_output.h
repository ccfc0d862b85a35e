// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace clerestory::tools {

/// Prints a text on stdout, whole. Throws MachineError.
/// @param consolation  ends the message: "; the results are in their folder all the same"
void print(const std::string& text, std::string_view consolation = {});

}  // namespace clerestory::tools
