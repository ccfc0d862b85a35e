// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/spaces.h"

#include <algorithm>
#include <cmath>

#include "mesh/planar.h"

namespace clerestory::mesh {

namespace {

/// Where the divergence theorem and the columns differ by more than this, the boundary does not close.
constexpr double kAgreement = 0.05;
/// Planes steeper than this cut no column [cosine].
constexpr double kUpright = 1e-6;

/// One planar polygon of a boundary, in local coordinates.
struct Sheet {
  Point at;
  Vector doubled_area;  ///< Newell's, all loops together
  std::vector<PlanarOutline::Segment> plan;
  Box box;
};

std::vector<Sheet> sheets_of(const Space& space, const Vector& origin) {
  std::vector<Sheet> sheets;
  const Model& model = space.boundary;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    Sheet sheet;
    for (std::size_t l = 0; l < model.loop_count(p); ++l) {
      const auto loop = model.loop(p, l);
      Vector sum;
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Point a = model.vertices[loop[k]] - origin;
        const Point b = model.vertices[loop[(k + 1) % loop.size()]] - origin;
        if (l == 0 && k == 0) sheet.at = a;
        sum = sum + cross(a - sheet.at, b - sheet.at);
        sheet.plan.push_back({Point2{a.x, a.y}, Point2{b.x, b.y}});
        sheet.box.add(a);
      }
      // A hole takes away, whichever way it is wound.
      const bool adds = l == 0 || dot(sum, sheet.doubled_area) < 0.0;
      sheet.doubled_area = adds ? sheet.doubled_area + sum : sheet.doubled_area - sum;
    }
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

/// Even-odd: holes count whichever way they are wound.
bool holds(const Sheet& sheet, double x, double y) {
  bool inside = false;
  for (const auto& [a, b] : sheet.plan) {
    if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

struct Crossing {
  std::uint32_t column;
  float z;
};

void cross_columns(const Sheet& sheet, const Raster& raster, std::vector<Crossing>& crossings) {
  const double length = norm(sheet.doubled_area);
  if (!(std::abs(sheet.doubled_area.z) > kUpright * length)) return;
  const auto cells = [&](double low, double high, double origin, std::uint32_t count) {
    const double most = static_cast<double>(count);
    return std::pair(static_cast<std::uint32_t>(std::clamp(std::floor((low - origin) / raster.cell_m), 0.0, most)),
                     static_cast<std::uint32_t>(std::clamp(std::ceil((high - origin) / raster.cell_m), 0.0, most)));
  };
  const auto [i0, i1] = cells(sheet.box.low.x, sheet.box.high.x, raster.low_x, raster.nx);
  const auto [j0, j1] = cells(sheet.box.low.y, sheet.box.high.y, raster.low_y, raster.ny);
  const Vector n = sheet.doubled_area;
  for (std::uint32_t j = j0; j < j1; ++j) {
    for (std::uint32_t i = i0; i < i1; ++i) {
      const std::uint32_t c = raster.column(i, j);
      const double x = raster.x(c);
      const double y = raster.y(c);
      if (!holds(sheet, x, y)) continue;
      const double z = sheet.at.z - (n.x * (x - sheet.at.x) + n.y * (y - sheet.at.y)) / n.z;
      crossings.push_back({c, static_cast<float>(z)});
    }
  }
}

/// Area of the lower side of a closed boundary in plan: half of all that is level, whichever way it is wound.
double plan_area(const std::vector<Sheet>& sheets) {
  double sum = 0.0;
  for (const Sheet& s : sheets) sum += 0.25 * std::abs(s.doubled_area.z);
  return sum;
}

double enclosed_volume(const std::vector<Sheet>& sheets) {
  double sum = 0.0;
  for (const Sheet& s : sheets) sum += dot(s.at - sheets.front().at, s.doubled_area) / 6.0;
  return std::abs(sum);
}

/// Area and volume as columns tell them.
struct Counted {
  double area_m2 = 0.0;
  double volume_m3 = 0.0;
};

}  // namespace

std::vector<RoomColumn> space_columns(std::span<const Space> spaces, const Raster& raster, const Vector& origin) {
  std::vector<RoomColumn> columns;
  for (std::uint32_t k = 0; k < spaces.size(); ++k) {
    std::vector<Crossing> crossings;
    for (const Sheet& sheet : sheets_of(spaces[k], origin)) cross_columns(sheet, raster, crossings);
    std::ranges::sort(crossings, {}, [](const Crossing& c) { return std::pair(c.column, c.z); });
    for (std::size_t first = 0; first < crossings.size();) {
      std::size_t last = first;
      while (last < crossings.size() && crossings[last].column == crossings[first].column) ++last;
      const std::size_t count = last - first;
      // An odd number: the boundary does not close; from the lowest to the highest is the best guess.
      const std::size_t pairs = count % 2 == 0 ? count / 2 : (count > 1 ? 1 : 0);
      for (std::size_t p = 0; p < pairs; ++p) {
        const float low = crossings[first + 2 * p].z;
        const float high = count % 2 == 0 ? crossings[first + 2 * p + 1].z : crossings[last - 1].z;
        columns.push_back({crossings[first].column, k, low, high, low});
      }
      first = last;
    }
  }
  return columns;
}

std::vector<Room> stated_rooms(std::span<const Space> spaces, const Raster& raster, std::span<const RoomColumn> columns,
                               const Vector& origin) {
  std::vector<Counted> counted(spaces.size());
  for (const RoomColumn& c : columns) {
    const double area = raster.cell_m * raster.cell_m;
    counted[c.room].area_m2 += area;
    counted[c.room].volume_m3 += area * (c.ceiling - c.floor);
  }
  std::vector<Room> rooms;
  for (std::size_t k = 0; k < spaces.size(); ++k) {
    const auto sheets = sheets_of(spaces[k], origin);
    Room room;
    room.name = spaces[k].name;
    room.stated = true;
    for (const Sheet& s : sheets) room.box.add(s.box);
    const double volume = sheets.empty() ? 0.0 : enclosed_volume(sheets);
    const bool closes = std::abs(volume - counted[k].volume_m3) <= kAgreement * volume;
    room.volume_m3 = closes ? volume : counted[k].volume_m3;
    room.floor_area_m2 = closes ? plan_area(sheets) : counted[k].area_m2;
    rooms.push_back(std::move(room));
  }
  return rooms;
}

}  // namespace clerestory::mesh
