// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/faces.h"
#include "mesh/geometry.h"
#include "mesh/model.h"
#include "mesh/rays.h"
#include "mesh/room_map.h"

namespace clerestory::mesh {

/// A volume that a file calls a room, as IfcSpace does.
struct Space {
  std::string name;
  Model boundary;  ///< closed polygons [m, model coordinates]; materials and parts mean nothing
};

/// Neither a room nor the inside of one: the outside, walls.
inline constexpr std::uint32_t kNoRoom = std::numeric_limits<std::uint32_t>::max();

/// Where light gets into a room or out of it.
struct RoomOpening {
  enum class Kind {
    kGlazing,
    kAir,   ///< an air polygon
    kHole,  ///< a place without a surface: an open door, a stairwell, a missing wall
  };

  Kind kind = Kind::kGlazing;
  std::uint32_t beyond = kNoRoom;  ///< the room on its other side; kNoRoom: the outside
  double area_m2 = 0.0;            ///< of a hole, as far as the raster tells
  Point at;                        ///< its middle [m, local]

  /// Whether a room is not closed there.
  [[nodiscard]] bool is_leak() const { return kind == Kind::kHole && beyond == kNoRoom; }
};

struct Room {
  std::string name;
  double floor_area_m2 = 0.0;  ///< in plan, galleries included; what furniture stands on counts
  double volume_m3 = 0.0;      ///< furniture does not count
  Box box;                     ///< [m, local]
  bool stated = false;         ///< taken from a space of the file
  std::string not_apart;  ///< of a stated room: why the geometry alone would not tell it as one; empty where it does
  std::vector<RoomOpening> openings;

  /// Whether it has no hole to the outside.
  [[nodiscard]] bool closed() const;
};

/// The rooms of a model. Rooms, storey by storey from below, in each from the least y and x on; those that a file states come first, in
/// the file's order.
struct Rooms {
  std::vector<Room> rooms;
  /// [triangles of the shape] the room whose floor the upper side of a triangle is, or kNoRoom.
  std::vector<std::uint32_t> floor_of;
  RoomMap map;
};

/// What rooms are found in.
struct RoomSearch {
  std::span<const std::uint8_t> glazing = {};  ///< [faces] non-zero for panes; empty: none
  std::span<const std::uint8_t> air = {};      ///< [faces] non-zero for air polygons; they end rooms; empty: none
  /// [2 a triangle of the shape] non-zero for sides that light or the outside can reach (reachable_triangles()), which tells rooms from
  /// the insides of solids; empty: unknown
  std::span<const std::uint8_t> reached = {};
  std::span<const Space> spaces = {};
};

/// Finds the rooms of a model: its spaces, and enclosed volumes that no space fills.
/// Enclosed volumes are found by a watershed of the free space's distance to the walls [Haumont, Debeir, Sillion 2003], below the
/// ceilings, where furniture does not divide; doors, open or closed, end rooms, and so do openings less than 1.2 m wide, or 1.6 m below a
/// lintel; gaps below 5 to 10 cm are closed (docs/theory/rooms.md). A room needs a headroom of 1.8 m on 0.8 m² and a width of 0.6 m;
/// one without a ceiling, or with a missing wall, is a room that is not closed. Floor areas are those of the floor's triangles where
/// these tell the room's edge, else counted on the raster with rays (to about 0.5 %); volumes add heights found by rays. Deterministic.
/// @param rays  of these faces
Rooms find_rooms(const Faces& faces, const Rays& rays, const RoomSearch& search = {});

/// The room that a place in the air lies in, or kNoRoom.
std::uint32_t room_at(const Rooms& rooms, const Rays& rays, const Point& place);

/// The room that a point of a surface looks into along a unit normal, or kNoRoom: the outside, or the inside of a solid.
std::uint32_t room_before(const Rooms& rooms, const Rays& rays, const Point& on_surface, const Vector& normal);

}  // namespace clerestory::mesh
