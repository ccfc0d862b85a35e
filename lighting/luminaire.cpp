// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/luminaire.h"

#include <cmath>
#include <numbers>

namespace clerestory::lighting {

using mesh::Point;
using mesh::Vector;

double Luminaire::intensity_cd(const Vector& direction) const { return factor * web->intensity_cd(to_own(direction)); }

Point Luminaire::place(const Vector& own) const { return at + own.x * axes.u + own.y * axes.v + own.z * axes.w; }

Vector Luminaire::to_own(const Vector& v) const { return {dot(v, axes.u), dot(v, axes.v), dot(v, axes.w)}; }

mesh::Frame luminaire_axes(const Vector& aim, double rotate_deg) {
  const Vector w = -normalized(aim);
  const bool along_x = std::abs(w.x) > 1.0 - 1e-9;
  const Vector towards = along_x ? Vector{0.0, 0.0, 1.0} : Vector{1.0, 0.0, 0.0};
  const Vector u = normalized(towards - dot(towards, w) * w);
  const Vector v = cross(w, u);
  const double angle = rotate_deg * std::numbers::pi / 180.0;
  const Vector turned = std::cos(angle) * u + std::sin(angle) * v;
  return {turned, cross(w, turned), w};
}

}  // namespace clerestory::lighting
