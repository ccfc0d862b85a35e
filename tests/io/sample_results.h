// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

#include "io/result_context.h"
#include "lighting/results.h"

namespace clerestory::test {

/// A value at a place in the plane of a grid [m].
using Field = std::function<double(double, double)>;

/// What to lay out as a grid.
struct GridShape {
  std::size_t columns = 24;
  std::size_t rows = 32;
  double spacing_m = 0.25;
  double margin_m = 0.0;  ///< between the cells and the outline
  mesh::Point corner{0.0, 0.0, 0.8};
  mesh::Vector right{1.0, 0.0, 0.0};
  mesh::Vector up{0.0, 1.0, 0.0};
};

/// A grid of cells with one outline, the daylight factor being field(x, y) [%] at (x, y) from the corner, and the
/// illuminance a hundred times that.
lighting::GridResult make_grid(const GridShape& shape, const Field& field);

/// Joins a grid to another.
void append(lighting::GridResult& grid, const lighting::GridResult& other);

/// The office of 6 x 8 m: two windows at y = 0 that make two peaks, and a dark depth of the room.
double office_daylight_factor(double x, double y);
lighting::GridResult office_grid();

/// Sets the grid's metrics from its values.
void set_metrics(lighting::GridResult& grid);

/// Results that hold the grid, and two triangles on the two sides of a desk.
lighting::Results make_results(const lighting::GridResult& grid);

io::ResultContext daylight_context();

}  // namespace clerestory::test
