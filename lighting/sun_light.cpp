// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sun_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lighting/light_paths.h"
#include "lighting/sampling.h"

namespace clerestory::lighting {

using mesh::Point;
using mesh::Vector;

namespace {

/// Panes that are turned by less mirror the sun to one place [1 - cosine], and a mirrored ray that leads so near to the sun leads there.
constexpr double kParallel = 1e-10;
constexpr std::uint32_t kPlacesOfDisc = 64;

/// The share of a ray's light that comes from the sun.
struct SunSeeker {
  Vector towards;
  double share = 0.0;

  void surface(const SurfacePoint&, float, bool) {}
  void sky(const Vector& direction, float weight, bool) {
    if (dot(direction, towards) > 1.0 - kParallel) share += weight;
  }
};

/// What passes from the sun to a point that it reaches from this direction.
double share_from(const Scene& scene, const Point& at, const Vector& direction, const Vector& towards, bool mirrors) {
  SunSeeker seeker{towards};
  follow(scene, at, direction, 1.0F, PathRule{PathRule::Part::kAll, -1, mirrors}, seeker);
  return seeker.share;
}

double whole_illuminance(const Scene& scene, const Sun& sun, const Point& at, const Receiver& receiver) {
  if (!sun.shines()) return 0.0;
  if (!sun.disc) return sun_illuminance(scene, sun, at, receiver, sun.towards);
  static const SobolPoints kNumbers(0x50F);
  double sum = 0.0;
  for (std::uint32_t i = 0; i < kPlacesOfDisc; ++i)
    sum += sun_illuminance(scene, sun, at, receiver, sun_direction(sun, kNumbers.at(i, 0), kNumbers.at(i, 1)));
  return sum / kPlacesOfDisc;
}

}  // namespace

Vector sun_direction(const Sun& sun, double a, double b) {
  if (!sun.disc) return sun.towards;
  const double rim = std::cos(0.5 * kSunDiameterDeg * std::numbers::pi / 180.0);
  const double cosine = 1.0 - a * (1.0 - rim);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double around = 2.0 * std::numbers::pi * b;
  const mesh::Frame frame = mesh::frame_around(sun.towards);
  return normalized(cosine * frame.w + sine * std::cos(around) * frame.u + sine * std::sin(around) * frame.v);
}

std::vector<Vector> pane_normals(const Scene& scene) {
  std::vector<Vector> normals;
  for (std::size_t f = 0; f < scene.faces.count(); ++f) {
    if (scene.glazing_of[f] < 0) continue;
    const Vector& w = scene.faces.faces[f].frame.w;
    const bool known = std::any_of(normals.begin(), normals.end(),
                                   [&](const Vector& n) { return std::abs(dot(n, w)) > 1.0 - kParallel; });
    if (!known) normals.push_back(w);
  }
  return normals;
}

double sun_illuminance(const Scene& scene, const Sun& sun, const Point& at, const Receiver& receiver,
                       const Vector& towards) {
  if (!sun.shines()) return 0.0;
  double sum = 0.0;
  const double straight = receiver.kernel(towards);
  if (straight > 0.0) sum += straight * share_from(scene, at, towards, towards, false);
  for (const Vector& w : scene.pane_normals) {
    const Vector image = towards - 2.0 * dot(towards, w) * w;
    const double cosine = receiver.kernel(image);
    if (cosine > 0.0) sum += cosine * share_from(scene, at, image, towards, true);
  }
  return sun.normal_illuminance_lux * sum;
}

double sun_illuminance(const Scene& scene, const Point& at, const Receiver& receiver) {
  double sum = 0.0;
  scene.sky.for_suns([&](const Sun& sun) { sum += whole_illuminance(scene, sun, at, receiver); });
  return sum;
}

}  // namespace clerestory::lighting
