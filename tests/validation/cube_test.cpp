// SPDX-License-Identifier: GPL-3.0-or-later
// CIE 171:2006 case 5.8, the cube with inner reflections: absolute values, and convergence.
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/lamps.h"
#include "tests/support/shapes.h"
#include "tests/validation/cube_reference.h"
#include "tests/validation/statistics.h"
#include "tests/validation/studies.h"

namespace clerestory::test {
namespace {

/// Points are to be right to 1 %: 95 % of sensors lie within twice the accuracy asked.
constexpr double kPointAccuracy = 0.005;

/// A point of a face [m] and the total illuminance there by reflectance [lx], good to 0.05 %.
struct PublishedPoint {
  double x, y;
  std::map<double, double> illuminance_lux;
};
const std::vector<PublishedPoint> kPublished{{2, 2, {{0, 198.944}, {.2, 227.82}, {.5, 310.98}, {.8, 629.9}}},
                                             {1, 2, {{0, 142.353}, {.2, 170.78}, {.5, 253.23}, {.8, 571.4}}},
                                             {.25, 2, {{0, 84.797}, {.2, 111.05}, {.5, 189.95}, {.8, 504.2}}},
                                             {1, 1, {{0, 108.291}, {.2, 135.59}, {.5, 216.08}, {.8, 531.8}}},
                                             {.25, .25, {{0, 49.400}, {.2, 69.45}, {.5, 135.81}, {.8, 431.1}}}};

lighting::Study cube_study(double reflectance, double accuracy) {
  lighting::Study study = grey_study(support::box_room(kCubeSide_m, kCubeSide_m, kCubeSide_m), reflectance);
  study.luminaires.push_back(clerestory::test::isotropic_lamp({2, 2, 2}, kCubeFlux_lm / (4.0 * std::numbers::pi)));
  study.accuracy.target = accuracy;
  return study;
}

/// Points of a face with their shares of its area, dense towards the edges, where the indirect light falls steeply.
struct FaceRule {
  std::vector<mesh::Point> points;  ///< of the floor
  std::vector<double> weights;
};
FaceRule face_rule(int count) {
  const auto at = [&](int i) {
    // The midpoint rule is at its best where all derivatives agree at both ends: x = s - sin(2πs)/2π [Sidi 1993].
    const double s = (i + 0.5) / count;
    const double turn = 2.0 * std::numbers::pi * s;
    return std::pair{s - std::sin(turn) / (2.0 * std::numbers::pi), (1.0 - std::cos(turn)) / count};
  };
  FaceRule rule;
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i < count; ++i) {
      rule.points.push_back({kCubeSide_m * at(i).first, kCubeSide_m * at(j).first, 0.0});
      rule.weights.push_back(at(i).second * at(j).second);
    }
  }
  return rule;
}

TEST(CubeReference, MatchesThePublishedPointsAndTheExactMean) {
  for (const double reflectance : {0.2, 0.5, 0.8}) {
    const CubeReference reference(reflectance);
    for (const PublishedPoint& p : kPublished) {
      const double published = p.illuminance_lux.at(reflectance);
      EXPECT_NEAR(reference.illuminance(p.x, p.y), published, 6e-4 * published)
          << reflectance << " at " << p.x << ", " << p.y;
    }
    double mean = 0.0;
    const FaceRule rule = face_rule(16);
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      const mesh::Point& p = rule.points[i];
      mean += rule.weights[i] * (reference.illuminance(p.x, p.y) - cube_direct(p.x, p.y));
    }
    EXPECT_NEAR(mean, cube_mean_indirect(reflectance), 5e-4 * mean);
  }
}

class Cie171Case58 : public testing::TestWithParam<double> {};

