// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/report_json.h"
#include "lighting/results.h"

// Private to io/: what summary.json says of light.
namespace clerestory::io {

/// What the summary tells of observers, of tasks by EN 12464-1, of luminaires with the power of rooms, and of materials.
Json observers_json(const lighting::Results& results);
Json tasks_json(const lighting::Results& results);
Json luminaires_json(const lighting::Results& results);
Json material_lights_json(const lighting::Results& results);

}  // namespace clerestory::io
