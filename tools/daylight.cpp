// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/daylight.h"

#include "tools/answer.h"

namespace clerestory::tools {

int daylight(const Options& options) { return answer(lighting::Study::Kind::kDaylight, options); }

}  // namespace clerestory::tools
