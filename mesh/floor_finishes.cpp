// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/floor_finishes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "mesh/regions.h"

namespace clerestory::mesh {

namespace {

/// Floors are flatter than this [cosine of 30 degrees].
constexpr double kLevelCosine = 0.866;
/// Coverings of one floor lie within this of each other [m].
constexpr float kCovering = 0.06F;
/// Levels are told to this [m].
constexpr float kLevelStep = 0.02F;
/// What stands on a floor is higher than this [m].
constexpr float kFurniture = 0.3F;
/// Counters and low walls are at least this high, tables are not [m].
constexpr float kCounterHeight = 0.8F;
/// … and no deeper than this, with what stands before it [m].
constexpr double kDeepest = 0.9;
/// A counter stands along a line when it is this near to it [m].
constexpr double kAlong = 0.15;

constexpr std::uint32_t kNoFinish = std::numeric_limits<std::uint32_t>::max();

/// The level at which most of each cell's floor lies [m].
std::vector<float> floor_levels(const Columns& columns, const RoomCells& cells) {
  std::vector<std::map<int, std::size_t>> levels(cells.count);
  for (std::uint32_t s = 0; s < cells.of_span.size(); ++s) {
    if (cells.of_span[s] == kNoCell || columns.spans[s].height() < kHeadroom) continue;
    ++levels[static_cast<std::size_t>(cells.of_span[s])]
            [static_cast<int>(std::floor(columns.spans[s].low / kLevelStep))];
  }
  std::vector<float> result;
  for (const auto& of_cell : levels) {
    const auto most = std::ranges::max_element(of_cell, {}, [](const auto& l) { return l.second; });
    result.push_back(most == of_cell.end() ? 0.0F : (static_cast<float>(most->first) + 0.5F) * kLevelStep);
  }
  return result;
}

/// Height of a triangle at a place of the plan; none outside of it.
std::optional<double> height_at(const std::array<Point, 3>& t, double x, double y) {
  const double whole = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
  const double b = ((x - t[0].x) * (t[2].y - t[0].y) - (y - t[0].y) * (t[2].x - t[0].x)) / whole;
  const double c = ((t[1].x - t[0].x) * (y - t[0].y) - (t[1].y - t[0].y) * (x - t[0].x)) / whole;
  if (!(b >= 0.0 && c >= 0.0 && b + c <= 1.0)) return std::nullopt;
  return t[0].z + b * (t[1].z - t[0].z) + c * (t[2].z - t[0].z);
}

/// The material of the floor that each span stands over.
class Finishes {
 public:
  Finishes(const Faces& faces, const Columns& columns, const RoomCells& cells)
      : columns_(columns),
        cells_(cells),
        levels_(floor_levels(columns, cells)),
        finish_(columns.spans.size(), kNoFinish),
        top_(columns.spans.size(), -std::numeric_limits<double>::infinity()) {
    for (std::size_t f = 0; f < faces.count(); ++f) {
      const Face& face = faces.faces[f];
      if (std::abs(face.frame.w.z) < kLevelCosine) continue;
      const MaterialId finish = face.material_of(face.frame.w.z > 0.0 ? Side::kFront : Side::kBack);
      for (std::uint32_t t = faces.shape.starts[f]; t < faces.shape.starts[f + 1]; ++t) {
        add(corners(faces, t), finish.value);
      }
    }
  }

  PartingLines lines() const {
    PartingLines result(finish_.size());
    result.label = finish_;
    result.furnished.assign(finish_.size(), 0);
    for (std::uint32_t s = 0; s < finish_.size(); ++s) {
      if (cells_.of_span[s] == kNoCell) continue;
      result.furnished[s] = columns_.spans[s].low > level(s) + kFurniture ? 1 : 0;
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const std::uint32_t t = beside_in_cell(columns_, cells_.of_span, s, axis);
        if (t == Span::kNone || finish_[s] == finish_[t] || finish_[s] == kNoFinish || finish_[t] == kNoFinish)
          continue;
        const int di = axis == 0 ? 1 : 0;
        const bool shut = is_shut(s, -di, di - 1) || is_shut(t, di, 1 - di);
        (shut ? result.shut : result.open)[s] |= static_cast<std::uint8_t>(1U << axis);
      }
    }
    return result;
  }

 private:
  [[nodiscard]] float level(std::uint32_t s) const { return levels_[static_cast<std::size_t>(cells_.of_span[s])]; }

  void add(const std::array<Point, 3>& triangle, std::uint32_t material) {
    const Raster& raster = columns_.raster;
    Box box;
    for (const Point& p : triangle) box.add(p);
    const auto first = [&](double x, double low) { return std::max(0.0, std::floor((x - low) / raster.cell_m)); };
    for (double j = first(box.low.y, raster.low_y); j < raster.ny && raster.low_y + j * raster.cell_m <= box.high.y;
         ++j) {
      for (double i = first(box.low.x, raster.low_x); i < raster.nx && raster.low_x + i * raster.cell_m <= box.high.x;
           ++i) {
        const std::uint32_t column = raster.column(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
        const auto z = height_at(triangle, raster.x(column), raster.y(column));
        if (z) lay(column, *z, material);
      }
    }
  }

  void lay(std::uint32_t column, double z, std::uint32_t material) {
    for (std::uint32_t s = columns_.of(column).first; s < columns_.of(column).second; ++s) {
      if (cells_.of_span[s] == kNoCell || std::abs(z - level(s)) > kCovering || z <= top_[s]) continue;
      top_[s] = z;
      finish_[s] = material;
    }
  }

  enum class Stands { kNothing, kCounter, kWall };

  [[nodiscard]] Stands stands(std::optional<std::uint32_t> column, std::uint32_t s) const {
    if (!column) return Stands::kWall;
    Stands found = Stands::kWall;
    for (std::uint32_t t = columns_.of(*column).first; t < columns_.of(*column).second; ++t) {
      if (cells_.of_span[t] != cells_.of_span[s]) continue;
      if (columns_.spans[t].low < level(s) + kCounterHeight) return Stands::kNothing;
      found = Stands::kCounter;
    }
    return found;
  }

  /// Whether a counter or a wall stands at a span or a little farther in a direction: what is wide is a platform.
  [[nodiscard]] bool is_shut(std::uint32_t s, int di, int dj) const {
    const int last_start = static_cast<int>(kAlong / columns_.raster.cell_m);
    const int most = static_cast<int>(kDeepest / columns_.raster.cell_m);
    bool counter = false;
    for (int k = 0; k <= (counter ? most : last_start); ++k) {
      const Stands here = stands(columns_.raster.beside(columns_.spans[s].column, k * di, k * dj), s);
      if (here == Stands::kWall || (counter && here == Stands::kNothing)) return true;
      counter = here == Stands::kCounter;
    }
    return false;
  }

  const Columns& columns_;
  const RoomCells& cells_;
  std::vector<float> levels_;
  std::vector<std::uint32_t> finish_;  ///< [spans] material, or kNoFinish
  std::vector<double> top_;            ///< [spans] of the floor [m]
};

}  // namespace

PartingLines floor_finish_lines(const Faces& faces, const Columns& columns, const RoomCells& cells) {
  return Finishes(faces, columns, cells).lines();
}

}  // namespace clerestory::mesh
