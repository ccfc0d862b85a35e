// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/group_gather.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lighting/run.h"
#include "tests/lighting/stages.h"

namespace clerestory::lighting {
namespace {

GridResult grid_of(Study study, Columns columns) {
  study.columns = columns;
  NoProgress progress;
  return run(study, progress).grids.at(0);
}

TEST(GroupGather, ColumnsAddUpToAllLightAndLeaveItAsItIs) {
  const Study study = test::furnished_room_study();
  const GridResult plain = grid_of(study, Columns::kMix);
  EXPECT_TRUE(plain.groups.empty());
  for (const Columns columns : {Columns::kGroups, Columns::kSky145, Columns::kSky577}) {
    const GridResult grid = grid_of(study, columns);
    EXPECT_EQ(grid.illuminance_lux, plain.illuminance_lux);
    EXPECT_EQ(grid.error_lux, plain.error_lux);
    for (std::size_t i = 0; i < grid.sensors.count(); ++i) {
      double sum = 0.0;
      for (const GroupColumn& group : grid.groups) sum += group.illuminance_lux[i];
      EXPECT_NEAR(sum / grid.illuminance_lux[i], 1.0, 3e-4);
    }
  }
}

TEST(GroupGather, ErrorsOfGroupsAreHonest) {
  // The same study with other random numbers differs from itself by the errors that both state.
  Study study = test::furnished_room_study();
  double squares = 0.0;
  double count = 0.0;
  const GridResult first = grid_of(study, Columns::kGroups);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    study.accuracy.seed = seed;
    const GridResult other = grid_of(study, Columns::kGroups);
    for (std::size_t g = 0; g < first.groups.size(); ++g) {
      for (std::size_t i = 0; i < first.sensors.count(); ++i) {
        const double error = std::hypot(first.groups[g].error_lux[i], other.groups[g].error_lux[i]);
        const double z = (first.groups[g].illuminance_lux[i] - other.groups[g].illuminance_lux[i]) / error;
        squares += z * z;
        count += 1.0;
      }
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 1.5);
}

}  // namespace
}  // namespace clerestory::lighting
