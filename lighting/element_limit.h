// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "lighting/solution.h"

namespace clerestory::lighting {

/// Where a solution's limit of elements leaves no room to open all of these nodes, opens those that are worth most, as far as there is
/// room: of the rest none may be opened any more. Where there is room for all, opens none. Serial; of equal worth the first comes first.
/// @param nodes  any of them may be there twice, or open
/// @param worth  of opening the node at an index; asked for only where there is no room
/// @return whether there is room for all
bool open_worthiest(Solution& solution, std::span<const mesh::ElementId> nodes,
                    const std::function<double(std::size_t)>& worth);

}  // namespace clerestory::lighting
