// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/write_model.h"

namespace clerestory::io {

/// Writes PLY, as write_model() says.
std::vector<std::filesystem::path> write_ply(const std::filesystem::path& file, const WrittenModel& written);

}  // namespace clerestory::io
