// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/geometry.h"

namespace clerestory::mesh {

/// An affine map p -> origin + p.x x + p.y y + p.z z: a placement, with scale, shear or mirror where its axes have them.
struct Affine {
  Vector x{1.0, 0.0, 0.0};
  Vector y{0.0, 1.0, 0.0};
  Vector z{0.0, 0.0, 1.0};
  Point origin;

  [[nodiscard]] Vector turn(const Vector& v) const { return v.x * x + v.y * y + v.z * z; }
  [[nodiscard]] Point operator()(const Point& p) const { return origin + turn(p - Point{}); }
  /// Negative where the map mirrors, 0 where it has no inverse.
  [[nodiscard]] double determinant() const { return dot(x, cross(y, z)); }
};

/// First `inner`, then `outer`.
inline Affine operator*(const Affine& outer, const Affine& inner) {
  return {outer.turn(inner.x), outer.turn(inner.y), outer.turn(inner.z), outer(inner.origin)};
}

/// The map back. The determinant must not be 0.
inline Affine inverse(const Affine& map) {
  const double scale = 1.0 / map.determinant();
  const Vector a = scale * cross(map.y, map.z);
  const Vector b = scale * cross(map.z, map.x);
  const Vector c = scale * cross(map.x, map.y);
  Affine back{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}, {}};
  back.origin = Point{} - back.turn(map.origin - Point{});
  return back;
}

}  // namespace clerestory::mesh
