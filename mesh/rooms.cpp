// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/rooms.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "mesh/regions.h"
#include "mesh/reveals.h"
#include "mesh/room_drafts.h"
#include "mesh/room_floors.h"
#include "mesh/room_measures.h"
#include "mesh/room_openings.h"
#include "mesh/spaces.h"

namespace clerestory::mesh {

namespace {

/// A room has walls on so much of its border; below eaves, canopies and balconies there is less.
constexpr double kEnclosed = 0.6;
/// Inside of a solid nearly all rays meet something, most of them back sides (what it stands on may lack a polygon of its own), and few
/// what light reaches.
constexpr double kClosed = 0.95;
constexpr double kBacks = 0.6;
constexpr double kLit = 0.25;
/// Where fronts look outwards everywhere, backs tell walls by their width alone: less than twice this [m].
constexpr double kHalfWall = 0.75;
constexpr std::uint32_t kPlaces = 8;
constexpr std::uint32_t kDirections = 16;
/// Floors that differ by more than this are of different storeys [m].
constexpr double kStorey = 1.2;
/// A draft is what a space is when so much of it lies in spaces.
constexpr double kSameRoom = 0.5;

/// What one sees of the faces around from within a space.
struct View {
  double rays = 0.0, hits = 0.0, backs = 0.0, lit = 0.0;

