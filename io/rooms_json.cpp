// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/rooms_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace clerestory::io {

namespace {

using Json = nlohmann::ordered_json;

/// To a tenth of a millimetre, or of a square decimetre: more is noise.
double rounded(double value) {
  constexpr double kSteps = 1e4;
  return std::round(value * kSteps) / kSteps;
}

const char* word(mesh::RoomOpening::Kind kind) {
  switch (kind) {
    case mesh::RoomOpening::Kind::kGlazing:
      return "glazing";
    case mesh::RoomOpening::Kind::kAir:
      return "air";
    case mesh::RoomOpening::Kind::kHole:
      return "hole";
  }
  return "";
}

}  // namespace

std::string rooms_json(const std::vector<mesh::Room>& rooms) {
  Json list = Json::array();
  for (const mesh::Room& room : rooms) {
    Json openings = Json::array();
    for (const mesh::RoomOpening& o : room.openings) {
      openings.push_back({{"kind", word(o.kind)},
                          {"to", o.beyond == mesh::kNoRoom ? "outside" : rooms[o.beyond].name},
                          {"area_m2", rounded(o.area_m2)},
                          {"at", {rounded(o.at.x), rounded(o.at.y), rounded(o.at.z)}}});
    }
    list.push_back({{"name", room.name},
                    {"floor_area_m2", rounded(room.floor_area_m2)},
                    {"volume_m3", rounded(room.volume_m3)},
                    {"closed", room.closed()},
                    {"source", room.stated ? "file" : "geometry"},
                    {"openings", std::move(openings)}});
  }
  return list.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace clerestory::io
