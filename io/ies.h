// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "lighting/photometry.h"

namespace clerestory::io {

/// Reads a photometric file of the IES: LM-63 of 1986, 1991, 1995, 2002 and 2019, types A, B and C. Candela multiplier and ballast factor are
/// applied, and before 1995 the ballast-lamp factor; feet become metres.
/// Throws InputError with file and line for a file that is cut off or none of that format, angles out of order, negative or no intensities, counts
/// that do not fit, and a TILT file that is not there.
/// Source: ANSI/IESNA LM-63-02; for older files I. Ashdown, Parsing the IESNA LM-63 Photometric Data File, 1998.
lighting::Photometry read_ies(const std::filesystem::path& path);

}  // namespace clerestory::io
