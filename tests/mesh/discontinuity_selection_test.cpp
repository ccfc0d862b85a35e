// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/discontinuity_selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <span>
#include <vector>

namespace clerestory::mesh {
namespace {

DiscontinuityLine line_at(double y, double from, double to, std::uint8_t order = 1) {
  DiscontinuityLine line;
  line.face = FaceId(0U);
  line.ends = {Point{from, y, 0}, Point{to, y, 0}};
  line.order = order;
  return line;
}

/// Lines along x, each of a weight of its own whatever the size of elements.
template <class Weight>
LineSelection select_by(std::span<const DiscontinuityLine> lines, const Weight& weight,
                        const SelectionOptions& options = {}) {
  std::vector<WeighedLine> weighed;
  for (const DiscontinuityLine& line : lines) {
    const double w = weight(line);
    weighed.push_back({{0, 1, 0}, 1.0, [w](double) { return w; }});
  }
  return select_lines(lines, weighed, options);
}

TEST(DiscontinuitySelection, KeepsWhatMattersTheWeightiestFirst) {
  const std::vector<DiscontinuityLine> lines{line_at(0, 0, 1), line_at(1, 0, 1, 2), line_at(2, 0, 1),
                                             line_at(3, 0, 1, 0)};
  const std::vector<double> weights{2.0, 0.5, 1.0, 9.0};
  const auto selection =
      select_by(lines, [&](const DiscontinuityLine& l) { return weights[static_cast<std::size_t>(l.ends[0].y)]; });
  EXPECT_THAT(selection.kept, testing::ElementsAre(3U, 0U));
  EXPECT_THAT(selection.found, testing::ElementsAre(1U, 2U, 1U));
  EXPECT_THAT(selection.kept_count, testing::ElementsAre(1U, 1U, 0U));
  EXPECT_EQ(selection.light, 2U);
}

TEST(DiscontinuitySelection, LinesAlongAWeightierOneAreMerged) {
  const std::vector<DiscontinuityLine> lines{line_at(0, 0.2, 0.8), line_at(0.0005, 0, 1), line_at(0, 0.5, 1.5)};
  const auto selection =
      select_by(lines, [](const DiscontinuityLine& l) { return 1.0 + norm(l.ends[1] - l.ends[0]) + l.ends[0].y; });
  EXPECT_THAT(selection.kept, testing::ElementsAre(1U, 2U));
  EXPECT_EQ(selection.merged, 1U);
}

TEST(DiscontinuitySelection, CapIsToldWithItsFace) {
  std::vector<DiscontinuityLine> lines;
  for (int i = 0; i < 10; ++i) lines.push_back(line_at(i, 0, 1));
  const auto selection = select_by(lines, [](const DiscontinuityLine&) { return 2.0; }, {.most_per_face = 4});
  EXPECT_THAT(selection.kept, testing::ElementsAre(0U, 1U, 2U, 3U));
  EXPECT_EQ(selection.over_cap, 6U);
  EXPECT_THAT(selection.cap_faces, testing::ElementsAre(FaceId(0U)));
}

TEST(DiscontinuitySelection, CapOnAllFacesKeepsTheWeightiest) {
  std::vector<DiscontinuityLine> lines;
  for (int i = 0; i < 10; ++i) {
    lines.push_back(line_at(i, 0, 1));
    lines.back().face = FaceId(static_cast<std::size_t>(i));
  }
  const auto selection = select_by(lines, [](const DiscontinuityLine& l) { return 2.0 + l.ends[0].y; }, {.most = 3});
  EXPECT_THAT(selection.kept, testing::ElementsAre(9U, 8U, 7U));
  EXPECT_EQ(selection.over_cap, 7U);
}

TEST(DiscontinuitySelection, KeptLinesMakeTheElementsOfTheNextOnesSmaller) {
  // Elements of 1 m; of lines 0.05 m apart each misses 10 times its element's size. Between two that are kept 0.1 m apart no third one
  // misses enough; a line that these do not reach does.
  std::vector<DiscontinuityLine> lines;
  for (int i = 0; i < 5; ++i) lines.push_back(line_at(0.05 * i, 0, 1));
  lines.push_back(line_at(0.1, 3, 4));
  std::vector<WeighedLine> weighed(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double more = i == 0 || i == 2 ? 1.0 : 0.9;
    weighed[i] = {{0, 1, 0}, 1.0, [more](double size) { return 10.0 * more * size; }};
  }
  const auto selection = select_lines(lines, weighed);
  EXPECT_THAT(selection.kept, testing::UnorderedElementsAre(0U, 2U, 3U, 4U, 5U));
  EXPECT_EQ(selection.light, 1U);
}

}  // namespace
}  // namespace clerestory::mesh