  [[nodiscard]] bool sees_backs() const { return hits > kClosed * rays && backs > kBacks * hits; }
  [[nodiscard]] bool is_lit() const { return lit > kLit * hits; }
};

void look(const Rays& rays, const RoomSearch& search, const Point& from, std::uint32_t seed, View& view) {
  for (std::uint32_t i = 0; i < kDirections; ++i) {
    const Hit hit = rays.first_hit({from, sphere_direction(spread(i, 0, seed), spread(i, 1, seed))});
    view.rays += 1.0;
    if (!hit.face.valid()) continue;
    view.hits += 1.0;
    if (hit.side == Side::kBack) view.backs += 1.0;
    const std::size_t side = 2 * std::size_t{hit.triangle} + static_cast<std::size_t>(hit.side);
    if (!search.reached.empty() && search.reached[side] != 0) view.lit += 1.0;
  }
}

/// What is seen from each draft.
std::vector<View> look_around(const Rays& rays, const RoomSearch& search, const RoomDrafts& drafts,
                              const std::vector<RoomColumn>& columns) {
  std::vector<std::vector<const RoomColumn*>> columns_of(drafts.rooms.size());
  for (const RoomColumn& c : columns) columns_of[c.room].push_back(&c);
  const Raster& raster = drafts.columns.raster;
  std::vector<View> views(drafts.rooms.size());
  for (std::size_t r = 0; r < views.size(); ++r) {
    for (std::uint32_t k = 0; k < kPlaces; ++k) {
      const std::size_t place = (2 * std::size_t{k} + 1) * columns_of[r].size() / (2 * std::size_t{kPlaces});
      const RoomColumn& c = *columns_of[r][place];
      const double z = 0.5 * (static_cast<double>(c.free_from) + c.ceiling);
      look(rays, search, {raster.x(c.column), raster.y(c.column), z}, k, views[r]);
    }
  }
  return views;
}

/// Which drafts are the insides of solids (the ground below a house, a thick wall): backs of faces and no light. Where lit rooms show
/// backs too, that tells walls, which are narrow, and what nothing leads into.
std::vector<bool> find_solids(const Rays& rays, const RoomSearch& search, const RoomDrafts& drafts,
                              const std::vector<RoomColumn>& columns) {
  const auto views = look_around(rays, search, drafts, columns);
  std::vector<bool> solid;
  solid.reserve(views.size());
  for (const View& v : views) solid.push_back(v.sees_backs() && !v.is_lit());
  if (std::ranges::none_of(views, [](const View& v) { return v.sees_backs() && v.is_lit(); })) return solid;
  std::vector<RoomColumn> niches;
  const auto holes = find_holes(drafts.columns, drafts.of_span, drafts.rooms.size(), niches);
  for (std::size_t r = 0; r < solid.size(); ++r) {
    if (drafts.rooms[r].clearance_m >= kHalfWall && !holes[r].empty()) solid[r] = false;
  }
  return solid;
}

/// Which drafts become rooms. Where none is a room by all that is asked, less is asked: a pavilion has no walls.
std::vector<bool> choose(const Rays& rays, const RoomSearch& search, const RoomDrafts& drafts,
                         const std::vector<RoomColumn>& columns) {
  const auto solid = find_solids(rays, search, drafts, columns);
  std::vector<bool> enclosed;
  std::vector<bool> rooms;
  for (std::size_t r = 0; r < drafts.rooms.size(); ++r) {
    enclosed.push_back(drafts.rooms[r].enclosed_share >= kEnclosed);
    rooms.push_back(enclosed[r] && !solid[r]);
  }
  const auto any = [](const std::vector<bool>& which) { return std::ranges::find(which, true) != which.end(); };
  if (any(rooms) || !search.spaces.empty()) return rooms;
  if (any(enclosed)) return enclosed;
  return std::vector<bool>(drafts.rooms.size(), true);
}

/// The room of each span after the spaces have taken theirs, and the drafts that are left.
struct Assignment {
  std::vector<CellId> room_of_span;
  std::vector<std::uint32_t> room_of_draft;  ///< [drafts] kNoRoom for those that are none
  std::size_t rooms = 0;
};

std::uint32_t space_of(const Span& span, const RoomMap& spaces) {
  if (!span.roofed()) return kNoRoom;
  for (const RoomColumn& c : spaces.of(span.column)) {
    const Span space{span.column, c.floor, c.ceiling};
    if (2.0F * overlap_m(span, space) > span.height()) return c.room;
  }
  return kNoRoom;
}

Assignment assign(const RoomDrafts& drafts, const std::vector<bool>& chosen, const RoomMap& spaces,
                  std::size_t space_count) {
  std::vector<std::size_t> all(drafts.rooms.size(), 0);
  std::vector<std::size_t> taken(drafts.rooms.size(), 0);
  Assignment result;
  for (std::uint32_t s = 0; s < drafts.of_span.size(); ++s) {
    const std::uint32_t space = space_count > 0 ? space_of(drafts.columns.spans[s], spaces) : kNoRoom;
    result.room_of_span.push_back(space == kNoRoom ? kNoCell : static_cast<CellId>(space));
    if (drafts.of_span[s] == kNoCell) continue;
    ++all[static_cast<std::size_t>(drafts.of_span[s])];
    if (space != kNoRoom) ++taken[static_cast<std::size_t>(drafts.of_span[s])];
  }
  result.rooms = space_count;
  for (std::size_t d = 0; d < drafts.rooms.size(); ++d) {
    const bool known = static_cast<double>(taken[d]) > kSameRoom * static_cast<double>(all[d]);
    result.room_of_draft.push_back(chosen[d] && !known ? static_cast<std::uint32_t>(result.rooms++) : kNoRoom);
  }
  for (std::uint32_t s = 0; s < drafts.of_span.size(); ++s) {
    if (result.room_of_span[s] != kNoCell || drafts.of_span[s] == kNoCell) continue;
    const std::uint32_t room = result.room_of_draft[static_cast<std::size_t>(drafts.of_span[s])];
    if (room != kNoRoom) result.room_of_span[s] = static_cast<CellId>(room);
  }
  return result;
}

/// The draft that most of each space lies in; kNoCell where that is none, or no room.
std::vector<CellId> drafts_of_spaces(const RoomDrafts& drafts, const std::vector<bool>& chosen, const RoomMap& spaces,
                                     std::size_t space_count) {
  std::vector<std::map<CellId, std::size_t>> votes(space_count);
  for (std::uint32_t s = 0; s < drafts.of_span.size(); ++s) {
    const std::uint32_t space = space_of(drafts.columns.spans[s], spaces);
    if (space == kNoRoom) continue;
    const CellId draft = drafts.of_span[s];
    ++votes[space][draft != kNoCell && chosen[static_cast<std::size_t>(draft)] ? draft : kNoCell];
  }
  std::vector<CellId> result;
  for (const auto& of_space : votes) {
    const auto most = std::ranges::max_element(of_space, {}, [](const auto& v) { return v.second; });
    result.push_back(most == of_space.end() ? kNoCell : most->first);
  }
  return result;
}

/// Says which stated rooms the geometry does not part from others, or from the outside.
void tell_what_is_not_apart(const std::vector<CellId>& drafts, std::vector<Room>& rooms) {
  for (std::size_t s = 0; s < drafts.size(); ++s) {
    if (drafts[s] == kNoCell) rooms[s].not_apart = "no walls enclose it";
    for (std::size_t other = 0; other < drafts.size(); ++other) {
      if (other == s || drafts[s] == kNoCell || drafts[other] != drafts[s]) continue;
      rooms[s].not_apart += (rooms[s].not_apart.empty() ? "no wall between it and '" : ", '") + rooms[other].name + "'";
    }
  }
}

/// Rooms in the order of storeys, then from the least y and x on; gives each its number.
std::vector<std::uint32_t> by_storey(const std::vector<RoomColumn>& columns, const Raster& raster, std::uint32_t first,
                                     std::uint32_t count) {
  std::vector<Box> box(count);
  for (const RoomColumn& c : columns) {
    if (c.room >= first) box[c.room - first].add(Point{raster.x(c.column), raster.y(c.column), c.floor});
  }
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t r) { return box[r].low.z; });
  std::vector<int> storey(count, 0);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const double rise = box[order[k]].low.z - box[order[k - 1]].low.z;
    storey[order[k]] = storey[order[k - 1]] + (rise > kStorey ? 1 : 0);
  }
  std::ranges::stable_sort(order, {}, [&](std::uint32_t r) {
    return std::tuple(storey[r], std::round(box[r].low.y), std::round(box[r].low.x));
  });
  std::vector<std::uint32_t> number(count);
  for (std::uint32_t k = 0; k < count; ++k) number[order[k]] = first + k;
  return number;
}

