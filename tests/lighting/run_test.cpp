// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/error.h"
#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

Results answer(const Study& study) {
  NoProgress nobody;
  return run(study, nobody);
}

void expect_same(const Results& a, const Results& b) {
  ASSERT_EQ(a.grids.size(), b.grids.size());
  EXPECT_EQ(a.grids[0].illuminance_lux, b.grids[0].illuminance_lux);
  EXPECT_EQ(a.grids[0].error_lux, b.grids[0].error_lux);
  EXPECT_EQ(a.surfaces.illuminance_lux, b.surfaces.illuminance_lux);
  EXPECT_EQ(a.surfaces.radiosity_lm_m2, b.surfaces.radiosity_lm_m2);
  EXPECT_EQ(a.surfaces.point_illuminance_lux, b.surfaces.point_illuminance_lux);
  EXPECT_EQ(a.surfaces.cells, b.surfaces.cells);
  EXPECT_EQ(a.energy.left_lm, b.energy.left_lm);
  EXPECT_EQ(a.energy.absorbed_lm, b.energy.absorbed_lm);
  EXPECT_EQ(a.counts.links, b.counts.links);
  EXPECT_EQ(a.counts.rays, b.counts.rays);
}

/// A black room with a lamp that is a point, and a plate of 1 m x 1 m half-way below it: its shadow is the square from (1, 1) to (3, 3).
Study plate_under_a_point() {
  mesh::Model model = support::box_room(4.3, 4.1, 3);
  support::add_quad(model, {1.5, 1.5, 1.25}, {2.5, 1.5, 1.25}, {2.5, 2.5, 1.25}, {1.5, 2.5, 1.25}, {"plate", "plate"});
  Study study = test::study_of(std::move(model), 0.0, {0.5, 0.5, 1});
  study.luminaires.push_back(clerestory::test::isotropic_lamp({2, 2, 2.5}, 1000.0));
  study.mesh.discontinuities = false;
  return study;
}

TEST(Run, ElementsDoNotCrossTheShadowEdgeOfALuminaire) {
  const SurfaceResult s = answer(plate_under_a_point()).surfaces;
  constexpr double kSlack = 1e-3;
  int cells = 0;
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    if (s.material_names.at(static_cast<std::size_t>(s.material[i])) != "floor" || s.side[i] != 0) continue;
    double nearest = 1e9;
    double farthest = 0.0;
    for (const std::uint32_t p : s.cells[i]) {
      const double off = std::max(std::abs(s.points[p].x - 2.0), std::abs(s.points[p].y - 2.0));
      nearest = std::min(nearest, off);
      farthest = std::max(farthest, off);
    }
    EXPECT_TRUE(nearest > 1.0 - kSlack || farthest < 1.0 + kSlack);
    EXPECT_TRUE(nearest > 1.0 - kSlack || s.illuminance_lux[i] == 0.0F);
    ++cells;
  }
  EXPECT_GT(cells, 10);
}

TEST(Run, StartElementsAreRefinedWhereSensorsLookAlone) {
  mesh::Model model = support::box_room(4, 4, 3);
  support::add_quad(model, {20, 0, 0}, {21, 0, 0}, {21, 0.1, 0}, {20, 0.1, 0}, {"far", "far"});
  Study study = test::study_of(std::move(model), 0.5, {1, 1, 0.8});
  test::shine(test::material(study, "ceiling"), 100.0);
  study.keep_solution = true;
  const Results results = answer(study);
  const Scene scene = build_scene(study);
  std::vector<std::uint32_t> inside;
  for (const char* name : {"floor", "wall", "ceiling"}) {
    for (const mesh::FaceId face : support::faces_of(scene.faces, name)) inside.push_back(face.value);
  }
  ASSERT_TRUE(results.solution.has_value());
  EXPECT_THAT(results.solution->start_refined, testing::UnorderedElementsAreArray(inside));
}

