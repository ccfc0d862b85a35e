// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/geometry.h"

namespace clerestory::mesh {

/// Uniform grids over planar regions: which of a region's triangles may hold a point. Cells are about as large as the triangles, so
/// that a cell knows a few of them and a triangle is known to a few cells.
/// Source: Franklin, Adaptive Grids for Geometric Operations, 1984.
class TriangleGrids {
 public:
  /// Lays the next grid.
  /// @param axes       of the region's plane
  /// @param triangles  of the region, numbered from `first` on; at least one
  /// @param slack_m    a point so far beside a triangle still may be held by it [m]; above 0
  void add(const Frame& axes, std::span<const std::array<Point, 3>> triangles, std::uint32_t first, double slack_m);

  /// Triangles that may hold a point of a grid's plane, in ascending order. None where there is no triangle within the slack.
  [[nodiscard]] std::span<const std::uint32_t> near(std::size_t grid, const Point& point) const {
    const Grid& g = grids_[grid];
    return cell(g, column(g, dot(point - Point{}, g.across) - g.low_across),
                row(g, dot(point - Point{}, g.up) - g.low_up));
  }

  /// Calls visit(triangles) for all cells within a distance [m] of a point, until it returns true; whether it did.
  template <class Visit>
  bool any_within(std::size_t grid, const Point& point, double distance, Visit visit) const {
    const Grid& g = grids_[grid];
    const double across = dot(point - Point{}, g.across) - g.low_across;
    const double up = dot(point - Point{}, g.up) - g.low_up;
    const std::uint32_t last_row = row(g, up + distance * g.rows_a_metre);
    const std::uint32_t last_column = column(g, across + distance * g.columns_a_metre);
    for (std::uint32_t r = row(g, up - distance * g.rows_a_metre); r <= last_row; ++r) {
      for (std::uint32_t c = column(g, across - distance * g.columns_a_metre); c <= last_column; ++c) {
        if (visit(cell(g, c, r))) return true;
      }
    }
    return false;
  }

 private:
  /// Columns and rows count from where dot(point, across) = low_across and dot(point, up) = low_up.
  struct Grid {
    Vector across;  ///< columns a metre
    Vector up;      ///< rows a metre
    double low_across = 0.0;
    double low_up = 0.0;
    double columns_a_metre = 0.0;
    double rows_a_metre = 0.0;
    std::uint32_t columns = 1;
    std::uint32_t rows = 1;
    std::size_t first_cell = 0;  ///< in cells_
  };

  static std::uint32_t clamped(double place, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(place, 0.0, count - 0.5));
  }
  static std::uint32_t column(const Grid& g, double across) { return clamped(across, g.columns); }
  static std::uint32_t row(const Grid& g, double up) { return clamped(up, g.rows); }
  [[nodiscard]] std::span<const std::uint32_t> cell(const Grid& g, std::uint32_t column, std::uint32_t row) const {
    const std::uint32_t* ends = &cells_[g.first_cell + std::size_t{row} * g.columns + column];
    return {members_.data() + ends[0], ends[1] - ends[0]};
  }

  std::vector<Grid> grids_;
  std::vector<std::uint32_t>
      cells_;  ///< where the members of each cell begin; one more a grid, where its last cell ends
  std::vector<std::uint32_t> members_;
};

}  // namespace clerestory::mesh
