// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lighting/results.h"
#include "lighting/scene.h"

namespace clerestory::lighting {

/// The luminaires of a scene by kind and group, in the order in which they first stand.
std::vector<LuminaireUse> luminaire_uses(const Scene& scene);

/// The power of the luminaires in each room that has some, in the order of the rooms. A luminaire stands in the room before its opening.
std::vector<RoomPower> room_powers(const Scene& scene);

/// Mean illuminance and luminance of each material's surfaces, by area, in the order of the materials; those without cells are left out.
std::vector<MaterialLight> material_lights(const SurfaceResult& surfaces);

}  // namespace clerestory::lighting
