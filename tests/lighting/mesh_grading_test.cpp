// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/mesh_grading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;

constexpr std::uint64_t kSeed = 12345;

/// A black floor of 4 m × 4 m, 1 m under a lamp of 0.2 m × 0.2 m, solved. Slats of 6 cm may hang half-way up, 12 cm from middle to middle.
struct LampOverFloor : test::Stage {
  static Study study(int slats) {
    mesh::Model model;
    support::add_quad(model, {-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, {"floor", "floor"});
    support::add_quad(model, {-0.1, -0.1, 1}, {-0.1, 0.1, 1}, {0.1, 0.1, 1}, {0.1, -0.1, 1}, {"lamp", "lamp"});
    for (int i = 0; i < slats; ++i) {
      const double x = 0.12 * i - 0.06 * slats;
      support::add_quad(model, {x, -1, 0.5}, {x + 0.06, -1, 0.5}, {x + 0.06, 1, 0.5}, {x, 1, 0.5}, {"slat", "slat"});
    }
    Study study = test::study_of(std::move(model), 0.0, {0.5, 0.5, 0.1});
    test::shine(test::material(study, "lamp"), 1000.0);
    return study;
  }
  explicit LampOverFloor(int slats = 0)
      : Stage(study(slats)),
        importance(solution, walks(kSeed)),
        direct(light_directly(solution, importance, 1e-4, kSeed, nobody)),
        transport(solve(solution, importance, direct, {.accuracy = 0.02, .seed = kSeed}, nobody)),
        local_pass(solution, transport.arrivals, transport.errors, direct.nodes, 0.02, 1.0) {}

  [[nodiscard]] GradedSizes graded(double size_m, const GradingOptions& options) {
    mesh = mesh::mesh_faces(scene.faces, {.max_size_m = size_m});
    std::vector<std::uint8_t> lit(2 * scene.faces.count(), 0);
    lit[solution.tree().face_side(root("floor")).index()] = 1;
    const std::vector<std::uint8_t> jumps(scene.faces.count(), 0);
    return graded_sizes(solution, local_pass, mesh, lit, jumps, options);
  }
  /// The least size of triangles of the floor whose middle is so far from the origin.
  [[nodiscard]] double least(const GradedSizes& sizes, double from_m, double to_m) const {
    double size = 1e9;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto& v = mesh.triangles[i].vertices;
      const Point a = mesh.vertices[v[0]] + scene.faces.origin;
      if (std::abs(a.z) > 1e-9) continue;
      const double distance = std::hypot(a.x, a.y);
      if (distance >= from_m && distance < to_m) size = std::min(size, sizes.longest_m[i]);
    }
    return size;
  }

  NoProgress nobody;
  Importance importance;
  DirectLight direct;
  Transport transport;
  LocalPass local_pass;
  mesh::Triangulation mesh;
};

TEST(MeshGrading, ElementsAreSmallWhereLightIsCurved) {
  LampOverFloor lamp;
  const GradedSizes sizes = lamp.graded(0.3, {.tolerance = 0.01, .darkest_lux = 1.0, .most = 1000000});
  EXPECT_FALSE(sizes.kept);
  // Light is E0 / (1 + r²)² about: its second derivative falls from 4 E0 to nothing, and less of it is tolerated further out.
  EXPECT_LT(2.0 * lamp.least(sizes, 0.0, 0.3), 0.3);
  EXPECT_LT(lamp.least(sizes, 0.0, 0.3), lamp.least(sizes, 0.4, 0.6));
}

TEST(MeshGrading, AMeshFineEnoughIsKept) {
  LampOverFloor lamp;
  EXPECT_TRUE(lamp.graded(0.1, {.tolerance = 0.05, .darkest_lux = 1.0, .most = 1000000}).kept);
}

TEST(MeshGrading, BelowSlatsTheMiddlesOfTrianglesTellWhatEdgesMiss) {
  LampOverFloor lamp(10);
  GradingOptions options{.tolerance = 0.05, .darkest_lux = 1.0, .most = 1000000};
  const GradedSizes by_edges = lamp.graded(0.3, options);
  options.closely = true;
  const GradedSizes closely = lamp.graded(0.3, options);
  std::size_t smaller = 0;
  for (std::size_t i = 0; i < closely.longest_m.size(); ++i) {
    EXPECT_LE(closely.longest_m[i], by_edges.longest_m[i]);
    smaller += closely.longest_m[i] < by_edges.longest_m[i] ? 1 : 0;
  }
  EXPECT_GT(smaller, 0U);
}

TEST(MeshGrading, SizesGrowAlikeWhereThereMayBeFewTriangles) {
  LampOverFloor lamp;
  const GradedSizes many = lamp.graded(0.3, {.tolerance = 0.001, .darkest_lux = 1.0, .most = 1000000});
  const GradedSizes few = lamp.graded(0.3, {.tolerance = 0.001, .darkest_lux = 1.0, .most = 2000});
  const double growth = few.longest_m[0] / many.longest_m[0];
  EXPECT_GT(growth, 1.1);
  for (std::size_t i = 0; i < many.longest_m.size(); ++i) {
    if (std::isinf(many.longest_m[i])) continue;
    EXPECT_NEAR(few.longest_m[i], growth * many.longest_m[i], 1e-9);
  }
}

}  // namespace
}  // namespace clerestory::lighting
