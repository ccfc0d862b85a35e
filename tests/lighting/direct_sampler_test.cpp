// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/direct_sampler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

#include "lighting/form_factor.h"
#include "lighting/sampling.h"
#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// From the floor of a room of 4 m × 4 m × 3 m to its ceiling.
constexpr double kFloorToCeiling = 0.28273279;

struct Sampled : test::Stage {
  explicit Sampled(const Study& study, double tolerance = 1e-4)
      : Stage(study), importance(solution, walks(1)), sampler(solution, importance, tolerance, 1) {}

  /// Of a root that may see everything.
  [[nodiscard]] DirectSurvey survey(const std::string& material, mesh::Side side = mesh::Side::kFront) const {
    DirectCandidate candidate;
    candidate.node = root(material, side);
    for (std::uint32_t k = 0; k < scene.openings.size(); ++k) candidate.openings.push_back(k);
    return sampler.survey(candidate);
  }

  Importance importance;
  DirectSampler sampler;
};

Study under_even_sky(mesh::Model model) {
  Study study = test::study_of(std::move(model), 0.2, {1, 1, 0.5});
  study.sky.type = Sky::Type::kUniform;
  return study;
}

Study open_ground() {
  mesh::Model model;
  support::add_quad(model, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {"ground", "ground"});
  return under_even_sky(model);
}

/// A room of 4 m × 4 m × 3 m whose ceiling is an air polygon.
Study open_room() {
  Study study = under_even_sky(support::box_room(4, 4, 3));
  test::leave_open(test::material(study, "ceiling"));
  return study;
}

