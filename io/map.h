// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/result_context.h"
#include "lighting/results.h"

namespace clerestory::io {

/// Draws a grid as a false-colour map for a report and writes it as PNG, about 1400 pixels wide: daylight factors [%] in a
/// daylight study, illuminances [lx] otherwise. Colours are interpolated between sensors, inside the outlines and where there
/// are sensors alone; isolines stand at round values, with their values; a list of points without cells becomes coloured dots.
/// Planes that lie apart (storeys, walls) are drawn side by side. Needs no display. The bytes depend on the arguments and the
/// fonts installed, not on locale, time or threads.
/// Throws InputError for a grid without sensors, MachineError when the file cannot be written whole.
void write_map_png(const std::filesystem::path& file, const lighting::GridResult& grid,
                   const lighting::Results& results, const ResultContext& context);

}  // namespace clerestory::io
