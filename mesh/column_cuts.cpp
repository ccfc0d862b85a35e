// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/column_cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

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
constexpr float kFineStep = 0.02F;
/// Steps are at least this high [m].
constexpr float kStep = 0.1F;
/// So far below the floor of a cell there is no floor of it [m].
constexpr float kVoidDepth = 0.75F;
/// A void is a stairwell when nothing in it is farther than this from its edge [m]. Wider ones are cut when they are no more than this
/// share of their cell.
constexpr float kHalfStairs = 1.25F;
constexpr double kSmallShare = 0.3;

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

/// The floor that most of a cell stands on.
struct MainFloor {
  float level = Span{}.low;  ///< with what lies on it [m]
  float usual = Span{}.low;  ///< of most of it [m]
  std::size_t columns = 0;   ///< of the whole cell, where one can stand
};

/// The level of most of each cell's main floor, to a fine step.
void find_usual_levels(const Columns& columns, const RoomCells& cells, std::vector<MainFloor>& floors) {
  std::vector<std::map<int, std::size_t>> levels(cells.count);
  for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
    const float low = columns.spans[s].low;
    if (cells.of_span[s] == kNoCell || columns.spans[s].height() < kHeadroom) continue;
    const auto cell = static_cast<std::size_t>(cells.of_span[s]);
    if (std::abs(low - floors[cell].level) < kLevelStep) ++levels[cell][static_cast<int>(std::floor(low / kFineStep))];
  }
  for (std::size_t cell = 0; cell < cells.count; ++cell) {
    const auto most = std::ranges::max_element(levels[cell], {}, [](const auto& l) { return l.second; });
    if (most != levels[cell].end()) floors[cell].usual = kFineStep * static_cast<float>(most->first);
  }
}

std::vector<MainFloor> main_floors(const Columns& columns, const RoomCells& cells) {
  std::vector<std::map<int, std::size_t>> levels(cells.count);
  const auto step_of = [](float z) { return static_cast<int>(std::floor(z / kLevelStep)); };
  for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
    if (cells.of_span[s] == kNoCell || columns.spans[s].height() < kHeadroom) continue;
    ++levels[static_cast<std::size_t>(cells.of_span[s])][step_of(columns.spans[s].low)];
  }
  std::vector<MainFloor> floors(cells.count);
  std::vector<int> main(cells.count, std::numeric_limits<int>::min());
  for (std::size_t cell = 0; cell < cells.count; ++cell) {
    for (const auto& [step, count] : levels[cell]) floors[cell].columns += count;
    const auto most = std::ranges::max_element(levels[cell], {}, [](const auto& l) { return l.second; });
    if (most != levels[cell].end()) main[cell] = most->first;
  }
  for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
    if (cells.of_span[s] == kNoCell) continue;
    const auto cell = static_cast<std::size_t>(cells.of_span[s]);
    if (step_of(columns.spans[s].low) == main[cell])
      floors[cell].level = std::max(floors[cell].level, columns.spans[s].low);
  }
  find_usual_levels(columns, cells, floors);
  return floors;
}

/// Adds the steps that lead down into a stairwell.
void add_steps(const Columns& columns, const RoomCells& cells, float floor, std::vector<std::uint32_t>& stairwell) {
  std::set<std::uint32_t> known(stairwell.begin(), stairwell.end());
  for (std::size_t next = 0; next < stairwell.size(); ++next) {
    const std::uint32_t s = stairwell[next];
    for (const auto& beside : columns.raster.four_beside(columns.spans[s].column)) {
      if (!beside) continue;
      for (std::uint32_t t = columns.of(*beside).first; t < columns.of(*beside).second; ++t) {
        if (cells.of_span[t] != cells.of_span[s] || columns.spans[t].low > floor - kStep) continue;
        if (known.insert(t).second) stairwell.push_back(t);
      }
    }
  }
}

/// How far the innermost of some spans of a cell lies from the edge of them all [m], in steps along the raster.
float depth_of(const Columns& columns, const std::vector<std::uint32_t>& spans) {
  std::map<std::uint32_t, int> depth;  // by column
  for (const std::uint32_t s : spans) depth[columns.spans[s].column] = 0;
  std::vector<std::uint32_t> layer;
  const auto at_edge = [&](std::uint32_t column) {
    return std::ranges::any_of(columns.raster.four_beside(column),
                               [&](const auto& beside) { return !beside || !depth.contains(*beside); });
  };
  for (auto& [column, d] : depth) {
    if (!at_edge(column)) continue;
    d = 1;
    layer.push_back(column);
  }
  int deepest = 1;
  for (std::size_t next = 0; next < layer.size(); ++next) {
    const int here = depth[layer[next]];
    deepest = std::max(deepest, here);
    for (const auto& beside : columns.raster.four_beside(layer[next])) {
      const auto known = beside ? depth.find(*beside) : depth.end();
      if (known == depth.end() || known->second != 0) continue;
      known->second = here + 1;
      layer.push_back(*beside);
    }
  }
  return (static_cast<float>(deepest) - 0.5F) * static_cast<float>(columns.raster.cell_m);
}

}  // namespace

Columns cut_columns(const Columns& columns, const std::vector<ColumnCut>& cuts, std::vector<std::uint32_t>& old_span) {
  constexpr std::uint32_t kNoCut = Span::kNone;
  std::vector<std::uint32_t> cut_of(columns.spans.size(), kNoCut);
  for (std::uint32_t k = 0; k < cuts.size(); ++k) cut_of[cuts[k].span] = k;
  Columns result{columns.raster, {0}, {}};
  old_span.clear();
  for (std::uint32_t c = 0; c < columns.raster.count(); ++c) {
    const auto [first, last] = columns.of(c);
    for (std::uint32_t s = first; s < last; ++s) {
      Span span = columns.spans[s];
      if (cut_of[s] != kNoCut && cuts[cut_of[s]].at > span.low && cuts[cut_of[s]].at < span.high) {
        const ColumnCut& cut = cuts[cut_of[s]];
        result.spans.push_back({c, span.low, cut.at, true, cut.stairs});
        old_span.push_back(s);
        span.low = cut.at;
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

std::vector<ColumnCut> voids(const Columns& columns, const RoomCells& cells) {
  const auto floors = main_floors(columns, cells);
  std::vector<std::vector<std::uint32_t>> below(cells.count);
  for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
    if (cells.of_span[s] == kNoCell) continue;
    const auto cell = static_cast<std::size_t>(cells.of_span[s]);
    if (columns.spans[s].low < floors[cell].level - kVoidDepth) below[cell].push_back(s);
  }
  std::vector<ColumnCut> cuts;
  for (std::size_t cell = 0; cell < cells.count; ++cell) {
    if (below[cell].empty()) continue;
    const bool stairs = depth_of(columns, below[cell]) <= kHalfStairs;
    const bool small =
        static_cast<double>(below[cell].size()) <= kSmallShare * static_cast<double>(floors[cell].columns);
    if (!stairs && !small) continue;
    if (stairs) add_steps(columns, cells, floors[cell].usual, below[cell]);
    for (const std::uint32_t s : below[cell]) cuts.push_back({s, floors[cell].level, stairs});
  }
  return cuts;
}

}  // namespace clerestory::mesh
