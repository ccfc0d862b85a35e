// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/map_plan.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "mesh/geometry.h"

namespace clerestory::io {

namespace {

/// Sensors that look within this angle of each other can share a plane: cos 5°.
constexpr double kSameDirection = 0.9962;
/// Planes further apart than this are drawn apart [m]: more than a step in a floor, less than a storey or a room.
constexpr double kApart = 0.6;
/// A line this near to the plane of sensors lies in it [m].
constexpr double kInPlane = 1e-3;
/// More planes than this are no planes (a curved surface, scattered sensors): all are drawn as seen from above.
constexpr std::size_t kMostPlanes = 24;
/// A normal this close to the vertical makes a plane level: cos 15°, as for grids on surfaces.
constexpr double kLevel = 0.966;

struct Plane {
  mesh::Frame axes;     ///< u to the right on the map, v up
  double lowest = 0.0;  ///< offset along the normal [m]
  double highest = 0.0;
  std::vector<std::uint32_t> sensors;
  std::vector<std::size_t> outlines;
  std::vector<std::array<mesh::Point, 2>> no_sky;
};

mesh::Vector position_vector(const mesh::Point& p) { return p - mesh::Point{}; }

/// Level planes are seen from above; others by somebody who stands before them, z being up.
mesh::Frame axes_of(const mesh::Vector& normal) {
  if (std::abs(normal.z) > kLevel) return {{1, 0, 0}, {0, 1, 0}, normal};
  const mesh::Vector right = normalized(cross({0, 0, 1}, normal));
  return {right, cross(normal, right), normal};
}

std::vector<Plane> by_direction(const lighting::Sensors& sensors) {
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < sensors.count(); ++i) {
    const mesh::Vector& normal = sensors.normals[i];
    auto plane = std::ranges::find_if(planes, [&](const Plane& p) { return dot(p.axes.w, normal) > kSameDirection; });
    if (plane == planes.end()) {
      if (planes.size() == kMostPlanes) return {};
      plane = planes.insert(planes.end(), Plane{axes_of(normal), 0.0, 0.0, {}, {}, {}});
    }
    plane->sensors.push_back(static_cast<std::uint32_t>(i));
  }
  return planes;
}

/// Splits the sensors of one direction where their planes lie apart.
std::vector<Plane> by_offset(const lighting::Sensors& sensors, const Plane& plane) {
  std::vector<std::pair<double, std::uint32_t>> offsets;
  for (const std::uint32_t i : plane.sensors) {
    offsets.emplace_back(dot(plane.axes.w, position_vector(sensors.positions[i])), i);
  }
  std::ranges::sort(offsets);
  std::vector<Plane> parts;
  double last = -std::numeric_limits<double>::infinity();
  for (const auto& [offset, sensor] : offsets) {
    if (offset - last > kApart) parts.push_back({plane.axes, offset, offset, {}, {}, {}});
    parts.back().highest = offset;
    parts.back().sensors.push_back(sensor);
    last = offset;
  }
  for (Plane& part : parts) std::ranges::sort(part.sensors);
  return parts;
}

std::vector<Plane> planes_of(const lighting::Sensors& sensors) {
  std::vector<Plane> planes;
  for (const Plane& direction : by_direction(sensors)) {
    const std::vector<Plane> parts = by_offset(sensors, direction);
    planes.insert(planes.end(), parts.begin(), parts.end());
  }
  if (!planes.empty() && planes.size() <= kMostPlanes) return planes;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Plane all{axes_of({0, 0, 1}), -kFar, kFar, std::vector<std::uint32_t>(sensors.count()), {}, {}};
  std::iota(all.sensors.begin(), all.sensors.end(), 0U);
  return {all};
}

/// Twice the vector area of a loop [Newell].
mesh::Vector area_vector(const std::vector<mesh::Point>& loop) {
  mesh::Vector area;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    area = area + cross(loop[i] - loop.front(), loop[(i + 1) % loop.size()] - loop.front());
  }
  return area;
}

/// The plane that an outline lies in, or nothing: the surface of the outline got no sensors.
std::optional<std::size_t> plane_of(const std::vector<mesh::Point>& loop, const std::vector<Plane>& planes) {
  const mesh::Vector normal = normalized(area_vector(loop));
  std::optional<std::size_t> best;
  double least = kApart;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const double offset = dot(planes[i].axes.w, position_vector(loop.front()));
    const double distance = std::max({0.0, planes[i].lowest - offset, offset - planes[i].highest});
    const bool parallel = std::abs(dot(planes[i].axes.w, normal)) > kLevel;
    if ((parallel || planes.size() == 1) && distance < least) {
      least = distance;
      best = i;
    }
  }
  return best;
}

/// The plane that holds a line of its sensors, or nothing.
std::optional<std::size_t> plane_of_line(const std::array<mesh::Point, 2>& line, const std::vector<Plane>& planes) {
  const auto holds = [&](const Plane& plane) {
    return std::ranges::all_of(line, [&](const mesh::Point& p) {
      const double offset = dot(plane.axes.w, position_vector(p));
      return offset > plane.lowest - kInPlane && offset < plane.highest + kInPlane;
    });
  };
  const auto found = std::ranges::find_if(planes, holds);
  if (found == planes.end()) return std::nullopt;
  return static_cast<std::size_t>(found - planes.begin());
}

