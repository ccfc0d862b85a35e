// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/contact_sectors.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::mesh {
namespace {

/// A floor of 4 m × 4 m on which stand a screen from (1, 2) to (3, 2), with another at right angles in its middle, and one from the floor's edge.
struct Floor {
  Floor() {
    Model model;
    support::add_quad(model, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {"floor", "floor"});
    support::add_quad(model, {1, 2, 0}, {3, 2, 0}, {3, 2, 1}, {1, 2, 1}, {"screen", "screen"});
    support::add_quad(model, {2, 2, 0}, {2, 3, 0}, {2, 3, 1}, {2, 2, 1}, {"screen", "fin"});
    support::add_quad(model, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}, {"screen", "stub"});
    faces = build_faces(clean(model, {}));
  }
  [[nodiscard]] std::uint32_t sector(const Point& point, const Point& place) const {
    return ContactSectors(faces).at(support::faces_of(faces, "floor").at(0), point - faces.origin,
                                    place - faces.origin);
  }
  Faces faces;
};

TEST(ContactSectors, TheSidesOfAScreenDiffer) {
  const Floor floor;
  EXPECT_NE(floor.sector({1.5, 2, 0}, {1.5, 1.9, 0}), floor.sector({1.5, 2, 0}, {1.5, 2.1, 0}));
  EXPECT_EQ(floor.sector({1.5, 2, 0}, {1.4, 2.1, 0}), floor.sector({1.5, 2, 0}, {1.7, 2.1, 0}));
}

TEST(ContactSectors, AFreeEndHasOneSectorAllRound) {
  const Floor floor;
  for (const Point& place : {Point{1.1, 2.1, 0}, Point{0.9, 2, 0}, Point{1.1, 1.9, 0}})
    EXPECT_EQ(floor.sector({1, 2, 0}, place), 0U);
}

TEST(ContactSectors, AMeetingOfThreeHasThree) {
  const Floor floor;
  const std::uint32_t below = floor.sector({2, 2, 0}, {2, 1.9, 0});
  const std::uint32_t left = floor.sector({2, 2, 0}, {1.9, 2.1, 0});
  const std::uint32_t right = floor.sector({2, 2, 0}, {2.1, 2.1, 0});
  EXPECT_NE(below, left);
  EXPECT_NE(left, right);
  EXPECT_NE(right, below);
  EXPECT_EQ(below, floor.sector({2, 2, 0}, {1.8, 1.99, 0}));
}

TEST(ContactSectors, AtTheFacesOwnEdgeAContactHasTwoSides) {
  const Floor floor;
  EXPECT_NE(floor.sector({0, 1, 0}, {0.1, 0.9, 0}), floor.sector({0, 1, 0}, {0.1, 1.1, 0}));
}

TEST(ContactSectors, ElsewhereThereIsOne) {
  const Floor floor;
  EXPECT_EQ(floor.sector({3.5, 0.5, 0}, {3.6, 0.5, 0}), 0U);
  EXPECT_EQ(floor.sector({3.5, 0.5, 0}, {3.4, 0.6, 0}), 0U);
}

}  // namespace
}  // namespace clerestory::mesh
