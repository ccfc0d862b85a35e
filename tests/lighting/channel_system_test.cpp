// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/channel_system.h"

#include <gtest/gtest.h>

#include "tests/lighting/stages.h"

namespace clerestory::lighting {
namespace {

struct System : test::Solved {
  System() : Solved(test::furnished_room_study()), system(solution, transport.arrivals, transport.clusters) {}

  ChannelSystem system;
};

TEST(ChannelSystem, ParentsComeBeforeTheirChildrenAndChildrenFillThem) {
  const System s;
  std::vector<double> shares(s.system.rows.size(), 0.0);
  for (std::uint32_t r = 0; r < s.system.rows.size(); ++r) {
    const ChannelSystem::Row& row = s.system.rows[r];
    EXPECT_EQ(s.system.row_of(row.node), r);
    if (row.parent == ChannelSystem::kNone) continue;
    EXPECT_LT(row.parent, r);
    shares[row.parent] += row.place.share;
  }
  for (std::size_t r = 0; r < shares.size(); ++r) EXPECT_NEAR(shares[r], s.system.rows[r].is_element ? 0.0 : 1.0, 1e-5);
}

TEST(ChannelSystem, EveryLinkIsATermAtEachOfItsReceivers) {
  const System s;
  const std::size_t arriving = s.transport.arrivals.count();
  EXPECT_EQ(s.system.terms.size(), arriving);
  EXPECT_EQ(s.system.first_term.back(), arriving);
  for (const ChannelSystem::Term& term : s.system.terms) EXPECT_LT(term.source, s.system.row_count());
}

TEST(ChannelSystem, ElementsAreThoseOfTheSolution) {
  const System s;
  std::vector<mesh::ElementId> elements;
  for (const ChannelSystem::Row& row : s.system.rows) {
    if (row.is_element) elements.push_back(row.node);
  }
  EXPECT_EQ(elements, s.solution.elements());
}

}  // namespace
}  // namespace clerestory::lighting
