// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/room_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "mesh/hash.h"
#include "mesh/regions.h"

namespace clerestory::mesh {

namespace {

constexpr Vector kUp{0.0, 0.0, 1.0};
/// Floors rise by less than this: 30 degrees. Roofs over attics are steeper, ramps are not.
constexpr double kLevelCosine = 0.866;
/// A triangle lies on a room's floor when it is this near to it [m]: coverings are thin, steps higher.
constexpr double kOnFloor = 0.06;
/// Points at which a triangle is asked for its room: one a square decimetre, within these bounds.
constexpr std::size_t kLeastPoints = 4;
constexpr std::size_t kMostPoints = 24;
constexpr double kPointArea = 0.1;  ///< [m²]
/// The triangles of a floor tell its area where they agree this well with the raster.
constexpr double kAgreement = 0.015;
/// A cell at the edge of a room is looked at in so many places along each side.
constexpr std::uint32_t kPlaces = 4;
/// Distance below the ceiling at which a room's edge is looked for [m]: above furniture, below cornices.
constexpr double kBelowCeiling = 0.12;

Point spread_point(const std::array<Point, 3>& t, std::uint32_t i) {
  const double a = std::sqrt(spread(i, 0, 0));
  const double b = spread(i, 1, 0);
  return t[0] + a * (1.0 - b) * (t[1] - t[0]) + a * b * (t[2] - t[0]);
}

/// The column on whose floor a point lies: its own, or, in a cell that a wall touches, one beside it.
const RoomColumn* floor_column(const RoomMap& map, const Point& p) {
  const auto column = map.raster().at(p.x, p.y);
  if (!column) return nullptr;
  for (const int dj : {0, -1, 1}) {
    for (const int di : {0, -1, 1}) {
      const auto near = map.raster().beside(*column, di, dj);
      if (!near) continue;
      for (const RoomColumn& c : map.of(*near)) {
        if (c.kind == RoomColumn::Kind::kWhole && std::abs(p.z - c.floor) < kOnFloor) return &c;
      }
    }
  }
  return nullptr;
}

/// Whether another layer of the floor lies on a place of it: screed on a slab, a covering on both.
bool is_covered(const Rays& rays, const Point& place, double floor) {
  const Point above = place + rays.offset_m() * kUp;
  const Hit hit = rays.first_hit({above, kUp});
  return hit.face.valid() && above.z + hit.distance < floor + kOnFloor;
}

std::uint32_t room_of_triangle(const std::array<Point, 3>& t, double area_m2, const Rays& rays, const RoomMap& map) {
  const auto wanted = static_cast<std::size_t>(area_m2 / kPointArea);
  const std::size_t count = std::clamp(wanted, kLeastPoints, kMostPoints);
  std::map<std::uint32_t, std::size_t> votes;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Point place = spread_point(t, i);
    const RoomColumn* const column = floor_column(map, place);
    ++votes[column == nullptr || is_covered(rays, place, column->floor) ? kNoRoom : column->room];
  }
  const auto most = std::ranges::max_element(votes, {}, [](const auto& v) { return v.second; });
  return most->first;
}

/// Height of a room's edge at a column [m, local].
double probe_height(const RoomColumn& c) {
  return c.ceiling - std::min<double>(kBelowCeiling, 0.5 * (c.ceiling - c.free_from));
}

/// A cell beside the columns of a room, with one of them.
struct EdgeCell {
  std::uint32_t room, column;
  int storey;  // a gallery and the hall below have edges in the same cell
  std::uint32_t from;
};

class Measures {
 public:
  Measures(const Rays& rays, const RoomMap& map, std::vector<Room>& rooms)
      : rays_(rays), map_(map), rooms_(rooms), area_(rooms.size(), 0.0), volume_(rooms.size(), 0.0) {}

  void add_columns() {
    const double cell = map_.raster().cell_m;
    for (const RoomColumn& c : map_.columns()) {
      if (c.kind == RoomColumn::Kind::kNiche || rooms_[c.room].stated) continue;
      const Point centre{map_.raster().x(c.column), map_.raster().y(c.column), probe_height(c)};
      const double floor = c.floor < c.free_from ? c.floor : centre.z - way(centre, -kUp, centre.z - c.floor);
      const double ceiling = centre.z + way(centre, kUp, c.ceiling - centre.z);
      add(c, cell * cell, floor, ceiling, centre);
    }
  }

  void add_edges() {
    std::vector<EdgeCell> edges = edge_cells();
    std::ranges::sort(edges, {}, [](const EdgeCell& e) { return std::tuple(e.room, e.storey, e.column, e.from); });
    for (std::size_t first = 0; first < edges.size();) {
      std::size_t last = first;
      const auto same = [&](const EdgeCell& e) {
        return e.room == edges[first].room && e.storey == edges[first].storey && e.column == edges[first].column;
      };
      while (last < edges.size() && same(edges[last])) ++last;
      add_edge(std::span(edges).subspan(first, last - first));
      first = last;
    }
  }

  [[nodiscard]] const std::vector<double>& area() const { return area_; }
  [[nodiscard]] const std::vector<double>& volume() const { return volume_; }

