// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/seen_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lighting/sampling.h"
#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::ElementId;
using mesh::Point;

/// Two squares that face each other; the lower one's illuminance is linear: 100 + 60 u - 30 v.
struct Facing : test::Stage {
  Facing() : Stage(test::study_of(support::facing_squares(), 0.5, {0.5, 0.5, 0.5})) { shade(); }
  void shade() {
    solution.direct(root("lower"))[0] = {100.0F, 60.0F, -30.0F};
    solution.push_pull();
  }
  /// Rays that end on a part of the lower square, more of them towards its corner.
  [[nodiscard]] std::vector<SeenSurface> seen(std::uint32_t count, double part) const {
    std::vector<SeenSurface> found;
    const SobolPoints numbers(3);
    const mesh::FaceSide side = solution.tree().face_side(root("lower"));
    for (std::uint32_t i = 0; i < count; ++i) {
      const double x = numbers.at(i, 0);
      const double y = numbers.at(i, 1);
      const SurfacePoint point{side, 0, local({part * x * x, part * y * y, 0.0})};
      found.push_back(seen_surface(solution, point, 0.002F * static_cast<float>(1 + i % 5)));
    }
    return found;
  }
  /// What these rays bring.
  [[nodiscard]] double brought(std::span<const SeenSurface> rays) const {
    double lux = 0.0;
    for (const SeenSurface& ray : rays) {
      const ElementId e = solution.element_at(ray.node, ray.at);
      lux += static_cast<double>(ray.factor) * solution.radiosity_at(e, ray.at, 0, true);
    }
    return lux;
  }
  /// The same by links.
  [[nodiscard]] double carried(const std::vector<Link>& links) const {
    double lux = 0.0;
    for (const Link& link : links) {
      const ElementId s = link.source.element();
      const Moments& m = solution.moments(s)[0];
      lux += link.factor * solution.radiosity(s)[0] + link.moment_u * m.u + link.moment_v * m.v;
    }
    return lux;
  }
};

TEST(LinksToSeen, MomentsCarryALinearRadiosityExactly) {
  const Facing facing;
  const auto rays = facing.seen(37, 0.7);
  const std::vector<Link> links = links_to_seen(facing.solution, facing.root("upper"), rays, {1.0F, 0.0F, 0.0F});
  ASSERT_EQ(links.size(), 1U);
  EXPECT_NEAR(facing.carried(links), facing.brought(rays), 1e-5 * facing.brought(rays));
  EXPECT_GT(std::abs(links[0].factor * facing.solution.radiosity(facing.root("lower"))[0] - facing.brought(rays)),
            0.05 * facing.brought(rays))
      << "the mean radiosity alone would not do";
}

TEST(LinksToSeen, SourcesAreTheElementsAsTheyStandInTheOrderOfTheirIds) {
  Facing facing;
  const ElementId lower = facing.root("lower");
  facing.solution.open(lower);
  const ElementId first = facing.solution.tree().first_child(lower);
  facing.solution.open(first);
  facing.shade();
  const auto rays = facing.seen(200, 1.0);
  const std::vector<Link> links = links_to_seen(facing.solution, facing.root("upper"), rays, {1.0F, 0.0F, 0.0F});
  EXPECT_EQ(links.size(), 5U) << "four parts of one half, and the other half";
  for (std::size_t i = 0; i < links.size(); ++i) {
    EXPECT_FALSE(facing.solution.is_open(links[i].source.element()));
    if (i > 0) {
      EXPECT_LT(links[i - 1].source.element().value, links[i].source.element().value);
    }
  }
  EXPECT_NEAR(facing.carried(links), facing.brought(rays), 1e-5 * facing.brought(rays));
}

TEST(LinksToSeen, RaysFromBeforeASplitEndOnTheParts) {
  Facing facing;
  const auto rays = facing.seen(200, 1.0);
  const ElementId lower = facing.root("lower");
  facing.solution.open(lower);
  facing.solution.open(facing.solution.tree().first_child(lower));
  facing.shade();
  const auto again = facing.seen(200, 1.0);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(facing.solution.element_at(rays[i].node, rays[i].at),
              facing.solution.element_at(again[i].node, again[i].at));
  }
}

TEST(LinksToSeen, KeepTheReceiverItsSlopeAndTheSumOfFactors) {
  const Facing facing;
  const auto rays = facing.seen(10, 1.0);
  double factors = 0.0;
  for (const SeenSurface& ray : rays) factors += ray.factor;
  const Link link = links_to_seen(facing.solution, facing.root("upper"), rays, {7.0F, 0.25F, -0.5F}).at(0);
  EXPECT_EQ(link.receiver, facing.root("upper"));
  EXPECT_NEAR(link.factor, factors, 1e-6);
  EXPECT_FLOAT_EQ(link.slope_u, 0.25F * link.factor);
  EXPECT_FLOAT_EQ(link.slope_v, -0.5F * link.factor);
  EXPECT_TRUE(link.by_rays);
}

TEST(SeenSurfaces, ARayBringsTheRadiosityOfThePartThatItEndsOnAtItsEnd) {
  Facing facing;
  const ElementId lower = facing.root("lower");
  const auto rays = facing.seen(1, 1.0);
  facing.solution.open(lower);
  facing.shade();
  const ElementId part = facing.solution.element_at(rays[0].node, rays[0].at);
  EXPECT_EQ(facing.solution.tree().parent(part), lower);
  EXPECT_DOUBLE_EQ(illuminance_by(facing.solution, rays),
                   static_cast<double>(rays[0].factor) * facing.solution.luminous_radiosity_at(part, rays[0].at, true));
  EXPECT_FLOAT_EQ(facing.solution.luminous_radiosity_at(part, rays[0].at, true),
                  facing.solution.radiosity_at(part, rays[0].at, 0, true));
}

TEST(SeenSurfaces, RaysAddUp) {
  const Facing facing;
  const auto rays = facing.seen(20, 1.0);
  double each = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) each += illuminance_by(facing.solution, std::span(rays).subspan(i, 1));
  EXPECT_DOUBLE_EQ(illuminance_by(facing.solution, rays), each);
}

TEST(SeenSurfaces, WithoutElementsGiveNothing) {
  const Facing facing;
  auto rays = facing.seen(10, 1.0);
  for (SeenSurface& ray : rays) ray.node = {};
  EXPECT_EQ(illuminance_by(facing.solution, rays), 0.0);
}

TEST(LinksToSeen, NothingSeenGivesNoLink) {
  const Facing facing;
  EXPECT_TRUE(links_to_seen(facing.solution, facing.root("upper"), {}, {}).empty());
}

}  // namespace
}  // namespace clerestory::lighting
