// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "io/raster.h"
#include "lighting/photometric_web.h"

namespace clerestory::io {

/// The intensities of a luminaire in the planes C0–C180 and C90–C270, by the angle from straight down: C0 and C90 to the right. The rings are
/// labelled in candelas.
Raster polar_diagram(const lighting::PhotometricWeb& web, const std::string& title);

}  // namespace clerestory::io
