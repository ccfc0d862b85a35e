// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "mesh/discontinuity_lines.h"
#include "mesh/faces.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::mesh {
namespace {

using support::area_of;
using support::region_count;

Faces faces_from(const Model& model) { return build_faces(clean(model, {})); }

double longest_edge(const Triangulation& mesh) {
  double longest = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, norm(mesh.vertices[t.vertices[(k + 1) % 3]] - mesh.vertices[t.vertices[k]]));
    }
  }
  return longest;
}

void expect_same_areas(const Faces& faces, const Triangulation& mesh) {
  ASSERT_EQ(mesh.starts.size(), faces.count() + 1);
  for (std::size_t f = 0; f < faces.count(); ++f) {
    const Face& face = faces.faces[f];
    EXPECT_NEAR(area_of(mesh, mesh.of(FaceId(f))), face.area_m2, 1e-9 * face.area_m2);
    EXPECT_EQ(region_count(mesh, FaceId(f)), region_count(faces.shape, FaceId(f)));
    for (const Triangle& t : mesh.of(FaceId(f))) {
      const Point& a = mesh.vertices[t.vertices[0]];
      const Vector doubled = cross(mesh.vertices[t.vertices[1]] - a, mesh.vertices[t.vertices[2]] - a);
      EXPECT_GT(dot(doubled, face.frame.w), 0.0);
    }
  }
}

TEST(ElementMesh, KeepsItsBoundsAndTheArea) {
  for (const double size : {4.0, 1.0, 0.3}) {
    const Faces faces = faces_from(support::rotated(support::l_room(), {1, 2, 3}, 0.77));
    MeshReport report;
    const Triangulation mesh = mesh_faces(faces, {.max_size_m = size}, &report);
    EXPECT_LE(longest_edge(mesh), size * (1 + 1e-9));
    EXPECT_GE(report.min_angle_deg, 20.0 - 0.01);
    EXPECT_EQ(report.small_angles, 0U);
    EXPECT_EQ(report.triangles, mesh.triangles.size());
    expect_same_areas(faces, mesh);
  }
}

TEST(ElementMesh, KeepsContactsAndRegions) {
  Model model = support::two_rooms_with_thin_wall({.thickness_m = 0.1});
  support::add_table(model, {0.5, 0.7, 0});
  const Faces faces = faces_from(support::rotated(model, {0, 0, 1}, 0.3));
  MeshReport report;
  const Triangulation mesh = mesh_faces(faces, {.max_size_m = 0.5}, &report);
  expect_same_areas(faces, mesh);
  EXPECT_EQ(report.small_angles, 0U);
  for (std::size_t f = 0; f < faces.count(); ++f) {
    for (const Triangle& t : faces.shape.of(FaceId(f))) {
      for (std::size_t k = 0; k < 3; ++k) {
        if ((t.constrained >> k & 1U) == 0) continue;
        const Point& from = faces.shape.vertices[t.vertices[k]];
        const Point& to = faces.shape.vertices[t.vertices[(k + 1) % 3]];
        EXPECT_EQ(support::triangles_cut(mesh, FaceId(f), from, to), 0U);
      }
    }
  }
}

TEST(ElementMesh, FacesThatAreNotRefinedHaveTheFewestTrianglesAndKeepTheirRegions) {
  // A strip of 10 cm between contacts on a wall of 6 m: the angle bound would cut it into pieces of its width.
  const Faces faces = faces_from(support::two_rooms_with_thin_wall({.thickness_m = 0.1}));
  const FaceId floor = support::faces_of(faces, "floor").at(0);
  std::vector<std::uint8_t> refined(faces.count(), 1);
  refined[floor.index()] = 0;
  const Triangulation mesh = mesh_faces(faces, {.max_size_m = 0.5, .refined = refined});
  const Triangulation all = mesh_faces(faces, {.max_size_m = 0.5});
  expect_same_areas(faces, mesh);
  EXPECT_EQ(mesh.of(floor).size(), faces.shape.of(floor).size());
  EXPECT_GT(all.of(floor).size(), 5 * mesh.of(floor).size());
  std::set<std::uint32_t> regions;
  for (const Triangle& t : mesh.of(floor)) regions.insert(t.region);
  EXPECT_EQ(regions.size(), 3U);
  for (std::size_t f = 0; f < faces.count(); ++f) {
    if (refined[f] == 0) continue;
    EXPECT_EQ(mesh.of(FaceId(f)).size(), all.of(FaceId(f)).size());
  }
}

