// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/form_factor.h"

#include <cmath>
#include <numbers>

#include "lighting/arc_tangent.h"
#include "lighting/edge_pair.h"

namespace clerestory::lighting {

using mesh::OutlineEdge;
using mesh::Point;
using mesh::Vector;

namespace {

/// The angle between a and b times the component along n of the unit normal of their plane.
double lambert_term(const Vector& a, const Vector& b, const Vector& n) {
  const Vector c = cross(a, b);
  const double sine = norm(c);
  if (sine <= 0.0) return 0.0;
  return arc_tangent(sine, dot(a, b)) * (dot(c, n) / sine);
}

}  // namespace

double point_form_factor(const Point& point, const Vector& normal, std::span<const OutlineEdge> outline,
                         const Vector& outline_normal) {
  if (outline.empty()) return 0.0;
  const double height = dot(point - outline[0].from, outline_normal);
  if (height <= 0.0) return 0.0;

  double sum = 0.0;
  // The horizon cuts the polygon's plane in one line. Its part inside the polygon closes the clipped outline; the angles at
  // which edges cross it add up whatever the order of the edges.
  Vector line;
  bool crossed = false;
  double closing = 0.0;
  const auto close = [&](const Vector& crossing, double sign) {
    if (!crossed) line = normalized(cross(outline_normal, normal));
    crossed = true;
    const double along = dot(crossing, line);
    closing += sign * arc_tangent(along, norm(crossing - along * line));
  };
  for (const OutlineEdge& edge : outline) {
    Vector a = edge.from - point;
    Vector b = edge.to - point;
    const double ha = dot(a, normal);
    const double hb = dot(b, normal);
    if (ha <= 0.0 && hb <= 0.0) continue;
    if (ha < 0.0 || hb < 0.0) {
      const Vector crossing = a + (ha / (ha - hb)) * (b - a);
      close(crossing, ha < 0.0 ? 1.0 : -1.0);
      (ha < 0.0 ? a : b) = crossing;
    } else if (ha == 0.0 || hb == 0.0) {
      // A corner on the horizon: only the edge that comes from above or goes there crosses it.
      close(ha == 0.0 ? a : b, ha == 0.0 ? 1.0 : -1.0);
    }
    sum += lambert_term(a, b, normal);
  }
  // Seen from the emitting side the outline runs counter-clockwise, and the point looks the other way: the sign turns. The closing
  // edges lie in the horizon, so that their planes' normal is the receiver's, up or down with the direction along the line.
  if (crossed) {
    const Vector towards = -height * outline_normal;
    sum += dot(cross(towards, line), normal) >= 0.0 ? closing : -closing;
  }
  return std::max(0.0, -sum / (2.0 * std::numbers::pi));
}

double exchange_area(std::span<const OutlineEdge> receiver, std::span<const OutlineEdge> source) {
  double sum = 0.0;
  for (const OutlineEdge& p : receiver) {
    for (const OutlineEdge& q : source) sum += edge_pair_integral(p, q);
  }
  return std::max(0.0, sum / (2.0 * std::numbers::pi));
}

}  // namespace clerestory::lighting
