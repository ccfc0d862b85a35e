// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/regions.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "mesh/hash.h"

namespace clerestory::mesh {

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

double triangle_area(const std::array<Point, 3>& c) { return 0.5 * norm(cross(c[1] - c[0], c[2] - c[0])); }

/// Regions of one face in the order of their numbers, and of labels within.
void number_face(const Faces& faces, FaceId face, std::span<const std::uint32_t> labels, Regions& regions) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> number;
  const std::uint32_t begin = faces.shape.starts[face.index()];
  const std::uint32_t end = faces.shape.starts[face.index() + 1];
  const auto key = [&](std::uint32_t t) {
    return std::pair(faces.shape.triangles[t].region, labels.empty() ? 0U : labels[t]);
  };
  for (std::uint32_t t = begin; t < end; ++t) number[key(t)] = 0;
  auto next = static_cast<std::uint32_t>(regions.count());
  for (auto& [region, n] : number) n = next++;
  regions.face.resize(next, face);
  for (std::uint32_t t = begin; t < end; ++t) regions.of_triangle.push_back(number[key(t)]);
}

void group_triangles(Regions& regions) {
  regions.starts.assign(regions.count() + 1, 0);
  for (const std::uint32_t r : regions.of_triangle) ++regions.starts[r + 1];
  std::partial_sum(regions.starts.begin(), regions.starts.end(), regions.starts.begin());
  regions.triangles.resize(regions.of_triangle.size());
  std::vector<std::uint32_t> next(regions.starts.begin(), regions.starts.end() - 1);
  for (std::uint32_t t = 0; t < regions.of_triangle.size(); ++t) regions.triangles[next[regions.of_triangle[t]]++] = t;
}

void measure(const Faces& faces, Regions& regions) {
  std::vector<double> perimeter(regions.count(), 0.0);
  regions.area_m2.assign(regions.count(), 0.0);
  for (std::uint32_t t = 0; t < regions.of_triangle.size(); ++t) {
    const std::uint32_t r = regions.of_triangle[t];
    const auto c = corners(faces, t);
    regions.area_m2[r] += triangle_area(c);
    for (std::size_t k = 0; k < 3; ++k) {
      if ((faces.shape.triangles[t].constrained >> k & 1) != 0) perimeter[r] += norm(c[(k + 1) % 3] - c[k]);
    }
  }
  regions.width_m.resize(regions.count());
  for (std::size_t r = 0; r < regions.count(); ++r) {
    regions.width_m[r] = perimeter[r] > 0.0 ? 2.0 * regions.area_m2[r] / perimeter[r] : std::sqrt(regions.area_m2[r]);
  }
}

}  // namespace

Regions number_regions(const Faces& faces, std::span<const std::uint32_t> labels) {
  assert(labels.empty() || labels.size() == faces.shape.triangles.size());
  Regions regions;
  regions.of_triangle.reserve(faces.shape.triangles.size());
  for (std::size_t f = 0; f < faces.count(); ++f) number_face(faces, FaceId(f), labels, regions);
  group_triangles(regions);
  measure(faces, regions);
  return regions;
}

std::array<Point, 3> corners(const Faces& faces, std::uint32_t triangle) {
  const auto& v = faces.shape.triangles[triangle].vertices;
  return {faces.shape.vertices[v[0]], faces.shape.vertices[v[1]], faces.shape.vertices[v[2]]};
}

Vector side_normal(const Faces& faces, FaceId face, Side side) {
  const Vector& w = faces.faces[face.index()].frame.w;
  return side == Side::kFront ? w : -w;
}

double spread(std::uint32_t i, std::uint32_t dimension, std::uint64_t seed) {
  constexpr double kRatio = 1.1347241384015194;  // the positive root of x^6 = x + 1
  static const auto kSteps = [] {
    std::array<double, 5> steps{};
    double power = 1.0;
    for (double& step : steps) step = (power /= kRatio);
    return steps;
  }();
  const double start = static_cast<double>(hash(seed, dimension) >> 11U) * 0x1p-53;
  const double x = start + (static_cast<double>(i) + 1.0) * kSteps[dimension];
  return x - std::floor(x);
}

RegionPoints::RegionPoints(const Faces& faces, const Regions& regions, std::size_t region)
    : faces_(faces), triangles_(regions.of(region)), seed_(hash(0x5EED, region)) {
  double sum = 0.0;
  for (const std::uint32_t t : triangles_) area_up_to_.push_back(sum += triangle_area(corners(faces, t)));
}

Point RegionPoints::at(std::uint32_t i) const {
  constexpr double kInside = 0.99;  // towards the centroid: a point on an edge might belong to either side of a contact
  const double wanted = spread(i, 0, seed_) * area_up_to_.back();
  const auto found = std::upper_bound(area_up_to_.begin(), area_up_to_.end() - 1, wanted);
  const auto c = corners(faces_, triangles_[static_cast<std::size_t>(found - area_up_to_.begin())]);
  const double root = std::sqrt(spread(i, 1, seed_));
  const double b1 = kInside * (1.0 - root) + (1.0 - kInside) / 3.0;
  const double b2 = kInside * root * spread(i, 2, seed_) + (1.0 - kInside) / 3.0;
  return c[0] + b1 * (c[1] - c[0]) + b2 * (c[2] - c[0]);
}

Vector cosine_direction(const Frame& frame, double a, double b) {
  const double radius = std::sqrt(a);
  const double angle = kTwoPi * b;
  return radius * std::cos(angle) * frame.u + radius * std::sin(angle) * frame.v +
         std::sqrt(std::max(0.0, 1.0 - a)) * frame.w;
}

Vector sphere_direction(double a, double b) {
  const double z = 1.0 - 2.0 * a;
  const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {radius * std::cos(kTwoPi * b), radius * std::sin(kTwoPi * b), z};
}

}  // namespace clerestory::mesh