TEST(Run, TwiceGivesTheSameBits) {
  expect_same(answer(test::furnished_room_study()), answer(test::furnished_room_study()));
}

TEST(Run, OneAndTwoThreadsGiveTheSameBits) {
  set_threads(1);
  const Results one = answer(test::furnished_room_study());
  set_threads(2);
  const Results two = answer(test::furnished_room_study());
  set_threads(0);
  expect_same(one, two);
}

/// The furnished room with its lamp in the morning, when the sun falls in, and at night.
Study study_of_moments() {
  Study study = test::furnished_room_study();
  Sky morning{.ground_reflectance = 0.2};
  morning.horizontal_illuminance_lux = 4'000.0;
  morning.sun = {.towards = {0.0, 0.6, 0.8}, .normal_illuminance_lux = 8'000.0};
  morning.moment = "morning";
  Sky evening{.type = Sky::Type::kUniform, .horizontal_illuminance_lux = 1'000.0};
  evening.moment = "evening";
  Sky night{.type = Sky::Type::kNone};
  night.moment = "night";
  study.moments = {morning, evening, night};
  study.sky = mean_sky(study.moments);
  study.columns = Columns::kGroups;
  return study;
}

TEST(Run, EachOfSeveralMomentsIsAsItIsByItself) {
  const Study study = study_of_moments();
  const Results all = answer(study);
  ASSERT_EQ(all.grids.size(), 3U);
  ASSERT_EQ(all.surfaces.moments.size(), 3U);
  EXPECT_TRUE(all.surfaces.illuminance_lux.empty());
  for (std::size_t m = 0; m < 3; ++m) {
    Study single = study;
    single.sky = study.moments[m];
    single.moments.clear();
    single.accuracy.seed = 7;
    const GridResult expected = answer(single).grids.at(0);
    const GridResult& grid = all.grids[m];
    EXPECT_EQ(grid.moment, study.moments[m].moment);
    EXPECT_LE(grid.metrics.accuracy_reached, study.accuracy.target);
    for (std::size_t i = 0; i < grid.sensors.count(); ++i) {
      const double error = std::hypot(grid.error_lux[i], expected.error_lux[i]);
      EXPECT_NEAR(grid.illuminance_lux[i], expected.illuminance_lux[i], 2.5 * error) << m << " " << i;
      double sum = 0.0;
      for (const GroupColumn& group : grid.groups) sum += group.illuminance_lux[i];
      EXPECT_NEAR(sum / grid.illuminance_lux[i], 1.0, 2e-3) << m << " " << i;
    }
    EXPECT_EQ(all.surfaces.moments[m].illuminance_lux.size(), all.surfaces.cells.size());
    EXPECT_EQ(all.surfaces.moments[m].point_illuminance_lux.size(), all.surfaces.points.size());
  }
  EXPECT_EQ(all.grids[0].groups.size(), 3U);  // sky, sun, lamp
  ASSERT_EQ(all.grids[2].groups.size(), 2U);  // a dark sky, lamp
  EXPECT_EQ(all.grids[2].groups[0].illuminance_lux[0], 0.0F);
}

TEST(Run, ObserversAreAskedAtEachOfSeveralMoments) {
  Study study = study_of_moments();
  study.observers = {{"front", {2.0, 3.0, 1.2}, {0.0, -1.0, 0.0}}, {"back", {2.0, 1.0, 1.2}, {0.0, 1.0, 0.0}}};
  const Results results = answer(study);
  ASSERT_EQ(results.observers.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(results.observers[i].observer.name, i < 3 ? "front" : "back");
    EXPECT_EQ(results.observers[i].moment, study.moments[i % 3].moment);
  }
  // The lamp glares alike; by day the surfaces behind it are brighter than at night.
  EXPECT_GT(results.observers[0].background_cd_m2, 2.0 * results.observers[2].background_cd_m2);
}

TEST(Run, SeveralMomentsGiveTheSameBitsByAnyNumberOfThreads) {
  const Study study = study_of_moments();
  set_threads(1);
  const Results one = answer(study);
  for (const int threads : {2, 7}) {
    set_threads(threads);
    const Results more = answer(study);
    for (std::size_t m = 0; m < 3; ++m) {
      EXPECT_EQ(one.grids[m].illuminance_lux, more.grids[m].illuminance_lux) << threads;
      EXPECT_EQ(one.grids[m].error_lux, more.grids[m].error_lux) << threads;
      EXPECT_EQ(one.surfaces.moments[m].illuminance_lux, more.surfaces.moments[m].illuminance_lux) << threads;
    }
  }
  set_threads(0);
}

TEST(Run, AStoredSolutionOfSeveralMomentsGivesThemToTheBit) {
  Study study = study_of_moments();
  study.keep_solution = true;
  const Results solved = answer(study);
  ASSERT_TRUE(solved.solution);
  NoProgress nobody;
  const Results again = sense(study, *solved.solution, nobody);
  ASSERT_EQ(again.grids.size(), 3U);
  for (std::size_t m = 0; m < 3; ++m) {
    EXPECT_EQ(solved.grids[m].illuminance_lux, again.grids[m].illuminance_lux);
    EXPECT_EQ(solved.grids[m].error_lux, again.grids[m].error_lux);
  }
  study.dimming = {{"lamp", 0.5}};
  const Results dimmed = sense(study, *solved.solution, nobody);
  for (std::size_t i = 0; i < dimmed.grids[2].sensors.count(); ++i)
    EXPECT_NEAR(dimmed.grids[2].illuminance_lux[i] / solved.grids[2].illuminance_lux[i], 0.5, 2e-3);
}

TEST(Run, PatchesOfTheSkyAreOfOneMoment) {
  Study study = study_of_moments();
  study.columns = Columns::kSky145;
  EXPECT_THROW(answer(study), InputError);
}

TEST(Run, AnotherSeedGivesOtherValuesWithinTheError) {
  Study other = test::furnished_room_study();
  other.accuracy.seed = 99;
  const Results a = answer(test::furnished_room_study());
  const Results b = answer(other);
  EXPECT_NE(a.grids[0].illuminance_lux, b.grids[0].illuminance_lux);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(a.grids[0].illuminance_lux[i], b.grids[0].illuminance_lux[i],
                3.0 * std::hypot(a.grids[0].error_lux[i], b.grids[0].error_lux[i]));
  }
}

TEST(Run, WhereTheModelStandsMattersLittle) {
  const mesh::Vector shift{612'345.125, 5'412'345.5, 520.25};
  Study far_off = test::furnished_room_study();
  far_off.model = support::moved(far_off.model, shift);
  for (Point& p : far_off.grids[0].points) p = p + shift;
  const Results here = answer(test::furnished_room_study());
  const Results there = answer(far_off);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(there.grids[0].illuminance_lux[i], here.grids[0].illuminance_lux[i], 2.0 * here.grids[0].error_lux[i]);
    EXPECT_NEAR(norm(there.grids[0].sensors.positions[i] - far_off.grids[0].points[i]), 0.0, 1e-8);
  }
}

TEST(Run, DaylightFactorsAreSharesOfTheHorizontalIlluminance) {
  Study study = test::furnished_room_study();
  study.kind = Study::Kind::kDaylight;
  study.sky.horizontal_illuminance_lux = 5'000.0;
  const Results results = answer(study);
  EXPECT_EQ(results.horizontal_illuminance_lux, 5'000.0);
  const GridResult& grid = results.grids.at(0);
  ASSERT_EQ(grid.daylight_factor_percent.size(), 2U);
  EXPECT_NEAR(grid.daylight_factor_percent[0], grid.illuminance_lux[0] / 50.0, 1e-4);
  EXPECT_TRUE(grid.metrics.has_daylight_factor);
}

TEST(Run, ALampInEmptySpaceGivesWhatItsFormFactorSaysAndAllLeaves) {
  mesh::Model model;
  support::add_quad(model, {0, 0, 3}, {0, 1, 3}, {1, 1, 3}, {1, 0, 3}, {"lamp", "lamp"});
  Study study = test::study_of(std::move(model), 0.0, {0.5, 0.5, 2.0});
  test::shine(test::material(study, "lamp"), 1000.0);
  study.grids[0].points.push_back({0.5, 0.5, 4.0});  // behind it
  study.grids[0].normals.push_back({0, 0, -1});
  const Results results = answer(study);
  EXPECT_NEAR(results.grids[0].illuminance_lux[0], 239.456, 0.01);  // point under the centre of a unit square, 1 m away
  EXPECT_EQ(results.grids[0].illuminance_lux[1], 0.0F);
  EXPECT_NEAR(results.energy.left_lm, 1000.0, 1e-6);
  EXPECT_NEAR(results.energy.residual, 0.0, 1e-9);
}

TEST(Run, AFloorOfSliversIsAFloor) {
  const auto room_with_floor_of = [](int strips) {
    mesh::Model model = support::box_room(4, 4, 3);
    for (int i = 0; i < strips; ++i) {
      const double x = 0.5 + 3.0 * i / strips;
      const double end = 0.5 + 3.0 * (i + 1) / strips;
      support::add_quad(model, {x, 0.5, 0.1}, {end, 0.5, 0.1}, {end, 3.5, 0.1}, {x, 3.5, 0.1}, {"wood", "boards"});
    }
    support::add_quad(model, {1.5, 1.5, 2.9}, {1.5, 2.5, 2.9}, {2.5, 2.5, 2.9}, {2.5, 1.5, 2.9}, {"lamp", "lamp"});
    Study study = test::study_of(std::move(model), 0.5, {1, 1, 0.8});
    test::shine(test::material(study, "lamp"), 1000.0);
    return study;
  };
  const Results whole = answer(room_with_floor_of(1));
  const Results slivers = answer(room_with_floor_of(500));
  EXPECT_EQ(slivers.counts.faces, whole.counts.faces);
  EXPECT_NEAR(slivers.grids[0].illuminance_lux[0], whole.grids[0].illuminance_lux[0],
              2.0 * std::hypot(slivers.grids[0].error_lux[0], whole.grids[0].error_lux[0]));
}

/// A user who wants what there is from a phase on.
class Impatient final : public Progress {
 public:
  explicit Impatient(std::string phase) : phase_(std::move(phase)) {}
  void phase(std::string_view name) override { wants_it_ = wants_it_ || name == phase_; }
  void advance(double) override {}
  [[nodiscard]] bool should_finish(double) const override { return wants_it_; }

 private:
  std::string phase_;
  bool wants_it_ = false;
};

TEST(Run, StoppedInAnyPhaseOfTheLightItGivesWhatItHasWithErrorsThatHold) {
  Study study = test::furnished_room_study();
  study.accuracy.target = 0.01;
  const Results whole = answer(study);
  for (const std::string phase : {"direct light", "linking", "gathering"}) {
    Impatient user(phase);
    const Results results = run(study, user);
    ASSERT_TRUE(results.stopped) << phase;
    EXPECT_EQ(results.stopped->by, Stop::By::kUser);
    EXPECT_EQ(results.stopped->phase, phase);
    EXPECT_EQ(results.converged, phase == "gathering");
    EXPECT_FALSE(results.accuracy_met) << phase;
    EXPECT_LT(results.counts.rays, whole.counts.rays) << phase;
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_GT(results.grids[0].error_lux[i], whole.grids[0].error_lux[i]) << phase;
      EXPECT_NEAR(results.grids[0].illuminance_lux[i], whole.grids[0].illuminance_lux[i],
                  2.0 * results.grids[0].error_lux[i])
          << phase;
    }
    EXPECT_FALSE(results.surfaces.cells.empty());
  }
}

TEST(Run, ABudgetOfElementsEndsRefinementWithErrorsThatHold) {
  Study study = test::furnished_room_study();
  study.accuracy.target = 0.01;
  study.keep_solution = true;  // else refinement ends where the sensors are right enough, before the budget does
  const Results whole = answer(study);
  EXPECT_FALSE(whole.stopped);
  for (const std::size_t budget : {whole.counts.elements / 4, whole.counts.elements / 2}) {
    study.mesh.max_elements = budget;
    const Results results = answer(study);
    ASSERT_TRUE(results.stopped);
    EXPECT_EQ(results.stopped->by, Stop::By::kElements);
    EXPECT_TRUE(results.converged);
    EXPECT_LE(results.counts.elements, budget);
    EXPECT_GE(results.counts.elements + 3, budget);  // no triangle more could be split
    EXPECT_THAT(results.notices, Contains(HasSubstr("mesh.max_elements")));
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(results.grids[0].illuminance_lux[i], whole.grids[0].illuminance_lux[i],
                  2.0 * std::hypot(results.grids[0].error_lux[i], whole.grids[0].error_lux[i]));
    }
  }
}