MapPoint flatten(const mesh::Frame& axes, const mesh::Point& p) {
  return {dot(axes.u, position_vector(p)), dot(axes.v, position_vector(p))};
}

MapBox box_of(const lighting::Sensors& sensors, const Plane& plane) {
  MapBox box;
  for (const std::uint32_t i : plane.sensors) {
    box.add(flatten(plane.axes, sensors.positions[i]));
    if (sensors.cells.empty()) continue;
    for (const mesh::Point& corner : sensors.cells[i]) box.add(flatten(plane.axes, corner));
  }
  for (const std::size_t o : plane.outlines) {
    for (const mesh::Point& p : sensors.outlines[o]) box.add(flatten(plane.axes, p));
  }
  return box;
}

bool level(const Plane& plane) { return std::abs(plane.axes.w.z) > kLevel; }

/// Of a wall only what sensors stand before is of interest, and the holes in it; not, say, the reveal of a window that looks
/// the same way. Of a storey also the rooms without sensors.
void drop_empty_outlines(const lighting::Sensors& sensors, Plane& plane) {
  if (level(plane)) return;
  mesh::Vector largest;
  for (const std::size_t o : plane.outlines) {
    const mesh::Vector area = area_vector(sensors.outlines[o]);
    if (norm(area) > norm(largest)) largest = area;
  }
  std::erase_if(plane.outlines, [&](std::size_t o) {
    if (dot(area_vector(sensors.outlines[o]), largest) < 0.0) return false;  // a hole
    MapOutline outline;
    for (const mesh::Point& p : sensors.outlines[o]) {
      outline.loop.push_back(flatten(plane.axes, p));
      outline.box.add(outline.loop.back());
    }
    return std::ranges::none_of(
        plane.sensors, [&](std::uint32_t i) { return contains(outline, flatten(plane.axes, sensors.positions[i])); });
  });
}

/// Long plans lie better than they stand.
void turn_if_on_end(const lighting::Sensors& sensors, std::vector<Plane>& planes) {
  double width = 0.0;
  double height = 0.0;
  for (const Plane& plane : planes) {
    const MapBox box = box_of(sensors, plane);
    width = std::max(width, box.width());
    height = std::max(height, box.height());
  }
  if (height <= 2.0 * width || !std::ranges::all_of(planes, level)) return;
  for (Plane& plane : planes) plane.axes = {{0, 1, 0}, {-1, 0, 0}, plane.axes.w};
}

