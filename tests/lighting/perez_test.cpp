// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/perez.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
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
constexpr double kRad = kPi / 180.0;
constexpr double kLumensPerWatt = 179.0;  ///< by which the peer divides its lux

struct Patch {
  Vector direction;
  double solid_angle_sr;
};

Vector direction(double altitude, double azimuth) {
  return {std::sin(azimuth) * std::cos(altitude), std::cos(azimuth) * std::cos(altitude), std::sin(altitude)};
}

/// Tregenza's 145 patches, the zenith last.
std::vector<Patch> patches() {
  constexpr std::array<int, 7> kRows{30, 30, 24, 24, 18, 12, 6};
  constexpr double kStep = 0.5 * kPi / 7.5;
  std::vector<Patch> all;
  for (int i = 0; i < 7; ++i) {
    const int count = kRows.at(static_cast<std::size_t>(i));
    const double size = 2.0 * kPi * (std::sin(kStep * (i + 1)) - std::sin(kStep * i)) / count;
    for (int j = 0; j < count; ++j) all.push_back({direction(kStep * (i + 0.5), 2.0 * kPi * j / count), size});
  }
  all.push_back({{0, 0, 1}, 2.0 * kPi * (1.0 - std::cos(0.5 * kStep))});
  return all;
}

/// A line of the peer's weather file, with the peer's own solar angles.
struct Hour {
  Irradiance irradiance;
  double altitude;
  double azimuth;
};