TEST(Run, ABudgetThatIsNotReachedChangesNothing) {
  Study study = test::furnished_room_study();
  const Results whole = answer(study);
  study.mesh.max_elements = 10 * whole.counts.elements;
  study.mesh.discontinuities = false;  // lines of shadows have the same budget
  const Results roomy = answer(study);
  EXPECT_FALSE(roomy.stopped);
  EXPECT_EQ(roomy.grids[0].illuminance_lux, whole.grids[0].illuminance_lux);
  EXPECT_EQ(roomy.grids[0].error_lux, whole.grids[0].error_lux);
  EXPECT_EQ(roomy.counts.links, whole.counts.links);
}

TEST(Run, AnAccuracyThatIsMetWithAllElementsUsedUpIsMet) {
  Study study = test::furnished_room_study();
  study.mesh.max_elements = answer(study).counts.elements - 1;
  const Results results = answer(study);
  ASSERT_TRUE(results.stopped);
  EXPECT_EQ(results.stopped->by, Stop::By::kElements);
  EXPECT_TRUE(results.accuracy_met);
}

TEST(Run, ABudgetBelowTheNumberOfSurfacesLeavesEachWhole) {
  Study study = test::furnished_room_study();
  study.mesh.max_elements = 1;
  const Results results = answer(study);
  EXPECT_EQ(results.counts.elements, test::Stage(study).solution.tree().roots().size());
  EXPECT_EQ(results.stopped.value().by, Stop::By::kElements);
  EXPECT_EQ(results.stopped->phase, "direct light");
}

