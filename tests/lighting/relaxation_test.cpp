// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/relaxation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

TEST(Relaxation, OfASolutionThatIsRelaxedChangesNothingMuch) {
  test::Solved solved(test::furnished_room_study());
  std::vector<float> before;
  for (const mesh::ElementId e : solved.solution.elements()) before.push_back(solved.solution.irradiance(e)[0].value);
  const Relaxed relaxed = relax(solved.solution, solved.transport.clusters, solved.transport.arrivals, NoProgress());
  EXPECT_LE(relaxed.missing, 1e-6);
  std::size_t i = 0;
  for (const mesh::ElementId e : solved.solution.elements()) {
    EXPECT_NEAR(solved.solution.irradiance(e)[0].value, before[i], 1e-3 * std::abs(before[i]) + 1e-3);
    ++i;
  }
}

TEST(Relaxation, AFurnaceNeedsNoMoreIterationsThanItsReflectanceTells) {
  Study study = test::study_of(support::box_room(4, 3, 2), 0.5, {2, 1, 1});
  for (Material& material : study.materials) test::shine(material, 100.0);
  test::Solved solved(study);
  // 0.5 to the power of 20 is 1e-6.
  EXPECT_LE(relax(solved.solution, solved.transport.clusters, solved.transport.arrivals, NoProgress()).iterations, 25U);
  for (const mesh::ElementId e : solved.solution.elements()) {
    if (!solved.scene.shines(solved.solution.tree().face_side(e))) continue;
    EXPECT_NEAR(solved.solution.radiosity_mean(e), 200.0, 0.02);
  }
}

}  // namespace
}  // namespace clerestory::lighting
