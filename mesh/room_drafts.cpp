// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/room_drafts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

#include "mesh/column_cuts.h"
#include "mesh/disjoint_sets.h"
#include "mesh/floor_finishes.h"
#include "mesh/portals.h"
#include "mesh/room_parts.h"
#include "mesh/wall_lines.h"

namespace clerestory::mesh {

namespace {

/// Openings from this width on are no doors: they join what they connect [m]. Below a lintel they have to be most of the wall as well,
/// as below a beam: what leaves more of it is a passage from one room to another.
constexpr double kWideOpening = 1.6;
constexpr double kMostOfWall = 2.0 / 3.0;
/// Share of its border over which a cell is open to another one that it is a part of: doorways, with a door on one side, have less.
constexpr double kMostOpen = 0.5;
/// Places are in a room as far as they are no more than this way [m] from one with this much space around it [m]: what comes after
/// is a slit.
constexpr float kCoreClearance = 0.2F;
constexpr double kSlitDepth = 1.0;

/// Cells of the divided columns: what was cut off below gets cells of its own, one for each that it was cut from.
RoomCells carried_over(const RoomCells& cells, const Columns& cut, const std::vector<std::uint32_t>& old_span) {
  RoomCells result;
  result.count = 2 * cells.count;
  for (std::uint32_t s = 0; s < cut.spans.size(); ++s) {
    const bool lower = s + 1 < cut.spans.size() && old_span[s] == old_span[s + 1];
    const CellId cell = cells.of_span[old_span[s]];
    const auto shift = lower ? static_cast<CellId>(cells.count) : 0;
    result.of_span.push_back(cell == kNoCell ? kNoCell : cell + shift);
    result.clearance_m.push_back(cells.clearance_m[old_span[s]]);
  }
  return result;
}

/// What makes a room of a cell.
struct Figures {
  double area_m2 = 0.0;  ///< where one can stand
  float clearance_m = 0.0F;
  Box plan;

  [[nodiscard]] bool is_room() const { return area_m2 >= kLeastRoom && clearance_m >= kLeastHalfWidth; }
};

std::vector<Figures> figures_of(const Columns& columns, const RoomCells& cells) {
  const double cell_area = columns.raster.cell_m * columns.raster.cell_m;
  std::vector<Figures> figures(cells.count);
  for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
    if (cells.of_span[s] == kNoCell || columns.spans[s].height() < kHeadroom) continue;
    Figures& mine = figures[static_cast<std::size_t>(cells.of_span[s])];
    mine.area_m2 += cell_area;
    mine.clearance_m = std::max(mine.clearance_m, cells.clearance_m[s]);
    const std::uint32_t column = columns.spans[s].column;
    mine.plan.add(Point{columns.raster.x(column), columns.raster.y(column), 0.0});
  }
  return figures;
}

/// The length of each cell's border, to walls and to other cells [m].
std::vector<double> borders_of(const Columns& columns, const RoomCells& cells) {
  std::vector<double> borders(cells.count, 0.0);
  for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
    if (cells.of_span[s] == kNoCell || columns.spans[s].height() < kHeadroom) continue;
    double& mine = borders[static_cast<std::size_t>(cells.of_span[s])];
    mine += 4.0 * columns.raster.cell_m;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const std::uint32_t t = beside_in_cell(columns, cells.of_span, s, axis);
      if (t != Span::kNone && columns.spans[t].height() >= kHeadroom) mine -= 2.0 * columns.raster.cell_m;
    }
  }
  return borders;
}

/// Whether an opening below a lintel is too wide for a door between two cells.
bool is_wide(const Portal& portal, const Figures& a, const Figures& b) {
  const Vector size = portal.box.size();
  const Vector wall_a = a.plan.size();
  const Vector wall_b = b.plan.size();
  const double wall = size.x > size.y ? std::min(wall_a.x, wall_b.x) : std::min(wall_a.y, wall_b.y);
  return portal.width_m >= std::max(kWideOpening, kMostOfWall * wall);
}

/// Cells that are no rooms themselves, such as what lies below a lintel or a beam, with their openings to rooms.
struct Doorway {
  CellId room = kNoCell;
  const Portal* opening = nullptr;
};
using Passages = std::map<CellId, std::vector<Doorway>>;