TEST(Run, ABudgetOfElementsIsSpentAlikeByAnyNumberOfThreads) {
  Study study = test::furnished_room_study();
  study.accuracy.target = 0.02;
  study.mesh.max_elements = answer(study).counts.elements / 2;
  set_threads(1);
  const Results one = answer(study);
  set_threads(3);
  const Results three = answer(study);
  set_threads(0);
  EXPECT_TRUE(one.stopped);
  expect_same(one, three);
}

TEST(Run, StoppedBeforeShadowsAreFoundItShowsSurfacesWithoutThem) {
  Impatient user("shadows");
  const Results results = run(test::furnished_room_study(), user);
  EXPECT_FALSE(results.shadow_lines);
  EXPECT_TRUE(results.accuracy_met);
  EXPECT_EQ(results.grids[0].illuminance_lux, answer(test::furnished_room_study()).grids[0].illuminance_lux);
  EXPECT_FALSE(results.surfaces.cells.empty());
  EXPECT_THAT(results.notices, Contains(HasSubstr("before the shadow lines")));
}

TEST(Run, StoppedBeforeThereIsAnythingToShowItFails) {
  Impatient user("meshing");
  EXPECT_THROW(run(test::furnished_room_study(), user), Interrupted);
  NoProgress nobody;
  EXPECT_THROW(run(test::furnished_room_study(), nobody, {.time_s = 1e-6}), LimitReached);
}

