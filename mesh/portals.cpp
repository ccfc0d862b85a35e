// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/portals.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

namespace clerestory::mesh {

namespace {

/// One column's width of a portal.
struct Strip {
  CellId a, b;
  int i, j;  ///< of the column with the lower number
  float low, high;
  bool taken = false;
};

/// Strips so many cells apart are of one opening: mullions are thin.
constexpr int kNear = 2;

void add_strips(const Columns& columns, const std::vector<CellId>& of_span, std::uint32_t c, std::uint32_t d,
                float least_overlap_m, CellId limit, std::vector<Strip>& strips) {
  for_each_overlap(columns, c, d, [&](std::uint32_t s, std::uint32_t t) {
    const CellId a = std::min(of_span[s], of_span[t]);
    const CellId b = std::max(of_span[s], of_span[t]);
    const Span& x = columns.spans[s];
    const Span& y = columns.spans[t];
    if (a == b || a == kNoCell || a >= limit || overlap_m(x, y) < least_overlap_m) return;
    strips.push_back({a, b, static_cast<int>(columns.raster.i(c)), static_cast<int>(columns.raster.j(c)),
                      std::max(x.low, y.low), std::min(x.high, y.high)});
  });
}

/// The strips of one portal, from a first one on.
class Opening {
 public:
  Opening(const Columns& columns, std::span<Strip> strips) : columns_(columns), strips_(strips) {}

  Portal grow(std::size_t start) {
    std::vector<std::size_t> mine{start};
    strips_[start].taken = true;
    for (std::size_t next = 0; next < mine.size(); ++next) {
      const Strip at = strips_[mine[next]];
      // Strips are sorted by row: those within reach lie in a window around this one.
      const auto first = std::ranges::lower_bound(strips_, at.j - kNear, {}, &Strip::j);
      for (auto it = first; it != strips_.end() && it->j <= at.j + kNear; ++it) {
        if (it->taken || std::abs(it->i - at.i) > kNear || it->low > at.high || it->high < at.low) continue;
        it->taken = true;
        mine.push_back(static_cast<std::size_t>(it - strips_.begin()));
      }
    }
    return measure(mine);
  }

 private:
  [[nodiscard]] Portal measure(const std::vector<std::size_t>& mine) const {
    const Raster& raster = columns_.raster;
    Portal portal;
    portal.a = strips_.front().a;
    portal.b = strips_.front().b;
    Box box;
    for (const std::size_t k : mine) {
      const Strip& s = strips_[k];
      const double x = raster.low_x + (s.i + 0.5) * raster.cell_m;
      const double y = raster.low_y + (s.j + 0.5) * raster.cell_m;
      box.add(Point{x, y, s.low});
      box.add(Point{x, y, s.high});
      portal.area_m2 += raster.cell_m * (s.high - s.low);
    }
    portal.box = box;
    portal.border_m = raster.cell_m * static_cast<double>(mine.size());
    portal.width_m = std::hypot(box.size().x, box.size().y) + raster.cell_m;
    // A slanted opening has strips along both axes.
    portal.area_m2 = std::min(portal.area_m2, portal.width_m * box.size().z);
    return portal;
  }

  const Columns& columns_;
  std::span<Strip> strips_;
};

}  // namespace

std::vector<Portal> find_portals(const Columns& columns, const std::vector<CellId>& of_span, float least_overlap_m,
                                 CellId limit) {
  std::vector<Strip> strips;
  columns.raster.for_each_pair([&](std::uint32_t c, std::uint32_t d, std::size_t) {
    add_strips(columns, of_span, c, d, least_overlap_m, limit, strips);
  });
  std::ranges::stable_sort(strips, {}, [](const Strip& s) { return std::tuple(s.a, s.b, s.j, s.i); });
  std::vector<Portal> portals;
  for (std::size_t first = 0; first < strips.size();) {
    std::size_t last = first;
    while (last < strips.size() && strips[last].a == strips[first].a && strips[last].b == strips[first].b) ++last;
    const std::span pair(strips.data() + first, last - first);
    Opening opening(columns, pair);
    for (std::size_t k = 0; k < pair.size(); ++k) {
      if (!pair[k].taken) portals.push_back(opening.grow(k));
    }
    first = last;
  }
  return portals;
}

}  // namespace clerestory::mesh
