// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/mirror_links.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/lighting/stages.h"
#include "tests/support/path_tracer.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using clerestory::test::pane_optics;
using mesh::ElementId;
using mesh::Model;
using mesh::Point;
using mesh::Vector;

constexpr double kClear = 0.70;
/// A small receiver at (2, 0, 0) that looks up, beside an upright pane in the plane x = 0.
constexpr Point kReceiver{2, 0, 0};

/// A rectangle of the plane x = 0.
struct PaneArea {
  double low_y, high_y, low_z, high_z;
};
constexpr PaneArea kPane{-0.8, 1.2, 0.5, 2.0};

void add_pane(Model& model, const PaneArea& a) {
  support::add_quad(model, {0, a.low_y, a.low_z}, {0, a.high_y, a.low_z}, {0, a.high_y, a.high_z},
                    {0, a.low_y, a.high_z}, {"glass", "pane"});
}

Model receiver_and_pane(const PaneArea& pane) {
  Model model;
  support::add_quad(model, {1.95, -0.05, 0}, {2.05, -0.05, 0}, {2.05, 0.05, 0}, {1.95, 0.05, 0}, {"floor", "floor"});
  add_pane(model, pane);
  return model;
}

/// ∫ cosθ cosθ'/(π r²) · weight(cosine at the pane, point of the pane, direction) dA over the pane, as seen from the receiver.
using Weight = std::function<double(double cosine, const Point& at, const Vector& direction)>;
double over_pane(const PaneArea& pane, const Weight& weight) {
  constexpr int kSteps = 400;
  const double dy = (pane.high_y - pane.low_y) / kSteps;
  const double dz = (pane.high_z - pane.low_z) / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const Point at{0, pane.low_y + (i + 0.5) * dy, pane.low_z + (j + 0.5) * dz};
      const Vector d = normalized(at - kReceiver);
      const double distance2 = dot(at - kReceiver, at - kReceiver);
      sum += d.z * -d.x / (std::numbers::pi * distance2) * weight(-d.x, at, d) * dy * dz;
    }
  }
  return sum;
}
double form_factor(const PaneArea& pane) {
  return over_pane(pane, [](double, const Point&, const Vector&) { return 1.0; });
}
double reflected_by(const PaneArea& pane) {
  return over_pane(pane,
                   [](double cosine, const Point&, const Vector&) { return pane_optics(kClear, cosine).reflectance; });
}

/// A run that may be told to finish.
struct Hurry final : Progress {
  void phase(std::string_view) override {}
  void advance(double) override {}
  [[nodiscard]] bool should_finish(double) const override { return hurries; }
  bool hurries = false;
};

/// All that is needed to follow links from the receiver to panes.
struct Mirrors : test::Stage {
  explicit Mirrors(const Study& study) : Stage(study), clusters((solution.push_pull(), scene), solution.tree()) {
    clusters.pull(solution);
  }
  [[nodiscard]] MirroredLight follow(const LinkSource& pane, double factor, std::uint64_t seed) const {
    Link link;
    link.receiver = root("floor");
    link.source = pane;
    link.factor = static_cast<float>(factor);
    link.slope_u = 0.5F * link.factor;
    link.slope_v = -0.25F * link.factor;
    return follow_mirrors(
        solution, clusters, {&link, 1}, [this](ElementId) { return tolerance_lux; }, seed, progress);
  }

  Clusters clusters;
  double tolerance_lux = 1e9;
  Hurry progress;
};

/// Mean of a value over many seeds, and its standard error.
struct Mean {
  double value = 0.0;
  double error = 0.0;
};
Mean mean_over_seeds(const std::function<double(std::uint64_t)>& value) {
  constexpr int kSeeds = 4000;
  double sum = 0.0;
  double square = 0.0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const double v = value(static_cast<std::uint64_t>(seed));
    sum += v / kSeeds;
    square += v * v / kSeeds;
  }
  return {sum, std::sqrt(std::max(0.0, square - sum * sum) / (kSeeds - 1.0))};
}

/// The mean is what it should be, and known well enough to tell.
void expect_mean(const Mean& mean, double expected) {
  EXPECT_NEAR(mean.value, expected, 3.0 * mean.error + 1e-3 * expected);
  EXPECT_LT(mean.error, 0.01 * expected);
}

