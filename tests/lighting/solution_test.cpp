// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/solution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::ElementId;

constexpr double kReflectance = 0.5;

/// A room whose floor receives an illuminance that runs linearly over it.
struct SlopingFloor : test::Stage {
  SlopingFloor() : Stage(study()), floor(root("floor")) {
    solution.direct(floor)[0] = {.value = 100.0F, .slope_u = 12.0F, .slope_v = -7.0F};
  }
  static Study study() {
    Study study = test::study_of(support::box_room(4, 5, 3), kReflectance, {2, 2, 1});
    test::shine(test::material(study, "ceiling"), 10.0);
    return study;
  }
  [[nodiscard]] double expected_at(const mesh::Point& p) const {
    const mesh::Vector d = p - solution.tree().centroid(floor);
    return 100.0 + 12.0 * dot(d, solution.tree().axes(floor).u) - 7.0 * dot(d, solution.tree().axes(floor).v);
  }
  [[nodiscard]] std::vector<ElementId> floor_elements() const {
    std::vector<ElementId> found;
    for (const ElementId e : solution.elements()) {
      if (solution.tree().root(e) == floor) found.push_back(e);
    }
    return found;
  }
  /// Opens elements of the floor here and there.
  void open_at_random(int times) {
    std::mt19937 random(2);
    for (int i = 0; i < times; ++i) {
      const auto elements = floor_elements();
      solution.open(elements[random() % elements.size()]);
    }
  }

  ElementId floor;
};

TEST(Solution, RadiosityIsEmissionAndReflectedIlluminance) {
  SlopingFloor s;
  s.solution.push_pull();
  EXPECT_FLOAT_EQ(s.solution.radiosity(s.floor)[0], 50.0F);
  EXPECT_FLOAT_EQ(s.solution.radiosity(s.root("ceiling"))[0], 10.0F);
  EXPECT_FLOAT_EQ(s.solution.radiosity_mean(s.floor), 50.0F);
}

TEST(Solution, CountsItsElementsAndWhatOpeningMakesOfThem) {
  SlopingFloor s;
  s.open_at_random(40);
  const ElementId triangle = s.floor_elements().back();
  EXPECT_EQ(s.solution.element_count(), s.solution.elements().size());
  EXPECT_EQ(s.solution.gained_by_opening(s.floor), 0U);
  ASSERT_TRUE(s.solution.tree().is_triangle(triangle));
  EXPECT_EQ(s.solution.gained_by_opening(triangle), 3U);
  s.solution.limit_elements(s.solution.element_count() + 2);
  EXPECT_FALSE(s.solution.may_open(triangle));
  s.solution.limit_elements(s.solution.element_count() + 3);
  EXPECT_TRUE(s.solution.may_open(triangle));
  s.solution.open(triangle);
  EXPECT_EQ(s.solution.elements_left(), 0U);
}

TEST(Solution, MomentsAreThoseOfTheLine) {
  SlopingFloor s;
  s.solution.push_pull();
  const mesh::SecondMoments& m = s.solution.tree().second_moments(s.floor);
  EXPECT_NEAR(s.solution.moments(s.floor)[0].u, kReflectance * (12.0 * m.uu - 7.0 * m.uv), 1e-4);
  EXPECT_NEAR(s.solution.moments(s.floor)[0].v, kReflectance * (12.0 * m.uv - 7.0 * m.vv), 1e-4);
  EXPECT_NEAR(s.solution.radiosity_deviation(s.floor), 0.0, 0.05) << "the line explains all";
  EXPECT_NEAR(s.solution.radiosity_variance(s.floor),
              kReflectance * kReflectance * (144.0 * m.uu - 168.0 * m.uv + 49.0 * m.vv), 1e-2);
}

TEST(Solution, PushHandsTheLineDownToTheElements) {
  SlopingFloor s;
  s.open_at_random(40);
  s.solution.push_pull();
  for (const ElementId e : s.floor_elements()) {
    EXPECT_NEAR(s.solution.irradiance(e)[0].value, s.expected_at(s.solution.tree().centroid(e)), 1e-4);
    EXPECT_FLOAT_EQ(s.solution.irradiance(e)[0].slope_u, 12.0F);
  }
}

TEST(Solution, PullConservesFluxAndMomentsHoweverTheFloorIsDivided) {
  SlopingFloor whole;
  whole.solution.push_pull();
  SlopingFloor divided;
  divided.open_at_random(40);
  divided.solution.push_pull();
  EXPECT_NEAR(divided.solution.radiosity(divided.floor)[0], whole.solution.radiosity(whole.floor)[0], 1e-4);
  EXPECT_NEAR(divided.solution.moments(divided.floor)[0].u, whole.solution.moments(whole.floor)[0].u, 1e-3);
  EXPECT_NEAR(divided.solution.moments(divided.floor)[0].v, whole.solution.moments(whole.floor)[0].v, 1e-3);
  EXPECT_NEAR(divided.solution.radiosity_variance(divided.floor), whole.solution.radiosity_variance(whole.floor), 1e-2);
  EXPECT_NEAR(divided.solution.radiosity_deviation(divided.floor), 0.0, 0.1);
  double flux = 0.0;
  for (const ElementId e : divided.floor_elements()) {
    flux += divided.solution.tree().area(e) * divided.solution.radiosity(e)[0];
  }
  EXPECT_NEAR(flux, 20.0 * 50.0, 1e-3);
}

