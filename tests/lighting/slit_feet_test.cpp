// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/slit_feet.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "mesh/clean.h"
#include "mesh/element_tree.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::lighting {
namespace {

using mesh::ElementId;
using mesh::FaceId;
using mesh::FaceSide;
using mesh::Point;
using mesh::Side;

constexpr double kWidth_m = 0.05;
constexpr double kFoot_m = 2.0;  ///< y

/// A floor of 4 m × 4 m, and a sheet across its middle that ends above it.
struct Site {
  explicit Site(double rotation_rad)
      : faces(mesh::build_faces(mesh::clean(support::rotated(model(), {0.48, -0.6, 0.64}, rotation_rad), {}))),
        slits(mesh::find_slits(faces, std::vector<std::uint8_t>(2 * faces.count(), 1))),
        tree(faces, mesh::mesh_faces(faces, {.max_size_m = 1e9}), std::vector<std::uint8_t>(2 * faces.count(), 1)),
        feet(faces.count(), slits) {}

  static mesh::Model model() {
    mesh::Model model;
    support::add_quad(model, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {"floor", "floor"});
    support::add_quad(model, {0, kFoot_m, kWidth_m}, {4, kFoot_m, kWidth_m}, {4, kFoot_m, 3}, {0, kFoot_m, 3},
                      {"wall", "wall"});
    return model;
  }
  [[nodiscard]] ElementId root(Side side) const {
    return tree.roots_of({support::faces_of(faces, "floor").at(0), side})[0];
  }
  [[nodiscard]] double to_foot(const Point& p) const {
    const mesh::FaceLine& foot = slits.at(0).foot;
    const mesh::Vector along = normalized(foot.ends[1] - foot.ends[0]);
    const mesh::Vector from = p - foot.ends[0];
    return norm(from - dot(from, along) * along);
  }

  mesh::Faces faces;
  std::vector<mesh::Slit> slits;
  mesh::ElementTree tree;
  SlitFeet feet;
};

/// Splits what is coarse, and counts what is left.
std::vector<ElementId> refined(Site& site, ElementId root) {
  std::vector<ElementId> leaves;
  std::vector<ElementId> open{root};
  while (!open.empty()) {
    const ElementId e = open.back();
    open.pop_back();
    if (!site.feet.is_coarse(site.tree, e)) {
      leaves.push_back(e);
      continue;
    }
    if (!site.tree.has_children(e)) site.tree.split(e);
    for (std::size_t k = 0; k < site.tree.child_count(e); ++k) open.emplace_back(site.tree.first_child(e).index() + k);
  }
  return leaves;
}

TEST(SlitFeet, PiecesAtAFootAreCoarseDownToItsWidthAndOthersByTheirDistance) {
  for (const double rotation_rad : {0.0, 0.7}) {
    Site site(rotation_rad);
    const std::vector<ElementId> leaves = refined(site, site.root(site.slits.at(0).side));
    EXPECT_GT(leaves.size(), 200U);
    EXPECT_LT(leaves.size(),
              5000U);  // graded: a floor of such pieces would have more than 3000 of them in every square metre
    double area_m2 = 0.0;
    for (const ElementId e : leaves) {
      area_m2 += site.tree.area(e);
      double nearest = 4.0;
      for (const Point& p : site.tree.corners(e)) nearest = std::min(nearest, site.to_foot(p));
      EXPECT_LE(site.tree.radius(e), std::max(kWidth_m, nearest + 1e-9));
    }
    EXPECT_NEAR(area_m2, 16.0, 1e-9);
  }
}

TEST(SlitFeet, TheOtherSideOfTheFaceAndSidesWithoutSlitsAreNeverCoarse) {
  const Site site(0.3);
  EXPECT_TRUE(site.feet.is_coarse(site.tree, site.root(site.slits.at(0).side)));
  EXPECT_FALSE(site.feet.is_coarse(site.tree, site.root(mesh::other(site.slits.at(0).side))));
  const FaceId wall = support::faces_of(site.faces, "wall").at(0);
  EXPECT_FALSE(site.feet.is_coarse(site.tree, site.tree.roots_of({wall, Side::kFront})[0]));
  const SlitFeet none(site.faces.count(), {});
  EXPECT_FALSE(none.is_coarse(site.tree, site.root(Side::kFront)));
}

TEST(SlitFeet, AFootAcrossAPieceWithItsEndsBeyondIsAtNoDistance) {
  Site site(0.0);
  mesh::Slit slit = site.slits.at(0);
  const mesh::Vector along = slit.foot.ends[1] - slit.foot.ends[0];
  slit.foot.ends = {slit.foot.ends[0] - along, slit.foot.ends[1] + along};
  const SlitFeet feet(site.faces.count(), std::vector{slit});
  const auto leaves = refined(site, site.root(slit.side));
  for (const ElementId e : leaves) EXPECT_EQ(feet.is_coarse(site.tree, e), site.feet.is_coarse(site.tree, e));
  EXPECT_TRUE(feet.is_coarse(site.tree, site.root(slit.side)));
}

}  // namespace
}  // namespace clerestory::lighting
