// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/grids.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <numeric>
#include <set>
#include <string_view>

#include "lighting/grid_layout.h"
#include "lighting/sensor_surfaces.h"
#include "mesh/error.h"

namespace clerestory::lighting {

namespace {

constexpr const char* kRooms = "rooms";
constexpr std::size_t kNamesInMessage = 3;
/// Names that other results have.
const std::set<std::string> kOtherNames{"summary", "surfaces", "discontinuities", "solution",
                                        "result",  "previous", "leaks",           "observers"};

/// How many letters must be changed, added or dropped to make one word of the other [Levenshtein 1966].
std::size_t letters_apart(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = std::exchange(row[j + 1], std::min({row[j + 1] + 1, row[j] + 1, replaced}));
    }
  }
  return row.back();
}

/// The names of parts and materials that are most like the one asked for.
std::vector<std::string> nearest_names(const mesh::Faces& faces, const std::string& asked) {
  std::set<std::string> all(faces.part_names.begin(), faces.part_names.end());
  all.insert(faces.material_names.begin(), faces.material_names.end());
  std::vector<std::string> names(all.begin(), all.end());
  std::erase(names, "");
  std::ranges::stable_sort(names, {}, [&](const std::string& name) { return letters_apart(name, asked); });
  if (names.size() > kNamesInMessage) names.resize(kNamesInMessage);
  return names;
}

std::string quoted_list(const std::vector<std::string>& names) {
  return names.empty() ? "none has a name" : fmt::format("'{}'", fmt::join(names, "', '"));
}

[[noreturn]] void refuse(const GridRequest& request, const std::string& what, const std::string& hint) {
  throw InputError(request.points_file, 0, fmt::format("grid '{}': {}", request.name, what), hint);
}

void check(const GridRequest& request) {
  if (!request.points.empty()) return;
  if (request.surfaces.empty()) refuse(request, "neither surfaces nor points are named", "give surface or points");
  if (!request.en12464_spacing && !(request.spacing_m > 0.0)) {
    refuse(request, fmt::format("the spacing is {:g} m", request.spacing_m), "give a spacing above zero");
  }
  if (!(request.height_m >= 0.0)) {
    refuse(request, fmt::format("the height is {:g} m", request.height_m), "give a height of zero or more");
  }
  if (request.margin_m && !(*request.margin_m >= 0.0)) {
    refuse(request, fmt::format("the margin is {:g} m", *request.margin_m), "give a margin of zero or more");
  }
}

/// The rooms that get sensors: those that light reaches; where it reaches none, all.
std::vector<std::uint32_t> rooms_for_sensors(const GridSite& site) {
  std::vector<std::uint32_t> all(site.rooms.rooms.size());
  std::iota(all.begin(), all.end(), 0U);
  std::vector<std::uint32_t> lit;
  std::ranges::copy_if(all, std::back_inserter(lit), [&](std::uint32_t r) { return light_reaches(site, r); });
  return lit.empty() ? all : lit;
}

[[noreturn]] void refuse_rooms(const GridSite& site, const GridRequest& request) {
  refuse(request, "no room is found: nothing encloses a floor with 1.8 m of free height",
         "name the part or material of the floor, " + quoted_list(nearest_names(site.faces, "floor")));
}

std::vector<GridSurface> surfaces_of(const GridSite& site, const RegionGraph& graph, const GridRequest& request,
                                     const std::string& name) {
  if (name == kRooms) {
    std::vector<GridSurface> floors;
    for (const std::uint32_t room : rooms_for_sensors(site)) {
      std::ranges::move(room_floors(site, graph, room, request.height_m), std::back_inserter(floors));
    }
    if (floors.empty()) refuse_rooms(site, request);
    return floors;
  }
  bool fits = false;
  auto surfaces = named_surfaces(site, graph, name, request.height_m, fits);
  if (!fits) {
    refuse(request, fmt::format("no part or material fits '{}'", name),
           "nearest names: " + quoted_list(nearest_names(site.faces, name)));
  }
  if (surfaces.empty()) {
    refuse(request, fmt::format("no surface of '{}' has {:g} m of free space before it", name, request.height_m),
           "reduce the height, or name another surface");
  }
  return surfaces;
}

/// Without those that another name has given already, and without strips narrower than a cell, such as reveals and the ends of
/// walls, where there are wider ones.
void tidy(const GridRequest& request, std::vector<GridSurface>& surfaces) {
  std::vector<GridSurface> kept;
  for (GridSurface& s : surfaces) {
    const bool known = std::ranges::any_of(kept, [&](const GridSurface& k) {
      return k.triangles.size() == s.triangles.size() && std::ranges::equal(k.loops, s.loops) &&
             mesh::dot(k.frame.w, s.frame.w) > 0.0;
    });
    if (!known) kept.push_back(std::move(s));
  }
  surfaces = std::move(kept);
  if (request.en12464_spacing) return;
  const auto narrow = [&](const GridSurface& s) { return s.smaller_width_m() < request.spacing_m; };
  if (!std::ranges::all_of(surfaces, narrow)) std::erase_if(surfaces, narrow);
}

Sensors on_surfaces(const GridSite& site, const RegionGraph& graph, const GridRequest& request) {
  std::vector<GridSurface> surfaces;
  for (const std::string& name : request.surfaces) {
    auto more = surfaces_of(site, graph, request, name);
    std::ranges::move(more, std::back_inserter(surfaces));
  }
  tidy(request, surfaces);
  Sensors sensors;
  for (const GridSurface& surface : surfaces) lay_out(request, surface, sensors);
  if (sensors.count() > 0) return sensors;
  const GridSurface& largest = *std::ranges::max_element(surfaces, {}, &GridSurface::smaller_width_m);
  if (!request.margin_m) {
    lay_out_middle(request, largest, sensors);
    return sensors;
  }
  refuse(request,
         fmt::format("a margin of {:.3g} m leaves no place for a sensor on the largest surface, {:.4g} x {:.4g} m",
                     *request.margin_m, largest.box.size().x, largest.box.size().y),
         "reduce the margin or the spacing");
}

