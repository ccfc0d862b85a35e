// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/seen_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

/// Two plates at z = 1, a wall between them, and a lamp above the first.
TEST(SeenEdges, BehindAWallAreLeftOut) {
  Model model;
  support::add_quad(model, {-2, -0.5, 1}, {-1, -0.5, 1}, {-1, 0.5, 1}, {-2, 0.5, 1}, {"plate", "plate"});
  support::add_quad(model, {1, -0.5, 1}, {2, -0.5, 1}, {2, 0.5, 1}, {1, 0.5, 1}, {"plate", "plate"});
  support::add_quad(model, {0, -9, -9}, {0, 9, -9}, {0, 9, 9}, {0, -9, 9}, {"wall", "wall"});
  const Faces faces = build_faces(clean(model, {}));
  const Rays rays(faces);
  const Occluders occluders(faces);
  ShadowSource lamp;
  lamp.normal = {0, 0, -1};
  lamp.outline = {{{-1.8, -0.1, 2}, {-1.2, -0.1, 2}, {-1.2, 0.1, 2}, {-1.8, 0.1, 2}}};
  for (Point& p : lamp.outline[0]) p = p - faces.origin;
  const SeenEdges seen = seen_edges(occluders, lamp, rays);
  ASSERT_EQ(seen.lit.size(), occluders.edges().size());
  int lit = 0;
  for (std::size_t e = 0; e < seen.lit.size(); ++e) {
    const auto ends = occluders.ends(occluders.edges()[e]);
    const Point middle = midpoint(ends[0], ends[1]) + faces.origin;
    if (middle.x > 0.5) {
      EXPECT_EQ(seen.lit[e], 0);
    }
    if (middle.x < -0.5) lit += seen.lit[e];
    EXPECT_EQ(seen.outdoors[e], 0);
  }
  EXPECT_EQ(lit, 4);
}

/// A wall with a pane between two strips, and behind it a plate that the sun meets on a tenth of its edge alone.
TEST(SeenEdges, TheSunComesThroughOpeningsAndIsFoundOnSmallPartsOfEdges) {
  Model model;
  support::add_quad(model, {-5, 0, 0}, {-0.2, 0, 0}, {-0.2, 0, 3}, {-5, 0, 3}, {"wall", "wall"});
  support::add_quad(model, {0.2, 0, 0}, {5, 0, 0}, {5, 0, 3}, {0.2, 0, 3}, {"wall", "wall"});
  support::add_quad(model, {-0.2, 0, 0}, {0.2, 0, 0}, {0.2, 0, 3}, {-0.2, 0, 3}, {"glass", "glass"});
  support::add_quad(model, {-0.8, 0.5, 1}, {3.2, 0.5, 1}, {3.2, 1.5, 1}, {-0.8, 1.5, 1}, {"plate", "plate"});
  const Faces faces = build_faces(clean(model, {}));
  std::vector<std::uint8_t> passable(faces.count(), 0);
  std::vector<Passage> passages(faces.count());
  for (std::size_t f = 0; f < faces.count(); ++f) {
    if (faces.part_names[faces.faces[f].part.index()] != "glass") continue;
    passable[f] = 1;
    const bool front = faces.faces[f].frame.w.y < 0.0;
    passages[f] = {.curve = 0, .opening = true, .outside = front ? Side::kFront : Side::kBack};
  }
  Rays rays(faces, passable);
  TransmittanceCurve open;
  open.fill(1.0F);
  rays.set_passages(std::move(passages), {open});
  const Occluders occluders(faces, passable);
  ShadowSource sun;
  sun.kind = ShadowSource::Kind::kDirection;
  sun.towards = normalized(Vector{0, -1, 0.5});
  const SeenEdges seen = seen_edges(occluders, sun, rays);
  int lit = 0;
  for (std::size_t e = 0; e < seen.lit.size(); ++e) {
    const auto ends = occluders.ends(occluders.edges()[e]);
    const Point middle = midpoint(ends[0], ends[1]) + faces.origin;
    if (std::abs(middle.z - 1.0) < 1e-9 && std::abs(middle.x - 1.2) < 1e-9) lit += seen.lit[e];
  }
  EXPECT_EQ(lit, 2);
}

}  // namespace
}  // namespace clerestory::mesh
