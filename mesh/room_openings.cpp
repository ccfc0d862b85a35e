// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/room_openings.h"

#include <algorithm>
#include <map>
#include <set>

#include "mesh/disjoint_sets.h"
#include "mesh/portals.h"
#include "mesh/regions.h"

namespace clerestory::mesh {

namespace {

/// Spans that overlap by less than this do not go on into each other [m].
constexpr float kLeastOverlap = 0.1F;
/// Holes smaller than this are gaps [m²].
constexpr double kLeastHole = 0.03;

/// Pieces of the free space that are no room, joined where they go on into each other, the open sky among them.
class Remainder {
 public:
  Remainder(const Columns& columns, const std::vector<CellId>& room_of_span, std::size_t room_count)
      : columns_(columns), room_of_span_(room_of_span), joined_(columns.spans.size() + 1) {
    join_all();
    number_from(room_count);
  }

  /// [spans] the room, or the number of the piece; the outside has the first number after the rooms.
  [[nodiscard]] const std::vector<CellId>& numbers() const { return numbers_; }
  [[nodiscard]] CellId count() const { return count_; }

 private:
  [[nodiscard]] std::uint32_t outside() const { return static_cast<std::uint32_t>(columns_.spans.size()); }

  void join_columns(std::uint32_t c, std::uint32_t d) {
    for_each_overlap(columns_, c, d, [&](std::uint32_t s, std::uint32_t t) {
      if (room_of_span_[s] != kNoCell || room_of_span_[t] != kNoCell) return;
      if (overlap_m(columns_.spans[s], columns_.spans[t]) >= kLeastOverlap) joined_.join(s, t);
    });
  }

  void join_all() {
    const Raster& raster = columns_.raster;
    for (std::uint32_t s = 0; s < columns_.spans.size(); ++s) {
      const Span& span = columns_.spans[s];
      if (room_of_span_[s] != kNoCell) continue;
      const std::uint32_t i = raster.i(span.column);
      const std::uint32_t j = raster.j(span.column);
      const bool at_border = i == 0 || j == 0 || i + 1 == raster.nx || j + 1 == raster.ny;
      if (!span.roofed() || at_border) joined_.join(s, outside());
      if (span.cut && room_of_span_[s + 1] == kNoCell) joined_.join(s, s + 1);
    }
    raster.for_each_pair([&](std::uint32_t c, std::uint32_t d, std::size_t) { join_columns(c, d); });
  }

  void number_from(std::size_t room_count) {
    std::map<std::uint32_t, CellId> number;
    count_ = static_cast<CellId>(room_count);
    number[joined_.root(outside())] = count_++;
    for (std::uint32_t s = 0; s < columns_.spans.size(); ++s) {
      if (room_of_span_[s] != kNoCell) {
        numbers_.push_back(room_of_span_[s]);
        continue;
      }
      const auto [entry, added] = number.try_emplace(joined_.root(s), count_);
      if (added) ++count_;
      numbers_.push_back(entry->second);
    }
  }

  const Columns& columns_;
  const std::vector<CellId>& room_of_span_;
  DisjointSets<std::uint32_t> joined_;
  std::vector<CellId> numbers_;
  CellId count_ = 0;
};

/// The portals of a piece that is no room, by the rooms that they lead from.
using PortalsOfPiece = std::map<CellId, std::vector<const Portal*>>;

double area_of(const std::vector<const Portal*>& portals) {
  double sum = 0.0;
  for (const Portal* p : portals) sum += p->area_m2;
  return sum;
}

class Holes {
 public:
  Holes(std::size_t room_count) : outside_(static_cast<CellId>(room_count)), holes_(room_count) {}

  void add(CellId room, CellId beyond, double area, const Point& at) {
    const std::uint32_t other = beyond >= outside_ ? kNoRoom : static_cast<std::uint32_t>(beyond);
    holes_[static_cast<std::size_t>(room)].push_back({RoomOpening::Kind::kHole, other, area, at});
  }

  void add_direct(const Portal& p) {
    add(p.a, p.b, p.area_m2, p.box.centre());
    if (p.b < outside_) add(p.b, p.a, p.area_m2, p.box.centre());
  }

  /// What leads through a doorway leads to the room behind that has the largest part in it.
  void add_through(const PortalsOfPiece& piece) {
    if (piece.size() < 2) return;
    for (const auto& [room, portals] : piece) {
      CellId beyond = kNoCell;
      double most = 0.0;
      for (const auto& [other, theirs] : piece) {
        if (other == room || area_of(theirs) <= most) continue;
        beyond = other;
        most = area_of(theirs);
      }
      for (const Portal* p : portals) add(room, beyond, std::min(p->area_m2, most), p->box.centre());
    }
  }

  /// Where a room was cut off from what lies above it.
  void add_vertical(const Columns& columns, const std::vector<CellId>& numbers) {
    struct Shaft {
      std::size_t cells = 0;
      Vector sum;
    };
    std::map<std::pair<CellId, CellId>, Shaft> shafts;
    for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
      const Span& span = columns.spans[s];
      if (!span.cut || numbers[s] == numbers[s + 1]) continue;
      Shaft& shaft = shafts[std::minmax(numbers[s], numbers[s + 1])];
      ++shaft.cells;
      shaft.sum = shaft.sum + Vector{columns.raster.x(span.column), columns.raster.y(span.column), span.high};
    }
    const double cell_area = columns.raster.cell_m * columns.raster.cell_m;
    for (const auto& [pair, shaft] : shafts) {
      const auto count = static_cast<double>(shaft.cells);
      const Point at = Point{} + shaft.sum / count;
      if (pair.first >= outside_ || count * cell_area < kLeastHole) continue;
      add_direct({.a = pair.first,
                  .b = pair.second,
                  .width_m = 0.0,
                  .border_m = 0.0,
                  .area_m2 = count * cell_area,
                  .box = {at, at}});
    }
  }

