// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/importance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::ElementId;

/// So much lies on all surfaces by area.
constexpr double kByArea = 0.01;
/// Area of the room's surfaces, of both their sides: the outside is a place too.
constexpr double kSides_m2 = 160.0;

Study room_study(double reflectance) {
  Study study = test::study_of(support::box_room(4, 4, 3), reflectance, {2, 2, 0.5});
  test::shine(test::material(study, "ceiling"), 100.0);
  return study;
}

double sum_over_roots(const test::Stage& stage, const Importance& importance) {
  double sum = 0.0;
  for (const ElementId e : stage.solution.tree().roots()) sum += importance.of(stage.solution.tree(), e);
  return sum;
}

TEST(Importance, WithoutSensorsFollowsTheArea) {
  test::Stage stage(room_study(0.5));
  const Importance importance(stage.solution, {});
  for (const ElementId e : stage.solution.tree().roots()) {
    EXPECT_NEAR(importance.of(stage.solution.tree(), e), stage.solution.tree().area(e) / kSides_m2, 1e-6);
  }
}

TEST(Importance, OfABlackRoomIsWhatTheSensorSees) {
  // Over the middle of the floor: four rectangles of 2 m × 2 m at 2.5 m over a corner [Howell, B-3].
  test::Stage stage(room_study(0.0));
  const Importance importance(stage.solution, stage.walks(1));
  EXPECT_NEAR(sum_over_roots(stage, importance), 1.0 + kByArea, 1e-3);
  const double a = 2.0 / 2.5;
  const double s = std::sqrt(1.0 + a * a);
  const double corner = 2.0 * a / s * std::atan(a / s) / (2.0 * std::acos(-1.0));
  EXPECT_NEAR(importance.of(stage.solution.tree(), stage.root("ceiling")), 4.0 * corner + kByArea * 16.0 / kSides_m2,
              5e-3);
  EXPECT_NEAR(importance.of(stage.solution.tree(), stage.root("floor")), kByArea * 16.0 / kSides_m2, 1e-6);
}

TEST(Importance, OfALightRoomGrowsByEachReflection) {
  test::Stage stage(room_study(0.5));
  const Importance importance(stage.solution, stage.walks(1));
  // Walks of five bounces: 1 + ρ + ρ² + ρ³ + ρ⁴.
  EXPECT_NEAR(sum_over_roots(stage, importance), 1.9375 + kByArea, 2e-3);
}

TEST(Importance, OfPartsAddsUpToTheWhole) {
  test::Stage stage(room_study(0.5));
  const Importance importance(stage.solution, stage.walks(1));
  for (const ElementId root : stage.roots("ceiling")) {
    for (int depth = 0; depth < 3; ++depth) {
      for (const ElementId e : stage.solution.elements()) {
        if (stage.solution.tree().root(e) == root) stage.solution.open(e);
      }
    }
  }
  const mesh::ElementTree& tree = stage.solution.tree();
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const ElementId e(i);
    if (!tree.has_children(e)) continue;
    double sum = 0.0;
    for (std::size_t k = 0; k < tree.child_count(e); ++k) {
      sum += importance.of(tree, ElementId(tree.first_child(e).index() + k));
    }
    EXPECT_NEAR(sum, importance.of(tree, e), 1e-5);
  }
}

TEST(Importance, LiesUnevenlyWhereASensorIsClose) {
  // A sensor 5 cm off a wall of a long room matters to the wall around it, not to the rest of the wall.
  Study study = test::study_of(support::box_room(12, 4, 3), 0.0, {6, 0.05, 1.5});
  study.grids[0].normals = {{0, -1, 0}};
  test::shine(test::material(study, "ceiling"), 100.0);
  test::Stage stage(study);
  const Importance importance(stage.solution, stage.walks(1));
  double uneven = 0.0;
  for (const ElementId e : stage.roots("wall")) uneven = std::max(uneven, importance.uneven(e));
  EXPECT_GT(uneven, 0.4);
  EXPECT_LT(importance.uneven(stage.root("ceiling")), 0.01);
}

TEST(Importance, KnowsTheMeanIlluminanceOfTheSensors) {
  // A furnace of ρ = 0.5 in five bounces: 100 · (1 + ρ + ρ² + ρ³ + ρ⁴).
  Study study = room_study(0.5);
  for (Material& m : study.materials) test::shine(m, 100.0);
  test::Stage stage(study);
  EXPECT_NEAR(Importance(stage.solution, stage.walks(1)).mean_lux(), 193.75, 0.2);
}

TEST(Importance, SensorUnderTheOpenSkySeesItsHorizontalIlluminance) {
  Study study = test::study_of(support::facing_squares(), 0.0, {5, 5, 2});
  study.sky.type = Sky::Type::kCieOvercast;
  test::Stage stage(study);
  EXPECT_NEAR(Importance(stage.solution, stage.walks(1)).mean_lux(), 10'000.0, 50.0);
}

}  // namespace
}  // namespace clerestory::lighting
