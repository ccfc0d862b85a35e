// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sky_distribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace clerestory::lighting {

using mesh::Vector;

namespace {

constexpr double kPi = std::numbers::pi;
/// Sine of 6°, where the lowest row of a sky scanner looks: where a gradation grows without bounds towards the horizon (b > 0, in some of
/// Perez's dark skies), it stays from here on as it is.
constexpr double kLowestMeasured = 0.104528463267653;

struct Coefficients {
  double a, b, c, d, e;
};

/// ISO 15469:2004, table 1.
constexpr std::array<Coefficients, 15> kGeneralSkies{{{4.0, -0.70, 0.0, -1.0, 0.00},
                                                      {4.0, -0.70, 2.0, -1.5, 0.15},
                                                      {1.1, -0.80, 0.0, -1.0, 0.00},
                                                      {1.1, -0.80, 2.0, -1.5, 0.15},
                                                      {0.0, -1.00, 0.0, -1.0, 0.00},
                                                      {0.0, -1.00, 2.0, -1.5, 0.15},
                                                      {0.0, -1.00, 5.0, -2.5, 0.30},
                                                      {0.0, -1.00, 10.0, -3.0, 0.45},
                                                      {-1.0, -0.55, 2.0, -1.5, 0.15},
                                                      {-1.0, -0.55, 5.0, -2.5, 0.30},
                                                      {-1.0, -0.55, 10.0, -3.0, 0.45},
                                                      {-1.0, -0.32, 10.0, -3.0, 0.45},
                                                      {-1.0, -0.32, 16.0, -3.0, 0.30},
                                                      {-1.0, -0.15, 16.0, -3.0, 0.30},
                                                      {-1.0, -0.15, 24.0, -2.8, 0.15}}};

/// At an altitude of this sine.
double gradation(const SkyDistribution& sky, double sine) {
  if (sky.a == 0.0) return 1.0;
  if (sky.b > 0.0) return 1.0 + sky.a * std::exp(sky.b / std::max(sine, kLowestMeasured));
  return sine > 0.0 ? 1.0 + sky.a * std::exp(sky.b / sine) : 1.0;
}

/// At this angle from the sun, of which the cosine is given.
double indicatrix(const SkyDistribution& sky, double cosine) {
  if (sky.c == 0.0 && sky.e == 0.0) return 1.0;
  const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
  return 1.0 + sky.c * (std::exp(sky.d * angle) - sky.k) + sky.e * cosine * cosine;
}

struct Node {
  double at = 0.0;
  double weight = 0.0;
};

/// Points and weights of Gauss and Legendre on [0, 1], by Newton's method on the polynomial's recurrence.
std::vector<Node> gauss_nodes(int count) {
  std::vector<Node> nodes;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(kPi * (i + 0.75) / (count + 0.5));
    double slope = 1.0;
    for (int step = 0; step < 8; ++step) {
      double before = 1.0;
      double p = x;
      for (int n = 2; n <= count; ++n) {
        const double next = ((2.0 * n - 1.0) * x * p - (n - 1.0) * before) / n;
        before = p;
        p = next;
      }
      slope = count * (x * p - before) / (x * x - 1.0);
      x -= p / slope;
    }
    nodes.push_back({0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope)});
  }
  return nodes;
}

}  // namespace

SkyDistribution cie_general_sky(int type, const Vector& towards_sun) {
  const Coefficients& row = kGeneralSkies.at(static_cast<std::size_t>(type - 1));
  return {row.a, row.b, row.c, row.d, row.e, std::exp(0.5 * kPi * row.d), towards_sun};
}

double relative_luminance(const SkyDistribution& sky, const Vector& direction) {
  return std::max(0.0, gradation(sky, direction.z)) * std::max(0.0, indicatrix(sky, dot(direction, sky.towards_sun)));
}

double relative_luminance_bound(const SkyDistribution& sky) {
  // The gradation runs one way from horizon to zenith; the exponential is largest at either end.
  const double largest = std::max({gradation(sky, 0.0), gradation(sky, 1.0), 0.0});
  const double near = sky.c * (1.0 - sky.k);
  const double far = sky.c * (std::exp(sky.d * kPi) - sky.k);
  return largest * std::max(0.0, 1.0 + std::max(near, far) + std::max(0.0, sky.e));
}

double relative_horizontal_illuminance(const SkyDistribution& sky) {
  // The indicatrix has a tip at the sun: points draw together there (t² in both angles), in altitude from both sides.
  constexpr int kNodes = 64;
  static const std::vector<Node> kGauss = gauss_nodes(kNodes);
  const double sun = std::clamp(std::asin(std::clamp(sky.towards_sun.z, -1.0, 1.0)), 0.0, 0.5 * kPi);
  const double sun_cosine = std::hypot(sky.towards_sun.x, sky.towards_sun.y);
  double sum = 0.0;
  for (const double end : {0.0, 0.5 * kPi}) {
    const double range = end - sun;
    for (const Node& up : kGauss) {
      const double altitude = sun + range * up.at * up.at;
      const double sine = std::sin(altitude);
      const double cosine = std::cos(altitude);
      double ring = 0.0;
      for (const Node& round : kGauss) {
        const double azimuth = kPi * round.at * round.at;
        const double from_sun = sine * sky.towards_sun.z + cosine * sun_cosine * std::cos(azimuth);
        ring += round.weight * 2.0 * kPi * round.at * std::max(0.0, indicatrix(sky, from_sun));
      }
      sum +=
          up.weight * 2.0 * up.at * std::abs(range) * 2.0 * ring * std::max(0.0, gradation(sky, sine)) * sine * cosine;
    }
  }
  return sum;
}

}  // namespace clerestory::lighting
