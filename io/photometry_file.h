// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>

#include "lighting/photometry.h"

namespace clerestory::io {

/// Whether a file's name ends as those of photometry do: .ies, .ldt, .eul.
bool is_photometry_file(const std::filesystem::path& path);

/// Reads an IES or EULUMDAT file, told apart by the name, else by whether there is a line TILT=.
/// @param lamp_set  of EULUMDAT, which of its lamp sets is fitted, counted from 0
/// Throws InputError where the readers do.
lighting::Photometry read_photometry(const std::filesystem::path& path, std::size_t lamp_set = 0);

}  // namespace clerestory::io
