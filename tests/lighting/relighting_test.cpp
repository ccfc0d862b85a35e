// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/relighting.h"

#include <gtest/gtest.h>

#include "tests/lighting/stages.h"

namespace clerestory::lighting {
namespace {

Study kept_study() {
  Study study = test::furnished_room_study();
  study.keep_solution = true;
  return study;
}

struct Relit : test::Solved {
  explicit Relit(const Study& study) : Solved(study), mean_lux(mean()) {}

  [[nodiscard]] double mean() const { return mean_illuminance(roots("floor")); }
  [[nodiscard]] Relighting relighting() {
    return {solution, transport, {scene.groups.all(), transport.groups, {}}, 0.08};
  }
  double mean_lux;
};

TEST(Relighting, ByTheSameLightNothingChanges) {
  Relit room(kept_study());
  Relighting relighting = room.relighting();
  NoProgress nobody;
  const Transport& lit = relighting.light(nobody);
  EXPECT_NEAR(room.mean() / room.mean_lux, 1.0, 1e-3);
  EXPECT_LT(lit.convergence, 1e-3);
  const double first = room.mean();
  relighting.light(nobody);
  EXPECT_EQ(room.mean(), first);
}

TEST(Relighting, ErrorsByRaysGoWithTheLight) {
  Relit room(kept_study());
  const std::vector<Solution::Errors> before = room.transport.given_errors;
  KnownLight known{room.scene.groups.all(), room.transport.groups, {}};
  for (SourceGroup& group : known.groups)
    group.strength *= 0.5;  // all has become twice as bright but what shines itself
  Relighting relighting(room.solution, room.transport, known, 0.08);
  NoProgress nobody;
  const Transport& lit = relighting.light(nobody);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_GE(lit.given_errors[i].noise2, 0.99 * before[i].noise2);
    EXPECT_LE(lit.given_errors[i].noise2, 4.01 * before[i].noise2);
  }
  EXPECT_GT(room.mean(), 1.2 * room.mean_lux);
}

TEST(Relighting, ASunThatIsCastAddsItsLightAndTheErrorOfItsEdges) {
  Relit room(kept_study());
  Relighting relighting = room.relighting();
  NoProgress nobody;
  const double without = relighting.light(nobody).errors.mean_error(room.root("floor"));
  Sky sunny = room.scene.sky;
  sunny.sun = {.towards = {0.0, 0.6, 0.8}, .normal_illuminance_lux = 20'000.0};
  set_sky(room.scene, sunny, SourceGroups(Columns::kMix, true, true, true, 0.0));
  const Transport& lit = relighting.light(nobody);
  EXPECT_GT(room.mean(), 2.0 * room.mean_lux);
  EXPECT_GT(lit.errors.mean_error(room.root("floor")), without);
  EXPECT_FALSE(relighting.known().errors.empty());
}

}  // namespace
}  // namespace clerestory::lighting
