// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangle_grids.h"

#include <cmath>
#include <utility>

namespace clerestory::mesh {

namespace {

/// Cells a triangle's rectangle is wide and high, on average: three or four are then near a point.
constexpr double kCellsAcross = 2.0;
/// Where most triangles lie together in a corner, there are no more than so many cells to each.
constexpr double kMostCells = 4.0;

struct Interval {
  double low = 1e300;
  double high = -1e300;

  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  [[nodiscard]] bool empty() const { return low > high; }
  [[nodiscard]] double length() const { return high - low; }
};

/// A corner in cells.
struct Place {
  double across;
  double up;
};
using PlacedTriangle = std::array<Place, 3>;

/// How far a triangle reaches across in a strip.
Interval across_in(const PlacedTriangle& t, double low, double high) {
  Interval found;
  for (std::size_t k = 0; k < 3; ++k) {
    const Place& a = t[k];
    const Place& b = t[(k + 1) % 3];
    if (a.up >= low && a.up <= high) found.add(a.across);
    for (const double level : {low, high}) {
      if ((a.up < level) == (b.up < level)) continue;
      found.add(a.across + (level - a.up) / (b.up - a.up) * (b.across - a.across));
    }
  }
  return found;
}

/// Calls visit(cell) for each cell within the slack of a triangle.
template <class Visit>
void visit_cells(const PlacedTriangle& t, const Place& slack, std::uint32_t columns, std::uint32_t rows, Visit visit) {
  const auto within = [](double place, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(place, 0.0, count - 0.5));
  };
  Interval up;
  for (const Place& p : t) up.add(p.up);
  const std::uint32_t last_row = within(up.high + slack.up, rows);
  for (std::uint32_t r = within(up.low - slack.up, rows); r <= last_row; ++r) {
    const Interval across = across_in(t, r - slack.up, r + 1.0 + slack.up);
    if (across.empty()) continue;
    const std::uint32_t last_column = within(across.high + slack.across, columns);
    for (std::uint32_t c = within(across.low - slack.across, columns); c <= last_column; ++c) {
      visit(std::size_t{r} * columns + c);
    }
  }
}

/// What a region measures, and its triangles on average.
struct Extent {
  Interval all;
  double mean = 0.0;

  Extent(std::span<const std::array<Point, 3>> triangles, const Vector& axis) {
    for (const auto& t : triangles) {
      Interval own;
      for (const Point& p : t) own.add(dot(p - Point{}, axis));
      all.add(own.low);
      all.add(own.high);
      mean += own.length() / static_cast<double>(triangles.size());
    }
  }
  [[nodiscard]] double cells() const { return mean > 0.0 ? kCellsAcross * all.length() / mean : 1.0; }
};

}  // namespace

void TriangleGrids::add(const Frame& axes, std::span<const std::array<Point, 3>> triangles, std::uint32_t first,
                        double slack_m) {
  const Extent across(triangles, axes.u);
  const Extent up(triangles, axes.v);
  Grid grid;
  if (triangles.size() > 2) {
    const double most = kMostCells * static_cast<double>(triangles.size());
    const double shrunk = std::sqrt(std::min(1.0, most / (across.cells() * up.cells())));
    grid.columns = static_cast<std::uint32_t>(std::clamp(shrunk * across.cells(), 1.0, most));
    grid.rows = static_cast<std::uint32_t>(std::clamp(shrunk * up.cells(), 1.0, most));
  }
  grid.columns_a_metre = grid.columns / std::max(across.all.length(), slack_m);
  grid.rows_a_metre = grid.rows / std::max(up.all.length(), slack_m);
  grid.across = grid.columns_a_metre * axes.u;
  grid.up = grid.rows_a_metre * axes.v;
  grid.low_across = grid.columns_a_metre * across.all.low;
  grid.low_up = grid.rows_a_metre * up.all.low;
  grid.first_cell = cells_.size();

  std::vector<PlacedTriangle> placed(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector p = triangles[i][k] - Point{};
      placed[i][k] = {dot(p, grid.across) - grid.low_across, dot(p, grid.up) - grid.low_up};
    }
  }
  const Place slack{slack_m * grid.columns_a_metre, slack_m * grid.rows_a_metre};
  const auto visit_all = [&](auto visit) {
    for (std::uint32_t i = 0; i < placed.size(); ++i) {
      visit_cells(placed[i], slack, grid.columns, grid.rows,
                  [&](std::size_t cell) { visit(grid.first_cell + cell, i); });
    }
  };
  // Counted, summed up to where each cell begins, and filled in.
  const std::size_t cells = std::size_t{grid.columns} * grid.rows;
  cells_.resize(grid.first_cell + cells + 1, 0);
  visit_all([&](std::size_t cell, std::uint32_t) { ++cells_[cell]; });
  const auto begin_of_members = static_cast<std::uint32_t>(members_.size());
  std::uint32_t begin = begin_of_members;
  for (std::size_t c = grid.first_cell; c < cells_.size(); ++c) begin += std::exchange(cells_[c], begin);
  members_.resize(begin);
  visit_all([&](std::size_t cell, std::uint32_t i) { members_[cells_[cell]++] = first + i; });
  for (std::size_t c = cells_.size(); --c > grid.first_cell;) cells_[c] = cells_[c - 1];
  cells_[grid.first_cell] = begin_of_members;
  grids_.push_back(grid);
}

}  // namespace clerestory::mesh