TEST(Run, CountsAndPhasesAreToldOff) {
  const Results results = answer(test::furnished_room_study());
  EXPECT_EQ(results.counts.parts, 3U);
  EXPECT_EQ(results.counts.polygons, test::furnished_room_study().model.polygon_count());
  EXPECT_EQ(results.counts.openings, 1U);
  EXPECT_GT(results.counts.links, 0U);
  EXPECT_GT(results.counts.rays, 0U);
  std::vector<std::string> names;
  for (const PhaseTime& phase : results.phases) names.push_back(phase.name);
  EXPECT_THAT(names, ElementsAre("cleaning the model", "placing sensors", "meshing", "direct light", "linking",
                                 "gathering", "balancing", "shadows"));
}

TEST(Run, SensorsAreTheSameWithAndWithoutShadowLines) {
  Study study = test::furnished_room_study();
  const Results with = answer(study);
  study.mesh.discontinuities = false;
  const Results without = answer(study);
  EXPECT_EQ(with.grids.at(0).illuminance_lux, without.grids.at(0).illuminance_lux);
  EXPECT_EQ(with.grids.at(0).error_lux, without.grids.at(0).error_lux);
  EXPECT_TRUE(with.shadow_lines.has_value());
  EXPECT_FALSE(without.shadow_lines.has_value());
}

