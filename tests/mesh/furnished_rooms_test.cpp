// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of 200 random rooms with random furniture, turned at random, with the shadow lines of a lamp in them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "mesh/discontinuity_lines.h"
#include "mesh/faces.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::mesh {
namespace {

constexpr int kRooms = 200;

/// A room with boxes that stand on its floor, and perhaps on each other's place, and the corners of a lamp under its ceiling.
struct FurnishedRoom {
  explicit FurnishedRoom(std::uint64_t seed) : random(seed) {
    const Vector size{between(2.5, 8.0), between(2.5, 6.0), between(2.3, 3.5)};
    model = support::box_room(size.x, size.y, size.z);
    const int boxes = static_cast<int>(between(1.0, 6.0));
    for (int i = 0; i < boxes; ++i) add_box(size);
    const Point middle{between(0.3, 0.7) * size.x, between(0.3, 0.7) * size.y, size.z - 0.1};
    lamp = {middle + Vector{-0.5, -0.2, 0}, middle + Vector{0.5, -0.2, 0}, middle + Vector{0.5, 0.2, 0},
            middle + Vector{-0.5, 0.2, 0}};
    turn();
  }

  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }

  void add_box(const Vector& room) {
    const Vector size{between(0.2, 1.6), between(0.2, 1.0), between(0.2, 1.8)};
    mesh::Model box;
    support::add_box(box, {-0.5 * size.x, -0.5 * size.y, 0.0}, {0.5 * size.x, 0.5 * size.y, size.z}, {"wood", "box"});
    box = support::rotated(box, {0, 0, 1}, between(0.0, 1.0) < 0.5 ? 0.0 : between(0.0, 3.0));
    support::append(model, support::moved(box, {between(1.0, room.x - 1.0), between(1.0, room.y - 1.0), 0.0}));
  }

  /// Turns model and lamp alike.
  void turn() {
    const Vector axis = normalized(Vector{between(-1, 1), between(-1, 1), between(-1, 1)});
    const double angle = between(0.0, 2.0 * std::numbers::pi);
    model = support::rotated(model, axis, angle);
    Model corners;
    support::add_polygon(corners, lamp);
    corners = support::rotated(corners, axis, angle);
    lamp = corners.vertices;
  }

  std::mt19937_64 random;
  Model model;
  std::vector<Point> lamp;
};

void expect_conforming(const Faces& faces, const Triangulation& mesh) {
  const support::MeshFaults faults = support::mesh_faults(faces, mesh);
  EXPECT_EQ(faults.turned_or_empty, 0U);
  EXPECT_EQ(faults.edges_used_twice, 0U);
  EXPECT_EQ(faults.open_edges, 0U);
  EXPECT_EQ(faults.loose_vertices, 0U);
  EXPECT_LT(faults.outline_error, 1e-9);
  EXPECT_LT(faults.area_error, 1e-9);
}

TEST(FurnishedRooms, HaveConformingMeshesWithTheirShadowLines) {
  std::size_t lines_in_all = 0;
  for (std::uint64_t seed = 1; seed <= kRooms && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    FurnishedRoom room(seed);
    const Faces faces = build_faces(clean(room.model, {}));
    ShadowSource source;
    for (const Point& p : room.lamp) {
      source.outline.resize(1);
      source.outline[0].push_back(p - faces.origin);
    }
    source.normal = -normalized(cross(room.lamp[1] - room.lamp[0], room.lamp[2] - room.lamp[0]));
    std::vector<FaceLine> lines;
    for (const DiscontinuityLine& line : DiscontinuityFinder(faces).find(source, 0, 400).lines) {
      lines.push_back({line.face, line.ends});
    }
    lines_in_all += lines.size();
    expect_conforming(faces, faces.shape);
    MeshOptions options;
    options.lines = lines;
    options.line_distance_m = 0.01;
    expect_conforming(faces, mesh_faces(faces, options));
  }
  EXPECT_GT(lines_in_all, 20U * kRooms);
}

}  // namespace
}  // namespace clerestory::mesh