  std::vector<std::vector<RoomOpening>> take() { return std::move(holes_); }

 private:
  CellId outside_;
  std::vector<std::vector<RoomOpening>> holes_;
};

/// Space that one room alone goes on into belongs to it.
void collect_niches(const Columns& columns, const std::vector<CellId>& numbers,
                    const std::map<CellId, std::set<CellId>>& rooms_at, CellId outside,
                    std::vector<RoomColumn>& niches) {
  for (std::uint32_t s = 0; s < columns.spans.size(); ++s) {
    const auto at = numbers[s] > outside ? rooms_at.find(numbers[s]) : rooms_at.end();
    if (at == rooms_at.end() || at->second.size() != 1) continue;
    const Span& span = columns.spans[s];
    niches.push_back({span.column, static_cast<std::uint32_t>(*at->second.begin()), span.low, span.high, span.low,
                      RoomColumn::Kind::kNiche});
  }
}

/// How far in front of a pane its room is looked for [m]: past the deepest of window niches.
constexpr double kNicheDepth = 1.0;
/// Points of a triangle that are asked.
constexpr std::array<std::array<double, 3>, 3> kAsked{{{0.6, 0.2, 0.2}, {0.2, 0.6, 0.2}, {0.2, 0.2, 0.6}}};

std::uint32_t room_of_side(const Rooms& rooms, const Rays& rays, const std::array<Point, 3>& t, const Vector& normal) {
  for (const auto& [a, b, c] : kAsked) {
    const Point p = Point{} + a * (t[0] - Point{}) + b * (t[1] - Point{}) + c * (t[2] - Point{});
    const std::uint32_t room = room_before(rooms, rays, p, normal);
    if (room != kNoRoom) return room;
  }
  return kNoRoom;
}

/// A pane between two rooms, or a room and the outside, as it is put together from triangles.
struct Pane {
  double area_m2 = 0.0;
  Vector moment;
};

void add_face(const Faces& faces, const Rays& rays, FaceId face, RoomOpening::Kind kind, Rooms& rooms) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Pane> panes;
  for (std::uint32_t t = faces.shape.starts[face.index()]; t < faces.shape.starts[face.index() + 1]; ++t) {
    const auto triangle = corners(faces, t);
    const Vector doubled = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const Vector normal = faces.faces[face.index()].frame.w;
    const std::uint32_t front = room_of_side(rooms, rays, triangle, normal);
    const std::uint32_t back = room_of_side(rooms, rays, triangle, -normal);
    if (front == back) continue;
    Pane& pane = panes[{front, back}];
    const double area = 0.5 * norm(doubled);
    pane.area_m2 += area;
    for (const Point& p : triangle) pane.moment = pane.moment + (area / 3.0) * (p - Point{});
  }
  for (const auto& [sides, pane] : panes) {
    if (!(pane.area_m2 > 0.0)) continue;
    const Point at = Point{} + pane.moment / pane.area_m2;
    const auto [front, back] = sides;
    if (front != kNoRoom) rooms.rooms[front].openings.push_back({kind, back, pane.area_m2, at});
    if (back != kNoRoom) rooms.rooms[back].openings.push_back({kind, front, pane.area_m2, at});
  }
}

}  // namespace

std::vector<std::vector<RoomOpening>> find_holes(const Columns& columns, const std::vector<CellId>& room_of_span,
                                                 std::size_t room_count, std::vector<RoomColumn>& niches) {
  const Remainder remainder(columns, room_of_span, room_count);
  const auto outside = static_cast<CellId>(room_count);
  Holes holes(room_count);
  std::map<CellId, PortalsOfPiece> pieces;
  std::map<CellId, std::set<CellId>> rooms_at;
  const auto portals = find_portals(columns, remainder.numbers(), kLeastOverlap, outside);
  for (const Portal& p : portals) {
    if (p.b > outside) rooms_at[p.b].insert(p.a);
    if (p.area_m2 < kLeastHole) continue;
    if (p.b <= outside)
      holes.add_direct(p);
    else
      pieces[p.b][p.a].push_back(&p);
  }
  for (const auto& [piece, leading] : pieces) holes.add_through(leading);
  holes.add_vertical(columns, remainder.numbers());
  collect_niches(columns, remainder.numbers(), rooms_at, outside, niches);
  return holes.take();
}

void add_panes(const Faces& faces, const Rays& rays, const RoomSearch& search, Rooms& rooms) {
  for (std::size_t f = 0; f < faces.count(); ++f) {
    if (!search.glazing.empty() && search.glazing[f] != 0)
      add_face(faces, rays, FaceId(f), RoomOpening::Kind::kGlazing, rooms);
    else if (!search.air.empty() && search.air[f] != 0)
      add_face(faces, rays, FaceId(f), RoomOpening::Kind::kAir, rooms);
  }
}

}  // namespace clerestory::mesh
