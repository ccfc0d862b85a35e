// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/channel_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lighting/parallel.h"
#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

GroupRadiosity channels_of(const test::Solved& solved) {
  const ChannelSystem system(solved.solution, solved.transport.arrivals, solved.transport.clusters);
  return solve_channels(solved.solution, system, solved.transport.groups);
}

/// What all groups together reflect in the middle of an element, and all light does [lm/m²].
struct Both {
  double groups = 0.0;
  double all = 0.0;
};

Both reflected(const test::Solved& solved, const GroupRadiosity& radiosity, mesh::ElementId e) {
  const Scene& scene = solved.scene;
  Both both;
  for (std::size_t g = 0; g < radiosity.groups(); ++g) both.groups += radiosity.lines(e)[g];
  const auto rho = scene.side_reflectance(solved.solution.tree().face_side(e));
  for (std::size_t c = 0; c < scene.channels; ++c)
    both.all += scene.channel_weights[c] * rho[c] * solved.solution.irradiance(e)[c].value;
  return both;
}

/// The largest difference of the sum of groups from all light, as a share of the latter.
double worst_difference(const test::Solved& solved) {
  const GroupRadiosity radiosity = channels_of(solved);
  double worst = 0.0;
  for (const mesh::ElementId e : solved.solution.elements()) {
    const Both both = reflected(solved, radiosity, e);
    if (both.all > 0.0) worst = std::max(worst, std::abs(both.groups - both.all) / both.all);
  }
  return worst;
}

TEST(ChannelSolver, GroupsAddUpToAllLight) {
  for (const Columns columns : {Columns::kGroups, Columns::kSky145, Columns::kSky577}) {
    Study study = test::furnished_room_study();
    study.columns = columns;
    EXPECT_LT(worst_difference(test::Solved(study)), 2e-4);
  }
}

TEST(ChannelSolver, GroupsAddUpInEveryBand) {
  Study study = test::furnished_room_study();
  study.columns = Columns::kSky145;
  test::material(study, "wall").front.reflectance = Spectrum{0.8F, 0.4F, 0.1F};
  EXPECT_LT(worst_difference(test::Solved(study)), 2e-4);
}

TEST(ChannelSolver, AGroupIsWhatItsLampsGiveAlone) {
  Study both = test::furnished_room_study();
  both.columns = Columns::kGroups;
  const test::Solved solved(both);
  const GroupRadiosity radiosity = channels_of(solved);
  // On the same links, twice the lamp and no sky is twice the lamp's group.
  ASSERT_EQ(radiosity.groups(), 2U);
  ASSERT_EQ(solved.scene.groups[1].name, "lamp");
  Study dark = both;
  dark.sky.type = Sky::Type::kNone;
  const test::Solved alone(dark);
  const auto mean_of = [](const test::Solved& s, std::size_t group) {
    const GroupRadiosity r = channels_of(s);
    double flux = 0.0;
    for (const mesh::ElementId e : s.solution.elements()) flux += s.solution.tree().area(e) * r.lines(e)[group];
    return flux;
  };
  EXPECT_NEAR(mean_of(solved, 1) / mean_of(alone, 0), 1.0, 0.02);
}

TEST(ChannelSolver, AFurnaceGlowsInEveryChannelAsItMust) {
  // Materials that shine, a group each; all reflect alike, band by band: all together M / (1 - rho) everywhere.
  mesh::Model model = support::box_room(4, 3, 2);
  Study study = test::study_of(std::move(model), 0.5, {2, 1, 1});
  study.columns = Columns::kGroups;
  const Spectrum rho{0.8F, 0.5F, 0.2F};
  for (Material& material : study.materials) {
    material.front.reflectance = material.back.reflectance = rho;
    test::shine(material, 100.0);
  }
  const test::Solved solved(study);
  const GroupRadiosity radiosity = channels_of(solved);
  ASSERT_EQ(radiosity.groups(), study.materials.size());
  double expected = 0.0;
  for (std::size_t c = 0; c < rho.size(); ++c)
    expected += solved.scene.channel_weights[c] * rho[c] * 100.0 / (1.0 - rho[c]);
  for (const mesh::ElementId e : solved.solution.elements()) {
    if (!solved.scene.shines(solved.solution.tree().face_side(e))) continue;
    EXPECT_NEAR(reflected(solved, radiosity, e).groups / expected, 1.0, 1e-4);
  }
}

TEST(ChannelSolver, ThreadsMakeNoDifference) {
  Study study = test::furnished_room_study();
  study.columns = Columns::kSky145;
  const test::Solved solved(study);
  std::vector<float> first;
  for (const std::size_t threads : {1U, 2U, 7U}) {
    const ThreadLimit limit = limit_threads(threads);
    const GroupRadiosity radiosity = channels_of(solved);
    std::vector<float> all;
    for (const mesh::ElementId e : solved.solution.elements())
      all.insert(all.end(), radiosity.lines(e).begin(), radiosity.lines(e).end());
    if (first.empty()) first = all;
    EXPECT_EQ(all, first);
  }
}

}  // namespace
}  // namespace clerestory::lighting
