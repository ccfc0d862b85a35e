// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/contact_sectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "mesh/box_tree.h"
#include "mesh/planar.h"

namespace clerestory::mesh {

namespace {

/// A point this near to a contact was put on it [m].
constexpr double kOn = 1e-7;
/// Directions that differ by less are those of one line [rad].
constexpr double kSameDirection = 1e-6;

/// The two triangles of an edge of a face's shape: their regions, and how many there are.
struct EdgeUse {
  std::array<std::uint32_t, 2> regions{};
  std::size_t count = 0;
};

using Segment2 = std::array<Point2, 2>;

/// The edges of a face that are contacts or boundary; none where every contact parts regions.
std::vector<Segment2> edges_of(const Faces& faces, FaceId face, const PlaneCoordinates& plane) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, EdgeUse> uses;
  for (const Triangle& t : faces.shape.of(face)) {
    for (std::size_t k = 0; k < 3; ++k) {
      if ((t.constrained >> k & 1U) == 0) continue;
      EdgeUse& use = uses[std::minmax(t.vertices[k], t.vertices[(k + 1) % 3])];
      if (use.count < 2) use.regions[use.count++] = t.region;
    }
  }
  const bool within = std::any_of(uses.begin(), uses.end(), [](const auto& entry) {
    return entry.second.count == 2 && entry.second.regions[0] == entry.second.regions[1];
  });
  std::vector<Segment2> edges;
  if (!within) return edges;
  for (const auto& [ends, use] : uses) {
    const auto& v = faces.shape.vertices;
    edges.push_back({plane.project(v[ends.first]), plane.project(v[ends.second])});
  }
  return edges;
}

double angle(const Point2& from, const Point2& to) { return std::atan2(to.y - from.y, to.x - from.x); }

/// Adds the directions in which an edge leaves a point: none where it passes by, two where the point is between its ends.
void add_directions(const Segment2& edge, const Point2& p, std::vector<double>& directions) {
  const double length = std::hypot(edge[1].x - edge[0].x, edge[1].y - edge[0].y);
  if (length <= 0.0 || std::abs(doubled_area(edge[0], edge[1], p)) > kOn * length) return;
  const double along =
      ((p.x - edge[0].x) * (edge[1].x - edge[0].x) + (p.y - edge[0].y) * (edge[1].y - edge[0].y)) / length;
  if (along < -kOn || along > length + kOn) return;
  if (along < length - kOn) directions.push_back(angle(edge[0], edge[1]));
  if (along > kOn) directions.push_back(angle(edge[1], edge[0]));
}

}  // namespace

struct ContactSectors::Data {
  struct OfFace {
    PlaneCoordinates plane;
    std::vector<Segment2> edges;
    BoxTree tree;
  };
  std::vector<OfFace> faces;
};

ContactSectors::ContactSectors(const Faces& faces) : data_(std::make_unique<Data>()) {
  for (std::size_t f = 0; f < faces.count(); ++f) {
    Data::OfFace& of_face = data_->faces.emplace_back();
    of_face.plane = {faces.faces[f].origin, faces.faces[f].frame};
    of_face.edges = edges_of(faces, FaceId(f), of_face.plane);
    std::vector<Box> boxes;
    for (const Segment2& edge : of_face.edges) {
      Box box;
      for (const Point2& p : edge) box.add(Point{p.x, p.y, 0.0});
      boxes.push_back(grown(box, kOn));
    }
    of_face.tree = BoxTree(boxes);
  }
}

ContactSectors::~ContactSectors() = default;
ContactSectors::ContactSectors(ContactSectors&&) noexcept = default;
ContactSectors& ContactSectors::operator=(ContactSectors&&) noexcept = default;

std::uint32_t ContactSectors::at(FaceId face, const Point& point, const Point& place) const {
  const Data::OfFace& of_face = data_->faces[face.index()];
  if (of_face.edges.empty()) return 0;
  const Point2 p = of_face.plane.project(point);
  Box here;
  here.add(Point{p.x, p.y, 0.0});
  std::vector<double> directions;
  of_face.tree.visit([&](const Box& box) { return overlap(box, here); },
                     [&](std::uint32_t i) { add_directions(of_face.edges[i], p, directions); });
  if (directions.size() < 2) return 0;
  std::sort(directions.begin(), directions.end());
  const auto same = [](double a, double b) { return std::abs(a - b) < kSameDirection; };
  directions.erase(std::unique(directions.begin(), directions.end(), same), directions.end());
  const double towards = angle(p, of_face.plane.project(place));
  const auto before = std::lower_bound(directions.begin(), directions.end(), towards) - directions.begin();
  return static_cast<std::uint32_t>(before) % static_cast<std::uint32_t>(directions.size());
}

}  // namespace clerestory::mesh