 private:
  /// The way to the next surface; the given one where that is about the same, or nothing is met.
  [[nodiscard]] double way(const Point& from, const Vector& direction, double about) const {
    const Hit hit = rays_.first_hit({from, direction});
    return hit.face.valid() && hit.distance < about + 1.0 ? hit.distance : about;
  }

  void add(const RoomColumn& c, double area, double floor, double ceiling, const Point& at) {
    if (c.kind == RoomColumn::Kind::kWhole) area_[c.room] += area;
    volume_[c.room] += area * (ceiling - floor);
    rooms_[c.room].box.add(Point{at.x, at.y, floor});
    rooms_[c.room].box.add(Point{at.x, at.y, ceiling});
  }

  [[nodiscard]] bool goes_on(const RoomColumn& c, std::uint32_t column) const {
    const double z = probe_height(c);
    return std::ranges::any_of(
        map_.of(column), [&](const RoomColumn& other) { return z > other.floor && z < other.ceiling + kBelowCeiling; });
  }

  [[nodiscard]] std::vector<EdgeCell> edge_cells() const {
    std::vector<EdgeCell> edges;
    for (std::uint32_t k = 0; k < map_.columns().size(); ++k) {
      const RoomColumn& c = map_.columns()[k];
      if (c.kind == RoomColumn::Kind::kNiche || rooms_[c.room].stated) continue;
      for (int dj = -1; dj <= 1; ++dj) {
        for (int di = -1; di <= 1; ++di) {
          const auto beside = map_.raster().beside(c.column, di, dj);
          if (!beside || goes_on(c, *beside)) continue;
          constexpr double kStorey = 2.0;
          edges.push_back({c.room, *beside, static_cast<int>(std::floor(c.floor / kStorey)), k});
        }
      }
    }
    return edges;
  }

  void add_edge(std::span<const EdgeCell> edge) {
    const Raster& raster = map_.raster();
    const std::uint32_t column = edge.front().column;
    const double step = raster.cell_m / kPlaces;
    for (std::uint32_t i = 0; i < kPlaces * kPlaces; ++i) {
      // Displaced from cell to cell, so that what is rounded at the edge evens out.
      const double a = spread(i, 0, hash(column, 1));
      const double b = spread(i, 1, hash(column, 2));
      const Point place{raster.x(column) + (a - 0.5) * raster.cell_m, raster.y(column) + (b - 0.5) * raster.cell_m,
                        0.0};
      add_place(edge, place, step * step);
    }
  }

  void add_place(std::span<const EdgeCell> edge, Point place, double area) {
    const Raster& raster = map_.raster();
    const auto away = [&](const EdgeCell& e) {
      const std::uint32_t c = map_.columns()[e.from].column;
      return std::hypot(raster.x(c) - place.x, raster.y(c) - place.y);
    };
    const RoomColumn& from = map_.columns()[std::ranges::min_element(edge, {}, away)->from];
    const Point start{raster.x(from.column), raster.y(from.column), probe_height(from)};
    place.z = start.z;
    const Hit hit = rays_.first_hit({start, place - start});
    if (hit.face.valid() && hit.distance <= 1.0) return;
    const double ceiling = place.z + way(place, kUp, from.ceiling - place.z);
    add(from, area, from.floor, ceiling, place);
  }

  const Rays& rays_;
  const RoomMap& map_;
  std::vector<Room>& rooms_;
  std::vector<double> area_;
  std::vector<double> volume_;
};

double plan_area(const std::array<Point, 3>& t) {
  const Vector a = t[1] - t[0];
  const Vector b = t[2] - t[0];
  return 0.5 * std::abs(a.x * b.y - a.y * b.x);
}

}  // namespace

std::vector<std::uint32_t> floor_triangles(const Faces& faces, const Rays& rays, const RoomMap& map) {
  std::vector<std::uint32_t> floor_of(faces.shape.triangles.size(), kNoRoom);
  for (std::size_t f = 0; f < faces.count(); ++f) {
    if (std::abs(faces.faces[f].frame.w.z) < kLevelCosine) continue;
    for (std::uint32_t t = faces.shape.starts[f]; t < faces.shape.starts[f + 1]; ++t) {
      const auto triangle = corners(faces, t);
      floor_of[t] = room_of_triangle(triangle, plan_area(triangle), rays, map);
    }
  }
  return floor_of;
}

void measure_rooms(const Faces& faces, const Rays& rays, const RoomMap& map, const std::vector<std::uint32_t>& floor_of,
                   std::vector<Room>& rooms) {
  Measures measures(rays, map, rooms);
  measures.add_columns();
  measures.add_edges();
  std::vector<double> floors(rooms.size(), 0.0);
  for (std::uint32_t t = 0; t < floor_of.size(); ++t) {
    if (floor_of[t] != kNoRoom) floors[floor_of[t]] += plan_area(corners(faces, t));
  }
  for (std::size_t r = 0; r < rooms.size(); ++r) {
    if (rooms[r].stated) continue;
    const double counted = measures.area()[r];
    const bool agree = std::abs(floors[r] - counted) <= kAgreement * counted;
    rooms[r].floor_area_m2 = agree ? floors[r] : counted;
    rooms[r].volume_m3 = measures.volume()[r] / counted * rooms[r].floor_area_m2;
  }
}

}  // namespace clerestory::mesh
