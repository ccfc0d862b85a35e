// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/perez.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace clerestory::lighting {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSolarConstant = 1367.0;  ///< [W/m²]
constexpr double kLeastBrightness = 0.01;
constexpr int kBins = 8;

/// Upper ends of the bins of ε [Perez et al. 1990, table 1].
constexpr std::array<double, kBins - 1> kBinEnds{1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2};

/// x = x1 + x2·Z + Δ(x3 + x4·Z) of a, b, c, d, e [Perez, Seals, Michalsky 1993, table 1].
using DistributionRow = std::array<std::array<double, 4>, 5>;
constexpr std::array<DistributionRow, kBins> kDistributions{{
    {{{1.3525, -0.2576, -0.269, -1.4366},
      {-0.767, 0.0007, 1.2734, -0.1233},
      {2.8, 0.6004, 1.2375, 1.0},
      {1.8734, 0.6297, 0.9738, 0.2809},
      {0.0356, -0.1246, -0.5718, 0.9938}}},
    {{{-1.2219, -0.773, 1.4148, 1.1016},
      {-0.2054, 0.0367, -3.9128, 0.9156},
      {6.975, 0.1774, 6.4477, -0.1239},
      {-1.5798, -0.5081, -1.7812, 0.108},
      {0.2624, 0.0672, -0.219, -0.4285}}},
    {{{-1.1, -0.2515, 0.8952, 0.0156},
      {0.2782, -0.1812, -4.5, 1.1766},
      {24.7219, -13.0812, -37.7, 34.8438},
      {-5.0, 1.5218, 3.9229, -2.6204},
      {-0.0156, 0.1597, 0.4199, -0.5562}}},
    {{{-0.5484, -0.6654, -0.2672, 0.7117},
      {0.7234, -0.6219, -5.6812, 2.6297},
      {33.3389, -18.3, -62.25, 52.0781},
      {-3.5, 0.0016, 1.1477, 0.1062},
      {0.4659, -0.3296, -0.0876, -0.0329}}},
    {{{-0.6, -0.3566, -2.5, 2.325},
      {0.2937, 0.0496, -5.6812, 1.8415},
      {21.0, -4.7656, -21.5906, 7.2492},
      {-3.5, -0.1554, 1.4062, 0.3988},
      {0.0032, 0.0766, -0.0656, -0.1294}}},
    {{{-1.0156, -0.367, 1.0078, 1.4051},
      {0.2875, -0.5328, -3.85, 3.375},
      {14.0, -0.9999, -7.1406, 7.5469},
      {-3.4, -0.1078, -1.075, 1.5702},
      {-0.0672, 0.4016, 0.3017, -0.4844}}},
    {{{-1.0, 0.0211, 0.5025, -0.5119},
      {-0.3, 0.1922, 0.7023, -1.6317},
      {19.0, -5.0, 1.2438, -1.9094},
      {-4.0, 0.025, 0.3844, 0.2656},
      {1.0468, -0.3788, -2.4517, 1.4656}}},
    {{{-1.05, 0.0289, 0.426, 0.359},
      {-0.325, 0.1156, 0.7781, 0.0025},
      {31.0625, -14.5, -46.1148, 55.375},
      {-7.2312, 0.405, 13.35, 0.6234},
      {1.5, -0.6426, 1.8564, 0.5636}}},
}};

/// a, b, c, d of diffuse and direct efficacy [Perez et al. 1990, table 4].
struct EfficacyRow {
  std::array<double, 4> diffuse;
  std::array<double, 4> direct;
};
constexpr std::array<EfficacyRow, kBins> kEfficacies{{
    {{97.24, -0.46, 12.0, -8.91}, {57.2, -4.55, -2.98, 117.12}},
    {{107.22, 1.15, 0.59, -3.95}, {98.99, -3.46, -1.21, 12.38}},
    {{104.97, 2.96, -5.53, -8.77}, {109.83, -4.9, -1.71, -8.81}},
    {{102.39, 5.59, -13.95, -13.9}, {110.34, -5.84, -1.99, -4.56}},
    {{100.71, 5.94, -22.75, -23.74}, {106.36, -3.97, -1.75, -6.16}},
    {{106.42, 3.83, -36.15, -28.83}, {107.19, -1.25, -1.51, -26.73}},
    {{141.88, 1.9, -53.24, -14.03}, {105.75, 0.77, -1.26, -34.44}},
    {{152.23, 0.35, -45.27, -7.98}, {101.18, 1.58, -1.1, -8.29}},
}};

