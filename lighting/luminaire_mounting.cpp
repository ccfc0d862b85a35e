// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/luminaire_mounting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace clerestory::lighting {

using mesh::Point;
using mesh::Vector;

namespace {

/// A ceiling that a luminaire is flush with may slope by so much against it: the cosine of 2.6 degrees.
constexpr double kParallel = 0.999;
constexpr int kLooks = 256;     ///< directions in which a luminaire's surroundings are looked at
constexpr double kNearM = 0.4;  ///< from the middle of a wall so thick, half of all directions end within its thickness
constexpr double kShareNear = 0.5;
constexpr double kLongM = 1.0;          ///< a solid that is no longer than this is a shade about its lamp
constexpr double kShareOfBacks = 0.98;  ///< of hits; edges may show a front

/// Half of the height of a luminaire's box, enlarged.
double half_box(const Luminaire& luminaire) { return 0.5 * luminaire.opening.z_m + kHousingM; }

/// What is met around a luminaire.
struct Looks {
  int count = 0;
  int near = 0;
  int far = 0;
  int backs = 0;

  void add(const mesh::Hit& hit) {
    ++count;
    near += hit.distance < kNearM ? 1 : 0;
    far += hit.distance > kLongM ? 1 : 0;
    backs += hit.side == mesh::Side::kBack ? 1 : 0;
  }
  [[nodiscard]] bool look_solid() const { return near >= kShareNear * count && backs >= kShareOfBacks * count; }
};

/// Directions spread evenly over the sphere [Fibonacci lattice].
Vector spread(int k) {
  const double z = 1.0 - (2.0 * k + 1.0) / kLooks;
  const double turn = 2.0 * std::numbers::pi * k / std::numbers::phi;
  const double across = std::sqrt(1.0 - z * z);
  return {across * std::cos(turn), across * std::sin(turn), z};
}

}  // namespace

std::vector<mesh::FaceId> flush_faces(const Scene& scene, const Luminaire& luminaire) {
  std::vector<mesh::FaceId> found;
  const Vector& w = luminaire.axes.w;
  const double reach = 2.0 * half_box(luminaire);
  for (const auto& [x, y] : {std::array{0.0, 0.0}, {-0.49, -0.49}, {-0.49, 0.49}, {0.49, -0.49}, {0.49, 0.49}}) {
    const Vector own{x * luminaire.opening.x_m, y * luminaire.opening.y_m, -half_box(luminaire)};
    const Point start = luminaire.place(own);
    for (double done = 0.0; done < reach;) {
      const mesh::Hit hit = scene.rays->first_hit({start + done * w, w});
      if (!hit.face.valid() || done + hit.distance > reach) break;
      const bool across = std::abs(dot(scene.faces.faces[hit.face.index()].frame.w, w)) > kParallel;
      if (across && scene.passable[hit.face.index()] == 0) found.push_back(hit.face);
      done += hit.distance + scene.rays->offset_m();
    }
  }
  std::sort(found.begin(), found.end(), [](mesh::FaceId a, mesh::FaceId b) { return a.index() < b.index(); });
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

Point light_start(const Luminaire& luminaire, const std::vector<mesh::FaceId>& flush) {
  const bool free = flush.empty() && luminaire.opening.shape == LuminousOpening::Shape::kPoint;
  return free ? luminaire.at : luminaire.at - (half_box(luminaire) + 1e-3) * luminaire.axes.w;
}

bool is_walled_in(const Scene& scene, const Luminaire& luminaire, const std::vector<mesh::FaceId>& flush) {
  constexpr double kDim = 0.01;  // of the peak: where a luminaire does not shine
  const Point start = light_start(luminaire, flush);
  Looks all;
  Looks lit;  // a lamp that hugs a corner has much near it, but not where it shines
  for (int k = 0; k < kLooks; ++k) {
    const Vector d = spread(k);
    const mesh::Hit hit = scene.rays->first_hit({start, d});
    if (!hit.face.valid() || scene.passable[hit.face.index()] != 0) return false;
    all.add(hit);
    if (luminaire.intensity_cd(d) > kDim * luminaire.peak_cd()) lit.add(hit);
  }
  return all.far > 0 && all.look_solid() && lit.look_solid();
}

}  // namespace clerestory::lighting
