// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace clerestory::mesh {

/// A displacement or direction [m, or no unit when normalised].
struct Vector {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

/// A place [m].
struct Point {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  constexpr bool operator==(const Point&) const = default;
};

constexpr Vector operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Point operator+(const Point& p, const Vector& v) { return {p.x + v.x, p.y + v.y, p.z + v.z}; }
constexpr Point operator-(const Point& p, const Vector& v) { return {p.x - v.x, p.y - v.y, p.z - v.z}; }
constexpr Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vector operator-(const Vector& v) { return {-v.x, -v.y, -v.z}; }
constexpr Vector operator*(double s, const Vector& v) { return {s * v.x, s * v.y, s * v.z}; }
constexpr Vector operator/(const Vector& v, double s) { return {v.x / s, v.y / s, v.z / s}; }

constexpr double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vector& v) { return std::sqrt(dot(v, v)); }

/// v scaled to length 1; the zero vector stays zero.
inline Vector normalized(const Vector& v) {
  const double length = norm(v);
  return length > 0.0 ? v / length : v;
}

constexpr Point midpoint(const Point& a, const Point& b) {
  return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.z + b.z)};
}

inline bool is_finite(const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Right-handed orthonormal axes; w is the normal where the frame belongs to a plane.
struct Frame {
  Vector u;
  Vector v;
  Vector w;
};

/// A frame whose w is the given unit vector.
/// Source: Duff et al., Building an Orthonormal Basis, Revisited, JCGT 2017.
inline Frame frame_around(const Vector& w) {
  const double sign = std::copysign(1.0, w.z);
  const double a = -1.0 / (sign + w.z);
  const double b = w.x * w.y * a;
  return {{1.0 + sign * w.x * w.x * a, sign * b, -sign * w.x}, {b, sign + w.y * w.y * a, -w.y}, w};
}

/// An axis-aligned box; empty until a point is added.
struct Box {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool empty() const { return low.x > high.x; }
  [[nodiscard]] Vector size() const { return empty() ? Vector{} : high - low; }
  [[nodiscard]] Point centre() const { return midpoint(low, high); }
  [[nodiscard]] double diagonal() const { return norm(size()); }
  void add(const Point& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  void add(const Box& b) {
    if (!b.empty()) {
      add(b.low);
      add(b.high);
    }
  }
};

/// Whether one box reaches into the other: those that only touch do not. A flat box reaches into what it divides, but not into what
/// has a face in its plane.
constexpr bool interiors_overlap(const Box& a, const Box& b) {
  return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y && a.low.z < b.high.z &&
         b.low.z < a.high.z;
}

}  // namespace clerestory::mesh
