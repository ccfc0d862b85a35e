// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/room_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace clerestory::mesh {

namespace {

using Links = std::vector<std::array<std::uint32_t, 4>>;

/// Tops of neighbours that differ by less than this, and a steep roof's rise over a cell, are one ceiling: lintels are higher [m].
constexpr float kBeam = 0.15F;
/// Half of the width from which an opening as high as the room is no door any more [m].
constexpr float kHalfDoor = 0.6F;
/// A neck is no narrower than what it joins, from this share on.
constexpr float kSameWidth = 0.75F;

/// The direction back.
constexpr std::size_t reverse(std::size_t direction) { return direction ^ 1U; }

/// Links each span to the one with the nearest top in the column on the positive side, one to one.
void link_columns(const Columns& columns, std::uint32_t a, std::uint32_t b, std::size_t direction, Links& links) {
  const float most = kBeam + static_cast<float>(columns.raster.cell_m);
  const auto step = [&](std::uint32_t s, std::uint32_t t) {
    return std::abs(columns.spans[s].high - columns.spans[t].high);
  };
  for_each_overlap(columns, a, b, [&](std::uint32_t s, std::uint32_t t) {
    if (!columns.spans[s].roofed() || !columns.spans[t].roofed() || step(s, t) > most) return;
    std::uint32_t& forth = links[s][direction];
    std::uint32_t& back = links[t][reverse(direction)];
    if (forth != Span::kNone && step(s, forth) <= step(s, t)) return;
    if (back != Span::kNone && step(back, t) <= step(s, t)) return;
    if (forth != Span::kNone) links[forth][reverse(direction)] = Span::kNone;
    if (back != Span::kNone) links[back][direction] = Span::kNone;
    forth = t;
    back = s;
  });
}

/// Offset from a span to the nearest wall [cells].
struct Offset {
  std::int16_t i = 0;
  std::int16_t j = 0;

  [[nodiscard]] int squared() const { return i * i + j * j; }
};

constexpr Offset kFarAway{10'000, 10'000};
constexpr std::array<Offset, 4> kSteps{Offset{-1, 0}, Offset{1, 0}, Offset{0, -1}, Offset{0, 1}};

/// The spans around one: the four linked ones, then those across the corners.
std::array<std::uint32_t, 8> around(const Links& links, std::uint32_t s) {
  std::array<std::uint32_t, 8> found;
  found.fill(Span::kNone);
  for (std::size_t d = 0; d < 4; ++d) found[d] = links[s][d];
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t dx = k & 1U;
    const std::size_t dy = 2 + (k >> 1U);
    std::uint32_t& corner = found[4 + k];
    if (links[s][dx] != Span::kNone) corner = links[links[s][dx]][dy];
    if (corner == Span::kNone && links[s][dy] != Span::kNone) corner = links[links[s][dy]][dx];
  }
  return found;
}

/// Distance to the nearest column that is no part of the plan, by propagating its offset in sweeps of the raster to and fro.
/// Source: [Danielsson 1980].
class Clearance {
 public:
  Clearance(const Columns& columns, const Links& links)
      : columns_(columns), links_(links), offset_(links.size(), kFarAway) {}

  std::vector<float> compute() {
    const auto count = static_cast<std::uint32_t>(offset_.size());
    for (std::uint32_t s = 0; s < count; ++s) {
      if (columns_.spans[s].roofed()) start(s);
    }
    constexpr int kSweeps = 2;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (std::uint32_t s = 0; s < count; ++s) relax(s);
      for (std::uint32_t s = count; s-- > 0;) relax(s);
    }
    std::vector<float> distance(count, 0.0F);
    for (std::uint32_t s = 0; s < count; ++s) {
      if (!columns_.spans[s].roofed()) continue;
      distance[s] = static_cast<float>(columns_.raster.cell_m) * std::sqrt(static_cast<float>(offset_[s].squared()));
    }
    return distance;
  }

 private:
  void start(std::uint32_t s) {
    const auto near = around(links_, s);
    for (std::size_t d = 0; d < 4; ++d) {
      if (near[d] == Span::kNone) offset_[s] = kSteps[d];
    }
    if (offset_[s].squared() <= 1) return;
    for (std::size_t k = 0; k < 4; ++k) {
      if (near[4 + k] != Span::kNone) continue;
      offset_[s] = {kSteps[k & 1U].i, kSteps[2 + (k >> 1U)].j};
    }
  }

  void relax(std::uint32_t s) {
    for (std::size_t d = 0; d < 4; ++d) {
      const std::uint32_t t = links_[s][d];
      if (t == Span::kNone) continue;
      const Offset& o = offset_[t];
      const Offset mine{static_cast<std::int16_t>(o.i + kSteps[d].i), static_cast<std::int16_t>(o.j + kSteps[d].j)};
      if (mine.squared() < offset_[s].squared()) offset_[s] = mine;
    }
  }

  const Columns& columns_;
  const Links& links_;
  std::vector<Offset> offset_;
};

