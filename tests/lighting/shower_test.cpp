// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/shower.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lighting/surface_values.h"
#include "tests/lighting/stages.h"

namespace clerestory::lighting {
namespace {

/// The furnished room solved, and what is shown of it.
struct Shown : test::Stage {
  explicit Shown(const Study& study)
      : Stage(study),
        importance(solution, walks(1)),
        direct(light_directly(solution, importance, 0.002 * study.accuracy.target, 1, nobody)),
        transport(solve(solution, importance, direct, {.accuracy = study.accuracy.target, .seed = 1}, nobody)),
        shower(study, solution, transport.arrivals, transport.errors, direct.nodes, importance, nobody) {}

  [[nodiscard]] auto of_elements() const { return surface_values(solution, transport.errors).illuminance_lux; }

  NoProgress nobody;
  Importance importance;
  DirectLight direct;
  Transport transport;
  Shower shower;
};

TEST(Shower, ShowsElementsWhereNoLinesAreAskedFor) {
  Study study = test::furnished_room_study();
  study.mesh.discontinuities = false;
  Shown shown(study);
  EXPECT_FALSE(shown.shower.mesh());
  const SurfaceResult surfaces =
      shown.shower.light(shown.solution, shown.transport.arrivals, shown.transport.errors, shown.nobody);
  EXPECT_EQ(surfaces.illuminance_lux, shown.of_elements());
  Results results;
  tell_of_lines(shown.shower, shown.scene, results);
  EXPECT_FALSE(results.shadow_lines);
  EXPECT_TRUE(results.notices.empty());
}

TEST(Shower, ShowsTheMeshOfTheLinesUntilItGivesUp) {
  Shown shown(test::furnished_room_study());
  ASSERT_TRUE(shown.shower.mesh());
  const SurfaceResult fine =
      shown.shower.light(shown.solution, shown.transport.arrivals, shown.transport.errors, shown.nobody);
  EXPECT_GT(*std::max_element(fine.illuminance_lux.begin(), fine.illuminance_lux.end()), 0.0F);
  Results results;
  tell_of_lines(shown.shower, shown.scene, results);
  EXPECT_TRUE(results.shadow_lines);

  shown.shower.give_up();
  EXPECT_TRUE(shown.shower.is_over());
  const SurfaceResult coarse =
      shown.shower.light(shown.solution, shown.transport.arrivals, shown.transport.errors, shown.nobody);
  EXPECT_EQ(coarse.illuminance_lux, shown.of_elements());
  EXPECT_NE(coarse.illuminance_lux, fine.illuminance_lux);
  Results stopped;
  tell_of_lines(shown.shower, shown.scene, stopped);
  EXPECT_FALSE(stopped.shadow_lines);
  EXPECT_EQ(stopped.notices.size(), 1U);
}

}  // namespace
}  // namespace clerestory::lighting
