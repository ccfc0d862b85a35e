// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clerestory::io {

namespace {

using mesh::Point;
using mesh::Vector;

constexpr std::size_t kFewestPieces = 8;
constexpr std::size_t kMostPieces = 128;

Point point_at(const std::vector<double>& reals, std::size_t at) { return {reals[at], reals[at + 1], reals[at + 2]}; }

/// Of two opposite directions the same one, so that circles drawn from either end of an axis have the same corners.
Vector either_way(const Vector& v) {
  const bool opposite = v.x < 0.0 || (v.x == 0.0 && (v.y < 0.0 || (v.y == 0.0 && v.z < 0.0)));
  return opposite ? -v : v;
}

/// A polygon about a circle that is as long as the circle.
class Circle {
 public:
  Circle(const Vector& axis, std::size_t pieces) : frame_(mesh::frame_around(either_way(axis))), pieces_(pieces) {
    const double half = std::numbers::pi / static_cast<double>(pieces);
    stretch_ = half / std::sin(half);
    along_ = mesh::dot(frame_.w, axis) > 0.0;
  }

  [[nodiscard]] std::size_t pieces() const { return pieces_; }
  /// Whether corners run counter-clockwise about the axis that was given.
  [[nodiscard]] bool along() const { return along_; }

  /// Appends the corners, or one where the radius is zero; gives their indices.
  std::vector<std::uint32_t> add(const Point& centre, double radius, std::vector<Point>& points) const {
    std::vector<std::uint32_t> corners;
    const std::size_t count = radius > 0.0 ? pieces_ : 1;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(pieces_);
      const double r = stretch_ * radius;
      corners.push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back(centre + r * std::cos(angle) * frame_.u + r * std::sin(angle) * frame_.v);
    }
    return corners;
  }

 private:
  mesh::Frame frame_;
  std::size_t pieces_;
  double stretch_ = 1.0;
  bool along_ = true;
};

void flip(Shape& shape) {
  for (ShapePolygon& polygon : shape.polygons) {
    std::reverse(polygon.outer.begin(), polygon.outer.end());
    std::reverse(polygon.hole.begin(), polygon.hole.end());
  }
}

/// The band between two circles, each of which may be one point; fronts outside where corners run about the way from a to b.
void add_band(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b, Shape& shape) {
  const std::size_t pieces = std::max(a.size(), b.size());
  for (std::size_t i = 0; i < pieces; ++i) {
    const std::size_t j = (i + 1) % pieces;
    ShapePolygon piece;
    piece.outer.push_back(a[i % a.size()]);
    if (a.size() > 1) piece.outer.push_back(a[j]);
    piece.outer.push_back(b[j % b.size()]);
    if (b.size() > 1) piece.outer.push_back(b[i]);
    shape.polygons.push_back(std::move(piece));
  }
}

Shape polygon_shape(const std::vector<double>& reals) {
  Shape shape;
  if (reals.size() < 9 || reals.size() % 3 != 0) return shape;
  ShapePolygon polygon;
  for (std::size_t at = 0; at < reals.size(); at += 3) {
    polygon.outer.push_back(static_cast<std::uint32_t>(shape.points.size()));
    shape.points.push_back(point_at(reals, at));
  }
  shape.polygons.push_back(std::move(polygon));
  return shape;
}

Shape ring_shape(const std::vector<double>& reals, double scale) {
  Shape shape;
  if (reals.size() != 8) return shape;
  const Vector normal = mesh::normalized(point_at(reals, 3) - Point{});
  const double inner = std::min(std::abs(reals[6]), std::abs(reals[7]));
  const double outer = std::max(std::abs(reals[6]), std::abs(reals[7]));
  if (!(mesh::norm(normal) > 0.0) || !(outer > inner)) return shape;
  const Circle circle(normal, circle_pieces(scale * outer));
  ShapePolygon polygon;
  polygon.outer = circle.add(point_at(reals, 0), outer, shape.points);
  if (inner > 0.0) {
    polygon.hole = Circle(normal, circle_pieces(scale * inner)).add(point_at(reals, 0), inner, shape.points);
    std::reverse(polygon.hole.begin(), polygon.hole.end());
  }
  shape.polygons.push_back(std::move(polygon));
  if (!circle.along()) flip(shape);
  return shape;
}

