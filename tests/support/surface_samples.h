// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lighting/results.h"
#include "mesh/geometry.h"

namespace clerestory::support {

/// What surfaces.vtp gives at places of one level surface by linear interpolation between the points of its cells, as a viewer shows it.
class SurfaceSamples {
 public:
  /// @param surfaces  kept by reference
  /// @param material  name; the cells of its front are taken, which face up or down
  SurfaceSamples(const lighting::SurfaceResult& surfaces, const std::string& material);

  /// Indices of its cells.
  [[nodiscard]] const std::vector<std::size_t>& cells() const { return cells_; }
  /// Illuminance below or above a place [lux]; nothing where no cell lies. Of cells that meet there, the first.
  [[nodiscard]] std::optional<double> at(double x, double y) const;

 private:
  /// Cells are found by squares of a grid.
  [[nodiscard]] std::array<std::size_t, 2> square_of(double x, double y) const;

  const lighting::SurfaceResult& surfaces_;
  std::vector<std::size_t> cells_;
  mesh::Box box_;
  std::vector<std::vector<std::size_t>> squares_;
};

}  // namespace clerestory::support