TEST(DirectSampler, AnEvenSkyIsTheSameAllOverOpenGroundAndHasNoNoise) {
  const Sampled ground(open_ground());
  const DirectSurvey survey = ground.survey("ground");
  EXPECT_TRUE(survey.below.open_sky);
  EXPECT_NEAR(survey.total, 10'000.0, 1e-2);
  EXPECT_NEAR(survey.fit.residual, 0.0, 1e-2);
  const DirectMeasurement measured = ground.sampler.measure(survey);
  EXPECT_NEAR(measured.slope.slope_u, 0.0F, 1e-6F);
  EXPECT_NEAR(measured.received, 10'000.0, 1e-2);
  EXPECT_EQ(measured.received, measured.total);
  EXPECT_NEAR(measured.noise, 0.0, 1e-2);
}

TEST(DirectSampler, WithoutASkyNothingIsSeenThroughOpenings) {
  Study study = open_room();
  study.sky.type = Sky::Type::kNone;
  const Sampled room(study);
  const DirectSurvey survey = room.survey("floor");
  EXPECT_THAT(survey.below.openings, IsEmpty());
  EXPECT_EQ(survey.total, 0.0);
  EXPECT_EQ(room.sampler.effect(survey), 0.0);
  EXPECT_EQ(room.sampler.measure(survey).slope.slope_u, 0.0F);
  EXPECT_EQ(room.sampler.measure(survey).total, 0.0);
}

TEST(DirectSampler, OpeningsAreHandedDownToNodesThatSeeThem) {
  const Sampled room(open_room());
  ASSERT_EQ(room.scene.openings.size(), 1U);
  const DirectSurvey inside = room.survey("floor");
  EXPECT_THAT(inside.below.openings, ElementsAre(0U));
  EXPECT_FALSE(inside.below.open_sky) << "all sky is seen through the opening";
  const DirectSurvey outside = room.survey("wall", mesh::Side::kBack);
  EXPECT_THAT(outside.below.openings, IsEmpty());
  EXPECT_TRUE(outside.below.open_sky);
}

TEST(DirectSampler, AFloorReceivesTheShareOfTheSkyThatItsFormFactorToTheOpenCeilingIs) {
  const Sampled room(open_room());
  const DirectMeasurement measured = room.sampler.measure(room.survey("floor"));
  EXPECT_GT(measured.noise, 0.0);
  EXPECT_NEAR(measured.received, 10'000.0 * kFloorToCeiling, 3.0 * measured.noise);
  EXPECT_NEAR(measured.total, measured.received, 1e-9 * measured.received) << "there is nothing above but sky";
  EXPECT_THAT(measured.beyond, IsEmpty());
}

/// Rays that a call casts.
template <class Call>
std::size_t rays_of(const Sampled& room, const Call& call) {
  const std::size_t before = room.scene.rays->use().rays;
  call();
  return room.scene.rays->use().rays - before;
}

/// A tolerance at which no opening is minor to the floor, and twice which all of it might be missed.
double coarsest(const Study& study) {
  const Sampled room(study);
  DirectCandidate candidate;
  candidate.node = room.root("floor");
  candidate.openings = {0};
  for (double tolerance = 1e-4;; tolerance *= 2.0) {
    const DirectSampler coarser(room.solution, room.importance, 2.0 * tolerance, 1);
    if (!coarser.survey(candidate).below.minor.empty()) return tolerance;
  }
}

TEST(DirectSampler, WhatCanMatterLittleIsMeasuredWithFewRays) {
  const Sampled room(open_room(), coarsest(open_room()));
  const DirectSurvey survey = room.survey("floor");
  ASSERT_THAT(survey.below.openings, ElementsAre(0U));
  DirectMeasurement measured;
  EXPECT_LE(rays_of(room, [&] { measured = room.sampler.measure(survey); }), 2U * (8U + 64U))
      << "one a batch, and those that find the slopes; each goes on behind the opening";
  EXPECT_NEAR(measured.received, 10'000.0 * kFloorToCeiling, 3.0 * measured.noise);
  const Sampled fine(open_room());
  EXPECT_GE(rays_of(fine, [&] { measured = fine.sampler.measure(fine.survey("floor")); }), 2U * (256U + 64U));
}

/// The open room with two sheets that hide its ceiling together, and neither alone.
Study covered_room() {
  mesh::Model model = support::box_room(4, 4, 3);
  support::add_quad(model, {0, 0, 2}, {2, 0, 2}, {2, 4, 2}, {0, 4, 2}, {"sheet", "sheet1"});
  support::add_quad(model, {2, 0, 2}, {4, 0, 2}, {4, 3, 2}, {2, 3, 2}, {"sheet", "sheet2"});
  support::add_quad(model, {2, 3, 2}, {4, 3, 2}, {4, 4, 2}, {2, 4, 2}, {"sheet", "sheet3"});
  Study study = under_even_sky(std::move(model));
  test::leave_open(test::material(study, "ceiling"));
  test::shine(test::material(study, "wall"), 100.0);
  return study;
}

/// 32 rays or 256 to the ceiling, and as many to the sky by no opening.
TEST(DirectSampler, WhatIsHiddenAndCanMatterLittleIsProbedWithFewRays) {
  const Sampled coarse(covered_room(), coarsest(covered_room()));
  const Sampled fine(covered_room());
  for (const auto& [room, least, most] :
       {std::tuple(&coarse, std::size_t{64}, std::size_t{64}), std::tuple(&fine, std::size_t{512}, std::size_t{512})}) {
    DirectSurvey survey;
    const std::size_t rays = rays_of(*room, [&] { survey = room->survey("floor"); });
    EXPECT_THAT(survey.below.openings, IsEmpty());
    EXPECT_GE(rays, least);
    EXPECT_LE(rays, most);
  }
}

TEST(DirectSampler, TheSlopesOfWhatIsAcceptedAreThoseOfTheLightOnTheAverage) {
  const Sampled room(open_room());
  const mesh::ElementTree& tree = room.solution.tree();
  const mesh::ElementId wall = room.root("wall");
  const DirectSurvey survey = room.survey("wall");
  // The best line's slope upwards, by the exact light at places all over the wall.
  const Opening& ceiling = room.scene.openings.at(0);
  const auto sky_lux = [&](const mesh::Point& p) {
    double factor = 0.0;
    for (const auto& t : ceiling.triangles) {
      const std::array<mesh::OutlineEdge, 3> down{{{t[0], t[1]}, {t[1], t[2]}, {t[2], t[0]}}};
      factor += point_form_factor(p, tree.normal(wall), down, -ceiling.outward);
    }
    return 10'000.0 * factor;
  };
  const SobolPoints numbers(1);
  double rise = 0.0;
  double square = 0.0;
  for (std::uint32_t i = 0; i < 4096; ++i) {
    const mesh::Point p = tree.sample(wall, numbers.at(i, 0), numbers.at(i, 1));
    const double height = p.z - tree.centroid(wall).z;
    rise += height * sky_lux(p);
    square += height * height;
  }
  constexpr int kSeeds = 200;
  double mean = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const DirectSampler sampler(room.solution, room.importance, 1.0, seed);
    const DirectMeasurement measured = sampler.measure(survey);
    mean += measured.total *
            (measured.slope.slope_u * tree.axes(wall).u.z + measured.slope.slope_v * tree.axes(wall).v.z) / kSeeds;
  }
  EXPECT_NEAR(mean, rise / square, 0.04 * rise / square);
}

}  // namespace
}  // namespace clerestory::lighting