TEST(ElementMesh, RegionsLieWhereTheShapeHasThem) {
  const Faces faces = faces_from(support::two_rooms_with_thin_wall());
  const FaceId floor = support::faces_of(faces, "floor").at(0);
  const Triangulation mesh = mesh_faces(faces, {.max_size_m = 1.0});
  std::array<int, 2> side_of_region{0, 0};
  const auto side = [&](const Triangulation& triangulation, const Triangle& t) {
    double x = 0.0;
    for (const std::uint32_t v : t.vertices) x += triangulation.vertices[v].x + faces.origin.x;
    return x / 3.0 < 3.0 ? -1 : 1;
  };
  for (const Triangle& t : faces.shape.of(floor)) side_of_region.at(t.region) = side(faces.shape, t);
  EXPECT_EQ(side_of_region[0], -side_of_region[1]);
  for (const Triangle& t : mesh.of(floor)) EXPECT_EQ(side(mesh, t), side_of_region.at(t.region));
}

TEST(ElementMesh, ConstrainedFlagsFollowTheSplits) {
  Model model = support::box_room(6, 4, 3);
  support::add_quad(model, {3, 1, 0}, {3, 3, 0}, {3, 3, 2}, {3, 1, 2}, {"partition", "partition"});
  const Faces faces = faces_from(model);
  const FaceId floor = support::faces_of(faces, "floor").at(0);
  const Triangulation mesh = mesh_faces(faces, {.max_size_m = 0.4});
  double length = 0.0;
  for (const Triangle& t : mesh.of(floor)) {
    for (std::size_t k = 0; k < 3; ++k) {
      if ((t.constrained >> k & 1U) == 0) continue;
      length += norm(mesh.vertices[t.vertices[(k + 1) % 3]] - mesh.vertices[t.vertices[k]]);
    }
  }
  EXPECT_NEAR(length, 2 * (6.0 + 4.0) + 2 * 2.0, 1e-9);  // the outline once, the contact from both sides
}

/// The lines that a lamp makes through a plate on a floor, turned so that nothing is in line with anything.
std::vector<FaceLine> shadow_lines(const Faces& faces) {
  ShadowSource lamp;
  lamp.normal = {0, 0, -1};
  lamp.outline = {{{-0.3, -0.2, 2.0}, {0.5, -0.1, 2.0}, {0.4, 0.3, 2.0}, {-0.4, 0.2, 2.0}}};
  for (Point& p : lamp.outline[0]) p = p - faces.origin;
  std::vector<FaceLine> lines;
  for (const DiscontinuityLine& l : DiscontinuityFinder(faces).find(lamp, 0).lines) lines.push_back({l.face, l.ends});
  return lines;
}

TEST(ElementMesh, TrianglesDoNotCrossLines) {
  Model model;
  support::add_quad(model, {-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}, {"floor", "floor"});
  support::add_quad(model, {-0.5, -0.4, 1}, {0.5, -0.4, 1}, {0.5, 0.4, 1}, {-0.5, 0.4, 1}, {"plate", "plate"});
  support::add_quad(model, {1, -1, 0}, {1, 1, 0}, {1, 1, 0.5}, {1, -1, 0.5}, {"screen", "screen"});
  const Faces faces = faces_from(model);
  const FaceId floor = support::faces_of(faces, "floor").at(0);
  const std::vector<FaceLine> lines = shadow_lines(faces);
  ASSERT_GT(lines.size(), 30U);
  MeshOptions options;
  options.lines = lines;
  MeshReport report;
  const Triangulation mesh = mesh_faces(faces, options, &report);
  expect_same_areas(faces, mesh);
  EXPECT_EQ(report.lines, lines.size());
  EXPECT_EQ(report.faces_with_fewer_lines, 0U);
  EXPECT_LT(10 * report.small_angles, report.triangles);
  EXPECT_LT(10 * (report.small_angles - report.small_input_angles), report.small_angles);
  for (const FaceLine& line : lines) {
    EXPECT_EQ(support::triangles_cut(mesh, line.face, line.ends[0], line.ends[1], 1.5e-3), 0U);
  }
  std::set<std::uint32_t> patches;
  for (const Triangle& t : mesh.of(floor)) patches.insert(t.patch);
  EXPECT_GT(patches.size(), 10U);
  EXPECT_EQ(support::region_count(mesh, floor), support::region_count(faces.shape, floor));
}

