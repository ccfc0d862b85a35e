// SPDX-License-Identifier: GPL-3.0-or-later
// The reference scenes, read and answered as the program does it, against converged results of independent programs.
#include <gtest/gtest.h>

#include <cmath>

#include "io/study_file.h"
#include "tests/support/places.h"
#include "tests/support/validation_scenes.h"
#include "tests/validation/statistics.h"
#include "tests/validation/studies.h"

namespace clerestory::test {
namespace {

Comparison run_scene(const std::string& name, lighting::Study::Kind kind, double accuracy) {
  const auto path = write_validation_study(name, testing::TempDir() + "clerestory-reference", accuracy);
  const lighting::Results results = answer(io::read_study(path, {.kind = kind, .set = {}}).study);
  const Comparison c = compare(results.grids.at(0), validation_reference(name));
  print(name, c);
  EXPECT_TRUE(results.accuracy_met) << name;
  return c;
}

TEST(ReferenceScenes, OfficeAtTheDefaultAccuracy) {
  CLERESTORY_NEEDS_VALIDATION("office");
  const Comparison c = run_scene("office", lighting::Study::Kind::kDaylight, 0.02);
  EXPECT_LE(std::abs(c.bias), 0.01);
  EXPECT_LE(c.rms, 0.03);  // the reference's own noise of 1.1 % included
  EXPECT_LE(c.p95, 0.06);
  expect_honest("office", c);
}

TEST(ReferenceScenes, LampRoomAtOnePerCent) {
  CLERESTORY_NEEDS_VALIDATION("lamp-room");
  const Comparison c = run_scene("lamp-room", lighting::Study::Kind::kIlluminance, 0.01);
  EXPECT_LE(c.rms, 0.01);
  expect_honest("lamp-room", c);
}

}  // namespace
}  // namespace clerestory::test