Passages passages_of(const std::vector<Portal>& portals, const std::vector<Figures>& figures) {
  const auto is_room = [&](CellId c) { return figures[static_cast<std::size_t>(c)].is_room(); };
  Passages passages;
  for (const Portal& p : portals) {
    if (is_room(p.a) && !is_room(p.b)) passages[p.b].push_back({p.a, &p});
    if (is_room(p.b) && !is_room(p.a)) passages[p.a].push_back({p.b, &p});
  }
  return passages;
}

void join_through(CellId passage, const std::vector<Doorway>& doorways, const std::vector<Figures>& figures,
                  DisjointSets<CellId>& joined) {
  const auto of = [&](CellId c) -> const Figures& { return figures[static_cast<std::size_t>(c)]; };
  for (const Doorway& one : doorways) {
    for (const Doorway& other : doorways) {
      if (other.room == one.room || !is_wide(*one.opening, of(one.room), of(other.room))) continue;
      if (!is_wide(*other.opening, of(one.room), of(other.room))) continue;
      joined.join(one.room, passage);
      joined.join(other.room, passage);
    }
  }
  // What is wide and does not join belongs to the smallest of the rooms that it leads from.
  std::vector<Doorway> wide;
  std::ranges::copy_if(doorways, std::back_inserter(wide),
                       [](const Doorway& d) { return d.opening->width_m >= kWideOpening; });
  if (wide.empty()) return;
  joined.join(std::ranges::min_element(wide, {}, [&](const Doorway& d) { return of(d.room).area_m2; })->room, passage);
}

void join_over_wide_openings(const Columns& columns, RoomCells& cells) {
  const auto figures = figures_of(columns, cells);
  const auto portals = find_portals(columns, cells.of_span, kHeadroom, static_cast<CellId>(cells.count));
  const auto borders = borders_of(columns, cells);
  const auto is_room = [&](CellId c) { return figures[static_cast<std::size_t>(c)].is_room(); };
  DisjointSets<CellId> joined(cells.count);
  for (const Portal& p : portals) {
    // Without a passage between them there is no lintel: one ceiling is just higher than the other.
    if (is_room(p.a) && is_room(p.b) && p.width_m >= kWideOpening) joined.join(p.a, p.b);
    // What has no walls on most of its border is a part of what it is open to: the shaft of a skylight, what is below a lamp.
    const double least = std::min(borders[static_cast<std::size_t>(p.a)], borders[static_cast<std::size_t>(p.b)]);
    if (p.border_m > kMostOpen * least) joined.join(p.a, p.b);
  }
  for (const auto& [passage, doorways] : passages_of(portals, figures)) {
    join_through(passage, doorways, figures, joined);
  }
  for (CellId& cell : cells.of_span) {
    if (cell != kNoCell) cell = joined.root(cell);
  }
}

/// Keeps what is large enough, and no flight of stairs: what lies in a stairwell alone leads from one room to another and is none.
void keep_rooms(const Columns& columns, RoomCells& cells) {
  const auto figures = figures_of(columns, cells);
  std::vector<std::size_t> spans(cells.count, 0);
  std::vector<std::size_t> in_stairwell(cells.count, 0);
  for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
    if (cells.of_span[s] == kNoCell) continue;
    ++spans[static_cast<std::size_t>(cells.of_span[s])];
    if (columns.spans[s].stairs) ++in_stairwell[static_cast<std::size_t>(cells.of_span[s])];
  }
  for (CellId& cell : cells.of_span) {
    if (cell == kNoCell) continue;
    const auto c = static_cast<std::size_t>(cell);
    if (!figures[c].is_room() || 2 * in_stairwell[c] > spans[c]) cell = kNoCell;
  }
}

