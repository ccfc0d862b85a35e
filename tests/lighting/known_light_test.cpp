// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/known_light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lighting/scene.h"
#include "lighting/scene_hash.h"
#include "mesh/error.h"
#include "tests/lighting/stages.h"

namespace clerestory::lighting {
namespace {

using testing::HasSubstr;
using Kind = SourceGroup::Kind;

const mesh::ElementId kNode(std::size_t{0});

/// A furnished room under a sun, with the sky in patches.
Study kept_study() {
  Study study = test::furnished_room_study();
  study.keep_solution = true;
  study.sky.sun = {.towards = {0.0, 0.6, 0.8}, .normal_illuminance_lux = 1000.0};
  return study;
}

/// One lux of each group of a scene, at node 0.
KnownLight one_lux_each(const Scene& scene) {
  KnownLight known;
  known.groups = scene.groups.all();
  for (std::uint32_t g = 0; g < known.groups.size(); ++g) known.direct.push_back({kNode, g, {1, 0, 0}});
  return known;
}

float lux_of(const FittedLight& fitted, std::uint32_t group) {
  float sum = 0.0F;
  for (const GroupDirect& given : fitted.direct) sum += given.group == group ? given.lux.value : 0.0F;
  return sum;
}

std::string refusal(const KnownLight& known, const Scene& scene) {
  try {
    fit(known, scene);
  } catch (const InputError& error) {
    return error.problem();
  }
  return "";
}

TEST(KnownLight, GoesWithTheStrengthOfPatchesSunAndLamps) {
  Study study = kept_study();
  const KnownLight known = one_lux_each(build_scene(study));
  study.sky.horizontal_illuminance_lux *= 2.0;
  study.sky.sun.normal_illuminance_lux *= 3.0;
  const Scene scene = build_scene(study);
  const FittedLight fitted = fit(known, scene);
  EXPECT_FALSE(fitted.lacks_sun);
  EXPECT_NEAR(lux_of(fitted, 0), 2.0, 1e-6);
  EXPECT_NEAR(lux_of(fitted, scene.groups.of_sun()), 3.0, 1e-6);
}

TEST(KnownLight, ASunElsewhereIsToBeCastAndOneThatIsDownIsNot) {
  Study study = kept_study();
  const KnownLight known = one_lux_each(build_scene(study));
  study.sky.sun.towards = {0.6, 0.0, 0.8};
  Scene scene = build_scene(study);
  EXPECT_TRUE(fit(known, scene).lacks_sun);
  EXPECT_EQ(lux_of(fit(known, scene), scene.groups.of_sun()), 0.0F);
  study.sky.sun.towards = {0.6, 0.0, -0.8};
  scene = build_scene(study);
  EXPECT_FALSE(fit(known, scene).lacks_sun);
}

TEST(KnownLight, TheSkyOfAMomentServesThatMomentAloneAndExactly) {
  Study study = kept_study();
  const Scene scene = build_scene(study);
  KnownLight known = one_lux_each(scene);
  known.groups.push_back({"sky_noon", Kind::kSky, 0.25, source_of(scene.sky)});
  known.direct.push_back({kNode, static_cast<std::uint32_t>(known.groups.size() - 1), {1, 0, 0}});
  const FittedLight same = fit(known, scene);
  EXPECT_NEAR(lux_of(same, 0), 4.0, 1e-6);  // the moment stood in the mean by a quarter of its light
  EXPECT_EQ(lux_of(same, 1), 0.0F);         // and patches would count it twice
  study.sky.horizontal_illuminance_lux *= 2.0;
  EXPECT_GT(lux_of(fit(known, build_scene(study)), 1), 1.0F);
}

TEST(KnownLight, ErrorsGoWithTheSquare) {
  Study study = kept_study();
  Scene scene = build_scene(study);
  KnownLight known = one_lux_each(scene);
  known.errors.push_back({kNode, scene.groups.of_sun(), {2.0F, 3.0F}});
  study.sky.sun.normal_illuminance_lux *= 2.0;
  const FittedLight fitted = fit(known, build_scene(study));
  ASSERT_EQ(fitted.errors.size(), 1U);
  EXPECT_NEAR(fitted.errors[0].errors.noise2, 8.0, 1e-5);
  EXPECT_NEAR(fitted.errors[0].errors.misfit2, 12.0, 1e-5);
}

TEST(KnownLight, WhatIsNotKnownIsRefused) {
  const Scene scene = build_scene(kept_study());
  KnownLight known = one_lux_each(scene);
  known.groups.back().name = "other lamps";
  EXPECT_THAT(refusal(known, scene), HasSubstr("does not know the group 'lamp'"));
  known = one_lux_each(scene);
  known.groups[7].strength = 0.0;
  EXPECT_THAT(refusal(known, scene), HasSubstr("has no light of 'sky-8'"));
  known.groups = {};
  known.direct = {};
  EXPECT_THAT(refusal(known, scene), HasSubstr("has no light of the sky"));
}

}  // namespace
}  // namespace clerestory::lighting
