// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/defect_advice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clerestory::io {
namespace {

using testing::HasSubstr;
using Repair = mesh::CleanOptions::Repair;

mesh::Defect gaps(std::size_t mended) {
  mesh::Defect defect{.kind = "gaps", .found = 4, .mended = mended, .places = {}};
  for (std::uint32_t i = 0; i < 4; ++i)
    defect.places.push_back({.polygon = i, .at = {}, .note = {}, .size_m = 0.001 * i});
  defect.places[1].mended = false;
  return defect;
}

std::vector<std::uint32_t> polygons(const std::vector<mesh::Defect::Place>& places) {
  std::vector<std::uint32_t> list;
  for (const auto& place : places) list.push_back(place.polygon);
  return list;
}

TEST(DefectAdvice, WhatWasLeftIsWorstThenWhatIsLargest) {
  EXPECT_EQ(polygons(worst_places(gaps(3))), (std::vector<std::uint32_t>{1, 3, 2}));
  EXPECT_EQ(polygons(worst_places(gaps(3), 9)), (std::vector<std::uint32_t>{1, 3, 2, 0}));
}

TEST(DefectAdvice, MendedDefectsNeedNothing) {
  EXPECT_THAT(defect_advice(gaps(4), Repair::kAuto), HasSubstr("nothing"));
  EXPECT_THAT(defect_advice(gaps(3), Repair::kAuto), HasSubstr("--gap"));
  EXPECT_THAT(defect_advice(gaps(0), Repair::kReport), HasSubstr("--repair auto"));
}

TEST(DefectAdvice, AKindWithoutAdviceOfItsOwnStillGetsSome) {
  mesh::Defect other = gaps(3);
  other.kind = "T-junctions";
  EXPECT_FALSE(defect_advice(other, Repair::kAuto).empty());
}

TEST(DefectAdvice, OneThatIsLeftMakesAModelUnmended) {
  mesh::CleanReport report;
  EXPECT_FALSE(has_unmended(report));
  report.defects = {gaps(4)};
  EXPECT_FALSE(has_unmended(report));
  report.defects.push_back(gaps(3));
  EXPECT_TRUE(has_unmended(report));
}

}  // namespace
}  // namespace clerestory::io
