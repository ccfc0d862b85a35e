// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "lighting/radiosity.h"
#include "lighting/results.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// The energy balance of a solution. What leaves is measured by rays from the surfaces, in proportion to the flux that they send
/// out, and from the luminaires; it is not the remainder.
EnergyBalance energy_balance(Solution& solution, const Transport& transport, std::uint64_t seed);

}  // namespace clerestory::lighting
