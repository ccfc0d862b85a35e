// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/io/refusal.h"
#include "tests/io/study_folder.h"

namespace clerestory::io {
namespace {

using lighting::Sky;
using test::StudyFolder;
using testing::Contains;
using testing::HasSubstr;

constexpr const char* kModel = "[model]\nfile = 'room.obj'\n";
constexpr const char* kSunAt60 = "sun_altitude = 60.0\nsun_azimuth = 180.0\n";

lighting::Study read(const std::string& lines) { return StudyFolder().read(kModel + lines).study; }
std::string refusal(const std::string& lines) {
  return test::refusal_of([&] { read(lines); });
}

TEST(StudySky, GeneralSkiesNeedTheSunWhereTheyDependOnIt) {
  const Sky clear = read(std::string("[sky]\ntype = 'cie-clear'\n") + kSunAt60).sky;
  EXPECT_EQ(clear.type, Sky::Type::kDistribution);
  EXPECT_DOUBLE_EQ(clear.distribution.c, 10.0);
  EXPECT_NEAR(clear.distribution.towards_sun.y, -0.5, 1e-12);
  EXPECT_DOUBLE_EQ(clear.horizontal_illuminance_lux, 10'000.0);
  EXPECT_FALSE(clear.sun.shines());
  EXPECT_EQ(read("[sky]\ntype = 'cie-1'\n").sky.type, Sky::Type::kDistribution);
  EXPECT_THAT(refusal("[sky]\ntype = 'cie-12'\n"), HasSubstr("needs to know where the sun stands; give sky.time"));
}

TEST(StudySky, TheZenithTellsHowBrightItIs) {
  const Sky sky = read("[sky]\ntype = 'cie-5'\nzenith_luminance = 1000\n").sky;
  EXPECT_NEAR(sky.horizontal_illuminance_lux, 3141.59265, 1e-3);
  EXPECT_NEAR(lighting::sky_luminance(sky, {0, 0, 1}), 1000.0, 1e-6);
  EXPECT_THAT(refusal("[sky]\nzenith_luminance = 1000\nhorizontal_illuminance = 5000\n"),
              HasSubstr("give one of them"));
}

TEST(StudySky, TheSunShinesWhereItIsAskedFor) {
  const Sky sky =
      read(std::string("[sky]\nsun = true\nsun_disc = true\nsun_normal_illuminance = 80000\n") + kSunAt60).sky;
  EXPECT_TRUE(sky.sun.shines());
  EXPECT_TRUE(sky.sun.disc);
  EXPECT_NEAR(sky.ground_illuminance_lux(), 10'000.0 + 80'000.0 * sky.sun.towards.z, 1e-6);
  EXPECT_THAT(refusal(std::string("[sky]\nsun = true\n") + kSunAt60), HasSubstr("give sky.sun_normal_illuminance"));
  EXPECT_THAT(refusal("[sky]\nsun = true\nsun_normal_illuminance = 1\n"),
              HasSubstr("needs to know where the sun stands"));
  EXPECT_THAT(refusal("[sky]\nsun_normal_illuminance = 1\n"), HasSubstr("the sun is off"));
}

TEST(StudySky, ASunUnderTheHorizonIsToldAndGivesNoLight) {
  const auto study =
      read("[sky]\nsun = true\nsun_normal_illuminance = 80000\nsun_altitude = -3.0\nsun_azimuth = 90.0\n");
  EXPECT_FALSE(study.sky.sun.shines());
  EXPECT_THAT(study.assumptions, Contains(HasSubstr("The sun stands 3.00 degrees under the horizon")));
}

TEST(StudySky, PerezComesFromIrradiances) {
  const Sky sky =
      read(std::string("[sky]\ntype = 'perez'\nsun = true\ndirect_normal = 700\ndiffuse_horizontal = 100\n") + kSunAt60)
          .sky;
  EXPECT_GT(sky.horizontal_illuminance_lux, 10'000.0);
  EXPECT_GT(sky.sun.normal_illuminance_lux, 60'000.0);
  EXPECT_THAT(refusal(std::string("[sky]\ntype = 'perez'\n") + kSunAt60), HasSubstr("needs irradiances"));
  const auto both =
      read(std::string("[sky]\ntype = 'perez'\ndiffuse_horizontal = 1\nhorizontal_illuminance = 9000\n") + kSunAt60);
  EXPECT_LT(both.sky.horizontal_illuminance_lux, 500.0);
  EXPECT_THAT(both.assumptions, Contains(HasSubstr("horizontal_illuminance in [sky] was set aside")));
}

}  // namespace
}  // namespace clerestory::io
