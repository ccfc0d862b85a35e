// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/channel_deviations.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/lighting/stages.h"

namespace clerestory::lighting {
namespace {

using mesh::ElementId;

struct Channels : test::Solved {
  Channels() : Solved(test::furnished_room_study()), system(solution, transport.arrivals, transport.clusters) {}

  [[nodiscard]] ChannelDeviations of(std::size_t count, const ChannelLine& line) const {
    return channel_deviations(system, solution.tree().size(), count, line);
  }
  /// What an element sends out of all light.
  [[nodiscard]] LinearValue sent(ElementId e) const {
    const mesh::FaceSide side = solution.tree().face_side(e);
    const float rho = scene.side_reflectance(side)[0];
    const LinearValue& lux = solution.irradiance(e)[0];
    return {rho * lux.value + scene.side_exitance(side)[0], rho * lux.slope_u, rho * lux.slope_v};
  }
  /// Whether an element lies in the western half of the room.
  [[nodiscard]] bool is_west(ElementId e) const { return solution.tree().centroid(e).x < local({2, 0, 0}).x; }

  ChannelSystem system;
};

TEST(ChannelDeviations, OfOneChannelAreThoseOfAllLight) {
  const Channels room;
  ASSERT_EQ(room.scene.channels, 1U);
  const ChannelDeviations found = room.of(1, [&](ElementId e, std::size_t) { return room.sent(e); });
  std::size_t uneven = 0;
  for (const ChannelSystem::Row& row : room.system.rows) {
    if (row.is_element) continue;
    const float mean = room.solution.radiosity_mean(row.node);
    EXPECT_NEAR(found.of(row.node), room.solution.radiosity_deviation(row.node), 3e-3F * mean);
    uneven += found.of(row.node) > 0.01F * mean ? 1 : 0;
  }
  EXPECT_GT(uneven, 10U);
  for (std::uint32_t c = 0; c < room.transport.clusters.size(); ++c) {
    EXPECT_NEAR(found.of_cluster(c), room.transport.clusters.radiosity_deviation(c),
                3e-3F * room.transport.clusters.radiosity_mean(c));
  }
}

TEST(ChannelDeviations, ChannelsThatAddUpToEvenLightAreNotEven) {
  const Channels room;
  const auto even = [&](ElementId, std::size_t) { return LinearValue{100.0F, 0.0F, 0.0F}; };
  const auto halves = [&](ElementId e, std::size_t channel) {
    return LinearValue{room.is_west(e) == (channel == 0) ? 100.0F : 0.0F, 0.0F, 0.0F};
  };
  const ChannelDeviations one = room.of(1, even);
  EXPECT_NEAR(*std::max_element(one.nodes.begin(), one.nodes.end()), 0.0, 0.05);
  const ChannelDeviations two = room.of(2, halves);
  EXPECT_GT(*std::max_element(two.nodes.begin(), two.nodes.end()), 10.0F);
  EXPECT_GT(two.of_cluster(0), 40.0F);
}

TEST(ChannelDeviations, TheMostUnevenOfManyChannelsCounts) {
  const Channels room;
  const auto dark_but_two = [&](ElementId e, std::size_t channel) {
    const float bright = channel == 3 ? 10.0F : channel == 37 ? 70.0F : 0.0F;
    return LinearValue{room.is_west(e) ? bright : 0.0F, 0.0F, 0.0F};
  };
  const auto one = [&](ElementId e, std::size_t) { return LinearValue{room.is_west(e) ? 70.0F : 0.0F, 0.0F, 0.0F}; };
  EXPECT_EQ(room.of(40, dark_but_two).nodes, room.of(1, one).nodes);
}

}  // namespace
}  // namespace clerestory::lighting
