// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>

#include "lighting/photometry.h"

namespace clerestory::io {

/// Reads a photometric file in EULUMDAT: all symmetries, several lamp sets, absolute photometry (a negative number of lamps). The conversion
/// factor is applied, and the flux of the lamp set that is fitted; the light output ratio is in the intensities already. Lengths lie along
/// C90–C270. Numbers may have commas for points.
/// @param lamp_set  which of the file's lamp sets is fitted, counted from 0
/// Throws InputError with file and line for a file that is cut off or none of that format, angles out of order, negative or no intensities, counts
/// that do not fit, and a lamp set that it does not have.
/// Source: A. W. Stockmar, EULUMDAT/2, CIBSE National Lighting Conference 1998.
lighting::Photometry read_eulumdat(const std::filesystem::path& path, std::size_t lamp_set = 0);

}  // namespace clerestory::io