TEST(Solution, LightGivenAtSeveralLevelsAddsUp) {
  SlopingFloor s;
  s.solution.open(s.floor);
  const ElementId child = s.solution.tree().first_child(s.floor);
  s.solution.direct(child)[0].value = 20.0F;
  s.solution.gathered(child)[0].value = 3.0F;
  s.solution.gathered(s.floor)[0].value = 1.0F;
  s.solution.push_pull();
  EXPECT_NEAR(s.solution.irradiance(child)[0].value, s.expected_at(s.solution.tree().centroid(child)) + 24.0, 1e-4);
  const ElementId other(child.index() + 1);
  EXPECT_NEAR(s.solution.irradiance(other)[0].value, s.expected_at(s.solution.tree().centroid(other)) + 1.0, 1e-4);
}

TEST(Solution, ElementsPartitionTheSurfaces) {
  SlopingFloor s;
  s.open_at_random(40);
  double area = 0.0;
  for (const ElementId e : s.solution.elements()) area += s.solution.tree().area(e);
  EXPECT_NEAR(area, 2.0 * 94.0, 1e-9) << "both sides, in and out";
}

TEST(Solution, PartsThatAreOnlyToldApartTakeNoPart) {
  SlopingFloor s;
  s.solution.open(s.floor);
  const ElementId triangle = s.solution.tree().first_child(s.floor);
  const std::size_t before = s.solution.elements().size();
  s.solution.divide(triangle);
  EXPECT_TRUE(s.solution.tree().has_children(triangle));
  EXPECT_FALSE(s.solution.is_open(triangle));
  EXPECT_EQ(s.solution.elements().size(), before);
  const mesh::Point p = s.solution.tree().centroid(s.solution.tree().first_child(triangle));
  EXPECT_EQ(s.solution.element_at(s.solution.tree().face_side(triangle), 0, p), triangle);
}

TEST(Solution, ElementAtAPointIsTheOneThatHoldsIt) {
  SlopingFloor s;
  s.open_at_random(60);
  for (const ElementId e : s.floor_elements()) {
    const mesh::Point p = s.solution.tree().sample(e, 0.4, 0.3);
    EXPECT_EQ(s.solution.element_at(s.solution.tree().face_side(e), 0, p), e);
  }
}

TEST(Solution, RadiosityAtAPointFollowsTheLineAndIsNeverNegative) {
  SlopingFloor s;
  s.solution.push_pull();
  const mesh::Point p = s.local({3.1, 1.2, 0.0});
  EXPECT_NEAR(s.solution.radiosity_at(s.floor, p, 0, true), kReflectance * s.expected_at(p), 1e-4);
  s.solution.direct(s.floor)[0] = {.value = 1.0F, .slope_u = 100.0F, .slope_v = 100.0F};
  s.solution.push_pull();
  for (const mesh::Point& corner : {mesh::Point{0, 0, 0}, {4, 0, 0}, {4, 5, 0}, {0, 5, 0}}) {
    EXPECT_GE(s.solution.radiosity_at(s.floor, s.local(corner), 0, true), 0.0F);
  }
  const ElementId ceiling = s.root("ceiling");
  EXPECT_FLOAT_EQ(s.solution.radiosity_at(ceiling, s.solution.tree().centroid(ceiling), 0, true), 10.0F);
  EXPECT_FLOAT_EQ(s.solution.radiosity_at(ceiling, s.solution.tree().centroid(ceiling), 0, false), 0.0F);
}

TEST(Solution, ErrorsOfANodeAddUpAsSquares) {
  SlopingFloor s;
  s.solution.add_error(s.floor, 7.0, 1.0);
  s.solution.add_error(s.floor, 9.0, 3.0);
  EXPECT_FLOAT_EQ(s.solution.noise(s.floor), 4.0F);
  EXPECT_FLOAT_EQ(s.solution.misfit(s.floor), 2.0F);
}

TEST(Solution, ChangeIsTheShareOfFluxThatMoved) {
  SlopingFloor s;
  EXPECT_NEAR(s.solution.push_pull(), 1.0, 1e-6) << "all of it is new";
  EXPECT_NEAR(s.solution.push_pull(), 0.0, 1e-6);
  s.solution.direct(s.floor)[0].value = 110.0F;
  EXPECT_NEAR(s.solution.push_pull(), 20.0 * 5.0 / (20.0 * 55.0 + 20.0 * 10.0), 1e-6);
}

}  // namespace
}  // namespace clerestory::lighting
