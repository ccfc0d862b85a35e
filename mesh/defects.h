// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "mesh/clean.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Collects what the steps of the clean-up find, by kind, in the order in which kinds first come.
class DefectList {
 public:
  /// One defect, found and mended.
  /// @param at  local coordinates [m]
  void add(std::string_view kind, std::uint32_t polygon, const Point& at, std::string_view note = {});

  /// The list, with places in model coordinates.
  [[nodiscard]] std::vector<Defect> take(const Vector& origin) &&;

 private:
  std::vector<Defect> defects_;
};

}  // namespace clerestory::mesh
