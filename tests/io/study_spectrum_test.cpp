// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh/error.h"
#include "tests/io/study_folder.h"

namespace clerestory::io {
namespace {

using testing::ElementsAre;
using testing::FloatEq;
using testing::HasSubstr;
using testing::Optional;

const std::string kModel = "[model]\nfile = 'room.obj'\n";

std::string refusal(const std::string& text) {
  try {
    (void)test::StudyFolder().read(kModel + text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(StudySpectrum, BandsAreRedGreenAndBlueUnlessWeightsAreGiven) {
  EXPECT_TRUE(test::StudyFolder().read(kModel).study.band_weights.empty());
}

TEST(StudySpectrum, WeightsAreSharesOfTheirSum) {
  EXPECT_THAT(test::StudyFolder().read(kModel + "[spectrum]\nweights = [1, 2, 5, 0]\n").study.band_weights,
              ElementsAre(0.125F, 0.25F, 0.625F, 0.0F));
}

TEST(StudySpectrum, MaterialsHaveANumberABand) {
  const lighting::Study study =
      test::StudyFolder()
          .read(kModel +
                "[spectrum]\nweights = [1, 2, 1, 0]\n[materials]\nfloor = { reflectance = [0.1, 0.2, 0.3, 0.4] }\n"
                "wall = { reflectance = 0.6 }\n")
          .study;
  EXPECT_THAT(study.materials[0].front.reflectance, Optional(ElementsAre(0.1F, 0.2F, 0.3F, 0.4F)));
  EXPECT_EQ(study.materials[0].became, "reflectance 0.10 to 0.40 (4 bands)");
  EXPECT_THAT(study.materials[1].front.reflectance, Optional(ElementsAre(0.6F)));
}

TEST(StudySpectrum, ColoursOfTheModelAreGreyWhereBandsAreOthers) {
  const test::StudyFolder folder;
  test::write_text(folder.path() / "room.mtl", "newmtl floor\nKd 0.1 0.5 0.9\n");
  const lighting::Study study = folder.read(kModel + "[spectrum]\nweights = [1, 1]\n").study;
  EXPECT_THAT(study.materials[0].front.reflectance,
              Optional(ElementsAre(FloatEq(0.265F * 0.1F + 0.670F * 0.5F + 0.065F * 0.9F))));
}

TEST(StudySpectrum, AsManyNumbersAsBandsAreAskedFor) {
  EXPECT_THAT(refusal("[materials.floor]\nreflectance = [0.1, 0.2]\n"),
              HasSubstr("has 2 numbers, and there are 3 bands"));
  EXPECT_THAT(refusal("[spectrum]\nweights = [1, 1]\n[materials.floor]\nreflectance = [0.1, 0.2, 0.3]\n"),
              HasSubstr("has 3 numbers, and there are 2 bands"));
}

TEST(StudySpectrum, WeightsThatAreNoneAreRefused) {
  EXPECT_THAT(refusal("[spectrum]\nweights = [0, 0]\n"), HasSubstr("all weights are zero"));
  EXPECT_THAT(refusal("[spectrum]\nweights = [1, -1]\n"), HasSubstr("no number from 0"));
  EXPECT_THAT(refusal("[spectrum]\nweights = [[1], [2]]\n"), HasSubstr("no number from 0"));
  EXPECT_THAT(refusal("[spectrum]\nweights = 3\n"), HasSubstr("expected a list of numbers"));
}

}  // namespace
}  // namespace clerestory::io
