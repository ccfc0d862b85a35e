// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/phase_clock.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

TEST(PhaseClock, GivesEachPhaseItsRaysAndItsTime) {
  const test::Stage stage(test::study_of(support::box_room(4, 4, 3), 0.5, {2, 2, 1}));
  const mesh::Rays& rays = *stage.scene.rays;
  const auto cast = [&](int count) {
    for (int i = 0; i < count; ++i) EXPECT_TRUE(rays.first_hit({stage.local({2, 2, 1}), {0, 0, 1}}).face.valid());
  };
  NoProgress nobody;
  std::vector<PhaseTime> phases;
  PhaseClock clock(phases);
  clock.begin("one", nobody);
  clock.watch(rays);
  cast(3);
  clock.begin("two", nobody);
  cast(5);
  clock.end();
  cast(7);  // in no phase
  clock.end();
  ASSERT_EQ(phases.size(), 2U);
  EXPECT_EQ(phases[0].name, "one");
  EXPECT_EQ(phases[1].name, "two");
  EXPECT_EQ(phases[1].rays, 5U);
  for (const PhaseTime& phase : phases) {
    EXPECT_GE(phase.wall_s, 0.0);
    EXPECT_LT(phase.wall_s, 60.0) << "a span, not a time of day";
  }
}

}  // namespace
}  // namespace clerestory::lighting