TEST(ElementMesh, SizesMayDifferFromPlaceToPlace) {
  Model model;
  support::add_polygon(model, {{0, 0, 0}, {8, 0, 0}, {8, 4, 0}, {0, 4, 0}});
  const Faces faces = faces_from(model);
  MeshOptions options;
  options.max_size_m = 2.0;
  options.size_at = [&](FaceId, const Point& p) { return p.x + faces.origin.x < 1.0 ? 0.2 : 2.0; };
  const Triangulation mesh = mesh_faces(faces, options);
  expect_same_areas(faces, mesh);
  std::size_t coarse = 0;
  for (const Triangle& t : mesh.triangles) {
    double longest = 0.0;
    double middle = faces.origin.x;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& p = mesh.vertices[t.vertices[k]];
      longest = std::max(longest, norm(mesh.vertices[t.vertices[(k + 1) % 3]] - p));
      middle += p.x / 3.0;
    }
    EXPECT_LE(longest, middle < 1.0 ? 0.2 : 2.0);
    coarse += longest > 0.7 ? 1 : 0;
  }
  EXPECT_GT(coarse, 5U);
}

TEST(ElementMesh, FacesThatAreNotWantedAreLeftOut) {
  Model model = support::box_room(4, 5, 3);
  const Faces faces = faces_from(model);
  std::vector<std::uint8_t> wanted(faces.count(), 0);
  wanted[0] = 1;
  MeshOptions options;
  options.wanted = wanted;
  const Triangulation mesh = mesh_faces(faces, options);
  ASSERT_EQ(mesh.starts.size(), faces.count() + 1);
  for (std::size_t f = 0; f < faces.count(); ++f) EXPECT_EQ(mesh.of(FaceId(f)).empty(), f != 0);
}

TEST(ElementMesh, EndsAtSmallInputAnglesAndCountsThem) {
  Model model;
  support::add_triangle(model, {0, 0, 0}, {10, 0, 0}, {10, 0.5, 0});
  support::add_polygon(model, {{0, 5, 0}, {10, 5, 0}, {0, 5.2, 0}, {10, 6, 0}, {-1, 6, 0}});
  const Faces faces = faces_from(model);
  MeshReport report;
  const Triangulation mesh = mesh_faces(faces, {.max_size_m = 1.0}, &report);
  expect_same_areas(faces, mesh);
  EXPECT_GT(report.small_angles, 0U);
  EXPECT_EQ(report.small_angles, report.small_input_angles);
  EXPECT_LT(mesh.triangles.size(), 3000U);
}

TEST(ElementMesh, GivesUpOnAngleBoundsThatNeedTooManyElements) {
  Model model;  // a frame of 1 mm round a wall of 10 m
  support::add_polygon(model, {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}, {},
                       {{{0.001, 0.001, 0}, {9.999, 0.001, 0}, {9.999, 9.999, 0}, {0.001, 9.999, 0}}});
  const Faces faces = faces_from(model);
  const Triangulation mesh = mesh_faces(faces, {});
  expect_same_areas(faces, mesh);
  EXPECT_LT(mesh.triangles.size(), 5000U);
}

TEST(ElementMesh, StripsNarrowerThanLightAsksForKeepTheirTriangles) {
  Model model;
  support::add_polygon(model, {{0, 0, 0}, {0.5, 0, 0}, {0.5, 0, 0.0001}, {0, 0, 0.0001}});
  support::add_polygon(model, {{0, 1, 0}, {0.5, 1, 0}, {0.5, 1, 0.01}, {0, 1, 0.01}});
  const Faces faces = faces_from(model);
  const Triangulation mesh = mesh_faces(faces, {});
  expect_same_areas(faces, mesh);
  EXPECT_EQ(mesh.of(FaceId(0U)).size(), 2U);
  EXPECT_GT(mesh.of(FaceId(1U)).size(), 20U);
}

}  // namespace
}  // namespace clerestory::mesh
