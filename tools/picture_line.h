// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "tools/options.h"

namespace clerestory::tools {

/// The last line of a report that has a picture: where it is, or how to get it.
/// @param what  "the polar diagram"
inline std::string picture_line(const Options& options, const std::string& what) {
  if (options.out.empty()) return "\npicture   with -o FILE.png: " + what + '\n';
  return "\npicture   " + options.out.string() + '\n';
}

}  // namespace clerestory::tools
