// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/closure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::ElementId;

/// A box room whose ceiling shines, seen by one sensor alone: the solver refines it unevenly.
Study lit_box() {
  Study study = test::study_of(support::box_room(4, 5, 3), 0.6, {0.5, 0.5, 1});
  test::shine(test::material(study, "ceiling"), 100.0);
  return study;
}

TEST(Closure, RefinementThatDiffersOverTheRoomIsScaledUntilAFurnaceIsOne) {
  Study study = lit_box();
  for (Material& m : study.materials) test::shine(m, 40.0);
  const test::Solved s(study);
  for (const ElementId e : s.solution.elements()) {
    if (s.solution.tree().face_side(e).side != mesh::Side::kFront) continue;
    const LinearValue& lux = s.solution.irradiance(e)[0];
    EXPECT_NEAR(lux.value, 100.0, 1e-2) << e.index();
    EXPECT_NEAR(s.solution.tree().radius(e) * std::hypot(lux.slope_u, lux.slope_v), 0.0, 2e-2) << e.index();
  }
}

TEST(Closure, ScalesLittle) {
  const test::Solved s(lit_box());
  double square = 0.0;
  double area = 0.0;
  for (const ElementId e : s.solution.elements()) {
    if (s.solution.tree().face_side(e).side != mesh::Side::kFront) continue;
    const double scale = s.solution.closing(e).value;
    square += s.solution.tree().area(e) * (scale - 1.0) * (scale - 1.0);
    area += s.solution.tree().area(e);
  }
  EXPECT_GT(square, 0.0);
  EXPECT_LT(std::sqrt(square / area), 0.02) << "the accuracy asked";
}

TEST(Closure, LeavesElementsAloneThatSeeOutside) {
  const test::Solved s([] {
    Study study = test::study_of(support::facing_squares(), 0.5, {0.5, 0.5, 0.5});
    test::shine(test::material(study, "upper"), 100.0);
    return study;
  }());
  for (const ElementId e : s.solution.elements()) EXPECT_EQ(s.solution.sent(e, 0).mean, s.solution.radiosity(e)[0]);
}

}  // namespace
}  // namespace clerestory::lighting
