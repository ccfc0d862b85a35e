// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/wall_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "mesh/regions.h"

namespace clerestory::mesh {

namespace {

/// Faces steeper than this are walls [cosine to the vertical].
constexpr double kUpright = 0.1;
/// Walls of a direction are worth a look from this share of all walls on.
constexpr double kManyWalls = 0.1;
constexpr std::size_t kAngles = 90;  ///< directions are told apart to a degree, up to a right angle
/// A stub of a wall is at least this long, and no thicker than that [m].
constexpr double kStub = 0.3;
constexpr double kThickWall = 0.6;
/// Openings narrower than this are gaps [m].
constexpr double kLeastOpening = 0.5;

struct Direction {
  double x = 1.0;
  double y = 0.0;
};

/// The directions in which walls stand, each with that across it.
std::vector<Direction> wall_directions(const Faces& faces) {
  struct Bin {
    double area = 0.0, cosine = 0.0, sine = 0.0;
  };
  std::array<Bin, kAngles> bins;
  double all = 0.0;
  for (std::size_t f = 0; f < faces.count(); ++f) {
    const Vector& w = faces.faces[f].frame.w;
    if (std::abs(w.z) > kUpright) continue;
    const double angle = 4.0 * std::atan2(w.y, w.x);  // a right angle is a full turn
    const double turn = angle / (2.0 * std::numbers::pi);
    Bin& bin = bins[static_cast<std::size_t>((turn - std::floor(turn)) * kAngles + 0.5) % kAngles];
    const double area = faces.faces[f].area_m2;
    bin.area += area;
    bin.cosine += area * std::cos(angle);
    bin.sine += area * std::sin(angle);
    all += area;
  }
  std::vector<Direction> directions;
  for (const Bin& bin : bins) {
    if (bin.area < kManyWalls * all || bin.area <= 0.0) continue;
    const double angle = 0.25 * std::atan2(bin.sine, bin.cosine);
    directions.push_back({std::cos(angle), std::sin(angle)});
    directions.push_back({-std::sin(angle), std::cos(angle)});
  }
  return directions;
}

struct Spot {
  double x = 0.0;
  double y = 0.0;
};

/// An opening on one line of the sweep.
struct Chord {
  double from = 0.0, to = 0.0;  ///< along the line [m]
  double across = 0.0;          ///< of the line [m]
};

/// Looks through one cell, line by line.
class Sweep {
 public:
  Sweep(const Columns& columns, const std::vector<CellId>& of_span, CellId cell, const Direction& along)
      : columns_(columns), of_span_(of_span), cell_(cell), along_(along) {}

  std::vector<Chord> openings(const std::vector<std::uint32_t>& spans) {
    double low_a = 1e300, high_a = -1e300, low_n = 1e300, high_n = -1e300;
    for (const std::uint32_t s : spans) {
      const double x = columns_.raster.x(columns_.spans[s].column);
      const double y = columns_.raster.y(columns_.spans[s].column);
      low_a = std::min(low_a, along_.x * x + along_.y * y);
      high_a = std::max(high_a, along_.x * x + along_.y * y);
      low_n = std::min(low_n, along_.x * y - along_.y * x);
      high_n = std::max(high_n, along_.x * y - along_.y * x);
    }
    for (double n = low_n; n <= high_n; n += step()) look_along(n, low_a, high_a);
    return middles();
  }

  [[nodiscard]] Spot spot(double a, double n) const {
    return {along_.x * a - along_.y * n, along_.x * n + along_.y * a};
  }

 private:
  [[nodiscard]] double step() const { return 0.5 * columns_.raster.cell_m; }

  [[nodiscard]] bool inside(double a, double n) const {
    const Spot p = spot(a, n);
    const auto column = columns_.raster.at(p.x, p.y);
    if (!column) return false;
    for (std::uint32_t s = columns_.of(*column).first; s < columns_.of(*column).second; ++s) {
      if (of_span_[s] == cell_) return true;
    }
    return false;
  }

  void look_along(double n, double low, double high) {
    double from = low;
    bool was = true;  // what begins at the border of the cell begins at no wall end
    for (double a = low; a <= high + step(); a += step()) {
      const bool is = inside(a, n);
      if (is && !was) from = a;
      if (!is && was && a - from >= kLeastOpening && is_wall_end(from, n, -1.0) && is_wall_end(a, n, 1.0)) {
        chords_.push_back({from, a, n});
      }
      was = is;
    }
  }

