// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lighting/local_pass.h"
#include "mesh/limit_surface.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// A point of a curved part that is to be lit.
struct LimitPlace {
  mesh::ElementId element;
  mesh::Point inside;      ///< of the element [m, local], off its edges
  mesh::LimitPoint limit;  ///< that it stands for, with the normal of the element's side
};

/// Light at the places by the local pass; nothing where the solution's is as good.
std::vector<std::optional<LocalPass::Light>> light_limit(const LocalPass& local, std::span<const LimitPlace> places,
                                                         Progress& progress);

}  // namespace clerestory::lighting
