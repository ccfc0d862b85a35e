// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/shadow_regions.h"

#include <array>

namespace clerestory::mesh {

namespace {

/// Points of a polygon's outline lie inside of it by this share of their distance from its middle: not in what holds it.
constexpr double kInside = 0.01;
constexpr int kPointsAnEdge = 4;

/// Points that stand for a polygon, on the side that shines.
std::vector<Point> points_of(const ShadowSource& source, double lift) {
  Vector sum;
  double count = 0.0;
  const Point& first = source.outline[0][0];
  for (const Point& p : source.outline[0]) {
    sum = sum + (p - first);
    count += 1.0;
  }
  const Point middle = first + sum / count + lift * source.normal;
  std::vector<Point> points{middle};
  const std::vector<Point>& loop = source.outline[0];
  for (std::size_t i = 0; i < loop.size(); ++i) {
    for (int k = 0; k < kPointsAnEdge; ++k) {
      const Point p = loop[i] + (1.0 * k / kPointsAnEdge) * (loop[(i + 1) % loop.size()] - loop[i]);
      points.push_back(p + lift * source.normal + kInside * (middle - p));
    }
  }
  return points;
}

/// Rays from a place to what it faces of a source.
void add_segments(const ShadowSource& source, const Rays& rays, const Point& from, const Vector& normal,
                  std::vector<Segment>& segments) {
  const auto add = [&](const Point& to) {
    if (dot(to - from, normal) > 0.0) segments.push_back({from, to});
  };
  switch (source.kind) {
    case ShadowSource::Kind::kPoint:
      add(source.at);
      break;
    case ShadowSource::Kind::kDirection:
      add(from + (2.0 * rays.bounds().diagonal()) * source.towards);
      break;
    case ShadowSource::Kind::kPolygon: {
      const double front = dot(from - source.outline[0][0], source.normal);
      if (front <= 0.0 && !source.two_sided) return;
      for (const Point& p : points_of(source, front > 0.0 ? rays.offset_m() : -rays.offset_m())) add(p);
      break;
    }
  }
}

/// The place of the largest triangle of each patch of a face.
std::vector<const Triangle*> largest_triangles(const Triangulation& mesh, std::span<const Triangle> triangles) {
  std::vector<const Triangle*> largest;
  std::vector<double> areas;
  for (const Triangle& t : triangles) {
    if (t.patch >= largest.size()) {
      largest.resize(t.patch + 1, nullptr);
      areas.resize(t.patch + 1, -1.0);
    }
    const Point& a = mesh.vertices[t.vertices[0]];
    const double area = norm(cross(mesh.vertices[t.vertices[1]] - a, mesh.vertices[t.vertices[2]] - a));
    if (area <= areas[t.patch]) continue;
    areas[t.patch] = area;
    largest[t.patch] = &t;
  }
  return largest;
}

}  // namespace

Shade shade_at(const Rays& rays, std::span<const ShadowSource> sources, const Point& at, const Vector& normal) {
  std::vector<Segment> segments;
  for (const ShadowSource& source : sources) {
    add_segments(source, rays, at + rays.offset_m() * normal, normal, segments);
  }
  if (segments.empty()) return Shade::kNone;
  std::vector<float> passed(segments.size());
  rays.transmittance(segments, passed);
  std::size_t seen = 0;
  for (const float t : passed) seen += t > 0.0F ? 1 : 0;
  if (seen == segments.size()) return Shade::kLit;
  return seen == 0 ? Shade::kUmbra : Shade::kPenumbra;
}

std::vector<Shade> shade_patches(const Faces& faces, const Triangulation& mesh, const Rays& rays,
                                 std::span<const ShadowSource> sources) {
  std::vector<Shade> shades;
  for (std::size_t f = 0; f < faces.count(); ++f) {
    const std::span<const Triangle> triangles = mesh.of(FaceId(f));
    std::vector<std::array<Shade, 2>> of_patch;
    for (const Triangle* t : largest_triangles(mesh, triangles)) {
      of_patch.push_back({Shade::kNone, Shade::kNone});
      if (t == nullptr) continue;
      const Point& a = mesh.vertices[t->vertices[0]];
      const Vector to_middle = (mesh.vertices[t->vertices[1]] - a + (mesh.vertices[t->vertices[2]] - a)) / 3.0;
      const Vector& normal = faces.faces[f].frame.w;
      of_patch.back() = {shade_at(rays, sources, a + to_middle, normal),
                         shade_at(rays, sources, a + to_middle, -normal)};
    }
    for (const Triangle& t : triangles) {
      shades.push_back(of_patch[t.patch][0]);
      shades.push_back(of_patch[t.patch][1]);
    }
  }
  return shades;
}

}  // namespace clerestory::mesh
