// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/write_model.h"

namespace clerestory::io {

/// Writes VTK XML polygons, as write_model() says.
std::vector<std::filesystem::path> write_vtp(const std::filesystem::path& file, const WrittenModel& written);

}  // namespace clerestory::io
