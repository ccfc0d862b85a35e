// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/io/sample_results.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace clerestory::test {

namespace {

mesh::Point place(const GridShape& shape, double x, double y) {
  return shape.corner + (x * shape.right + y * shape.up);
}

std::array<mesh::Point, 4> cell(const GridShape& shape, double x, double y) {
  const double h = 0.5 * shape.spacing_m;
  return {place(shape, x - h, y - h), place(shape, x + h, y - h), place(shape, x + h, y + h),
          place(shape, x - h, y + h)};
}

double window_peak(double x, double y, double window_x) {
  const double dx = (x - window_x) / 0.9;
  const double dy = (y - 0.9) / 1.5;
  return 9.0 * std::exp(-0.5 * (dx * dx + dy * dy));
}

}  // namespace

lighting::GridResult make_grid(const GridShape& shape, const Field& field) {
  lighting::GridResult grid;
  grid.name = "workplane";
  const double width = static_cast<double>(shape.columns) * shape.spacing_m + 2.0 * shape.margin_m;
  const double height = static_cast<double>(shape.rows) * shape.spacing_m + 2.0 * shape.margin_m;
  grid.sensors.outlines.push_back(
      {place(shape, 0, 0), place(shape, width, 0), place(shape, width, height), place(shape, 0, height)});
  for (std::size_t row = 0; row < shape.rows; ++row) {
    for (std::size_t column = 0; column < shape.columns; ++column) {
      const double x = shape.margin_m + (static_cast<double>(column) + 0.5) * shape.spacing_m;
      const double y = shape.margin_m + (static_cast<double>(row) + 0.5) * shape.spacing_m;
      grid.sensors.positions.push_back(place(shape, x, y));
      grid.sensors.normals.push_back(cross(shape.right, shape.up));
      grid.sensors.cells.push_back(cell(shape, x, y));
      grid.daylight_factor_percent.push_back(static_cast<float>(field(x, y)));
      grid.illuminance_lux.push_back(100.0F * grid.daylight_factor_percent.back());
      grid.error_lux.push_back(0.01F * grid.illuminance_lux.back());
    }
  }
  set_metrics(grid);
  return grid;
}

void append(lighting::GridResult& grid, const lighting::GridResult& other) {
  const auto join = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  join(grid.sensors.positions, other.sensors.positions);
  join(grid.sensors.normals, other.sensors.normals);
  join(grid.sensors.cells, other.sensors.cells);
  join(grid.sensors.outlines, other.sensors.outlines);
  join(grid.illuminance_lux, other.illuminance_lux);
  join(grid.error_lux, other.error_lux);
  join(grid.daylight_factor_percent, other.daylight_factor_percent);
  set_metrics(grid);
}

double office_daylight_factor(double x, double y) {
  return 0.35 + 1.4 * std::exp(-y / 2.2) + window_peak(x, y, 1.5) + window_peak(x, y, 4.5);
}

lighting::GridResult office_grid() { return make_grid({}, office_daylight_factor); }

void set_metrics(lighting::GridResult& grid) {
  lighting::GridMetrics& m = grid.metrics;
  std::vector<float> sorted = grid.illuminance_lux;
  if (sorted.empty()) return;
  std::ranges::sort(sorted);
  const auto count = static_cast<double>(sorted.size());
  m.mean_lux = std::accumulate(sorted.begin(), sorted.end(), 0.0) / count;
  m.median_lux = static_cast<double>(sorted[sorted.size() / 2]);
  m.minimum_lux = static_cast<double>(sorted.front());
  m.maximum_lux = static_cast<double>(sorted.back());
  m.uniformity = m.mean_lux > 0.0 ? m.minimum_lux / m.mean_lux : 0.0;
  m.accuracy_reached = 0.017;
  m.accuracy_met = true;
  m.has_daylight_factor = !grid.daylight_factor_percent.empty();
  m.mean_df_percent = 0.01 * m.mean_lux;
  m.median_df_percent = 0.01 * m.median_lux;
  m.minimum_df_percent = 0.01 * m.minimum_lux;
  const auto share = [&](float limit) {
    return static_cast<double>(std::ranges::count_if(sorted, [&](float e) { return e >= limit; })) / count;
  };
  m.share_above_2_percent = share(200.0F);
  m.share_above_5_percent = share(500.0F);
}

lighting::Results make_results(const lighting::GridResult& grid) {
  lighting::Results results;
  results.grids = {grid};
  results.horizontal_illuminance_lux = 10'000.0;
  results.accuracy_target = 0.02;
  results.accuracy_reached = grid.metrics.accuracy_reached;
  results.accuracy_met = true;
  lighting::SurfaceResult& s = results.surfaces;
  s.points = {{612345.123456, 0, 0.75}, {612346.123456, 0, 0.75}, {612346.123456, 1, 0.75},
              {612345.123456, 0, 0.75}, {612346.123456, 0, 0.75}, {612346.123456, 1, 0.75}};
  s.point_illuminance_lux = {100, 200, 300, 10, 20, 30};
  s.point_normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, -1}, {0, 0, -1}, {0, 0, -1}};
  s.cells = {{0, 1, 2}, {5, 4, 3}};
  s.side = {0, 1};
  s.illuminance_lux = {200, 20};
  s.error_lux = {2, 1};
  s.radiosity_lm_m2 = {60, 6};
  s.luminance_cd_m2 = {19.098593F, 1.9098593F};
  s.reflectance = {0.3F, 0.3F};
  s.level = {2, 0};
  s.part = {0, 0};
  s.material = {1, 1};
  s.room = {0, -1};
  s.part_names = {"desk <1> & \"süd\""};
  s.material_names = {"wall", "wood"};
  s.room_names = {"room 1"};
  results.shadow_lines.emplace();
  return results;
}

io::ResultContext daylight_context() {
  io::ResultContext context;
  context.study_name = "office";
  context.kind = lighting::Study::Kind::kDaylight;
  context.version = "0.1.0";
  context.sky = "CIE overcast sky, 10000 lx horizontal";
  return context;
}

}  // namespace clerestory::test
