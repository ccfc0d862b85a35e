// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/task_areas.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lighting/grid_layout.h"
#include "lighting/room_bounds.h"
#include "lighting/sensor_surfaces.h"
#include "mesh/error.h"

namespace clerestory::lighting {

namespace {

using mesh::Point;
using mesh::Vector;

constexpr Vector kUp{0.0, 0.0, 1.0};
constexpr double kSurroundingM = 0.5;  // EN 12464-1:2021, 4.3.4: at least
constexpr double kBackgroundM = 3.0;   // EN 12464-1:2021, 4.3.5: at least
/// Observers stand this far from the wall behind them [m]: before it, not in it.
constexpr double kBeforeWallM = 0.05;
constexpr std::size_t kNamesInMessage = 5;

/// A rectangle in plan at one height.
struct Plan {
  double x0, y0, x1, y1;

  [[nodiscard]] Plan grown(double by) const { return {x0 - by, y0 - by, x1 + by, y1 + by}; }
  [[nodiscard]] bool holds(const Point& p) const { return p.x > x0 && p.x < x1 && p.y > y0 && p.y < y1; }
};

/// Cells no larger than the standard's spacing, without a margin.
void lay_out(const Plan& plan, double z, Sensors& sensors) {
  const double spacing = en12464_spacing_m(plan.x1 - plan.x0, plan.y1 - plan.y0);
  const auto columns = static_cast<int>(std::ceil((plan.x1 - plan.x0) / spacing - 1e-9));
  const auto rows = static_cast<int>(std::ceil((plan.y1 - plan.y0) / spacing - 1e-9));
  const double dx = (plan.x1 - plan.x0) / columns;
  const double dy = (plan.y1 - plan.y0) / rows;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const double x = plan.x0 + i * dx;
      const double y = plan.y0 + j * dy;
      sensors.positions.push_back({x + 0.5 * dx, y + 0.5 * dy, z});
      sensors.normals.push_back(kUp);
      sensors.cells.push_back({Point{x, y, z}, Point{x + dx, y, z}, Point{x + dx, y + dy, z}, Point{x, y + dy, z}});
    }
  }
}

void outline(const Plan& plan, double z, Sensors& sensors) {
  sensors.outlines.push_back(
      {{plan.x0, plan.y0, z}, {plan.x1, plan.y0, z}, {plan.x1, plan.y1, z}, {plan.x0, plan.y1, z}});
}

/// Keeps the sensors of which `stays` holds.
template <class Stays>
void filter(Sensors& sensors, const Stays& stays) {
  Sensors kept;
  kept.outlines = sensors.outlines;
  for (std::size_t i = 0; i < sensors.count(); ++i) {
    if (!stays(sensors.positions[i])) continue;
    kept.positions.push_back(sensors.positions[i]);
    kept.normals.push_back(sensors.normals[i]);
    kept.cells.push_back(sensors.cells[i]);
  }
  sensors = std::move(kept);
}

/// Everything of one task in one room.
class TaskPlacer {
 public:
  TaskPlacer(const Study& study, const Scene& scene, const GridSite& site, const RegionGraph& graph)
      : study_(study), scene_(scene), site_(site), graph_(graph) {}

  /// @param task  with its name, request and room
  void place(PlacedTask& task, std::set<std::string>& taken) const {
    const TaskRequest& request = study_.tasks[task.request];
    if (request.rectangle) {
      place_on_rectangle(request, task, taken);
    } else {
      keep(task, TaskArea::kTask, "", floor(task.room, request.height_m), taken);
      keep(task, TaskArea::kActivity, " activity", floor(task.room, request.eye_height_m), taken);
    }
    const RoomBounds bounds = room_bounds(site_, graph_, task.room, scene_.passable);
    keep(task, TaskArea::kWalls, " walls", on(bounds.walls, 0.0), taken);
    keep(task, TaskArea::kCeiling, " ceiling", on(bounds.ceilings, 0.0), taken);
    if (request.required.ugr > 0.0) place_observers(request, task);
  }

  /// The rooms that a task is done in.
  [[nodiscard]] std::vector<std::uint32_t> rooms_of(const TaskRequest& request) const {
    std::vector<std::uint32_t> rooms;
    for (std::uint32_t r = 0; r < scene_.rooms.rooms.size(); ++r) {
      const mesh::Room& room = scene_.rooms.rooms[r];
      if (fnmatch(request.rooms.c_str(), room.name.c_str(), 0) != 0 || !light_reaches(site_, r)) continue;
      if (request.rectangle && !has(r, middle(request, r))) continue;
      rooms.push_back(r);
    }
    return rooms;
  }

 private:
  [[nodiscard]] bool has(std::uint32_t room, const Point& place) const {
    return mesh::room_at(scene_.rooms, *scene_.rays, place) == room;
  }
  [[nodiscard]] double floor_z(std::uint32_t room) const { return scene_.rooms.rooms[room].box.low.z; }
  [[nodiscard]] Plan plan(const TaskRequest& request) const {
    const mesh::Box& box = *request.rectangle;
    const Vector& o = scene_.faces.origin;
    return {box.low.x - o.x, box.low.y - o.y, box.high.x - o.x, box.high.y - o.y};
  }
  [[nodiscard]] Point middle(const TaskRequest& request, std::uint32_t room) const {
    const Plan p = plan(request);
    return {0.5 * (p.x0 + p.x1), 0.5 * (p.y0 + p.y1), floor_z(room) + request.height_m};
  }

