// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/box_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace clerestory::mesh {
namespace {

TEST(BoxTree, FindsWhatALoopOverAllBoxesFinds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0.0, 10.0);
  std::uniform_real_distribution<double> size(0.0, 1.0);
  std::vector<Box> boxes(500);
  for (Box& box : boxes) {
    const Point low{place(random), place(random), place(random)};
    box.add(low);
    box.add(low + Vector{size(random), size(random), size(random)});
  }
  const BoxTree tree(boxes);
  for (const Box& query : boxes) {
    std::vector<std::uint32_t> found;
    tree.visit([&](const Box& b) { return overlap(query, b); }, [&](std::uint32_t i) { found.push_back(i); });
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      if (overlap(query, boxes[i])) expected.push_back(i);
    }
    EXPECT_THAT(found, testing::UnorderedElementsAreArray(expected));
  }
}

TEST(BoxTree, NeverVisitsEmptyBoxes) {
  std::vector<Box> boxes(20);
  boxes[3].add(Point{1, 1, 1});
  const BoxTree tree(boxes);
  std::vector<std::uint32_t> found;
  tree.visit([](const Box&) { return true; }, [&](std::uint32_t i) { found.push_back(i); });
  EXPECT_THAT(found, testing::ElementsAre(3U));
  BoxTree().visit([](const Box&) { return true; }, [](std::uint32_t) { FAIL(); });
}

}  // namespace
}  // namespace clerestory::mesh