double sum_of_factors(const MirroredLight& light) {
  double sum = 0.0;
  for (const Link& link : light.links) sum += link.factor;
  return sum;
}

Study glazed(Model model) {
  Study study = test::study_of(std::move(model), 0.5, {2, 0, 0.5});
  test::glaze(test::material(study, "glass"), kClear);
  return study;
}

/// An upright poster at x = 6 that the receiver sees in a part of the pane only: between y = 0 and 3, z = 1 and 4.
bool on_poster(const Point& at, const Vector& towards_pane) {
  const Vector d{-towards_pane.x, towards_pane.y, towards_pane.z};
  const Point hit = at + (6.0 / d.x) * d;
  return hit.y > 0.0 && hit.y < 3.0 && hit.z > 1.0 && hit.z < 4.0;
}
Study poster_study(const Model& between = {}) {
  Model model = receiver_and_pane(kPane);
  support::append(model, between);
  support::add_quad(model, {6, 0, 1}, {6, 0, 4}, {6, 3, 4}, {6, 3, 1}, {"poster", "poster"});
  return glazed(std::move(model));
}
double poster_factor() {
  return over_pane(kPane, [](double cosine, const Point& at, const Vector& d) {
    return on_poster(at, d) ? pane_optics(kClear, cosine).reflectance : 0.0;
  });
}

TEST(FollowMirrors, SurfaceSeenInAPaneHasTheFormFactorOfItsImageTimesTheReflectance) {
  const Mirrors mirrors(poster_study());
  const LinkSource pane = LinkSource::element(mirrors.root("glass"));
  const double factor = form_factor(kPane);
  ASSERT_LT(poster_factor(), 0.8 * reflected_by(kPane)) << "the poster fills only a part of the mirror";
  expect_mean(mean_over_seeds([&](std::uint64_t seed) { return sum_of_factors(mirrors.follow(pane, factor, seed)); }),
              poster_factor());
  for (const Link& link : mirrors.follow(pane, factor, 1).links) {
    EXPECT_EQ(link.source.element(), mirrors.root("poster"));
    EXPECT_EQ(link.receiver, mirrors.root("floor"));
  }
}

TEST(FollowMirrors, LinksAreInProportionToThePanesOwnHoweverSmall) {
  const Mirrors mirrors(poster_study());
  const LinkSource pane = LinkSource::element(mirrors.root("glass"));
  std::size_t found = 0;
  for (std::uint64_t seed = 0; seed < 64; ++seed) {
    const std::vector<Link> big = mirrors.follow(pane, 0.03, seed).links;
    const std::vector<Link> small = mirrors.follow(pane, 3e-7, seed).links;
    ASSERT_EQ(big.size(), small.size());
    if (big.empty()) continue;
    ++found;
    EXPECT_NEAR(small[0].factor, 1e-5 * big[0].factor, 1e-10 * big[0].factor);
    EXPECT_FLOAT_EQ(big[0].slope_u, 0.5F * big[0].factor);
    EXPECT_FLOAT_EQ(big[0].slope_v, -0.25F * big[0].factor);
  }
  EXPECT_GT(found, 32U);
}

/// What the receiver gets of the poster, which sends out 100 lm/m², in many runs: how far it spreads, and what is said of it.
struct Spread {
  double true_lux = 0.0;
  double stated_lux = 0.0;
};
Spread spread_of(const Mirrors& mirrors) {
  constexpr int kSeeds = 400;
  const LinkSource pane = LinkSource::element(mirrors.root("glass"));
  const double factor = form_factor(kPane);
  double sum = 0.0;
  double square = 0.0;
  double stated = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const MirroredLight light = mirrors.follow(pane, factor, seed);
    const double lux = 100.0 * sum_of_factors(light);
    sum += lux / kSeeds;
    square += lux * lux / kSeeds;
    stated += light.noise.at(0).lux * light.noise.at(0).lux / kSeeds;
  }
  return {std::sqrt(square - sum * sum), std::sqrt(stated)};
}