/// The point of the compass that a vector looks to.
std::string compass(const mesh::Vector& v, double north_deg) {
  constexpr std::array<const char*, 8> kPoints{"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  const double azimuth_deg = north_deg - std::atan2(-v.x, v.y) * 180.0 / std::numbers::pi;
  return kPoints[static_cast<std::size_t>(std::lround(azimuth_deg / 45.0 + 16.0)) % 8];
}

std::string caption_of(const Plane& plane, const lighting::Sensors& sensors, double north_deg) {
  const double z = sensors.positions[plane.sensors.front()].z;
  if (level(plane)) return fmt::format("z = {:.2f} m{}", z, plane.axes.w.z < 0.0 ? ", looking down" : "");
  return "looking " + compass(plane.axes.w, north_deg);
}

/// Puts the panels side by side, in rows about as wide as the whole is high; gives the shift of each.
std::vector<MapPoint> arrange(const std::vector<MapBox>& boxes) {
  double area = 0.0;
  double widest = 0.0;
  double largest = 0.0;
  for (const MapBox& box : boxes) {
    largest = std::max({largest, box.width(), box.height()});
    widest = std::max(widest, box.width());
  }
  const double gap = 0.12 * largest;
  for (const MapBox& box : boxes) area += (box.width() + gap) * (box.height() + gap);
  const double row_width = std::max(widest, std::sqrt(1.3 * area));
  std::vector<MapPoint> shifts;
  MapPoint pen;
  double row_height = 0.0;
  for (const MapBox& box : boxes) {
    if (pen.x > 0.0 && pen.x + box.width() > row_width * 1.001) {
      pen = {0.0, pen.y - row_height - gap};
      row_height = 0.0;
    }
    shifts.push_back({pen.x - box.low.x, pen.y - box.high.y});
    pen.x += box.width() + gap;
    row_height = std::max(row_height, box.height());
  }
  return shifts;
}

double signed_area(const std::vector<MapPoint>& loop) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const MapPoint& a = loop[i];
    const MapPoint& b = loop[(i + 1) % loop.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return 0.5 * twice;
}

/// Builds the plan from the planes and where they go.
class PlanBuilder {
 public:
  PlanBuilder(const lighting::Sensors& sensors, MapPlan& plan) : sensors_(sensors), plan_(plan) {
    plan_.positions.resize(sensors.count());
    plan_.cells.resize(sensors.cells.size());
    plan_.zone.resize(sensors.count());
    plan_.inside.resize(sensors.count());
  }

  void add(const Plane& plane, const MapPoint& shift, std::string caption) {
    const auto place = [&](const mesh::Point& p) {
      const MapPoint flat = flatten(plane.axes, p);
      return MapPoint{flat.x + shift.x, flat.y + shift.y};
    };
    MapPanel panel{std::move(caption), {}};
    const std::size_t first = plan_.outlines.size();
    for (const std::size_t o : plane.outlines) add_outline(sensors_.outlines[o], place, panel.box);
    mark_holes(first);
    for (const auto& line : plane.no_sky) plan_.no_sky.push_back({place(line[0]), place(line[1])});
    for (const std::uint32_t i : plane.sensors) {
      plan_.positions[i] = place(sensors_.positions[i]);
      panel.box.add(plan_.positions[i]);
      if (!plan_.cells.empty()) {
        for (std::size_t k = 0; k < 4; ++k) panel.box.add(plan_.cells[i][k] = place(sensors_.cells[i][k]));
      }
      set_zone(i, first);
    }
    plan_.box.add(panel.box.low);
    plan_.box.add(panel.box.high);
    plan_.panels.push_back(std::move(panel));
  }

 private:
  template <class Place>
  void add_outline(const std::vector<mesh::Point>& points, const Place& place, MapBox& panel_box) {
    MapOutline outline;
    for (const mesh::Point& p : points) {
      outline.loop.push_back(place(p));
      outline.box.add(outline.loop.back());
      panel_box.add(outline.loop.back());
    }
    plan_.outlines.push_back(std::move(outline));
  }

  void mark_holes(std::size_t first) {
    double largest = 0.0;
    for (std::size_t o = first; o < plan_.outlines.size(); ++o) {
      const double area = signed_area(plan_.outlines[o].loop);
      if (std::abs(area) > std::abs(largest)) largest = area;
    }
    for (std::size_t o = first; o < plan_.outlines.size(); ++o) {
      plan_.outlines[o].hole = signed_area(plan_.outlines[o].loop) * largest < 0.0;
    }
  }

  /// The zone is the smallest room of the plane that holds the sensor.
  void set_zone(std::uint32_t sensor, std::size_t first_outline) {
    std::size_t zone = first_outline + plan_.panels.size();  // of no room; differs from panel to panel
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t o = first_outline; o < plan_.outlines.size(); ++o) {
      const MapOutline& outline = plan_.outlines[o];
      if (outline.hole || !contains(outline, plan_.positions[sensor])) continue;
      plan_.inside[sensor] = 1;
      const double area = std::abs(signed_area(outline.loop));
      if (area < smallest) {
        smallest = area;
        zone = o + 1 + plan_.panels.size();
      }
    }
    plan_.zone[sensor] = static_cast<std::uint32_t>(zone);
  }

  const lighting::Sensors& sensors_;
  MapPlan& plan_;
};

}  // namespace

bool contains(const MapOutline& outline, const MapPoint& p) {
  if (!outline.box.contains(p)) return false;
  bool inside = false;
  for (std::size_t i = 0; i < outline.loop.size(); ++i) {
    const MapPoint& a = outline.loop[i];
    const MapPoint& b = outline.loop[(i + 1) % outline.loop.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

MapPlan lay_flat(const lighting::Sensors& sensors, double north_deg,
                 std::span<const std::array<mesh::Point, 2>> no_sky) {
  std::vector<Plane> planes = planes_of(sensors);
  for (const auto& line : no_sky) {
    if (const auto plane = plane_of_line(line, planes)) planes[*plane].no_sky.push_back(line);
  }
  for (std::size_t o = 0; o < sensors.outlines.size(); ++o) {
    if (sensors.outlines[o].size() < 3) continue;
    const auto plane = plane_of(sensors.outlines[o], planes);
    if (plane) planes[*plane].outlines.push_back(o);
  }
  for (Plane& plane : planes) drop_empty_outlines(sensors, plane);
  turn_if_on_end(sensors, planes);
  std::vector<MapBox> boxes;
  boxes.reserve(planes.size());
  for (const Plane& plane : planes) boxes.push_back(box_of(sensors, plane));
  const std::vector<MapPoint> shifts = arrange(boxes);
  MapPlan plan;
  PlanBuilder builder(sensors, plan);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    builder.add(planes[i], shifts[i], caption_of(planes[i], sensors, north_deg));
  }
  std::ranges::stable_sort(plan.no_sky, [](const auto& a, const auto& b) {
    return std::hypot(a[1].x - a[0].x, a[1].y - a[0].y) > std::hypot(b[1].x - b[0].x, b[1].y - b[0].y);
  });
  plan.seen_from_above = std::ranges::all_of(planes, level);
  const double north = north_deg * std::numbers::pi / 180.0;
  const mesh::Vector to_north{-std::sin(north), std::cos(north), 0.0};
  plan.north = {dot(planes.front().axes.u, to_north), dot(planes.front().axes.v, to_north)};
  return plan;
}

}  // namespace clerestory::io