/// Basins that grow from the places with the most room around them.
class Watershed {
 public:
  Watershed(const Links& links, const std::vector<float>& clearance, float cell_m)
      : links_(links), clearance_(clearance), cell_m_(cell_m), basin_(links.size(), Span::kNone) {}

  void flood(const std::vector<std::uint32_t>& order) {
    for (const std::uint32_t s : order) add(s);
  }

  [[nodiscard]] std::uint32_t root(std::uint32_t basin) {
    while (parent_[basin] != basin) basin = parent_[basin] = parent_[parent_[basin]];
    return basin;
  }
  [[nodiscard]] std::uint32_t basin_of(std::uint32_t s) { return root(basin_[s]); }
  [[nodiscard]] std::size_t count() const { return peak_.size(); }

 private:
  void add(std::uint32_t s) {
    std::uint32_t best = Span::kNone;
    const auto near = around(links_, s);
    for (const std::uint32_t t : near) {
      if (t == Span::kNone || basin_[t] == Span::kNone) continue;
      const std::uint32_t r = basin_of(t);
      if (best == Span::kNone || peak_[r] > peak_[best]) best = r;
    }
    if (best == Span::kNone) {
      best = static_cast<std::uint32_t>(peak_.size());
      peak_.push_back(clearance_[s]);
      parent_.push_back(best);
    }
    basin_[s] = best;
    for (const std::uint32_t t : near) {
      if (t != Span::kNone && basin_[t] != Span::kNone) meet(best, basin_of(t), clearance_[s]);
    }
  }

  void meet(std::uint32_t a, std::uint32_t b, float neck) {
    a = root(a);
    if (a == b) return;
    if (peak_[a] < peak_[b]) std::swap(a, b);
    const bool noise = peak_[b] - neck <= 1.01F * cell_m_;
    if (neck >= kHalfDoor || neck >= kSameWidth * peak_[b] || noise) parent_[b] = a;
  }

  const Links& links_;
  const std::vector<float>& clearance_;
  float cell_m_;
  std::vector<std::uint32_t> basin_;
  std::vector<std::uint32_t> parent_;
  std::vector<float> peak_;
};

}  // namespace

Links ceiling_links(const Columns& columns) {
  Links links(columns.spans.size());
  for (auto& l : links) l.fill(Span::kNone);
  columns.raster.for_each_pair([&](std::uint32_t c, std::uint32_t d, std::size_t axis) {
    link_columns(columns, c, d, axis == 0 ? 1 : 3, links);
  });
  return links;
}

RoomCells room_cells(const Columns& columns, const Links& links) {
  RoomCells cells;
  cells.clearance_m = Clearance(columns, links).compute();
  cells.of_span.assign(columns.spans.size(), kNoCell);
  std::vector<std::uint32_t> order;
  for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
    if (columns.spans[s].roofed()) order.push_back(s);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return cells.clearance_m[a] > cells.clearance_m[b]; });
  Watershed watershed(links, cells.clearance_m, static_cast<float>(columns.raster.cell_m));
  watershed.flood(order);

  std::vector<CellId> number(watershed.count(), kNoCell);
  for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
    if (!columns.spans[s].roofed()) continue;
    CellId& mine = number[watershed.basin_of(s)];
    if (mine == kNoCell) mine = static_cast<CellId>(cells.count++);
    cells.of_span[s] = mine;
  }
  return cells;
}

}  // namespace clerestory::mesh
