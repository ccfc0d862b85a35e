// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "io/result_context.h"
#include "lighting/results.h"

namespace clerestory::tools {

/// The results for a reader at a terminal: a table of the grids, accuracy, energy balance, time, where the maps are,
/// and each assumption and notice once.
/// @param out  the folder that the results were written to, as the user named it
std::string report(const lighting::Results& results, const io::ResultContext& context,
                   const std::filesystem::path& out);

/// What kept a run from its accuracy: "the accuracy of 2 % was not reached, only 3.1 %", after what has stopped it.
std::string shortfall(const lighting::Results& results);
/// What to do about that.
/// @param from_stored  whether the results are by a solution that an earlier run has kept
std::string remedy(const lighting::Results& results, bool from_stored);

}  // namespace clerestory::tools
