// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

namespace clerestory::io {

/// Writes the bytes to a file, replacing it, and checks every step to the close.
/// Throws MachineError, saying why; the part that was written is removed.
void write_whole_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace clerestory::io
