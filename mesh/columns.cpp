// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/columns.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace clerestory::mesh {

namespace {

/// Below this height nobody stands [m].
constexpr double kHeadroom = 1.8;
/// Cells are as fine as this many columns allow, between these widths [m]; rays find the edges of rooms more precisely anyway.
constexpr double kEnoughColumns = 1.2e5;
constexpr double kFinestCell = 0.05;
constexpr double kCoarsestCell = 0.1;
/// More columns are never made, so that memory stays below some 300 MB: models over 140 m x 140 m get coarser cells.
constexpr double kMostColumns = 2e6;
/// The first look at a model, which tells where it has anything above anything [m].
constexpr double kCoarseCell = 1.0;
constexpr double kMostCoarse = 1e6;
/// Openings lower than this are no openings [m].
constexpr float kClosedGap = 0.1F;
/// Cells begin this far off the model's own lines, which would else fall on the border of two columns [cells].
constexpr double kOffLine = 0.3717;

struct Corner {
  double x, y, z;
};

/// A convex polygon that is being cut: a triangle cut by four lines has seven corners at most.
struct Piece {
  std::array<Corner, 8> corners;
  std::size_t count = 0;

  void add(const Corner& c) { corners[count++] = c; }
};

/// The part of a piece where sign · (coordinate - limit) ≥ 0.
template <double Corner::*Axis>
Piece cut(const Piece& piece, double limit, double sign) {
  Piece kept;
  for (std::size_t i = 0; i < piece.count; ++i) {
    const Corner& a = piece.corners[i];
    const Corner& b = piece.corners[(i + 1) % piece.count];
    const double da = sign * (a.*Axis - limit);
    const double db = sign * (b.*Axis - limit);
    if (da >= 0.0) kept.add(a);
    if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
      const double t = da / (da - db);
      Corner c{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
      c.*Axis = limit;
      kept.add(c);
    }
  }
  return kept;
}

template <double Corner::*Axis>
std::pair<double, double> extent(const Piece& piece) {
  double low = piece.corners[0].*Axis;
  double high = low;
  for (std::size_t i = 1; i < piece.count; ++i) {
    low = std::min(low, piece.corners[i].*Axis);
    high = std::max(high, piece.corners[i].*Axis);
  }
  return {low, high};
}

/// A stretch of a column that a surface fills.
struct Filled {
  std::uint32_t column;
  float low, high;
};

class Filling {
 public:
  explicit Filling(const Raster& raster) : raster_(raster) {}

  void add(const Piece& triangle) {
    const auto [first, last] = range<&Corner::y>(triangle, raster_.low_y, raster_.ny);
    Piece rest = triangle;
    for (std::uint32_t j = first; j < last && rest.count >= 3; ++j) {
      const double top = raster_.low_y + (j + 1) * raster_.cell_m;
      const Piece row = j == first ? cut<&Corner::y>(rest, top - raster_.cell_m, 1.0) : rest;
      add_row(cut<&Corner::y>(row, top, -1.0), j);
      rest = cut<&Corner::y>(row, top, 1.0);
    }
  }

  std::vector<Filled> take() { return std::move(filled_); }

 private:
  template <double Corner::*Axis>
  std::pair<std::uint32_t, std::uint32_t> range(const Piece& piece, double origin, std::uint32_t count) const {
    const auto [low, high] = extent<Axis>(piece);
    const auto index = [&](double x) {
      return std::clamp(std::floor((x - origin) / raster_.cell_m), -1.0, static_cast<double>(count));
    };
    const double first = std::max(0.0, index(low));
    const double last = std::min(static_cast<double>(count), index(high) + 1.0);
    if (last <= first) return {0, 0};
    return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last)};
  }

  void add_row(const Piece& row, std::uint32_t j) {
    if (row.count == 0) return;
    const auto [first, last] = range<&Corner::x>(row, raster_.low_x, raster_.nx);
    Piece rest = row;
    for (std::uint32_t i = first; i < last && rest.count > 0; ++i) {
      const double right = raster_.low_x + (i + 1) * raster_.cell_m;
      const Piece cell = i == first ? cut<&Corner::x>(rest, right - raster_.cell_m, 1.0) : rest;
      const Piece mine = cut<&Corner::x>(cell, right, -1.0);
      if (mine.count > 0) {
        const auto [low, high] = extent<&Corner::z>(mine);
        filled_.push_back({raster_.column(i, j), static_cast<float>(low), static_cast<float>(high)});
      }
      rest = cut<&Corner::x>(cell, right, 1.0);
    }
  }

  const Raster& raster_;
  std::vector<Filled> filled_;
};