TEST(FollowMirrors, NoiseIsStatedAndMoreRaysAreTakenWhereItWouldMatter) {
  Study study = poster_study();
  test::shine(test::material(study, "poster"), 100.0);
  Mirrors mirrors(study);
  mirrors.solution.direct(mirrors.root("glass"))[0].value = 10.0F;  // so much light is to be expected in the pane
  mirrors.solution.push_pull();
  const Spread few = spread_of(mirrors);
  EXPECT_NEAR(few.stated_lux / few.true_lux, 1.0, 0.15);
  mirrors.tolerance_lux = 1e-9;
  const Spread many = spread_of(mirrors);
  EXPECT_NEAR(many.stated_lux / many.true_lux, 1.0, 0.15);
  EXPECT_LT(many.true_lux, few.true_lux / 4.0) << "32 times as many rays";
}

TEST(FollowMirrors, FewRaysMustDoInAHurry) {
  Mirrors mirrors(poster_study());
  const LinkSource pane = LinkSource::element(mirrors.root("glass"));
  const auto rays = [&] {
    const std::uint64_t before = mirrors.scene.rays->use().rays;
    (void)mirrors.follow(pane, 0.05, 1);
    return mirrors.scene.rays->use().rays - before;
  };
  const std::uint64_t unhurried = rays();
  mirrors.progress.hurries = true;
  EXPECT_LE(4 * rays(), unhurried + 4);
}

TEST(FollowMirrors, SkySeenInAPaneIsLight) {
  Study study = glazed(receiver_and_pane(kPane));
  study.sky.type = Sky::Type::kUniform;
  const Mirrors mirrors(study);
  const LinkSource pane = LinkSource::element(mirrors.root("glass"));
  const double factor = form_factor(kPane);
  expect_mean(mean_over_seeds([&](std::uint64_t seed) {
                const auto sky = mirrors.follow(pane, factor, seed).sky;
                EXPECT_EQ(sky.at(0).receiver, mirrors.root("floor"));
                EXPECT_FLOAT_EQ(sky.at(0).lux.slope_u, 0.5F * sky.at(0).lux.value);
                return sky.at(0).lux.value;
              }),
              10'000.0 * reflected_by(kPane));
}

TEST(FollowMirrors, WithoutASkyAndWithNothingBeforeItThePaneShowsNothing) {
  const Mirrors mirrors(glazed(receiver_and_pane(kPane)));
  const MirroredLight light = mirrors.follow(LinkSource::element(mirrors.root("glass")), 0.05, 1);
  EXPECT_TRUE(light.links.empty());
  EXPECT_TRUE(light.sky.empty());
}

TEST(FollowMirrors, PaneThatIsHiddenShowsNothing) {
  Model screen;
  support::add_quad(screen, {1, -5, -1}, {1, 5, -1}, {1, 5, 5}, {1, -5, 5}, {"screen", "screen"});
  const Mirrors mirrors(poster_study(screen));
  EXPECT_TRUE(mirrors.follow(LinkSource::element(mirrors.root("glass")), 0.05, 1).links.empty());
}

/// Two panes one above the other, and a wall before them that fills both mirrors.
Mirrors two_panes() {
  Model model = receiver_and_pane({-0.8, 1.2, 0.5, 1.2});
  add_pane(model, {-0.8, 1.2, 1.4, 2.0});
  support::add_quad(model, {6, -50, -1}, {6, -50, 50}, {6, 50, 50}, {6, 50, -1}, {"wall", "wall"});
  return Mirrors(glazed(std::move(model)));
}

TEST(FollowMirrors, ClusterOfPanesShowsWhatItsPanesDo) {
  const Mirrors mirrors = two_panes();
  std::uint32_t panes = 0;
  for (const std::uint32_t top : mirrors.clusters.tops()) {
    if (mirrors.clusters.kind(top) == Clusters::Kind::kPanes) panes = top;
  }
  // The cluster's fronts alone: its backs look away.
  ASSERT_NEAR(mirrors.clusters.area(panes), 2.0 * (2.0 * 0.7 + 2.0 * 0.6), 1e-9);
  const double expected = reflected_by({-0.8, 1.2, 0.5, 1.2}) + reflected_by({-0.8, 1.2, 1.4, 2.0});
  const Mean mean = mean_over_seeds(
      [&](std::uint64_t seed) { return sum_of_factors(mirrors.follow(LinkSource::cluster(panes), 0.05, seed)); });
  EXPECT_NEAR(mean.value, expected, 3.0 * mean.error + 1e-3 * expected);
  EXPECT_LT(mean.error, 0.03 * expected) << "points by area, not by solid angle";
}

}  // namespace
}  // namespace clerestory::lighting
