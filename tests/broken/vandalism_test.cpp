// SPDX-License-Identifier: GPL-3.0-or-later
// Clean models are damaged by rule at fixed seeds; the clean-up must give back their area and what was closed.
#include <gtest/gtest.h>

#include "io/model_file.h"
#include "mesh/clean.h"
#include "tests/support/places.h"
#include "tests/support/shapes.h"
#include "tests/support/vandalism.h"

namespace clerestory::test {
namespace {

using mesh::Model;

/// Twice what rounding to six decimals moves.
constexpr double kJitter = 1e-6;

/// An L-shaped house and a box, closed shells with shared vertices.
Model closed_shape() {
  Model shape;
  support::add_prism(shape, std::vector<mesh::Point>{{0, 0, 0}, {5, 0, 0}, {5, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}},
                     0.0, 3.0);
  support::add_box(shape, {7, 0, 0}, {9, 1.5, 2}, {"wall", "box"});
  return mesh::clean(shape, {}).polygons;
}

Model sample_office() {
  return mesh::clean(io::read_model(samples_dir() / "office" / "office.obj").model, {}).polygons;
}

void expect_restored(const Model& sound, const support::Damage& damage, std::uint32_t seed) {
  const mesh::CleanReport before = mesh::clean(sound, {}).report;
  const mesh::CleanReport after = mesh::clean(support::vandalised(sound, damage, seed), {}).report;
  EXPECT_NEAR(after.area_after_m2, before.area_after_m2, 1e-6 * before.area_after_m2) << "seed " << seed;
  EXPECT_NEAR(after.open_length_m, before.open_length_m, 1e-4) << "seed " << seed;
  EXPECT_EQ(after.closed_shells, before.closed_shells) << "seed " << seed;
}

TEST(Vandalism, OfOneKindIsUndone) {
  const support::Damage kinds[] = {
      {.jitter_m = kJitter}, {.duplicated = 0.1}, {.flipped = 0.2}, {.split = 0.2}, {.unwelded = 0.05}};
  for (const Model& sound : {closed_shape(), sample_office()}) {
    for (const support::Damage& damage : kinds) expect_restored(sound, damage, 1);
  }
}

TEST(Vandalism, OfAllKindsIsUndone) {
  const support::Damage all{.jitter_m = kJitter, .duplicated = 0.1, .flipped = 0.2, .split = 0.2, .unwelded = 0.05};
  const Model shape = closed_shape();
  const Model office = sample_office();
  for (std::uint32_t seed = 1; seed <= 20; ++seed) expect_restored(shape, all, seed);
  for (std::uint32_t seed = 1; seed <= 5; ++seed) expect_restored(office, all, seed);
}

TEST(Vandalism, ChangesTheModel) {
  const Model sound = closed_shape();
  const Model damaged = support::vandalised(sound, {.duplicated = 0.5, .split = 0.5}, 3);
  EXPECT_GT(damaged.polygon_count(), sound.polygon_count());
  EXPECT_GT(damaged.vertices.size(), sound.vertices.size());
}

}  // namespace
}  // namespace clerestory::test
