// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/limit_surface.h"

#include <gtest/gtest.h>

#include "tests/support/cages.h"

namespace clerestory {
namespace {

using mesh::LimitSurface;
using mesh::SubdivisionRules;
using mesh::SubdivisionScheme;
using mesh::SubdivisionTags;

/// A grid of 3 x 3 unit squares in the xy plane, fronts up, moved by a shift.
mesh::ControlCage flat_grid(const mesh::Vector& shift = {}) {
  mesh::ControlCage cage;
  for (std::uint32_t y = 0; y < 4; ++y) {
    for (std::uint32_t x = 0; x < 4; ++x) cage.points.push_back(mesh::Point{1.0 * x, 1.0 * y, 0.0} + shift);
  }
  for (std::uint32_t y = 0; y < 3; ++y) {
    for (std::uint32_t x = 0; x < 3; ++x) {
      const std::uint32_t v = 4 * y + x;
      cage.corners.insert(cage.corners.end(), {v, v + 1, v + 5, v + 4});
      cage.face_starts.push_back(static_cast<std::uint32_t>(cage.corners.size()));
    }
  }
  return cage;
}

void expect_near(const mesh::Point& a, const mesh::Point& b, double tolerance = 1e-12) {
  EXPECT_LT(norm(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

// A vertex of valence n goes to (n² v + 4 Σ neighbours + Σ opposite corners) / (n (n + 5)) [Halstead, Kass, DeRose 1993].
TEST(LimitSurface, AVertexOfACubeGoesWhereTheLimitMaskSays) {
  const LimitSurface surface(support::whole_cage(support::cube_cage()));
  const mesh::LimitPoint corner = surface.at(surface.first_patch(1), 1.0, 1.0);
  expect_near(corner.at, {0.5, 0.5, 0.5});
  const double third = 1.0 / std::sqrt(3.0);
  EXPECT_LT(norm(corner.normal - mesh::Vector{third, third, third}), 1e-6);
}

// Loop's mask for valence 4: v (1 - 4 w) + w Σ neighbours, w = 1 / (4 + 3 / (8 β)), β = (5/8 - (3/8 + cos(2π/4)/4)²) / 4.
TEST(LimitSurface, AVertexOfAnOctahedronGoesWhereLoopsLimitMaskSays) {
  const LimitSurface surface(support::whole_cage(support::octahedron_cage(), SubdivisionScheme::kLoop));
  const double beta = (5.0 / 8.0 - 9.0 / 64.0) / 4.0;
  const double w = 1.0 / (4.0 + 3.0 / (8.0 * beta));
  expect_near(surface.at(surface.first_patch(0), 0.0, 1.0).at, {0.0, 0.0, 1.0 - 4.0 * w});
}

TEST(LimitSurface, AFlatCageIsItsOwnLimitWhereItsEdgesAreSharp) {
  const LimitSurface surface(flat_grid());
  for (std::uint32_t face = 0; face < 9; ++face) {
    const mesh::LimitPoint p = surface.at(surface.first_patch(face), 0.5, 0.5);
    EXPECT_NEAR(p.at.z, 0.0, 1e-12);
    EXPECT_NEAR(p.normal.z, 1.0, 1e-12);
  }
  expect_near(surface.at(0, 0.0, 0.0).at, {0, 0, 0});
  expect_near(surface.at(surface.first_patch(4), 0.25, 0.75).at, {1.25, 1.75, 0.0});
}

TEST(LimitSurface, CoordinatesFarFromTheOriginLoseNothing) {
  const mesh::Vector far{612'345.0, 5'412'345.0, 500.0};
  const LimitSurface surface(flat_grid(far));
  expect_near(surface.at(surface.first_patch(4), 0.25, 0.75).at, mesh::Point{1.25, 1.75, 0.0} + far, 1e-8);
}

TEST(LimitSurface, BoundaryRulesDecideOnCornersAndOnFacesAtTheBoundary) {
  mesh::ControlCage cage = flat_grid();
  cage.rules.boundary = SubdivisionRules::Boundary::kEdgeOnly;
  EXPECT_GT(norm(LimitSurface(cage).at(0, 0.0, 0.0).at - mesh::Point{0, 0, 0}), 0.1);
  cage.rules.boundary = SubdivisionRules::Boundary::kNone;
  const LimitSurface open(cage);
  EXPECT_EQ(open.patch_count(0), 0U);
  EXPECT_EQ(open.patch_count(4), 1U);
}

TEST(LimitSurface, AHoleShapesTheSurfaceAndHasNoPatch) {
  mesh::ControlCage cage = support::whole_cage(support::cube_cage());
  const LimitSurface closed(cage);
  cage.holes = {1};
  const LimitSurface open(cage);
  EXPECT_EQ(open.patch_count(1), 0U);
  expect_near(open.at(open.first_patch(2), 0.3, 0.9).at, closed.at(closed.first_patch(2), 0.3, 0.9).at);
}

TEST(LimitSurface, ASharpCreaseHasTwoNormalsAndASmoothEdgeOne) {
  mesh::ControlCage cage = support::whole_cage(support::cube_cage());
  const auto normals_differ = [](const LimitSurface& s) {
    // Top and front meet at the top's first edge, which is the front's third.
    return norm(s.at(s.first_patch(1), 0.5, 0.0).normal - s.at(s.first_patch(2), 0.5, 1.0).normal);
  };
  EXPECT_LT(normals_differ(LimitSurface(cage)), 1e-6);
  const std::uint32_t a = cage.corner(1, 0);
  const std::uint32_t b = cage.corner(1, 1);
  cage.creases.push_back(SubdivisionTags::Crease{{a, b}, 10.0F});
  EXPECT_GT(normals_differ(LimitSurface(cage)), 0.5);
}

TEST(LimitSurface, PatchesOfAnIrregularFaceMeetAtItsCentre) {
  const LimitSurface surface(support::whole_cage(support::irregular_cage()));
  ASSERT_EQ(surface.patch_count(1), 3U);
  ASSERT_EQ(surface.patch_count(2), 5U);
  const std::uint32_t first = surface.first_patch(2);
  for (std::uint32_t k = 0; k < 5; ++k) {
    expect_near(surface.at(first + k, 1.0, 1.0).at, surface.at(first, 1.0, 1.0).at, 1e-9);
    expect_near(surface.at(first + k, 1.0, 0.3).at, surface.at(first + (k + 1) % 5, 0.3, 1.0).at, 1e-9);
  }
}

TEST(LimitSurface, SecondDerivativesAreThoseOfThePositions) {
  const LimitSurface surface(support::whole_cage(support::irregular_cage()));
  const std::uint32_t patch = surface.first_patch(2);
  constexpr double kStep = 1e-4;
  const auto d = surface.derivatives(patch, 0.4, 0.6);
  const mesh::Vector du =
      (surface.at(patch, 0.4 + kStep, 0.6).at - surface.at(patch, 0.4 - kStep, 0.6).at) / (2.0 * kStep);
  const mesh::Vector duu =
      ((surface.at(patch, 0.4 + kStep, 0.6).at - d.at) - (d.at - surface.at(patch, 0.4 - kStep, 0.6).at)) /
      (kStep * kStep);
  EXPECT_LT(norm(du - d.du), 1e-6);
  EXPECT_LT(norm(duu - d.duu), 1e-4);
}

}  // namespace
}  // namespace clerestory
