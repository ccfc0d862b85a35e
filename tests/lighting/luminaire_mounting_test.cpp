// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/luminaire_mounting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh/error.h"
#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Model;
using mesh::Point;

Model closed_box(const Point& low, const Point& high) {
  Model model;
  support::add_box(model, low, high);
  return model;
}

Luminaire panel_at(const Point& at) {
  Luminaire panel = clerestory::test::lambertian_lamp(at, {0, 0, -1}, 100.0);
  panel.opening = {.shape = LuminousOpening::Shape::kRectangle, .x_m = 0.6, .y_m = 0.6};
  return panel;
}

std::size_t flush_count(const Luminaire& luminaire) {
  Study study = test::study_of(closed_box({0, 0, 0}, {4, 4, 3}), 0.5, {2, 2, 1});
  study.luminaires.push_back(luminaire);
  return build_scene(study).flush_faces[0].size();
}

TEST(FlushFaces, AreTheCeilingWithinFiveCentimetres) {
  EXPECT_EQ(flush_count(panel_at({2, 2, 3.0})), 1U);
  EXPECT_EQ(flush_count(panel_at({2, 2, 2.96})), 1U);
  EXPECT_EQ(flush_count(panel_at({2, 2, 2.9})), 0U);
  // Beside a wall, which does not lie across the axis.
  EXPECT_EQ(flush_count(panel_at({0.02, 2, 2})), 0U);
}

TEST(BuildScene, ALuminaireInsideAWallIsRefused) {
  // A wall 0.3 m thick, as a solid.
  Study study = test::study_of(closed_box({0, 0, 0}, {4, 0.3, 3}), 0.5, {2, 2, 1});
  study.luminaires.push_back(panel_at({2, 0.15, 1.5}));
  study.luminaires.back().opening = {};
  study.luminaires.back().name = "spot.ies";
  try {
    build_scene(study);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("the luminaire spot.ies at (2.000, 0.150, 1.500) stands inside a solid"));
  }
}

TEST(BuildScene, ALuminaireInARoomIsNot) {
  Study study = test::study_of(closed_box({0, 0, 0}, {4, 4, 3}), 0.5, {2, 2, 1});
  for (const double z : {0.1, 1.5, 2.95, 3.0}) study.luminaires.push_back(panel_at({2, 2, z}));
  EXPECT_NO_THROW(build_scene(study));
}

}  // namespace
}  // namespace clerestory::lighting
