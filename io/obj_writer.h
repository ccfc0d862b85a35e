// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/write_model.h"

namespace clerestory::io {

/// Writes OBJ and MTL, as write_model() says.
std::vector<std::filesystem::path> write_obj(const std::filesystem::path& file, const WrittenModel& written);

}  // namespace clerestory::io