Sensors at_points(const mesh::Faces& faces, const GridRequest& request) {
  assert(request.normals.size() == request.points.size());
  Sensors sensors;
  for (const mesh::Point& p : request.points) sensors.positions.push_back(p - faces.origin);
  sensors.normals = request.normals;
  sensors.cells = lattice_cells(sensors.positions, sensors.normals);
  return sensors;
}

template <class T>
void keep(std::vector<T>& values, const std::vector<std::uint32_t>& which) {
  for (std::size_t i = 0; i < which.size(); ++i) values[i] = values[which[i]];
  values.resize(which.size());
}

void number(Sensors& sensors) { std::iota(sensors.ids.begin(), sensors.ids.end(), 0U); }

Sensors place_one(const GridSite& site, const GridRequest& request) {
  Sensors sensors =
      request.points.empty() ? on_surfaces(site, RegionGraph(site), request) : at_points(site.faces, request);
  leave_out_solids(site, sensors);
  if (sensors.count() == 0) {
    refuse(request, fmt::format("all {} sensors lie inside solids", sensors.left_out),
           request.points.empty() ? fmt::format("change the height, {:g} m", request.height_m) : "move the points");
  }
  if (request.points.empty()) number(sensors);
  return sensors;
}

/// The floor of one room, with a sensor at least where there is floor at all and it is not within a solid.
Sensors place_in_room(const GridSite& site, const RegionGraph& graph, const GridRequest& request, std::uint32_t room) {
  auto surfaces = room_floors(site, graph, room, request.height_m);
  Sensors sensors;
  if (surfaces.empty()) return sensors;
  tidy(request, surfaces);
  for (const GridSurface& surface : surfaces) lay_out(request, surface, sensors);
  if (sensors.count() == 0) {
    lay_out_middle(request, *std::ranges::max_element(surfaces, {}, &GridSurface::smaller_width_m), sensors);
  }
  leave_out_solids(site, sensors);
  number(sensors);
  return sensors;
}

std::vector<NamedSensors> place_by_room(const GridSite& site, const GridRequest& request,
                                        std::vector<std::string>& notices) {
  const RegionGraph graph(site);
  const auto lit = rooms_for_sensors(site);
  std::vector<NamedSensors> grids;
  std::set<std::string> taken;
  for (std::uint32_t room = 0; room < site.rooms.rooms.size(); ++room) {
    const std::string& name = site.rooms.rooms[room].name;
    if (!std::ranges::binary_search(lit, room)) {
      notices.push_back(fmt::format("{} has no grid: no light reaches it", name));
      continue;
    }
    Sensors sensors = place_in_room(site, graph, request, room);
    if (sensors.count() == 0)
      notices.push_back(fmt::format("{} has no grid: its floor has no place for a sensor", name));
    else
      grids.push_back({grid_name(name, taken), std::move(sensors)});
  }
  if (grids.empty()) refuse_rooms(site, request);
  return grids;
}

/// Lets sensors look where the request wants them to.
void turn(const GridRequest& request, Sensors& sensors) {
  sensors.cylinders = request.cylindrical;
  if (request.cylindrical) std::ranges::fill(sensors.normals, mesh::Vector{0.0, 0.0, 1.0});
  if (request.look) std::ranges::fill(sensors.normals, *request.look);
}

}  // namespace

std::string lower(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

void leave_out_solids(const GridSite& site, Sensors& sensors) {
  const std::size_t asked = sensors.count();
  for (std::uint32_t i = 0; i < asked; ++i) {
    if (!inside_solid(site, sensors.positions[i], sensors.normals[i])) sensors.ids.push_back(i);
  }
  sensors.left_out = asked - sensors.ids.size();
  keep(sensors.positions, sensors.ids);
  keep(sensors.normals, sensors.ids);
  if (!sensors.cells.empty()) keep(sensors.cells, sensors.ids);
}

std::string grid_name(const std::string& room, std::set<std::string>& taken) {
  constexpr std::size_t kLongest = 80;  // bytes: any ending fits behind it
  std::string name = room.substr(0, kLongest);
  while (name.size() < room.size() && !name.empty() && (static_cast<unsigned char>(room[name.size()]) & 0xC0U) == 0x80U)
    name.pop_back();  // not within a letter
  for (char& c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || std::string_view("/\\<>:\"|?*\x7f").find(c) != std::string_view::npos)
      c = '-';
  }
  if (name.empty() || name.front() == '.' || kOtherNames.contains(lower(name))) name = "room " + name;
  const std::string first = name;
  for (int n = 2; !taken.insert(lower(name)).second; ++n) name = fmt::format("{} ({})", first, n);
  return name;
}

std::vector<NamedSensors> place_sensors(const GridRequest& request, const SensorPlaces& places,
                                        std::vector<std::string>& notices) {
  check(request);
  const GridSite site(places);
  std::vector<NamedSensors> grids;
  if (request.by_room)
    grids = place_by_room(site, request, notices);
  else
    grids.push_back({request.name, place_one(site, request)});
  for (NamedSensors& grid : grids) turn(request, grid.sensors);
  return grids;
}

}  // namespace clerestory::lighting
