// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/surface_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace clerestory::support {

using mesh::FaceId;
using mesh::Faces;
using mesh::Point;
using mesh::Triangle;
using mesh::Triangulation;
using mesh::Vector;

namespace {

std::array<Point, 3> corners(const Triangulation& mesh, const Triangle& t) {
  return {mesh.vertices[t.vertices[0]], mesh.vertices[t.vertices[1]], mesh.vertices[t.vertices[2]]};
}

/// The part of a convex polygon on the inward side of the plane through a.
std::vector<Point> clip(const std::vector<Point>& polygon, const Point& a, const Vector& inward) {
  std::vector<Point> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& p = polygon[i];
    const Point& q = polygon[(i + 1) % polygon.size()];
    const double dp = dot(p - a, inward);
    const double dq = dot(q - a, inward);
    if (dp >= 0.0) result.push_back(p);
    if ((dp > 0.0) != (dq > 0.0) && dp != dq) result.push_back(p + (dp / (dp - dq)) * (q - p));
  }
  return result;
}

double perimeter(const Faces& faces, const mesh::Face& face) {
  double sum = 0.0;
  for (const auto& loop : face.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      sum += norm(faces.shape.vertices[loop[(i + 1) % loop.size()]] - faces.shape.vertices[loop[i]]);
    }
  }
  return sum;
}

/// Whether a point lies on a segment, off its ends.
bool is_inside(const Point& p, const Point& a, const Point& b) {
  const Vector along = b - a;
  const double length = norm(along);
  const double at = dot(p - a, along) / length;
  return at > 1e-9 && at < length - 1e-9 && norm(p - (a + (at / length) * along)) < 1e-9;
}

/// The faults of one face's edges.
void check_edges(const Faces& faces, const Triangulation& mesh, FaceId id, MeshFaults& faults) {
  std::map<std::array<std::uint32_t, 2>, bool> edges;  // directed, whether constrained
  for (const Triangle& t : mesh.of(id)) {
    for (std::size_t k = 0; k < 3; ++k) {
      const bool constrained = (t.constrained >> k & 1U) != 0;
      if (!edges.insert({{t.vertices[k], t.vertices[(k + 1) % 3]}, constrained}).second) ++faults.edges_used_twice;
    }
  }
  double outline = 0.0;
  std::vector<std::array<std::uint32_t, 2>> single;
  for (const auto& [edge, constrained] : edges) {
    if (edges.contains({edge[1], edge[0]})) continue;
    if (!constrained) ++faults.open_edges;
    outline += norm(mesh.vertices[edge[1]] - mesh.vertices[edge[0]]);
    single.push_back(edge);
  }
  // A vertex inside of an edge would be on one that its neighbour does not share.
  for (const auto& edge : single) {
    for (const auto& other : single) {
      if (is_inside(mesh.vertices[other[0]], mesh.vertices[edge[0]], mesh.vertices[edge[1]])) ++faults.loose_vertices;
    }
  }
  const double expected = perimeter(faces, faces.faces[id.index()]);
  faults.outline_error = std::max(faults.outline_error, std::abs(outline - expected) / expected);
}

double reach(const std::vector<Point>& polygon, const Point& a, const Vector& direction) {
  double most = 0.0;
  for (const Point& p : polygon) most = std::max(most, dot(p - a, direction));
  return most;
}

}  // namespace

mesh::MaterialId material(const Faces& faces, std::string_view name) {
  const auto found = std::find(faces.material_names.begin(), faces.material_names.end(), name);
  if (found == faces.material_names.end()) throw std::invalid_argument("no material " + std::string(name));
  return mesh::MaterialId(static_cast<std::size_t>(found - faces.material_names.begin()));
}

std::vector<FaceId> faces_of(const Faces& faces, std::string_view name) {
  const mesh::MaterialId wanted = material(faces, name);
  std::vector<FaceId> found;
  for (std::size_t f = 0; f < faces.count(); ++f) {
    if (faces.faces[f].material == wanted) found.emplace_back(f);
  }
  return found;
}

MeshFaults mesh_faults(const Faces& faces, const Triangulation& mesh) {
  MeshFaults faults;
  for (std::size_t f = 0; f < faces.count(); ++f) {
    const FaceId id(f);
    for (const Triangle& t : mesh.of(id)) {
      const auto c = corners(mesh, t);
      if (!(dot(cross(c[1] - c[0], c[2] - c[0]), faces.faces[f].frame.w) > 0.0)) ++faults.turned_or_empty;
    }
    check_edges(faces, mesh, id, faults);
    const double expected = faces.faces[f].area_m2;
    faults.area_error = std::max(faults.area_error, std::abs(area_of(mesh, mesh.of(id)) - expected) / expected);
  }
  return faults;
}

double area_of(const Triangulation& mesh, std::span<const Triangle> triangles) {
  double sum = 0.0;
  for (const Triangle& t : triangles) {
    const auto [a, b, c] = corners(mesh, t);
    sum += 0.5 * norm(cross(b - a, c - a));
  }
  return sum;
}

std::size_t region_count(const Triangulation& mesh, FaceId face) {
  std::size_t count = 0;
  for (const Triangle& t : mesh.of(face)) count = std::max<std::size_t>(count, t.region + 1);
  return count;
}

std::size_t unbalanced_edges(const Faces& faces, std::string_view part) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (std::size_t f = 0; f < faces.count(); ++f) {
    if (faces.part_names[faces.faces[f].part.index()] != part) continue;
    for (const Triangle& t : faces.shape.of(FaceId(f))) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t.vertices[k];
        const std::uint32_t b = t.vertices[(k + 1) % 3];
        balance[std::minmax(a, b)] += a < b ? 1 : -1;
      }
    }
  }
  return static_cast<std::size_t>(
      std::count_if(balance.begin(), balance.end(), [](const auto& edge) { return edge.second != 0; }));
}

std::size_t vertices_on_edges(const Faces& faces, double distance) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> edges;
  for (const Triangle& t : faces.shape.triangles) {
    for (std::size_t k = 0; k < 3; ++k) edges[std::minmax(t.vertices[k], t.vertices[(k + 1) % 3])] = true;
  }
  std::size_t count = 0;
  for (const auto& [edge, unused] : edges) {
    const Point& a = faces.shape.vertices[edge.first];
    const Vector d = faces.shape.vertices[edge.second] - a;
    for (std::uint32_t v = 0; v < faces.shape.vertices.size(); ++v) {
      if (v == edge.first || v == edge.second) continue;
      const Vector offset = faces.shape.vertices[v] - a;
      const double t = dot(offset, d) / dot(d, d);
      if (t > 0.0 && t < 1.0 && norm(offset - t * d) <= distance) ++count;
    }
  }
  return count;
}

std::size_t triangles_cut(const Triangulation& mesh, FaceId face, const Point& from, const Point& to, double distance) {
  const Vector along = normalized(to - from);
  std::size_t count = 0;
  for (const Triangle& t : mesh.of(face)) {
    const auto [a, b, c] = corners(mesh, t);
    const Vector normal = normalized(cross(b - a, c - a));
    if (std::abs(dot(from - a, normal)) > 1e-4 || std::abs(dot(to - a, normal)) > 1e-4) continue;
    const Vector across = cross(normal, along);
    const std::vector<Point> within = clip(clip({a, b, c}, from, along), to, -along);
    if (reach(within, from, across) > distance && reach(within, from, -across) > distance) ++count;
  }
  return count;
}

}  // namespace clerestory::support
