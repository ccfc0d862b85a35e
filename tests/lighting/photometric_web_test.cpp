// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/photometric_web.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/lamps.h"

namespace clerestory::lighting {
namespace {

using mesh::Vector;
using std::numbers::pi;

/// Unlike in every plane but at the poles, with uneven steps.
IntensityGrid uneven_grid() {
  IntensityGrid grid{
      .polar_deg = {0, 10, 25, 40, 70, 90, 130, 180}, .azimuth_deg = {0, 30, 75, 180, 300}, .candela = {}};
  for (std::size_t k = 0; k < grid.azimuth_deg.size() * grid.polar_deg.size(); ++k)
    grid.candela.push_back(100.0 + 37.0 * static_cast<double>(k * k % 11));
  for (std::size_t k = 0; k < grid.candela.size(); k += grid.polar_deg.size()) {
    grid.candela[k] = 250.0;
    grid.candela[k + grid.polar_deg.size() - 1] = 50.0;
  }
  return grid;
}

/// The midpoint rule on a fine grid of directions.
double flux_by_sums(const PhotometricWeb& web) {
  constexpr int kGamma = 720;
  constexpr int kC = 720;
  double sum = 0.0;
  for (int i = 0; i < kGamma; ++i) {
    const double gamma = (i + 0.5) * 180.0 / kGamma;
    for (int j = 0; j < kC; ++j) sum += web.intensity_cd((j + 0.5) * 360.0 / kC, gamma) * std::sin(gamma * pi / 180.0);
  }
  return sum * (pi / kGamma) * (2.0 * pi / kC);
}

TEST(PhotometricWeb, IsWhatItsGridSaysAndLinearInBetween) {
  const PhotometricWeb web(uneven_grid());
  EXPECT_NEAR(web.intensity_cd(30, 25), web.grid().candela[8 + 2], 1e-9);
  EXPECT_NEAR(web.intensity_cd(52.5, 25), 0.5 * (web.grid().candela[8 + 2] + web.grid().candela[16 + 2]), 1e-9);
  EXPECT_NEAR(
      web.intensity_cd(330, 55),
      0.25 * (web.grid().candela[32 + 3] + web.grid().candela[32 + 4] + web.grid().candela[3] + web.grid().candela[4]),
      1e-9);
}

TEST(PhotometricWeb, FluxIsTheIntegralOfWhatIsInterpolated) {
  const PhotometricWeb web(uneven_grid());
  EXPECT_NEAR(web.flux_lm(), flux_by_sums(web), 2e-5 * web.flux_lm());
  EXPECT_NEAR(test::isotropic_lamp({}, 100.0).web->flux_lm(), 400.0 * pi, 1e-10);
  EXPECT_NEAR(test::lambertian_lamp({}, {0, 0, -1}, 100.0).web->flux_lm(), 100.0 * pi, 4e-7 * 100.0 * pi);
}

TEST(PhotometricWeb, PlanesAndAnglesPutInBetweenChangeNeitherLightNorFlux) {
  const PhotometricWeb web(uneven_grid());
  IntensityGrid finer{.polar_deg = {0, 5, 10, 25, 33, 40, 70, 90, 91, 130, 150, 180},
                      .azimuth_deg = {0, 11, 30, 75, 100, 180, 300, 340},
                      .candela = {}};
  for (const double c : finer.azimuth_deg) {
    for (const double gamma : finer.polar_deg) finer.candela.push_back(web.intensity_cd(c, gamma));
  }
  const PhotometricWeb same(finer);
  EXPECT_NEAR(same.flux_lm(), web.flux_lm(), 1e-12 * web.flux_lm());
  for (const double c : {3.0, 88.0, 279.0, 359.0})
    EXPECT_NEAR(same.intensity_cd(c, 61.0), web.intensity_cd(c, 61.0), 1e-9);
}

TEST(PhotometricWeb, QuarterTurnsAndMirrorsRoundTripToTheBit) {
  const PhotometricWeb web(uneven_grid());
  const PhotometricWeb round = web.turned(1).turned(1).turned(-1).turned(3);
  const PhotometricWeb there_and_back = web.mirrored().mirrored();
  // A turn, mirrored, is the mirror image turned back.
  const PhotometricWeb mixed = web.turned(1).mirrored().turned(1).mirrored();
  for (int k = 0; k < 500; ++k) {
    const Vector d = direction_at(0.717 * k, 180.0 / 500.0 * k);
    EXPECT_EQ(round.intensity_cd(d), web.intensity_cd(d));
    EXPECT_EQ(there_and_back.intensity_cd(d), web.intensity_cd(d));
    EXPECT_EQ(mixed.intensity_cd(d), web.intensity_cd(d));
    EXPECT_EQ(web.turned(1).intensity_cd(Vector{-d.y, d.x, d.z}), web.intensity_cd(d));
    EXPECT_EQ(web.mirrored().intensity_cd(Vector{d.x, -d.y, d.z}), web.intensity_cd(d));
  }
  EXPECT_EQ(web.turned(1).flux_lm(), web.flux_lm());
}

TEST(PhotometricWeb, ThereIsNoLightBeyondItsGrid) {
  const PhotometricWeb down({.polar_deg = {0, 90}, .azimuth_deg = {0}, .candela = {10, 10}});
  EXPECT_EQ(down.intensity_cd(0, 90), 10.0);
  EXPECT_EQ(down.intensity_cd(0, 90.1), 0.0);
  EXPECT_NEAR(down.flux_lm(), 20.0 * pi, 1e-12);
  const PhotometricWeb sector(
      {.polar_deg = {0, 180}, .azimuth_deg = {-90, 0, 90}, .candela = {1, 1, 1, 1, 1, 1}, .closed = false});
  EXPECT_EQ(sector.intensity_cd(80, 90), 1.0);
  EXPECT_EQ(sector.intensity_cd(100, 90), 0.0);
  EXPECT_NEAR(sector.flux_lm(), 2.0 * pi, 1e-12);
}

}  // namespace
}  // namespace clerestory::lighting