TEST_P(Cie171Case58, PointsOfAFaceLieWithinOnePerCent) {
  lighting::Study study = cube_study(GetParam(), kPointAccuracy);
  std::vector<mesh::Point> floor;
  std::vector<mesh::Point> wall;
  for (const PublishedPoint& p : kPublished) {
    floor.push_back({p.x, p.y, 0});
    wall.push_back({p.y, 0, p.x});
  }
  add_sensors(study, floor, {0, 0, 1});
  add_sensors(study, wall, {0, 1, 0});
  const lighting::Results results = answer(study);
  for (std::size_t i = 0; i < 2 * kPublished.size(); ++i) {
    const double published = kPublished[i % kPublished.size()].illuminance_lux.at(GetParam());
    EXPECT_NEAR(results.grids[0].illuminance_lux.at(i), published, 0.01 * published) << "point " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Reflectances, Cie171Case58, testing::Values(0.0, 0.2, 0.5, 0.8));

class Cie171Case58Mean : public testing::TestWithParam<double> {};

TEST_P(Cie171Case58Mean, IndirectIlluminanceIsTheExactValueWithinThreePerMille) {
  lighting::Study study = cube_study(GetParam(), kPointAccuracy);
  const FaceRule rule = face_rule(16);
  std::vector<mesh::Point> wall;
  for (const mesh::Point& p : rule.points) wall.push_back({0, p.x, p.y});
  add_sensors(study, rule.points, {0, 0, 1});
  add_sensors(study, wall, {1, 0, 0});
  const lighting::Results results = answer(study);
  double mean = 0.0;
  for (std::size_t i = 0; i < 2 * rule.points.size(); ++i) {
    const std::size_t k = i % rule.points.size();
    const double direct = cube_direct(rule.points[k].x, rule.points[k].y);
    mean += 0.5 * rule.weights[k] * (results.grids[0].illuminance_lux.at(i) - direct);
  }
  const double exact = cube_mean_indirect(GetParam());
  std::printf("[ FIGURES  ] 5.8, reflectance %.2f: mean indirect %.3f lx, exact %.3f lx, %+.3f %%\n", GetParam(), mean,
              exact, 100.0 * (mean / exact - 1.0));
  EXPECT_NEAR(mean, exact, 0.003 * exact);
}

INSTANTIATE_TEST_SUITE_P(Reflectances, Cie171Case58Mean, testing::Values(0.05, 0.2, 0.5, 0.8, 0.95));

/// RMS of the relative error over 400 points of the floor, the mean of three seeds.
double true_error(double accuracy, const Reference& reference) {
  double sum = 0.0;
  for (const std::uint64_t seed : {0U, 1U, 2U}) {
    lighting::Study study = cube_study(0.5, accuracy);
    study.accuracy.seed = seed;
    add_sensors(study, cell_centres({0, 0, 0}, kCubeSide_m, kCubeSide_m, 20), {0, 0, 1});
    const lighting::Results results = answer(study);
    const Comparison c = compare(results.grids.at(0), reference);
    std::printf("[ FIGURES  ] accuracy %.0f %%, seed %d: rms %.3f %%, rms(z) %.2f, %zu elements, %zu links, %zu rays\n",
                100.0 * accuracy, static_cast<int>(seed), 100.0 * c.rms, c.rms_z, results.counts.elements,
                results.counts.links, results.counts.rays);
    sum += c.rms / 3.0;
  }
  return sum;
}

TEST(Convergence, TrueErrorStaysBelowTheAccuracyAskedAndFallsWithIt) {
  const CubeReference solution(0.5);
  Reference reference;
  for (const mesh::Point& p : cell_centres({0, 0, 0}, kCubeSide_m, kCubeSide_m, 20))
    reference.illuminance_lux.push_back(solution.illuminance(p.x, p.y));
  reference.standard_error_lux.assign(reference.illuminance_lux.size(), 0.0);

  // Slope of the straight line through (log accuracy, log error); the accuracies lie a factor of two apart.
  constexpr std::array accuracies{0.08, 0.04, 0.02, 0.01};
  constexpr std::array deviations{1.5, 0.5, -0.5, -1.5};  // of log2 accuracy from its mean; their squares sum to 5
  double slope = 0.0;
  for (std::size_t i = 0; i < accuracies.size(); ++i) {
    const double error = true_error(accuracies[i], reference);
    EXPECT_LE(error, accuracies[i]);
    slope += deviations[i] * std::log2(error) / 5.0;
  }
  std::printf("[ FIGURES  ] log-log slope of true error against accuracy: %.2f\n", slope);
  EXPECT_GE(slope, 0.7);
}

}  // namespace
}  // namespace clerestory::test
