// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/discontinuity_selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clerestory::mesh {
namespace {

DiscontinuityLine line_at(double y, double from, double to, std::uint8_t order = 1) {
  DiscontinuityLine line;
  line.face = FaceId(0U);
  line.ends = {Point{from, y, 0}, Point{to, y, 0}};
  line.order = order;
  return line;
}

TEST(DiscontinuitySelection, KeepsWhatMattersTheWeightiestFirst) {
  const std::vector<DiscontinuityLine> lines{line_at(0, 0, 1), line_at(1, 0, 1, 2), line_at(2, 0, 1),
                                             line_at(3, 0, 1, 0)};
  const std::vector<double> weights{2.0, 0.5, 1.0, 9.0};
  const auto selection =
      select_lines(lines, [&](const DiscontinuityLine& l) { return weights[static_cast<std::size_t>(l.ends[0].y)]; });
  EXPECT_THAT(selection.kept, testing::ElementsAre(3U, 0U));
  EXPECT_THAT(selection.found, testing::ElementsAre(1U, 2U, 1U));
  EXPECT_THAT(selection.kept_count, testing::ElementsAre(1U, 1U, 0U));
  EXPECT_EQ(selection.light, 2U);
}

TEST(DiscontinuitySelection, LinesAlongAWeightierOneAreMerged) {
  const std::vector<DiscontinuityLine> lines{line_at(0, 0.2, 0.8), line_at(0.0005, 0, 1), line_at(0, 0.5, 1.5)};
  const auto selection =
      select_lines(lines, [](const DiscontinuityLine& l) { return 1.0 + norm(l.ends[1] - l.ends[0]) + l.ends[0].y; });
  EXPECT_THAT(selection.kept, testing::ElementsAre(1U, 2U));
  EXPECT_EQ(selection.merged, 1U);
}

TEST(DiscontinuitySelection, CapIsToldWithItsFace) {
  std::vector<DiscontinuityLine> lines;
  for (int i = 0; i < 10; ++i) lines.push_back(line_at(i, 0, 1));
  const auto selection = select_lines(lines, [](const DiscontinuityLine&) { return 2.0; }, {.most_per_face = 4});
  EXPECT_THAT(selection.kept, testing::ElementsAre(0U, 1U, 2U, 3U));
  EXPECT_EQ(selection.over_cap, 6U);
  EXPECT_THAT(selection.cap_faces, testing::ElementsAre(FaceId(0U)));
}

}  // namespace
}  // namespace clerestory::mesh