void renumber(const std::vector<std::uint32_t>& number, std::uint32_t first, Assignment& assigned) {
  for (CellId& room : assigned.room_of_span) {
    if (room >= static_cast<CellId>(first))
      room = static_cast<CellId>(number[static_cast<std::uint32_t>(room) - first]);
  }
  for (std::uint32_t& room : assigned.room_of_draft) {
    if (room != kNoRoom) room = number[room - first];
  }
}

/// Columns of the drafts that are rooms, with the rooms' numbers.
std::vector<RoomColumn> columns_of_rooms(std::vector<RoomColumn> columns, const Assignment& assigned) {
  for (RoomColumn& c : columns) c.room = assigned.room_of_draft[c.room];
  std::erase_if(columns, [](const RoomColumn& c) { return c.room == kNoRoom; });
  return columns;
}

void name(std::vector<Room>& rooms) {
  std::size_t number = 0;
  for (Room& room : rooms) {
    ++number;
    if (room.name.empty()) room.name = "room " + std::to_string(number);
  }
}

}  // namespace

bool Room::closed() const { return std::ranges::none_of(openings, &RoomOpening::is_leak); }

Rooms find_rooms(const Faces& faces, const Rays& rays, const RoomSearch& search) {
  const RoomDrafts drafts = draft_rooms(faces);
  const Raster& raster = drafts.columns.raster;
  std::vector<RoomColumn> drafted = room_columns(drafts);
  set_reveals_apart(faces, rays, search, raster, drafted);
  std::vector<RoomColumn> columns = space_columns(search.spaces, raster, faces.origin);

  Rooms rooms;
  rooms.rooms = stated_rooms(search.spaces, raster, columns, faces.origin);
  const auto stated = static_cast<std::uint32_t>(rooms.rooms.size());
  const std::vector<bool> chosen = choose(rays, search, drafts, drafted);
  const RoomMap stated_map(raster, columns);
  Assignment assigned = assign(drafts, chosen, stated_map, stated);
  if (stated > 0) tell_what_is_not_apart(drafts_of_spaces(drafts, chosen, stated_map, stated), rooms.rooms);
  rooms.rooms.resize(assigned.rooms);
  const auto found = columns_of_rooms(drafted, assigned);
  renumber(by_storey(found, raster, stated, static_cast<std::uint32_t>(assigned.rooms) - stated), stated, assigned);
  std::ranges::move(columns_of_rooms(drafted, assigned), std::back_inserter(columns));

  auto holes = find_holes(drafts.columns, assigned.room_of_span, rooms.rooms.size(), columns);
  for (std::size_t r = 0; r < rooms.rooms.size(); ++r) rooms.rooms[r].openings = std::move(holes[r]);
  rooms.map = RoomMap(raster, std::move(columns));
  rooms.floor_of = floor_triangles(faces, rays, rooms.map);
  measure_rooms(faces, rays, rooms.map, rooms.floor_of, rooms.rooms);
  add_panes(faces, rays, search, rooms);
  name(rooms.rooms);
  return rooms;
}

std::uint32_t room_at(const Rooms& rooms, const Rays& rays, const Point& place) {
  if (const RoomColumn* c = rooms.map.at(place)) return c->room;
  const Raster& raster = rooms.map.raster();
  const auto column = raster.at(place.x, place.y);
  if (!column) return kNoRoom;
  // A wall may touch the cell: what is clear beside it is the same room.
  for (int dj = -1; dj <= 1; ++dj) {
    for (int di = -1; di <= 1; ++di) {
      const auto beside = raster.beside(*column, di, dj);
      if (!beside) continue;
      const Point near{raster.x(*beside), raster.y(*beside), place.z};
      const RoomColumn* c = rooms.map.at(near);
      if (c == nullptr) continue;
      const Hit hit = rays.first_hit({place, near - place});
      if (!hit.face.valid() || hit.distance > 1.0) return c->room;
    }
  }
  return kNoRoom;
}

std::uint32_t room_before(const Rooms& rooms, const Rays& rays, const Point& on_surface, const Vector& normal) {
  constexpr double kMostDepth = 1.0;  // past the deepest of window niches [m]
  const Point start = on_surface + rays.offset_m() * normal;
  const Hit hit = rays.first_hit({start, normal});
  const double end = hit.face.valid() ? std::min(hit.distance, kMostDepth) : kMostDepth;
  const double step = 0.5 * rooms.map.raster().cell_m;
  for (double way = std::min(step, 0.5 * end); way < end; way += step) {
    if (const RoomColumn* c = rooms.map.at(start + way * normal)) return c->room;
  }
  // All of that way may run in cells that a wall touches.
  return room_at(rooms, rays, start + std::min(step, 0.5 * end) * normal);
}

}  // namespace clerestory::mesh