/// Cones, cylinders, and their inverses.
Shape cone_shape(const Point& a, const Point& b, double radius_a, double radius_b, double scale) {
  Shape shape;
  const Vector axis = mesh::normalized(b - a);
  const double largest = std::max(std::abs(radius_a), std::abs(radius_b));
  if (!(mesh::norm(axis) > 0.0) || !(largest > 0.0)) return shape;
  const Circle circle(axis, circle_pieces(scale * largest));
  const auto first = circle.add(a, std::abs(radius_a), shape.points);
  const auto second = circle.add(b, std::abs(radius_b), shape.points);
  add_band(first, second, shape);
  // A radius below zero turns the surface inside out.
  const bool inside_out = radius_a + radius_b < 0.0;
  if (circle.along() == inside_out) flip(shape);
  return shape;
}

double area(const Shape& shape) {
  double sum = 0.0;
  for (const ShapePolygon& polygon : shape.polygons) {
    Vector twice;
    const Point& first = shape.points[polygon.outer[0]];
    for (std::size_t i = 1; i + 1 < polygon.outer.size(); ++i)
      twice = twice + mesh::cross(shape.points[polygon.outer[i]] - first, shape.points[polygon.outer[i + 1]] - first);
    sum += 0.5 * mesh::norm(twice);
  }
  return sum;
}

/// Meridians and parallels about z, with the area of the sphere.
Shape sphere_shape(const std::vector<double>& reals, double scale) {
  Shape shape;
  if (reals.size() != 4 || !(std::abs(reals[3]) > 0.0)) return shape;
  const Circle circle({0.0, 0.0, 1.0}, circle_pieces(scale * reals[3]));
  const std::size_t bands = circle.pieces() / 2;
  std::vector<std::uint32_t> below = circle.add({0.0, 0.0, -1.0}, 0.0, shape.points);
  for (std::size_t i = 1; i <= bands; ++i) {
    const double angle = std::numbers::pi * static_cast<double>(i) / static_cast<double>(bands);
    const double radius = i == bands ? 0.0 : std::sin(angle);
    auto above = circle.add({0.0, 0.0, -std::cos(angle)}, radius, shape.points);
    add_band(below, above, shape);
    below = std::move(above);
  }
  const double radius = std::abs(reals[3]) * std::sqrt(4.0 * std::numbers::pi / area(shape));
  for (Point& p : shape.points) p = point_at(reals, 0) + radius * (p - Point{});
  if (reals[3] < 0.0) flip(shape);
  return shape;
}

Shape outward_shape(const RadiancePrimitive& primitive, double scale) {
  const std::vector<double>& reals = primitive.reals;
  if (primitive.type == "polygon") return polygon_shape(reals);
  if (primitive.type == "ring") return ring_shape(reals, scale);
  if (primitive.type == "sphere" || primitive.type == "bubble") return sphere_shape(reals, scale);
  const bool straight = primitive.type == "cylinder" || primitive.type == "tube";
  if (reals.size() != (straight ? 7U : 8U)) return {};
  return cone_shape(point_at(reals, 0), point_at(reals, 3), reals[6], straight ? reals[6] : reals[7], scale);
}

}  // namespace

std::size_t circle_pieces(double radius) {
  const double chord = std::clamp(kChordOverRadius * std::abs(radius), kFinestChord, kCoarsestChord);
  const double share = chord / std::abs(radius);
  if (!(share < 1.0)) return kFewestPieces;
  const double pairs = std::ceil(0.5 * std::numbers::pi / std::acos(1.0 - share));
  return std::clamp(2 * static_cast<std::size_t>(std::min(pairs, 1e6)), kFewestPieces, kMostPieces);
}

Shape radiance_shape(const RadiancePrimitive& primitive, double scale) {
  Shape shape = outward_shape(primitive, std::abs(scale));
  if (primitive.type == "tube" || primitive.type == "cup" || primitive.type == "bubble") flip(shape);
  return shape;
}

}  // namespace clerestory::io