TEST(Run, MeetsTheAccuracyItWasAsked) {
  const Results results = answer(test::furnished_room_study());
  EXPECT_TRUE(results.accuracy_met);
  EXPECT_EQ(results.accuracy_target, 0.08);
  EXPECT_LE(results.accuracy_reached, 0.08);
  EXPECT_GT(results.accuracy_reached, 0.0);
}

TEST(Run, ReflectanceOfOneIsRefused) {
  Study study = test::furnished_room_study();
  test::material(study, "wall").front.reflectance = Spectrum{1.0F};
  try {
    std::ignore = answer(study);
    FAIL() << "nothing was thrown";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("wall"));
    EXPECT_THAT(e.what(), HasSubstr("reflectance of 1"));
    EXPECT_FALSE(e.hint().empty());
  }
}

/// Stops a run in a phase.
class Stopper final : public Progress {
 public:
  explicit Stopper(std::string phase) : wanted_(std::move(phase)) {}
  void phase(std::string_view name) override { here_ = name == wanted_; }
  void advance(double fraction) override {
    EXPECT_GE(fraction, 0.0);
    EXPECT_LE(fraction, 1.0);
    if (here_) throw std::runtime_error("stop");
  }

 private:
  std::string wanted_;
  bool here_ = false;
};

TEST(Run, CanBeStoppedInItsLongPhases) {
  for (const std::string phase : {"direct light", "linking", "gathering"}) {
    Stopper stopper(phase);
    EXPECT_THROW(std::ignore = run(test::furnished_room_study(), stopper), std::runtime_error) << phase;
  }
}

TEST(Run, PartsOfTheSolverSaveWorkAndDoNotChangeTheAnswer) {
  Study study = test::furnished_room_study();
  study.accuracy.target = 0.05;
  NoProgress nobody;
  const Results all = run(study, nobody);
  for (const SolverParts& parts :
       {SolverParts{.clusters = false}, SolverParts{.importance = false}, SolverParts{.proofs = false}}) {
    study.parts = parts;
    const Results without = run(study, nobody);
    for (std::size_t i = 0; i < all.grids[0].sensors.count(); ++i) {
      const double error = std::hypot(all.grids[0].error_lux[i], without.grids[0].error_lux[i]);
      EXPECT_NEAR(without.grids[0].illuminance_lux[i], all.grids[0].illuminance_lux[i], 3.0 * error);
    }
    if (!parts.proofs) {
      EXPECT_GT(without.counts.rays, all.counts.rays);
    }
  }
}

}  // namespace
}  // namespace clerestory::lighting
