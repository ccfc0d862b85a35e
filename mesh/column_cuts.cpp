// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/column_cuts.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace clerestory::mesh {

namespace {

constexpr float kHeadroom = 1.8F;  ///< [m]
/// What one climbs on outdoors without meeting a wall [m].
constexpr float kClimb = 1.5F;
/// A yard larger than this is a yard, unless there is no room at all [m²].
constexpr double kLargestYard = 100.0;
/// Share of a yard's border that may go down in place of up.
constexpr double kFewDrops = 0.05;
/// A floor's level is told to this [m].
constexpr float kLevelStep = 0.25F;
/// So far below the floor of a cell there is no floor of it [m].
constexpr float kVoidDepth = 1.0F;
/// A void is a stairwell when nothing farther than this from its edge [m], or when it is no more than this share of its cell.
constexpr float kHalfStairs = 1.25F;
constexpr double kSmallShare = 0.15;

/// The span of a column that the sky is above.
std::uint32_t sky_span(const Columns& columns, std::uint32_t column) { return columns.of(column).second - 1; }

/// One connected yard, and what is around it.
struct Yard {
  std::vector<std::uint32_t> columns;
  std::vector<float> walls;  ///< tops of what is around, one a cell of the border [m]
  std::size_t drops = 0;
  bool leaves = false;  ///< goes on to the border of the raster, or to where nothing lies below
};

class Yards {
 public:
  explicit Yards(const Columns& columns) : columns_(columns), seen_(columns.raster.count(), 0) {}

  Yard grow(std::uint32_t start) {
    Yard yard;
    seen_[start] = 1;
    yard.columns.push_back(start);
    for (std::size_t next = 0; next < yard.columns.size(); ++next) look_around(yard.columns[next], yard);
    return yard;
  }
  [[nodiscard]] bool seen(std::uint32_t column) const { return seen_[column] != 0; }

 private:
  void look_around(std::uint32_t column, Yard& yard) {
    const float low = columns_.spans[sky_span(columns_, column)].low;
    for (const auto& beside : columns_.raster.four_beside(column)) {
      const float other = beside ? columns_.spans[sky_span(columns_, *beside)].low : Span{}.low;
      if (std::isinf(other)) {
        yard.leaves = true;
      } else if (other > low + kClimb) {
        yard.walls.push_back(other);
      } else if (other < low - kClimb) {
        ++yard.drops;
      } else if (seen_[*beside] == 0) {
        seen_[*beside] = 1;
        yard.columns.push_back(*beside);
      }
    }
  }

  const Columns& columns_;
  std::vector<std::uint8_t> seen_;
};

float median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool has_roofed_room(const Columns& columns) {
  return std::ranges::any_of(columns.spans, [](const Span& s) { return s.roofed() && s.height() >= kHeadroom; });
}

/// Area below each level of one cell, in steps.
using Levels = std::map<int, std::size_t>;

int level_of(float z) { return static_cast<int>(std::floor(z / kLevelStep)); }

}  // namespace

Columns cut_columns(const Columns& columns, const std::vector<ColumnCut>& cuts, std::vector<std::uint32_t>& old_span) {
  std::vector<float> at(columns.spans.size(), Span{}.high);
  for (const ColumnCut& cut : cuts) at[cut.span] = cut.at;
  Columns result{columns.raster, {0}, {}};
  old_span.clear();
  for (std::uint32_t c = 0; c < columns.raster.count(); ++c) {
    const auto [first, last] = columns.of(c);
    for (std::uint32_t s = first; s < last; ++s) {
      Span span = columns.spans[s];
      if (at[s] > span.low && at[s] < span.high) {
        result.spans.push_back({c, span.low, at[s], true});
        old_span.push_back(s);
        span.low = at[s];
      }
      result.spans.push_back(span);
      old_span.push_back(s);
    }
    result.starts.push_back(static_cast<std::uint32_t>(result.spans.size()));
  }
  return result;
}

std::vector<ColumnCut> roofless_rooms(const Columns& columns) {
  const double cell_area = columns.raster.cell_m * columns.raster.cell_m;
  const double largest = has_roofed_room(columns) ? kLargestYard : std::numeric_limits<double>::infinity();
  std::vector<ColumnCut> cuts;
  Yards yards(columns);
  for (std::uint32_t c = 0; c < columns.raster.count(); ++c) {
    if (yards.seen(c) || std::isinf(columns.spans[sky_span(columns, c)].low)) continue;
    const Yard yard = yards.grow(c);
    const double area = cell_area * static_cast<double>(yard.columns.size());
    if (yard.leaves || yard.walls.empty() || area > largest) continue;
    if (static_cast<double>(yard.drops) > kFewDrops * static_cast<double>(yard.walls.size() + yard.drops)) continue;
    const float top = median(yard.walls);
    for (const std::uint32_t column : yard.columns) {
      const std::uint32_t span = sky_span(columns, column);
      if (columns.spans[span].low < top) cuts.push_back({span, top});
    }
  }
  return cuts;
}

std::vector<ColumnCut> stairwells(const Columns& columns, const RoomCells& cells) {
  std::vector<Levels> levels(cells.count);
  for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
    const bool tall = columns.spans[s].height() >= kHeadroom;
    if (cells.of_span[s] != kNoCell && tall)
      ++levels[static_cast<std::size_t>(cells.of_span[s])][level_of(columns.spans[s].low)];
  }
  std::vector<float> floor(cells.count, Span{}.low);
  std::vector<std::size_t> whole(cells.count, 0);
  for (std::size_t cell = 0; cell < cells.count; ++cell) {
    for (const auto& [level, area] : levels[cell]) whole[cell] += area;
    const auto most = std::ranges::max_element(levels[cell], {}, [](const auto& l) { return l.second; });
    if (most != levels[cell].end()) floor[cell] = (static_cast<float>(most->first) + 1.0F) * kLevelStep;
  }
  std::vector<std::vector<std::uint32_t>> voids(cells.count);
  std::vector<float> level(cells.count, Span{}.low);
  for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
    if (cells.of_span[s] == kNoCell) continue;
    const auto cell = static_cast<std::size_t>(cells.of_span[s]);
    if (columns.spans[s].low < floor[cell] - kVoidDepth) voids[cell].push_back(s);
    // The floor's own level, better than the steps of the levels.
    else if (columns.spans[s].low < floor[cell])
      level[cell] = std::max(level[cell], columns.spans[s].low);
  }
  std::vector<ColumnCut> cuts;
  for (std::size_t cell = 0; cell < cells.count; ++cell) {
    float widest = 0.0F;
    for (const std::uint32_t s : voids[cell]) widest = std::max(widest, cells.clearance_m[s]);
    const bool small = static_cast<double>(voids[cell].size()) <= kSmallShare * static_cast<double>(whole[cell]);
    if (widest > kHalfStairs && !small) continue;
    for (const std::uint32_t s : voids[cell]) cuts.push_back({s, level[cell]});
  }
  return cuts;
}

}  // namespace clerestory::mesh
