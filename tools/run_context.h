// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/result_context.h"
#include "io/study_file.h"
#include "tools/options.h"

namespace clerestory::tools {

/// What the files of a run that begins now say about it.
io::ResultContext context_of(const io::StudyInput& input, const std::filesystem::path& file, const Options& options);

}  // namespace clerestory::tools