  /// Whether there is a wall from a place on, with the cell on both sides of it.
  [[nodiscard]] bool is_wall_end(double a, double n, double sign) const {
    for (double way = 2.0 * step(); way <= kStub; way += step()) {
      const double at = a + sign * way;
      if (inside(at, n)) return false;
      if (thickness(at, n, 1.0) + thickness(at, n, -1.0) > kThickWall) return false;
    }
    return true;
  }

  [[nodiscard]] double thickness(double a, double n, double sign) const {
    double way = step();
    while (way <= kThickWall && !inside(a, n + sign * way)) way += step();
    return way;
  }

  /// One chord for each opening, in the middle of the wall's thickness.
  [[nodiscard]] std::vector<Chord> middles() const {
    std::vector<Chord> result;
    std::vector<bool> taken(chords_.size(), false);
    for (std::size_t i = 0; i < chords_.size(); ++i) {
      if (taken[i]) continue;
      std::vector<std::size_t> stack{i};
      for (std::size_t j = i + 1; j < chords_.size(); ++j) {
        const Chord& last = chords_[stack.back()];
        const Chord& next = chords_[j];
        if (next.across - last.across > 1.5 * step()) break;
        const double common = std::min(last.to, next.to) - std::max(last.from, next.from);
        if (taken[j] || next.across == last.across || common < 0.5 * (last.to - last.from)) continue;
        taken[j] = true;
        stack.push_back(j);
      }
      result.push_back(chords_[stack[stack.size() / 2]]);
    }
    return result;
  }

  const Columns& columns_;
  const std::vector<CellId>& of_span_;
  CellId cell_;
  Direction along_;
  std::vector<Chord> chords_;
};

double side(const Spot& a, const Spot& b, const Spot& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

bool crosses(const Spot& a, const Spot& b, const Spot& p, const Spot& q) {
  return (side(a, b, p) >= 0.0) != (side(a, b, q) >= 0.0) && (side(p, q, a) >= 0.0) != (side(p, q, b) >= 0.0);
}

/// Marks where the way from one span to the next leads over a line.
void draw(const Columns& columns, const std::vector<std::uint32_t>& spans, const Spot& a, const Spot& b,
          PartingLines& lines) {
  const double cell = columns.raster.cell_m;
  for (const std::uint32_t s : spans) {
    const Spot at{columns.raster.x(columns.spans[s].column), columns.raster.y(columns.spans[s].column)};
    if (at.x < std::min(a.x, b.x) - cell || at.x > std::max(a.x, b.x) + cell) continue;
    if (at.y < std::min(a.y, b.y) - cell || at.y > std::max(a.y, b.y) + cell) continue;
    if (crosses(a, b, at, {at.x + cell, at.y})) lines.open[s] |= 1U;
    if (crosses(a, b, at, {at.x, at.y + cell})) lines.open[s] |= 2U;
  }
}

}  // namespace

PartingLines wall_lines(const Faces& faces, const Columns& columns, const RoomCells& cells) {
  std::vector<std::vector<std::uint32_t>> spans_of(cells.count);
  for (std::uint32_t s = 0; s < cells.of_span.size(); ++s) {
    if (cells.of_span[s] != kNoCell) spans_of[static_cast<std::size_t>(cells.of_span[s])].push_back(s);
  }
  PartingLines lines(cells.of_span.size());
  const double overhang = columns.raster.cell_m;  // into the walls at either end
  const auto directions = wall_directions(faces);
  for (std::size_t cell = 0; cell < spans_of.size(); ++cell) {
    if (spans_of[cell].empty()) continue;
    for (const Direction& along : directions) {
      Sweep sweep(columns, cells.of_span, static_cast<CellId>(cell), along);
      for (const Chord& c : sweep.openings(spans_of[cell])) {
        draw(columns, spans_of[cell], sweep.spot(c.from - overhang, c.across), sweep.spot(c.to + overhang, c.across),
             lines);
      }
    }
  }
  return lines;
}

}  // namespace clerestory::mesh