/// Takes slits away from the rooms, such as the insides of walls that lack an end.
void cut_slits(const Columns& columns, RoomCells& cells) {
  const int most = static_cast<int>(kSlitDepth / columns.raster.cell_m);
  std::vector<std::uint32_t> reached;
  std::vector<int> way(columns.spans.size(), -1);
  for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
    if (cells.of_span[s] == kNoCell || cells.clearance_m[s] < kCoreClearance) continue;
    way[s] = 0;
    reached.push_back(s);
  }
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const std::uint32_t s = reached[next];
    if (way[s] >= most) continue;
    for (const auto& beside : columns.raster.four_beside(columns.spans[s].column)) {
      if (!beside) continue;
      for (std::uint32_t t = columns.of(*beside).first; t < columns.of(*beside).second; ++t) {
        if (way[t] >= 0 || cells.of_span[t] != cells.of_span[s]) continue;
        if (overlap_m(columns.spans[s], columns.spans[t]) <= 0.0F) continue;
        way[t] = way[s] + 1;
        reached.push_back(t);
      }
    }
  }
  for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
    if (way[s] < 0) cells.of_span[s] = kNoCell;
  }
}

/// What the border of a span towards a column is: inside of its room, towards another room, or open where more than half of its height
/// is free there.
enum class Border { kInside, kRoom, kOpen, kWall };

Border border(const RoomDrafts& drafts, std::uint32_t s, std::optional<std::uint32_t> column) {
  if (!column) return Border::kOpen;
  const Span& span = drafts.columns.spans[s];
  const auto [first, last] = drafts.columns.of(*column);
  Border found = Border::kWall;
  for (std::uint32_t t = first; t < last; ++t) {
    const float overlap = overlap_m(span, drafts.columns.spans[t]);
    if (overlap <= 0.0F) continue;
    if (drafts.of_span[t] == drafts.of_span[s]) return Border::kInside;
    if (overlap > 0.5F * span.height()) found = drafts.of_span[t] == kNoCell ? Border::kOpen : Border::kRoom;
  }
  return found;
}

void measure_enclosure(RoomDrafts& drafts) {
  std::vector<std::array<double, 2>> border_of(drafts.rooms.size());  // walls, open
  const Raster& raster = drafts.columns.raster;
  for (std::uint32_t s = 0; s < drafts.of_span.size(); ++s) {
    if (drafts.of_span[s] == kNoCell) continue;
    for (const auto& beside : raster.four_beside(drafts.columns.spans[s].column)) {
      const Border b = border(drafts, s, beside);
      if (b == Border::kOpen || b == Border::kWall)
        border_of[static_cast<std::size_t>(drafts.of_span[s])][b == Border::kOpen ? 1 : 0] += 1.0;
    }
  }
  for (std::size_t r = 0; r < drafts.rooms.size(); ++r) {
    const auto& [walls, open] = border_of[r];
    drafts.rooms[r].enclosed_share = walls + open > 0.0 ? walls / (walls + open) : 0.0;
  }
}

RoomCells divided(const Columns& columns, Columns& result) {
  const RoomCells cells = room_cells(columns, ceiling_links(columns));
  std::vector<std::uint32_t> old_span;
  result = cut_columns(columns, voids(columns, cells), old_span);
  return carried_over(cells, result, old_span);
}

}  // namespace

RoomDrafts draft_rooms(const Faces& faces) {
  const Columns free = free_columns(faces, room_raster(faces));
  std::vector<std::uint32_t> old_span;
  const Columns yards_cut = cut_columns(free, roofless_rooms(free), old_span);

  RoomDrafts drafts;
  RoomCells cells = divided(yards_cut, drafts.columns);
  join_over_wide_openings(drafts.columns, cells);
  keep_rooms(drafts.columns, cells);
  cut_slits(drafts.columns, cells);
  part_cells(drafts.columns, wall_lines(faces, drafts.columns, cells), cells);
  part_cells(drafts.columns, floor_finish_lines(faces, drafts.columns, cells), cells);

  std::map<CellId, CellId> number;
  for (const CellId cell : cells.of_span) {
    const auto next = static_cast<CellId>(number.size());
    drafts.of_span.push_back(cell == kNoCell ? kNoCell : number.try_emplace(cell, next).first->second);
  }
  drafts.rooms.resize(number.size());
  for (std::uint32_t s = 0; s < drafts.of_span.size(); ++s) {
    if (drafts.of_span[s] == kNoCell) continue;
    float& widest = drafts.rooms[static_cast<std::size_t>(drafts.of_span[s])].clearance_m;
    widest = std::max(widest, cells.clearance_m[s]);
  }
  measure_enclosure(drafts);
  return drafts;
}

}  // namespace clerestory::mesh
