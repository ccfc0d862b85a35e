// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/faces.h"
#include "mesh/geometry.h"

namespace clerestory::mesh {

/// Square cells over the plan; a column stands on each.
struct Raster {
  double low_x = 0.0;
  double low_y = 0.0;
  double cell_m = 0.1;
  std::uint32_t nx = 0;
  std::uint32_t ny = 0;

  [[nodiscard]] std::size_t count() const { return std::size_t{nx} * ny; }
  [[nodiscard]] std::uint32_t column(std::uint32_t i, std::uint32_t j) const { return j * nx + i; }
  [[nodiscard]] std::uint32_t i(std::uint32_t column) const { return column % nx; }
  [[nodiscard]] std::uint32_t j(std::uint32_t column) const { return column / nx; }
  [[nodiscard]] double x(std::uint32_t column) const { return low_x + (i(column) + 0.5) * cell_m; }
  [[nodiscard]] double y(std::uint32_t column) const { return low_y + (j(column) + 0.5) * cell_m; }
  /// The column that a place lies in; none outside of the raster.
  [[nodiscard]] std::optional<std::uint32_t> at(double px, double py) const;
  /// The column so many cells away; none outside of the raster.
  [[nodiscard]] std::optional<std::uint32_t> beside(std::uint32_t column, int di, int dj) const {
    const std::int64_t in_row = di == 0 ? 0 : std::int64_t{i(column)} + di;
    const std::int64_t there = std::int64_t{column} + std::int64_t{dj} * nx;
    if (in_row < 0 || in_row >= nx || there < 0 || there >= static_cast<std::int64_t>(count())) return std::nullopt;
    return static_cast<std::uint32_t>(there + di);
  }
  /// Those at its four sides: -x, +x, -y, +y.
  [[nodiscard]] std::array<std::optional<std::uint32_t>, 4> four_beside(std::uint32_t column) const {
    const std::uint32_t in_row = i(column);
    const auto where = [](bool there, std::uint32_t c) { return there ? std::optional(c) : std::nullopt; };
    return {where(in_row > 0, column - 1), where(in_row + 1 < nx, column + 1), where(column >= nx, column - nx),
            where(column + nx < count(), column + nx)};
  }
  /// Visits each column with that at +x of it (axis 0), then with that at +y (axis 1).
  template <class Visit>
  void for_each_pair(const Visit& visit) const {
    for (std::uint32_t row = 0; row < ny; ++row) {
      for (std::uint32_t in_row = 0; in_row < nx; ++in_row) {
        const std::uint32_t c = column(in_row, row);
        if (in_row + 1 < nx) visit(c, c + 1, 0);
        if (row + 1 < ny) visit(c, c + nx, 1);
      }
    }
  }
};

/// A stretch of a column that no surface meets.
struct Span {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t column = 0;
  float low = -std::numeric_limits<float>::infinity();  ///< [m]; infinite where nothing lies below
  float high = std::numeric_limits<float>::infinity();  ///< [m]; infinite below the open sky
  bool cut = false;     ///< whether it goes on above without a surface between, in the next span of the column
  bool stairs = false;  ///< whether that is by a stairwell, which is no floor of what lies above

  [[nodiscard]] bool roofed() const { return low > -kFar && high < kFar; }
  [[nodiscard]] float height() const { return high - low; }

 private:
  static constexpr float kFar = std::numeric_limits<float>::max();
};

/// The free space of a model, column by column: the spans of column c are spans[starts[c]] … spans[starts[c+1]-1], from below.
struct Columns {
  Raster raster;
  std::vector<std::uint32_t> starts;
  std::vector<Span> spans;

  /// Numbers of the spans of a column.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> of(std::uint32_t column) const {
    return {starts[column], starts[column + 1]};
  }
};

/// The raster that rooms are looked for on: over all that has something 1.8 m or more above it, of 5 to 10 cm, coarser where a model is
/// so large that this would need too much memory.
Raster room_raster(const Faces& faces);

/// What triangles leave free. A surface fills the part of every column that it touches (so sheets without thickness are never
/// slipped through), and gaps lower than 10 cm are closed.
Columns free_columns(const Faces& faces, const Raster& raster);

/// Overlap of two spans [m]; negative when there is none.
inline float overlap_m(const Span& a, const Span& b) { return std::min(a.high, b.high) - std::max(a.low, b.low); }

/// Visits the spans of one column with those of another that they overlap, from below.
template <class Visit>
void for_each_overlap(const Columns& columns, std::uint32_t one, std::uint32_t other, const Visit& visit) {
  const auto [first, last] = columns.of(one);
  auto [next, end] = columns.of(other);
  for (std::uint32_t s = first; s < last; ++s) {
    const Span& span = columns.spans[s];
    while (next < end && columns.spans[next].high <= span.low) ++next;
    for (std::uint32_t t = next; t < end && columns.spans[t].low < span.high; ++t) visit(s, t);
  }
}

}  // namespace clerestory::mesh
