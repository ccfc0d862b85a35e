// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/limit_tessellation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "tests/support/cages.h"

namespace clerestory {
namespace {

using mesh::LimitSurface;
using mesh::LimitTessellation;
using mesh::SubdivisionScheme;

LimitTessellation tessellation_of(const mesh::ControlCage& cage, const std::vector<double>& tolerance_m) {
  return tessellate(cage, LimitSurface(cage), tolerance_m);
}

LimitTessellation tessellation_of(const mesh::ControlCage& cage, double tolerance_m) {
  return tessellation_of(cage, std::vector<double>(cage.face_count(), tolerance_m));
}

double area_of(const LimitTessellation& mesh) {
  double area = 0.0;
  for (const auto& piece : mesh.pieces) {
    const auto& c = piece.corners;
    area += 0.5 * norm(cross(mesh.points[c[1]] - mesh.points[c[0]], mesh.points[c[2]] - mesh.points[c[0]]));
  }
  return area;
}

/// Edges that are not walked once each way.
std::size_t unmatched_edges(const LimitTessellation& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> walked;
  for (const auto& piece : mesh.pieces) {
    for (std::size_t k = 0; k < 3; ++k) ++walked[{piece.corners[k], piece.corners[(k + 1) % 3]}];
  }
  std::size_t unmatched = 0;
  for (const auto& [edge, count] : walked) {
    const auto back = walked.find({edge.second, edge.first});
    if (count != 1 || back == walked.end() || back->second != 1) ++unmatched;
  }
  return unmatched;
}

TEST(LimitTessellation, AClosedCageGivesAClosedSurface) {
  for (const double tolerance : {0.3, 0.01, 0.001}) {
    EXPECT_EQ(unmatched_edges(tessellation_of(support::whole_cage(support::cube_cage()), tolerance)), 0U);
    EXPECT_EQ(unmatched_edges(tessellation_of(support::whole_cage(support::irregular_cage()), tolerance)), 0U);
    EXPECT_EQ(unmatched_edges(tessellation_of(support::whole_cage(support::octahedron_cage(), SubdivisionScheme::kLoop),
                                              tolerance)),
              0U);
  }
}

TEST(LimitTessellation, PatchesOfDifferentDensityShareTheirEdges) {
  const mesh::ControlCage cage = support::whole_cage(support::irregular_cage());
  std::vector<double> tolerance(cage.face_count(), 0.05);
  tolerance[2] = 0.0005;
  const LimitTessellation mesh = tessellation_of(cage, tolerance);
  EXPECT_EQ(unmatched_edges(mesh), 0U);
  std::size_t fine = 0;
  for (const auto& piece : mesh.pieces) {
    if (piece.face == 2) ++fine;
  }
  EXPECT_GT(fine, mesh.pieces.size() / 2);
}

/// A half cylinder of 3 m radius and 10 m length, six faces across and four along.
mesh::ControlCage vault_cage() {
  constexpr int kAcross = 6;
  constexpr int kAlong = 4;
  mesh::ControlCage cage;
  for (int j = 0; j <= kAlong; ++j) {
    for (int i = 0; i <= kAcross; ++i) {
      const double angle = std::numbers::pi * i / kAcross;
      cage.points.push_back({3.0 * std::cos(angle), 10.0 * j / kAlong, 3.0 * std::sin(angle)});
    }
  }
  for (std::uint32_t j = 0; j < kAlong; ++j) {
    for (std::uint32_t i = 0; i < kAcross; ++i) {
      const std::uint32_t first = j * (kAcross + 1) + i;
      for (const std::uint32_t k : {first, first + 1, first + kAcross + 2, first + kAcross + 1})
        cage.corners.push_back(k);
      cage.face_starts.push_back(static_cast<std::uint32_t>(cage.corners.size()));
    }
  }
  return cage;
}

TEST(LimitTessellation, WhatIsStraightOneWayIsNotCutThatWay) {
  // An arc of 30 degrees of so large a radius takes six pieces for this tolerance.
  const LimitTessellation mesh = tessellation_of(vault_cage(), 0.00375);
  EXPECT_EQ(mesh.pieces.size(), 24U * 6U * 2U);
  for (const auto& piece : mesh.pieces) EXPECT_LE(piece.deviation_m, 0.00375);
}

TEST(LimitTessellation, NoTriangleIsFartherOffThanTheTolerance) {
  for (const double tolerance : {0.05, 0.005, 0.0005}) {
    for (const auto& piece : tessellation_of(support::whole_cage(support::irregular_cage()), tolerance).pieces)
      EXPECT_LE(piece.deviation_m, tolerance);
  }
}

TEST(LimitTessellation, AFlatCageIsNotCut) {
  mesh::ControlCage cage = support::whole_cage(support::cube_cage());
  for (std::size_t f = 0; f < cage.face_count(); ++f) {
    for (std::size_t k = 0; k < 4; ++k) cage.creases.push_back({{cage.corner(f, k), cage.corner(f, k + 1)}, 10.0F});
  }
  EXPECT_EQ(tessellation_of(cage, 1e-4).pieces.size(), 12U);
}

// The area's error falls with the square of the triangles' size, that is as one by their number.
TEST(LimitTessellation, TheAreaConvergesToSecondOrderInTheSizeOfTheTriangles) {
  for (const auto scheme : {SubdivisionScheme::kCatmullClark, SubdivisionScheme::kLoop}) {
    const mesh::ControlCage cage = support::whole_cage(
        scheme == SubdivisionScheme::kLoop ? support::octahedron_cage() : support::cube_cage(), scheme);
    const LimitTessellation coarse = tessellation_of(cage, 4e-3);
    const LimitTessellation fine = tessellation_of(cage, 5e-4);
    const double limit = area_of(tessellation_of(cage, 3e-5));
    const double ratio = static_cast<double>(fine.pieces.size()) / static_cast<double>(coarse.pieces.size());
    const double order = 2.0 * std::log((limit - area_of(coarse)) / (limit - area_of(fine))) / std::log(ratio);
    RecordProperty("order", std::to_string(order));
    EXPECT_NEAR(order, 2.0, 0.2);
  }
}

}  // namespace
}  // namespace clerestory