/// Relative optical air mass [Kasten 1966].
double air_mass(double zenith_rad) {
  return 1.0 / (std::cos(zenith_rad) + 0.15 * std::pow(93.885 - zenith_rad * 180.0 / kPi, -1.253));
}

/// Squared mean distance of the sun over that of the day [Spencer 1971].
double eccentricity(int day_of_year) {
  const double t = 2.0 * kPi * (day_of_year - 1) / 365.0;
  return 1.00011 + 0.034221 * std::cos(t) + 0.00128 * std::sin(t) + 0.000719 * std::cos(2.0 * t) +
         0.000077 * std::sin(2.0 * t);
}

/// Water in the air above [cm].
double precipitable_water(double dew_point_c) { return std::exp(0.07 * dew_point_c - 0.075); }

}  // namespace

SkyClearness clearness_of(const Irradiance& irradiance, double sun_zenith_rad) {
  SkyClearness sky;
  sky.zenith_rad = std::clamp(sun_zenith_rad, 0.0, 0.5 * kPi);
  const double diffuse = irradiance.diffuse_horizontal_w_m2;
  const double k = 1.041 * std::pow(sky.zenith_rad, 3.0);
  if (diffuse > 0.0) sky.clearness = ((diffuse + irradiance.direct_normal_w_m2) / diffuse + k) / (1.0 + k);
  sky.brightness = std::max(
      kLeastBrightness, diffuse * air_mass(sky.zenith_rad) / (kSolarConstant * eccentricity(irradiance.day_of_year)));
  sky.bin = static_cast<int>(std::upper_bound(kBinEnds.begin(), kBinEnds.end(), sky.clearness) - kBinEnds.begin());
  return sky;
}

DaylightIlluminance illuminance_of(const Irradiance& irradiance, const SkyClearness& sky) {
  const auto& [diffuse, direct] = kEfficacies.at(static_cast<std::size_t>(sky.bin));
  const double water = precipitable_water(irradiance.dew_point_c);
  const double of_diffuse =
      diffuse[0] + diffuse[1] * water + diffuse[2] * std::cos(sky.zenith_rad) + diffuse[3] * std::log(sky.brightness);
  const double of_direct =
      direct[0] + direct[1] * water + direct[2] * std::exp(5.73 * sky.zenith_rad - 5.0) + direct[3] * sky.brightness;
  return {irradiance.diffuse_horizontal_w_m2 * std::max(0.0, of_diffuse),
          irradiance.direct_normal_w_m2 * std::max(0.0, of_direct)};
}

SkyDistribution perez_distribution(const SkyClearness& sky, const mesh::Vector& towards_sun) {
  const double z = sky.zenith_rad;
  const bool between = sky.clearness > 1.065 && sky.clearness < 2.8;
  const double delta = between ? std::max(0.2, sky.brightness) : sky.brightness;
  const DistributionRow& x = kDistributions.at(static_cast<std::size_t>(sky.bin));
  const auto value = [&](std::size_t i) { return x[i][0] + x[i][1] * z + delta * (x[i][2] + x[i][3] * z); };
  SkyDistribution result{value(0), value(1), value(2), value(3), value(4), 0.0, towards_sun};
  if (sky.bin == 0) {
    result.c = std::exp(std::pow(delta * (x[2][0] + x[2][1] * z), x[2][2])) - x[2][3];
    result.d = -std::exp(delta * (x[3][0] + x[3][1] * z)) + x[3][2] + delta * x[3][3];
  }
  return result;
}

Sky perez_sky(const Irradiance& irradiance, const mesh::Vector& towards_sun) {
  const double zenith = std::acos(std::clamp(towards_sun.z, -1.0, 1.0));
  const SkyClearness clearness = clearness_of(irradiance, zenith);
  const DaylightIlluminance light = illuminance_of(irradiance, clearness);
  mesh::Vector place = towards_sun;
  if (place.z < 0.0) place = normalized(mesh::Vector{place.x, place.y, 0.0});
  Sky sky = sky_of(perez_distribution(clearness, place), light.diffuse_horizontal_lux);
  sky.sun.towards = towards_sun;
  sky.sun.normal_illuminance_lux = light.direct_normal_lux;
  return sky;
}

}  // namespace clerestory::lighting
