// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/channels.h"

#include <gtest/gtest.h>

#include "mesh/error.h"

namespace clerestory::lighting {
namespace {

TEST(SourceGroups, OneGroupHoldsAllWhereNothingIsToldApart) {
  SourceGroups groups;
  EXPECT_FALSE(groups.parted());
  EXPECT_EQ(groups.count(), 1U);
  EXPECT_EQ(groups.add_lamps("row-a"), 0U);
  EXPECT_EQ(groups.of_sky({0.0, 0.0, 1.0}), 0U);
  EXPECT_EQ(groups.count(), 1U);
}

TEST(SourceGroups, LampsOfOneNameShareAGroup) {
  SourceGroups groups(Columns::kGroups, false, true, true, 0.0);
  EXPECT_EQ(groups.count(), 2U);
  EXPECT_EQ(groups[groups.of_sun()].name, "sun");
  EXPECT_EQ(groups[groups.of_sky({0.0, 0.6, -0.8})].name, "sky");
  const std::uint32_t a = groups.add_lamps("row-a");
  const std::uint32_t b = groups.add_lamps("row-b");
  EXPECT_NE(a, b);
  EXPECT_EQ(groups.add_lamps("row-a"), a);
  EXPECT_EQ(groups.count(), 4U);
}

TEST(SourceGroups, PatchesComeFirstAndTheGroundBehindThem) {
  const SourceGroups groups(Columns::kSky145, false, true, false, 0.0);
  EXPECT_EQ(groups.count(), 146U);
  EXPECT_EQ(groups[0].name, "sky-1");
  EXPECT_EQ(groups[145].name, "ground");
  EXPECT_EQ(groups.of_sky({0.0, 0.0, 1.0}), 144U);
  EXPECT_EQ(groups.of_sky({0.0, 0.6, -0.8}), 145U);
  EXPECT_EQ(SourceGroups(Columns::kSky577, false, true, false, 0.0).count(), 578U);
}

TEST(SourceGroups, OfKeptSolutionsTheSkyIsInPatchesWhateverColumnsThereAre) {
  SourceGroups hidden(Columns::kMix, true, true, false, 0.0);
  EXPECT_TRUE(hidden.parted());
  EXPECT_FALSE(hidden.has_columns());
  EXPECT_EQ(hidden.count(), 146U);
  SourceGroups joined(Columns::kGroups, true, true, false, 0.0);
  const std::uint32_t lamps = joined.add_lamps("row-a");
  EXPECT_EQ(joined.count(), 147U);
  EXPECT_EQ(joined.column_count(), 2U);
  for (std::uint32_t g = 0; g < 146; ++g) EXPECT_EQ(joined.column_of(g), 0U);
  EXPECT_EQ(joined.column_of(lamps), 1U);
  EXPECT_EQ(joined.column_name(0), "sky");
  EXPECT_EQ(joined.column_name(1), "row-a");
  EXPECT_THROW(joined.add_lamps("sky"), InputError);
}

TEST(SourceGroups, LampsCannotBearTheNameOfDaylight) {
  SourceGroups groups(Columns::kGroups, false, true, false, 0.0);
  EXPECT_THROW(groups.add_lamps("sky"), InputError);
}

TEST(SourceGroups, OfMomentsAreTheSkyAndTheSunOfEachBehindThePatchesOfAKeptSolution) {
  for (const bool kept : {false, true}) {
    SourceGroups groups({"a", "b"}, kept, 0.0);
    const std::uint32_t first = kept ? 146 : 0;
    EXPECT_TRUE(groups.parted());
    EXPECT_FALSE(groups.has_columns());
    EXPECT_EQ(groups.has_patches(), kept);
    EXPECT_EQ(groups.of_sky_at(1), first + 1);
    EXPECT_EQ(groups.of_sun_at(0), first + 2);
    EXPECT_EQ(groups[groups.of_sun_at(1)].name, "sun_b");
    EXPECT_EQ(groups.add_lamps("row"), first + 4);
  }
}

TEST(SourceGroups, OfOneMomentTellLampsApartWhetherColumnsAreAskedForOrNot) {
  for (const Columns columns : {Columns::kMix, Columns::kGroups}) {
    SourceGroups groups = SourceGroups::of_moment(columns, true, true);
    EXPECT_EQ(groups.of_sun(), 1U);
    EXPECT_EQ(groups.add_lamps("row"), 2U);
    EXPECT_EQ(groups.has_columns(), columns == Columns::kGroups);
  }
  EXPECT_EQ(SourceGroups::of_moment(Columns::kMix, false, false).add_lamps("row"), 0U);
}

TEST(GroupSums, TellWhatIsLitAndNothingWhereGroupsAreOne) {
  const SourceGroups groups(Columns::kSky145, false, true, false, 0.0);
  GroupSums sums(groups);
  sums.add(7, 1.5);
  sums.add(145, 2.0);
  sums.add(7, 0.5);
  const std::vector<GroupLight> lit = sums.lit();
  ASSERT_EQ(lit.size(), 2U);
  EXPECT_EQ(lit[0].group, 7U);
  EXPECT_EQ(lit[0].lux, 2.0);
  EXPECT_EQ(lit[1].group, 145U);
  GroupSums none;
  none.add(0, 1.0);
  EXPECT_TRUE(none.lit().empty());
  none = GroupSums{SourceGroups()};
  none.add(0, 1.0);
  EXPECT_TRUE(none.lit().empty());
}

}  // namespace
}  // namespace clerestory::lighting
