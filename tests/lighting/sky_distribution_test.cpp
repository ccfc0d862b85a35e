// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sky_distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace clerestory::lighting {
namespace {

using mesh::Vector;

constexpr double kPi = std::numbers::pi;

Vector sun_at(double altitude_deg) {
  const double a = altitude_deg * kPi / 180.0;
  return {0.0, std::cos(a), std::sin(a)};
}

/// Illuminance of a plane that faces a direction, by the sky of unit scale: midpoint rule in altitude and azimuth.
double illuminance(const SkyDistribution& sky, const Vector& normal) {
  constexpr int kRows = 500;
  constexpr int kColumns = 1000;
  double sum = 0.0;
  for (int i = 0; i < kRows; ++i) {
    const double altitude = 0.5 * kPi * (i + 0.5) / kRows;
    const double sine = std::sin(altitude);
    const double cosine = std::cos(altitude);
    for (int j = 0; j < kColumns; ++j) {
      const double azimuth = 2.0 * kPi * (j + 0.5) / kColumns;
      const Vector d{cosine * std::sin(azimuth), cosine * std::cos(azimuth), sine};
      const double facing = dot(d, normal);
      if (facing > 0.0) sum += facing * cosine * relative_luminance(sky, d);
    }
  }
  return sum * kPi * kPi / (kRows * kColumns);
}

/// The rows of skies.csv whose coefficients are given: 15 numbers after the type.
std::vector<std::vector<double>> published() {
  std::ifstream in(test::validation_dir() / "skies.csv");
  std::string line;
  std::getline(in, line);
  std::vector<std::vector<double>> rows;
  while (std::getline(in, line) && line.find(",,") == std::string::npos) {
    std::istringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    rows.push_back(std::move(row));
  }
  return rows;
}

TEST(SkyDistribution, CoefficientsOfTheGeneralSkiesAreTheStandards) {
  CLERESTORY_NEEDS_VALIDATION("skies.csv");
  const auto rows = published();
  ASSERT_EQ(rows.size(), 15U);
  for (const auto& row : rows) {
    const SkyDistribution sky = cie_general_sky(static_cast<int>(row[0]), sun_at(60.0));
    EXPECT_EQ(std::vector<double>({sky.a, sky.b, sky.c, sky.d, sky.e}),
              std::vector<double>(row.begin() + 1, row.begin() + 6));
  }
}

TEST(SkyDistribution, GeneralSkiesGiveThePublishedIlluminances) {
  CLERESTORY_NEEDS_VALIDATION("skies.csv");
  for (const auto& row : published()) {
    SCOPED_TRACE(row[0]);
    const SkyDistribution high = cie_general_sky(static_cast<int>(row[0]), sun_at(60.0));
    const SkyDistribution low = cie_general_sky(static_cast<int>(row[0]), sun_at(30.0));
    const double zenith = relative_luminance(high, {0, 0, 1});
    const double horizontal = relative_horizontal_illuminance(high);
    EXPECT_NEAR(horizontal / zenith, row[6], 1e-4);
    EXPECT_NEAR(illuminance(high, {0, 1, 0}) / horizontal, row[7], 1e-4);
    EXPECT_NEAR(illuminance(high, {1, 0, 0}) / horizontal, row[8], 1e-4);
    EXPECT_NEAR(illuminance(high, {0, -1, 0}) / horizontal, row[9], 1e-4);
    EXPECT_NEAR(relative_horizontal_illuminance(low) / relative_luminance(low, {0, 0, 1}), row[10], 1e-4);
  }
}

TEST(SkyDistribution, TheIntegralAgreesWithAnotherWhereverTheSunStands) {
  for (const double altitude : {-5.0, 0.0, 1.0, 45.0, 89.0, 90.0}) {
    for (const int type : {7, 12, 15}) {
      const SkyDistribution sky = cie_general_sky(type, sun_at(altitude));
      const double other = illuminance(sky, {0, 0, 1});
      EXPECT_NEAR(relative_horizontal_illuminance(sky), other, 2e-5 * other) << type << " at " << altitude;
    }
  }
}

TEST(SkyDistribution, NothingIsBrighterThanTheBound) {
  for (int type = 1; type <= 15; ++type) {
    const SkyDistribution sky = cie_general_sky(type, sun_at(40.0));
    const double bound = relative_luminance_bound(sky);
    double brightest = 0.0;
    for (int i = 0; i <= 180; ++i) {
      for (int j = 0; j < 90; ++j) {
        const double azimuth = i * kPi / 90.0;
        const double altitude = (j + 0.5) * kPi / 180.0;
        const Vector d{std::sin(azimuth) * std::cos(altitude), std::cos(azimuth) * std::cos(altitude),
                       std::sin(altitude)};
        brightest = std::max(brightest, relative_luminance(sky, d));
      }
    }
    EXPECT_LE(brightest, bound) << type;
    EXPECT_GE(brightest, 0.1 * bound) << type;
  }
}

TEST(SkyDistribution, AGradationThatGrowsTowardsTheHorizonEndsAtSixDegrees) {
  const SkyDistribution sky{1.0, 0.2, 0.0, -1.0, 0.0, 0.0, {0, 0, 1}};
  const double lowest = relative_luminance(sky, {1.0, 0.0, 0.0});
  EXPECT_NEAR(lowest, 1.0 + std::exp(0.2 / std::sin(kPi / 30.0)), 1e-9);
}

}  // namespace
}  // namespace clerestory::lighting
