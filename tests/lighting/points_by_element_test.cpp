// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/points_by_element.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace clerestory::lighting {
namespace {

using mesh::ElementId;

TEST(PointsByElement, HoldsEachPointOnceWithItsElement) {
  std::vector<ElementId> elements;
  for (std::size_t i = 0; i < 500; ++i) elements.push_back(i % 7 == 0 ? ElementId() : ElementId((i * 37) % 11));
  const PointsByElement points(elements);
  std::vector<int> times(elements.size(), 0);
  for (std::size_t g = 0; g < points.groups(); ++g) {
    EXPECT_FALSE(points.points(g).empty());
    EXPECT_TRUE(std::is_sorted(points.points(g).begin(), points.points(g).end()));
    for (const std::uint32_t i : points.points(g)) {
      EXPECT_EQ(elements[i], points.element(g));
      ++times[i];
    }
  }
  for (std::size_t i = 0; i < elements.size(); ++i) EXPECT_EQ(times[i], elements[i].valid() ? 1 : 0) << i;
}

TEST(PointsByElement, PartsWhatIsTooManyForOneThread) {
  const PointsByElement points(std::vector<ElementId>(1000, ElementId(3U)));
  EXPECT_GT(points.groups(), 10U);
  EXPECT_LT(points.groups(), 20U);
}

TEST(PointsByElement, IsEmptyWithoutPointsOnElements) {
  EXPECT_EQ(PointsByElement({}).groups(), 0U);
  EXPECT_EQ(PointsByElement(std::vector<ElementId>(3)).groups(), 0U);
}

}  // namespace
}  // namespace clerestory::lighting
