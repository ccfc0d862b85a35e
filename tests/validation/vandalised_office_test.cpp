// SPDX-License-Identifier: GPL-3.0-or-later
// A damaged model gives the light of the sound one: the clean-up undoes what was done to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/study_file.h"
#include "tests/support/places.h"
#include "tests/support/vandalism.h"
#include "tests/validation/studies.h"

namespace clerestory::test {
namespace {

constexpr double kAccuracy = 0.05;

TEST(VandalisedOffice, GivesTheSameDaylight) {
  auto input = io::read_study(samples_dir() / "office" / "office.toml",
                              {.kind = lighting::Study::Kind::kDaylight, .set = {"accuracy.target=0.05"}});
  const lighting::GridResult sound = answer(input.study).grids.at(0);
  input.study.model = support::vandalised(
      input.study.model, {.jitter_m = 1e-6, .duplicated = 0.1, .flipped = 0.2, .split = 0.2, .unwelded = 0.05}, 7);
  const lighting::GridResult damaged = answer(input.study).grids.at(0);
  ASSERT_EQ(damaged.illuminance_lux.size(), sound.illuminance_lux.size());
  double squares = 0.0;
  for (std::size_t i = 0; i < sound.illuminance_lux.size(); ++i) {
    const double scale = std::max<double>(sound.illuminance_lux[i], kAccuracy * sound.metrics.mean_lux);
    squares += std::pow((damaged.illuminance_lux[i] - sound.illuminance_lux[i]) / scale, 2.0);
  }
  EXPECT_LE(std::sqrt(squares / static_cast<double>(sound.illuminance_lux.size())), kAccuracy);
  EXPECT_NEAR(damaged.metrics.mean_lux, sound.metrics.mean_lux, kAccuracy * sound.metrics.mean_lux);
}

}  // namespace
}  // namespace clerestory::test
