// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/solution_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::ElementId;

constexpr double kReflectance = 0.5;

struct Box : test::Stage {
  Box() : Stage(study()) {}
  static Study study() {
    Study study = test::study_of(support::box_room(4, 5, 3), kReflectance, {2, 2, 1});
    test::shine(test::material(study, "ceiling"), 10.0);
    return study;
  }

  [[nodiscard]] SolutionErrors errors(const std::vector<Link>& links, double missing = 0.0) const {
    return {solution, Arrivals({links}, solution.tree(), true), Clusters(solution.scene(), solution.tree()), missing,
            1};
  }

  ElementId floor = root("floor");
  ElementId ceiling = root("ceiling");
};

TEST(SolutionErrors, NoneComeOfNone) {
  const Box box;
  const SolutionErrors errors = box.errors({});
  EXPECT_EQ(errors.mean_error(box.floor), 0.0);
  EXPECT_EQ(errors.point_error(box.solution, box.floor), 0.0);
}

TEST(SolutionErrors, LightOfIterationsNotMadeIsMissingEverywhereAlike) {
  Box box;
  for (const ElementId e : {box.floor, box.ceiling}) box.solution.direct(e)[0].value = 200.0F;
  box.solution.push_pull();
  const SolutionErrors errors = box.errors({}, 0.01);
  EXPECT_NEAR(errors.mean_error(box.floor), 2.0, 1e-5);
  const auto there = errors.radiosity(box.solution, box.ceiling, box.solution.tree().centroid(box.ceiling));
  for (const float e : there) EXPECT_NEAR(e, kReflectance * 2.0, 1e-5);
}

TEST(SolutionErrors, OfANodeAreThoseOfAllItsPartsAlike) {
  Box box;
  box.solution.add_error(box.floor, 9.0, 0.0);
  box.solution.open(box.floor);
  const SolutionErrors errors = box.errors({});
  const ElementId first = box.solution.tree().first_child(box.floor);
  const ElementId second(first.index() + 1);
  EXPECT_NEAR(errors.mean_error(first), 3.0, 1e-6);
  EXPECT_EQ(errors.radiosity(box.solution, first, box.solution.tree().centroid(first)),
            errors.radiosity(box.solution, second, box.solution.tree().centroid(second)));
}

TEST(SolutionErrors, OfWhatALineMissesCancelOverTheNode) {
  Box box;
  box.solution.add_error(box.floor, 0.0, 4.0);
  const SolutionErrors errors = box.errors({});
  EXPECT_EQ(errors.mean_error(box.floor), 0.0);
  EXPECT_NEAR(errors.point_error(box.solution, box.floor), 2.0, 1e-6);
  const mesh::Frame& axes = box.solution.tree().axes(box.floor);
  std::array<double, SolutionErrors::kSamples> sums{};
  for (const double u : {-0.5, 0.5}) {
    for (const double v : {-0.5, 0.5}) {
      const auto at = box.solution.tree().centroid(box.floor) + u * axes.u + v * axes.v;
      const auto samples = errors.radiosity(box.solution, box.floor, at);
      for (std::size_t k = 0; k < samples.size(); ++k) {
        EXPECT_NEAR(std::abs(samples[k]), kReflectance * 2.0, 1e-6);
        sums[k] += samples[k];
      }
    }
  }
  for (const double sum : sums) EXPECT_NEAR(sum, 0.0, 1e-6);
}

TEST(SolutionErrors, AreReflectedOnByLinksUntilNothingIsLeft) {
  Box box;
  box.solution.add_error(box.floor, 9.0, 0.0);
  Link link;
  link.receiver = box.floor;
  link.source = LinkSource::element(box.ceiling);
  link.factor = 0.4F;
  link.mutual = true;
  const SolutionErrors errors = box.errors({link});
  const double back = kReflectance * link.factor;
  EXPECT_NEAR(errors.mean_error(box.floor), 3.0 / (1.0 - back * back), 0.01 * 3.0);
  EXPECT_NEAR(errors.mean_error(box.ceiling), 3.0 * back / (1.0 - back * back), 0.01 * 3.0);
}

/// A lamp behind a screen: much of what the links see is sampled. What the errors say of the elements, against a solution that is five
/// times as good, in all: neither a third of what it is nor three times as much.
TEST(SolutionErrors, SayHowFarASolutionIsFromABetterOne) {
  mesh::Model model = support::box_room(4, 5, 3);
  support::add_box(model, {1.0, 2.0, 0.0}, {3.0, 2.2, 1.8}, {.material = "screen", .part = "screen"});
  Study study = test::study_of(std::move(model), 0.6, {2, 4, 0.8});
  test::shine(test::material(study, "ceiling"), 100.0);
  study.accuracy.target = 0.05;
  const test::Solved coarse(study);
  study.accuracy.target = 0.01;
  const test::Solved fine(study);
  double square = 0.0;
  double said = 0.0;
  for (const ElementId e : coarse.solution.elements()) {
    const mesh::ElementTree& tree = coarse.solution.tree();
    if (tree.face_side(e).side != mesh::Side::kFront) continue;
    const ElementId there = fine.solution.tree().find(tree.face_side(e), tree.centroid(e));
    const ElementId same = fine.solution.element_at(there, tree.centroid(e));
    const double better = fine.solution.radiosity_at(same, tree.centroid(e), 0, false);
    const double off = coarse.solution.radiosity_at(e, tree.centroid(e), 0, false) - better;
    const double error = coarse.solution.mean_reflectance(e) * coarse.transport.errors.mean_error(e);
    square += tree.area(e) * off * off;
    said += tree.area(e) * error * error;
  }
  EXPECT_LT(std::sqrt(said / square), 3.0);
  EXPECT_GT(std::sqrt(said / square), 1.0 / 3.0);
}

}  // namespace
}  // namespace clerestory::lighting
