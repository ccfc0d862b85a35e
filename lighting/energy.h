// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lighting/radiosity.h"
#include "lighting/results.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// The energy balance of a solution. What leaves is measured by rays from the surfaces, in proportion to the flux that they send
/// out, and from the luminaires; it is not the remainder.
EnergyBalance energy_balance(Solution& solution, const Transport& transport, std::uint64_t seed);

/// A sentence for the user where the balance is off by more than errors of either sign account for; else nothing. Errors that have one
/// sign in all links are not in the errors of the sensors: the balance alone tells of them.
/// @param accuracy  asked for, relative
std::optional<std::string> imbalance_note(const EnergyBalance& balance, double accuracy);

}  // namespace clerestory::lighting
