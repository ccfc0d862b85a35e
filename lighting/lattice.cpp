// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "lighting/grid_layout.h"

namespace clerestory::lighting {

namespace {

using mesh::Point;
using mesh::Vector;

/// How far a point may lie beside its place in the lattice, in steps: files print few digits.
constexpr double kBeside = 0.05;
/// How far normals may differ, and points lie off their plane in steps.
constexpr double kAlike = 1e-3;

/// One axis of a lattice through the first point.
struct Steps {
  Vector along;  ///< unit
  double step = 0.0;
  std::vector<long> place;  ///< [points]
};

/// Whole steps along a unit vector, or nothing when the points do not keep to them.
/// @param guess  about the length of a step [m]
std::optional<Steps> whole_steps(const std::vector<Point>& points, const Vector& along, double guess) {
  std::vector<double> way;
  way.reserve(points.size());
  for (const Point& p : points) way.push_back(mesh::dot(p - points.front(), along));
  const auto [low, high] = std::ranges::minmax(way);
  const double count = std::round((high - low) / guess);
  if (!(count >= 1.0 && count <= static_cast<double>(points.size()))) return {};
  // The whole extent tells the step better than one step of few digits.
  Steps steps{along, (high - low) / count, {}};
  for (const double w : way) {
    const double place = std::round((w - low) / steps.step);
    if (std::abs((w - low) / steps.step - place) > kBeside) return {};
    steps.place.push_back(static_cast<long>(place));
  }
  return steps;
}

bool in_one_plane(const std::vector<Point>& points, const std::vector<Vector>& normals, double step) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (mesh::norm(normals[i] - normals.front()) > kAlike) return false;
    if (std::abs(mesh::dot(points[i] - points.front(), normals.front())) > kAlike * step) return false;
  }
  return true;
}

/// The smallest way across that any point lies off the line of the first two.
double smallest_way(const std::vector<Point>& points, const Vector& across, double least) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Point& p : points) {
    const double way = std::abs(mesh::dot(p - points.front(), across));
    if (way > least) smallest = std::min(smallest, way);
  }
  return smallest;
}

bool fills_lattice(const Steps& a, const Steps& b) {
  std::set<std::pair<long, long>> places;
  for (std::size_t i = 0; i < a.place.size(); ++i) places.emplace(a.place[i], b.place[i]);
  const double whole = static_cast<double>(*std::ranges::max_element(a.place) + 1) *
                       static_cast<double>(*std::ranges::max_element(b.place) + 1);
  return places.size() == a.place.size() && 2.0 * static_cast<double>(places.size()) >= whole;
}

}  // namespace

std::vector<std::array<Point, 4>> lattice_cells(const std::vector<Point>& points, const std::vector<Vector>& normals) {
  if (points.size() < 4) return {};
  const Vector first = points[1] - points[0];
  const double guess = mesh::norm(first);
  if (!(guess > 0.0) || !in_one_plane(points, normals, guess)) return {};
  const Vector u = first / guess;
  const Vector v = mesh::normalized(mesh::cross(normals.front(), u));
  const double across = smallest_way(points, v, kBeside * guess);
  if (!std::isfinite(across)) return {};
  const auto a = whole_steps(points, u, guess);
  const auto b = whole_steps(points, v, across);
  if (!a || !b || !fills_lattice(*a, *b)) return {};

  const Vector hu = 0.5 * a->step * u;
  const Vector hv = 0.5 * b->step * v;
  std::vector<std::array<Point, 4>> cells;
  cells.reserve(points.size());
  for (const Point& p : points) cells.push_back({p - hu - hv, p + hu - hv, p + hu + hv, p - hu + hv});
  return cells;
}

}  // namespace clerestory::lighting
