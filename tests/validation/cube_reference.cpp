// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/validation/cube_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "mesh/geometry.h"

namespace clerestory::test {

using mesh::Point;
using mesh::Vector;
using std::numbers::pi;

namespace {

constexpr int kPatches = 40;  ///< along an edge
constexpr double kPatch_m = kCubeSide_m / kPatches;

/// Form factor from a point with normal +z to a rectangle that lies nowhere below its horizon [Lambert 1760], the rectangle
/// clockwise as the point sees it.
double point_to_rectangle(const Point& at, const std::array<Point, 4>& corners) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector a = corners[k] - at;
    const Vector b = corners[(k + 1) % 4] - at;
    const Vector c = cross(a, b);
    const double length = norm(c);
    if (length > 1e-14) sum += std::atan2(length, dot(a, b)) * c.z / length;
  }
  return std::abs(sum) / (2.0 * pi);
}

/// The patch with its low corner at (u, v) of the opposite face, or of the face at x = 0 (v is its height).
std::array<Point, 4> opposite_patch(double u, double v) {
  const double z = kCubeSide_m;
  return {{{u, v, z}, {u + kPatch_m, v, z}, {u + kPatch_m, v + kPatch_m, z}, {u, v + kPatch_m, z}}};
}
std::array<Point, 4> side_patch(double u, double v) {
  return {{{0, u, v}, {0, u + kPatch_m, v}, {0, u + kPatch_m, v + kPatch_m}, {0, u, v + kPatch_m}}};
}

double centre(int i) { return (i + 0.5) * kPatch_m; }
std::size_t patch(int i, int j) { return static_cast<std::size_t>(j * kPatches + i); }

/// Mean direct illuminance of a patch, from the solid angle that it fills as the source sees it.
double mean_direct(int i, int j) {
  const double h = 0.5 * kCubeSide_m;
  const auto corner = [h](int a, int b) {  // solid angle from the foot of the source to a grid point
    const double x = a * kPatch_m - h;
    const double y = b * kPatch_m - h;
    return std::atan2(x * y, h * std::sqrt(x * x + y * y + h * h));
  };
  const double solid_angle = corner(i + 1, j + 1) - corner(i, j + 1) - corner(i + 1, j) + corner(i, j);
  return kCubeFlux_lm / (4.0 * pi) * solid_angle / (kPatch_m * kPatch_m);
}

/// By patch of a face, the form factor from a point of the floor to that patch of all five other faces together.
std::vector<double> factors(double x_m, double y_m) {
  const double s = kCubeSide_m;
  // The four side faces are one face seen from four places.
  const std::array<Point, 4> places{{{x_m, y_m, 0}, {s - x_m, y_m, 0}, {y_m, x_m, 0}, {s - y_m, x_m, 0}}};
  std::vector<double> result;
  for (int j = 0; j < kPatches; ++j) {
    for (int i = 0; i < kPatches; ++i) {
      double sum = point_to_rectangle(places[0], opposite_patch(i * kPatch_m, j * kPatch_m));
      for (const Point& place : places) sum += point_to_rectangle(place, side_patch(i * kPatch_m, j * kPatch_m));
      result.push_back(sum);
    }
  }
  return result;
}

double dot_product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// The eight patches of a face that symmetry makes equal.
struct Orbit {
  int i, j;
  double direct;
  std::vector<double> factors;
};

}  // namespace

double cube_direct(double x_m, double y_m) {
  const double h = 0.5 * kCubeSide_m;
  const double r2 = (x_m - h) * (x_m - h) + (y_m - h) * (y_m - h) + h * h;
  return kCubeFlux_lm / (4.0 * pi) * h / (r2 * std::sqrt(r2));
}

double cube_mean_indirect(double reflectance) {
  return kCubeFlux_lm * reflectance / (6.0 * kCubeSide_m * kCubeSide_m * (1.0 - reflectance));
}

CubeReference::CubeReference(double reflectance) : reflectance_(reflectance) {
  std::vector<Orbit> orbits;
  for (int j = 0; j < kPatches / 2; ++j)
    for (int i = 0; i <= j; ++i) orbits.push_back({i, j, mean_direct(i, j), factors(centre(i), centre(j))});

  illuminance_.assign(std::size_t{kPatches} * kPatches, cube_mean_indirect(reflectance));
  for (double change = 1.0; change > 1e-8;) {
    std::vector<double> next(illuminance_.size());
    change = 0.0;
    for (const Orbit& orbit : orbits) {
      const double value = orbit.direct + reflectance_ * dot_product(orbit.factors, illuminance_);
      change = std::max(change, std::abs(value - illuminance_[patch(orbit.i, orbit.j)]) / value);
      for (const auto& [a, b] : {std::pair{orbit.i, orbit.j}, std::pair{orbit.j, orbit.i}})
        for (const int c : {a, kPatches - 1 - a})
          for (const int d : {b, kPatches - 1 - b}) next[patch(c, d)] = value;
    }
    illuminance_ = std::move(next);
  }
}

double CubeReference::illuminance(double x_m, double y_m) const {
  return cube_direct(x_m, y_m) + reflectance_ * dot_product(factors(x_m, y_m), illuminance_);
}

}  // namespace clerestory::test