Piece triangle_piece(const Triangulation& shape, const Triangle& t) {
  Piece piece;
  for (const std::uint32_t v : t.vertices) {
    const Point& p = shape.vertices[v];
    piece.add({p.x, p.y, p.z});
  }
  return piece;
}

/// Sorts by column, and by height within a column.
std::vector<Filled> sorted(const std::vector<Filled>& filled, std::size_t columns) {
  std::vector<std::uint32_t> next(columns + 1, 0);
  for (const Filled& f : filled) ++next[f.column + 1];
  for (std::size_t c = 0; c < columns; ++c) next[c + 1] += next[c];
  std::vector<Filled> result(filled.size());
  std::vector<std::uint32_t> begin = next;
  for (const Filled& f : filled) result[next[f.column]++] = f;
  for (std::size_t c = 0; c < columns; ++c) {
    std::sort(result.begin() + begin[c], result.begin() + begin[c + 1],
              [](const Filled& a, const Filled& b) { return a.low < b.low; });
  }
  return result;
}

/// Where the model has something at least a man's height above something else.
Box roofed_box(const Faces& faces, const Box& all) {
  const Vector size = all.size();
  const double cell = std::max(kCoarseCell, std::sqrt(size.x * size.y / kMostCoarse));
  Raster coarse{all.low.x, all.low.y, cell, static_cast<std::uint32_t>(size.x / cell) + 1,
                static_cast<std::uint32_t>(size.y / cell) + 1};
  std::vector<Box> content(coarse.count());
  for (const Triangle& t : faces.shape.triangles) {
    Box box;
    for (const std::uint32_t v : t.vertices) box.add(faces.shape.vertices[v]);
    const std::uint32_t low = *coarse.at(box.low.x, box.low.y);
    const std::uint32_t high = *coarse.at(box.high.x, box.high.y);
    for (std::uint32_t j = coarse.j(low); j <= coarse.j(high); ++j) {
      for (std::uint32_t i = coarse.i(low); i <= coarse.i(high); ++i) {
        content[coarse.column(i, j)].add(Point{0.0, 0.0, box.low.z});
        content[coarse.column(i, j)].add(Point{0.0, 0.0, box.high.z});
      }
    }
  }
  Box roofed;
  for (std::uint32_t c = 0; c < content.size(); ++c) {
    if (content[c].size().z < kHeadroom) continue;
    roofed.add(Point{coarse.x(c) - cell, coarse.y(c) - cell, all.low.z});
    roofed.add(Point{coarse.x(c) + cell, coarse.y(c) + cell, all.high.z});
  }
  return roofed;
}

}  // namespace

std::optional<std::uint32_t> Raster::at(double px, double py) const {
  const double fi = std::floor((px - low_x) / cell_m);
  const double fj = std::floor((py - low_y) / cell_m);
  if (!(fi >= 0.0 && fj >= 0.0 && fi < nx && fj < ny)) return std::nullopt;
  return column(static_cast<std::uint32_t>(fi), static_cast<std::uint32_t>(fj));
}

Raster room_raster(const Faces& faces) {
  Box all;
  for (const Point& p : faces.shape.vertices) all.add(p);
  if (all.empty()) return {};
  const Box box = roofed_box(faces, all);
  if (box.empty()) return {};
  const Vector size = box.size();
  const double wanted = std::clamp(std::sqrt(size.x * size.y / kEnoughColumns), kFinestCell, kCoarsestCell);
  const double cell = std::max(wanted, std::sqrt(size.x * size.y / kMostColumns));
  return {box.low.x - kOffLine * cell, box.low.y - kOffLine * cell, cell, static_cast<std::uint32_t>(size.x / cell) + 2,
          static_cast<std::uint32_t>(size.y / cell) + 2};
}

Columns free_columns(const Faces& faces, const Raster& raster) {
  Filling filling(raster);
  for (const Triangle& t : faces.shape.triangles) filling.add(triangle_piece(faces.shape, t));
  const std::vector<Filled> filled = sorted(filling.take(), raster.count());

  Columns columns{raster, {0}, {}};
  columns.starts.reserve(raster.count() + 1);
  auto next = filled.begin();
  for (std::uint32_t c = 0; c < raster.count(); ++c) {
    Span span{.column = c};
    for (; next != filled.end() && next->column == c; ++next) {
      if (next->low - span.low >= kClosedGap) {
        span.high = next->low;
        columns.spans.push_back(span);
        span.high = Span{}.high;
      }
      span.low = std::max(span.low, next->high);
    }
    columns.spans.push_back(span);
    columns.starts.push_back(static_cast<std::uint32_t>(columns.spans.size()));
  }
  return columns;
}

}  // namespace clerestory::mesh