  [[nodiscard]] Sensors on(const std::vector<GridSurface>& surfaces, double height_m) const {
    GridRequest request;
    request.en12464_spacing = true;
    request.height_m = height_m;
    Sensors sensors;
    for (const GridSurface& surface : surfaces) lighting::lay_out(request, surface, sensors);
    return sensors;
  }
  [[nodiscard]] Sensors floor(std::uint32_t room, double height_m) const {
    return on(room_floors(site_, graph_, room, height_m), height_m);
  }

  void place_on_rectangle(const TaskRequest& request, PlacedTask& task, std::set<std::string>& taken) const {
    const Plan own = plan(request);
    const Plan near = own.grown(kSurroundingM);
    const double z = floor_z(task.room) + request.height_m;
    const auto in_room = [&](const Point& p) { return has(task.room, p); };
    Sensors on_task;
    lay_out(own, z, on_task);
    outline(own, z, on_task);
    Sensors activity = on_task;
    const double up = request.eye_height_m - request.height_m;
    for (Point& p : activity.positions) p.z += up;
    for (auto& cell : activity.cells) {
      for (Point& p : cell) p.z += up;
    }
    keep(task, TaskArea::kTask, "", std::move(on_task), taken);
    keep(task, TaskArea::kActivity, " activity", std::move(activity), taken);
    Sensors band;
    for (const Plan& strip : {Plan{near.x0, near.y0, near.x1, own.y0}, Plan{near.x0, own.y1, near.x1, near.y1},
                              Plan{near.x0, own.y0, own.x0, own.y1}, Plan{own.x1, own.y0, near.x1, own.y1}})
      lay_out(strip, z, band);
    outline(near, z, band);
    filter(band, in_room);
    keep(task, TaskArea::kSurrounding, " surrounding", std::move(band), taken);
    Sensors beyond = floor(task.room, request.height_m);
    filter(beyond, [&](const Point& p) { return !near.holds(p) && near.grown(kBackgroundM).holds(p); });
    keep(task, TaskArea::kBackground, " background", std::move(beyond), taken);
  }

  /// An area without a place for a sensor is none.
  void keep(PlacedTask& task, TaskArea area, const char* suffix, Sensors sensors, std::set<std::string>& taken) const {
    leave_out_solids(site_, sensors);
    if (sensors.count() == 0) return;
    std::iota(sensors.ids.begin(), sensors.ids.end(), 0U);
    task.areas[static_cast<std::size_t>(area)] = {grid_name(task.name + suffix, taken), std::move(sensors)};
  }

  void place_observers(const TaskRequest& request, PlacedTask& task) const {
    const Vector& origin = scene_.faces.origin;
    if (std::ranges::any_of(study_.observers, [&](const Observer& o) { return has(task.room, o.eye - origin); }))
      return;
    const auto floors = room_floors(site_, graph_, task.room, request.eye_height_m);
    if (floors.empty()) return;
    const GridSurface& surface = *std::ranges::max_element(floors, {}, &GridSurface::smaller_width_m);
    const mesh::Box& box = surface.box;
    const Point c = box.centre();
    const double z = box.low.z + request.eye_height_m;
    struct Place {
      Point eye;
      Vector look;
    };
    const mesh::Frame& f = surface.frame;
    for (const Place& p :
         {Place{{box.low.x + kBeforeWallM, c.y, z}, f.u}, Place{{box.high.x - kBeforeWallM, c.y, z}, -f.u},
          Place{{c.x, box.low.y + kBeforeWallM, z}, f.v}, Place{{c.x, box.high.y - kBeforeWallM, z}, -f.v}}) {
      const Point eye = surface.to_local(p.eye);
      if (!has(task.room, eye) || inside_solid(site_, eye, p.look)) continue;
      task.observers.push_back({fmt::format("{} {}", task.name, task.observers.size() + 1), eye + origin, p.look});
    }
  }

  const Study& study_;
  const Scene& scene_;
  const GridSite& site_;
  const RegionGraph& graph_;
};

[[noreturn]] void refuse(const TaskRequest& request, const Scene& scene) {
  std::vector<std::string> names;
  for (const mesh::Room& room : scene.rooms.rooms) {
    if (names.size() < kNamesInMessage) names.push_back(room.name);
  }
  const char* const where = request.rectangle ? " and holds the middle of its rectangle" : "";
  throw InputError("", 0,
                   fmt::format("task '{}': no room that light reaches fits '{}'{}", request.name, request.rooms, where),
                   names.empty() ? "the model has no room" : fmt::format("rooms are '{}'", fmt::join(names, "', '")));
}

}  // namespace

std::vector<PlacedTask> place_tasks(const Study& study, const Scene& scene, std::set<std::string> taken) {
  std::vector<PlacedTask> tasks;
  if (study.tasks.empty()) return tasks;
  const GridSite site({scene.faces, *scene.rays, scene.reachable_triangles, scene.rooms});
  const RegionGraph graph(site);
  const TaskPlacer placer(study, scene, site, graph);
  for (std::size_t t = 0; t < study.tasks.size(); ++t) {
    const TaskRequest& request = study.tasks[t];
    const auto rooms = placer.rooms_of(request);
    if (rooms.empty()) refuse(request, scene);
    for (const std::uint32_t room : rooms) {
      PlacedTask task;
      task.request = t;
      task.room = room;
      task.name = rooms.size() > 1 ? request.name + " " + scene.rooms.rooms[room].name : request.name;
      placer.place(task, taken);
      tasks.push_back(std::move(task));
    }
  }
  return tasks;
}

}  // namespace clerestory::lighting
