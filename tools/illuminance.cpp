// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/illuminance.h"

#include "tools/answer.h"

namespace clerestory::tools {

int illuminance(const Options& options) { return answer(lighting::Study::Kind::kIlluminance, options); }

}  // namespace clerestory::tools
