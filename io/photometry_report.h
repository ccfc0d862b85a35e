// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "lighting/photometry.h"

namespace clerestory::io {

/// What is in a photometric file, for a reader at a terminal: the luminaire, its fluxes, and its table of UGR where it has a luminous area.
/// @param file  as the user named it
std::string photometry_text(const lighting::Photometry& photometry, const std::string& file);

/// The same as JSON, with the intensities by plane.
/// @param version  of the program
std::string photometry_json(const lighting::Photometry& photometry, const std::string& file,
                            const std::string& version);

}  // namespace clerestory::io