std::vector<Hour> peer_hours() {
  constexpr double kLatitude = 37.42 * kRad;
  std::ifstream in(test::shared_data_dir() / "radiance-tests/gen/test.wea");
  std::string line;
  for (int i = 0; i < 6; ++i) std::getline(in, line);
  std::vector<Hour> hours;
  double month = 0;
  double day = 0;
  double hour = 0;
  double direct = 0;
  double diffuse = 0;
  while (in >> month >> day >> hour >> direct >> diffuse) {
    constexpr std::array<int, 12> kBefore{0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
    const int number = kBefore.at(static_cast<std::size_t>(month) - 1) + static_cast<int>(day);
    const double declination = 0.4093 * std::sin(2.0 * kPi * (number - 81) / 365.0);
    const double equation_h = 0.170 * std::sin(4.0 * kPi * (number - 80) / 373.0) -
                              0.129 * std::sin(2.0 * kPi * (number - 8) / 355.0) +
                              12.0 * (120.0 * kRad - 122.05 * kRad) / kPi;
    const double turned = (hour + equation_h) * kPi / 12.0;
    const double altitude = std::asin(std::sin(kLatitude) * std::sin(declination) -
                                      std::cos(kLatitude) * std::cos(declination) * std::cos(turned));
    const double from_south = -std::atan2(
        std::cos(declination) * std::sin(turned),
        -std::cos(kLatitude) * std::sin(declination) - std::sin(kLatitude) * std::cos(declination) * std::cos(turned));
    hours.push_back({{direct, diffuse, 11.0, number}, altitude, from_south + kPi - 90.0 * kRad});
  }
  return hours;
}

/// The peer's matrix: [patch, ground first][column] green.
std::vector<std::vector<double>> peer_matrix() {
  std::ifstream in(test::shared_data_dir() / "radiance-tests/gen/ref/test.smx");
  std::string line;
  while (std::getline(in, line) && !line.empty()) {
  }
  std::vector<std::vector<double>> rows(146);
  for (auto& row : rows) {
    double r = 0;
    double g = 0;
    double b = 0;
    for (int i = 0; i < 56 && in >> r >> g >> b; ++i) row.push_back(g);
  }
  return rows;
}

/// Radiances of the 145 patches as the peer has them: normalised by their own sum, the sun in the four nearest.
std::vector<double> radiances(const Hour& hour, const std::vector<Patch>& sky_patches) {
  constexpr double kSkyGreen = 0.9;
  const Vector sun = direction(hour.altitude, hour.azimuth);
  const SkyClearness clearness = clearness_of(hour.irradiance, 0.5 * kPi - hour.altitude);
  const DaylightIlluminance light = illuminance_of(hour.irradiance, clearness);
  const SkyDistribution sky = perez_distribution(clearness, sun);
  double horizontal = 0.0;
  std::vector<double> values;
  for (const Patch& p : sky_patches) {
    values.push_back(relative_luminance(sky, p.direction));
    horizontal += values.back() * p.direction.z * p.solid_angle_sr;
  }
  for (double& v : values) v *= kSkyGreen * light.diffuse_horizontal_lux / (horizontal * kLumensPerWatt);
  std::vector<std::size_t> order(sky_patches.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto cosine = [&](std::size_t i) { return dot(sky_patches[i].direction, sun); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return cosine(a) > cosine(b); });
  double weights = 0.0;
  for (std::size_t k = 0; k < 4; ++k) weights += 1.0 / (1.002 - cosine(order[k]));
  for (std::size_t k = 0; k < 4; ++k) {
    values[order[k]] += light.direct_normal_lux / (1.002 - cosine(order[k])) /
                        (weights * kLumensPerWatt * sky_patches[order[k]].solid_angle_sr);
  }
  return values;
}

TEST(Perez, SkiesAreThePeersWithinItsPrintedDigits) {
  CLERESTORY_NEEDS_SHARED_DATA("radiance-tests/gen/ref/test.smx");
  const std::vector<Hour> hours = peer_hours();
  const auto matrix = peer_matrix();
  const std::vector<Patch> sky_patches = patches();
  ASSERT_EQ(hours.size(), 56U);
  ASSERT_EQ(matrix.back().size(), 56U);
  std::size_t lit = 0;
  double worst = 0.0;
  for (std::size_t h = 0; h < hours.size(); ++h) {
    if (matrix[145][h] <= 0.0) continue;
    ++lit;
    const std::vector<double> values = radiances(hours[h], sky_patches);
    for (std::size_t p = 0; p < values.size(); ++p) {
      const double printed = matrix[p + 1][h];
      EXPECT_NEAR(values[p], printed, 0.006 * printed) << "hour " << h << ", patch " << p;
      worst = std::max(worst, std::abs(values[p] / printed - 1.0));
    }
    // The ground: its green reflectance is 0.2, and the beam counts.
    const SkyClearness clearness = clearness_of(hours[h].irradiance, 0.5 * kPi - hours[h].altitude);
    const DaylightIlluminance light = illuminance_of(hours[h].irradiance, clearness);
    const double ground = 0.2 / (kPi * kLumensPerWatt) *
                          (light.diffuse_horizontal_lux + light.direct_normal_lux * std::sin(hours[h].altitude));
    EXPECT_NEAR(ground, matrix[0][h], 0.006 * matrix[0][h]) << "hour " << h;
  }
  EXPECT_EQ(lit, 48U);
  std::printf("[ FIGURES  ] %zu x 145 patches: largest difference %.3f %%\n", lit, 100.0 * worst);
}

TEST(Perez, TheSkyGivesTheIlluminanceOfItsIrradiance) {
  const Irradiance irradiance{600.0, 120.0, 8.0, 172};
  const double altitude = 50.0 * kRad;
  const Sky sky = perez_sky(irradiance, direction(altitude, 1.0));
  const DaylightIlluminance light = illuminance_of(irradiance, clearness_of(irradiance, 0.5 * kPi - altitude));
  EXPECT_DOUBLE_EQ(sky.horizontal_illuminance_lux, light.diffuse_horizontal_lux);
  EXPECT_DOUBLE_EQ(sky.sun.normal_illuminance_lux, light.direct_normal_lux);
  EXPECT_NEAR(sky.ground_illuminance_lux(), light.diffuse_horizontal_lux + light.direct_normal_lux * std::sin(altitude),
              1e-9);
  // Efficacies of a clear sky are some 130 and 100 lm/W [Perez et al. 1990].
  EXPECT_NEAR(light.diffuse_horizontal_lux / 120.0, 130.0, 15.0);
  EXPECT_NEAR(light.direct_normal_lux / 600.0, 100.0, 8.0);
}

TEST(Perez, ClearnessSortsOvercastFromClear) {
  EXPECT_EQ(clearness_of({0.0, 200.0, 10.0, 1}, 1.0).bin, 0);
  EXPECT_EQ(clearness_of({900.0, 80.0, 10.0, 1}, 0.5).bin, 7);
}

TEST(Perez, WithoutIrradianceThereIsNoLight) {
  const Sky sky = perez_sky({0.0, 0.0, 10.0, 1}, direction(0.5, 1.0));
  EXPECT_EQ(sky_luminance(sky, {0, 0, 1}), 0.0);
  EXPECT_EQ(sky.ground_illuminance_lux(), 0.0);
}

TEST(Perez, UnderTheHorizonTheSunGivesNoBeamAndTheSkyIsFinite) {
  const Sky sky = perez_sky({5.0, 10.0, 10.0, 1}, direction(-2.0 * kRad, 1.0));
  EXPECT_FALSE(sky.sun.shines());
  for (int i = 0; i < 90; ++i) {
    const double l = sky_luminance(sky, direction(i * kRad, 1.0));
    EXPECT_TRUE(std::isfinite(l) && l >= 0.0);
  }
}

}  // namespace
}  // namespace clerestory::lighting
