// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstring>

#include "io/study_file.h"
#include "tests/support/places.h"
#include "tests/validation/studies.h"

namespace clerestory::test {
namespace {

template <class T>
void expect_same_bytes(const char* what, const std::vector<T>& a, const std::vector<T>& b) {
  ASSERT_EQ(a.size(), b.size()) << what;
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(T)), 0) << what;
}

TEST(Threads, OneTwoAndThreeGiveTheSameBytes) {
  lighting::Study study =
      io::read_study(samples_dir() / "office" / "office.toml", {.kind = lighting::Study::Kind::kDaylight, .set = {}})
          .study;
  study.accuracy.target = 0.1;  // a coarse answer goes through all stages as a fine one does
  lighting::set_threads(1);
  const lighting::Results one = answer(study);
  for (const int threads : {2, 3}) {
    lighting::set_threads(threads);
    const lighting::Results many = answer(study);
    expect_same_bytes("illuminance", one.grids.at(0).illuminance_lux, many.grids.at(0).illuminance_lux);
    expect_same_bytes("error", one.grids.at(0).error_lux, many.grids.at(0).error_lux);
    expect_same_bytes("surface illuminance", one.surfaces.illuminance_lux, many.surfaces.illuminance_lux);
    expect_same_bytes("surface radiosity", one.surfaces.radiosity_lm_m2, many.surfaces.radiosity_lm_m2);
    expect_same_bytes("surface error", one.surfaces.error_lux, many.surfaces.error_lux);
    expect_same_bytes("surface points", one.surfaces.point_illuminance_lux, many.surfaces.point_illuminance_lux);
    EXPECT_EQ(one.counts.links, many.counts.links);
  }
  lighting::set_threads(0);
}

}  // namespace
}  // namespace clerestory::test
