// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/phase_part.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include <string>
#include <vector>

#include "mesh/clean.h"
#include "mesh/faces.h"
#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

using testing::ElementsAre;

/// Remembers what it is told.
class Listener final : public Progress {
 public:
  void phase(std::string_view name) override {
    phases.emplace_back(name);
    shares.emplace_back();
  }
  void advance(double fraction) override {
    if (shares.empty()) shares.emplace_back();
    shares.back().push_back(fraction);
  }

  [[nodiscard]] bool should_finish(double until) const override { return until < finish_before; }

  double finish_before = 0.0;
  std::vector<std::string> phases;
  std::vector<std::vector<double>> shares;  ///< of each phase
};

TEST(PhasePart, IsAStretchOfThePhase) {
  Listener listener;
  PhasePart half(listener, 0.5, 1.0);
  half.advance(0.5);
  PhasePart quarter(half, 0.0, 0.5);
  quarter.phase("hidden");
  quarter.advance(1.0);
  EXPECT_THAT(listener.phases, ElementsAre());
  EXPECT_THAT(listener.shares, ElementsAre(ElementsAre(0.75, 0.75)));
}

TEST(PhasePart, FinishesWithItsShareOfTheTime) {
  Listener listener;
  listener.finish_before = 0.7;
  const PhasePart half(listener, 0.5, 1.0);
  EXPECT_TRUE(half.should_finish(0.3));
  EXPECT_FALSE(half.should_finish(0.5));
  EXPECT_FALSE(half.should_finish());
}

TEST(PhasePart, TellsOfStepsNowAndThen) {
  Listener listener;
  PhasePart all(listener, 0.0, 1.0);
  for (std::size_t i = 0; i < 1024; ++i) all.advance(i, 1024);
  EXPECT_THAT(listener.shares[0], ElementsAre(0.0, 0.25, 0.5, 0.75));
}

/// Boxes in a row that poke through a floor.
Model boxes_in_a_floor(std::size_t count) {
  Model model;
  const auto length = static_cast<double>(count);
  support::add_quad(model, {-1, -1, 0}, {2 * length, -1, 0}, {2 * length, 2, 0}, {-1, 2, 0}, {"floor", "floor"});
  for (std::size_t i = 0; i < count; ++i) {
    const double x = 2.0 * static_cast<double>(i);
    support::add_box(model, {x, 0, -0.5}, {x + 1, 1, 0.5}, {"wood", "box"});
  }
  return model;
}

TEST(PhasePart, TheSharesOfTheCleanUpAndOfFacesNeverFallWithinAPhase) {
  Listener listener;
  const CleanSurface surface = clean(boxes_in_a_floor(200), {}, &listener);
  listener.phase("faces");
  build_faces(surface, {}, &listener);
  EXPECT_THAT(listener.phases,
              ElementsAre("placing", "welding", "T-junctions", "gaps", "intersections", "shells", "faces"));
  for (std::size_t p = 0; p < listener.shares.size(); ++p) {
    const std::vector<double>& shares = listener.shares[p];
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end())) << listener.phases[p];
    EXPECT_TRUE(shares.empty() || (shares.front() >= 0.0 && shares.back() <= 1.0)) << listener.phases[p];
  }
  EXPECT_GE(listener.shares[4].size(), 8U);  // the longest of the clean-up
}

}  // namespace
}  // namespace clerestory::mesh
