// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/form_factor.h"

#include <array>
#include <cmath>
#include <numbers>

#include "lighting/arc_tangent.h"

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

  // The horizon cuts the polygon's plane in one line. Its part inside the polygon closes the clipped outline; the angles at
  // which edges cross it add up whatever the order of the edges.
  const Vector line = normalized(cross(outline_normal, normal));
  double sum = 0.0;
  double closing = 0.0;
  for (const OutlineEdge& edge : outline) {
    Vector a = edge.from - point;
    Vector b = edge.to - point;
    const double ha = dot(a, normal);
    const double hb = dot(b, normal);
    if (ha <= 0.0 && hb <= 0.0) continue;
    if (ha < 0.0 || hb < 0.0) {
      const Vector crossing = a + (ha / (ha - hb)) * (b - a);
      const double along = dot(crossing, line);
      const double across = norm(crossing - along * line);
      const double angle = arc_tangent(along, across);
      closing += ha < 0.0 ? angle : -angle;
      (ha < 0.0 ? a : b) = crossing;
    } else if (ha == 0.0 || hb == 0.0) {
      // A corner on the horizon: only the edge that comes from above or goes there crosses it.
      const Vector& corner = ha == 0.0 ? a : b;
      const double along = dot(corner, line);
      const double angle = arc_tangent(along, norm(corner - along * line));
      closing += ha == 0.0 ? angle : -angle;
    }
    sum += lambert_term(a, b, normal);
  }
  // Seen from the emitting side the outline runs counter-clockwise, and the point looks the other way: the sign turns. The closing
  // edges lie in the horizon, so that their planes' normal is the receiver's, up or down with the direction along the line.
  const Vector towards = -height * outline_normal;
  const double turn = dot(cross(towards, line), normal) >= 0.0 ? 1.0 : -1.0;
  const double factor = -(sum + turn * closing) / (2.0 * std::numbers::pi);
  return std::max(0.0, factor);
}

namespace {

struct GaussRule {
  std::array<double, 8> x;
  std::array<double, 8> w;
  std::size_t n;
};

// Gauss-Legendre nodes and weights on [0, 1]. Source: Abramowitz, Stegun, table 25.4.
constexpr GaussRule kFour{{0.06943184420297371, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629},
                          {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693},
                          4};
constexpr GaussRule kEight{{0.01985507175123188, 0.10166676129318664, 0.23723379504183550, 0.40828267875217510,
                            0.59171732124782490, 0.76276620495816450, 0.89833323870681336, 0.98014492824876812},
                           {0.05061426814518813, 0.11119051722668724, 0.15685332293894364, 0.18134189168918099,
                            0.18134189168918099, 0.15685332293894364, 0.11119051722668724, 0.05061426814518813},
                           8};

/// ∫ ln(distance from q to a + t·direction) dt over the length of an edge.
double inner_integral(const Point& q, const Point& a, const Vector& direction, double length) {
  const Vector d = a - q;
  const double begin = dot(d, direction);
  const double end = begin + length;
  const double distance2 = std::max(0.0, dot(d, d) - begin * begin);
  const double distance = std::sqrt(distance2);
  const auto primitive = [&](double t) {
    const double r2 = t * t + distance2;
    if (r2 <= 0.0) return 0.0;
    return 0.5 * t * std::log(r2) - t + (distance > 0.0 ? distance * arc_tangent(t, distance) : 0.0);
  };
  return primitive(end) - primitive(begin);
}

/// Pieces of an edge that comes close to another: what changes over a tenth of a long edge is then seen.
constexpr int kClosePieces = 4;

double edge_pair(const OutlineEdge& p, const OutlineEdge& q) {
  const Vector ep = p.to - p.from;
  const Vector eq = q.to - q.from;
  const double lp = norm(ep);
  const double lq = norm(eq);
  if (lp <= 0.0 || lq <= 0.0) return 0.0;
  const double parallel = dot(ep, eq) / (lp * lq);
  if (std::abs(parallel) < 1e-14) return 0.0;

  const Point middle_p = midpoint(p.from, p.to);
  const Point middle_q = midpoint(q.from, q.to);
  const double gap = norm(middle_p - middle_q) - 0.5 * (lp + lq);
  const bool close = gap < 0.5 * std::min(lp, lq);
  const GaussRule& rule = close ? kEight : kFour;
  // The outer integral runs over the shorter edge.
  const OutlineEdge& outer = lp < lq ? p : q;
  const OutlineEdge& inner = lp < lq ? q : p;
  const Vector direction = (lp < lq ? eq : ep) / std::max(lp, lq);
  const int pieces = close ? kClosePieces : 1;
  double sum = 0.0;
  for (int piece = 0; piece < pieces; ++piece) {
    for (std::size_t i = 0; i < rule.n; ++i) {
      // Graded: x = s³(10 − 15 s + 6 s²) takes the logarithm's edge off at both ends.
      const double s = rule.x[i];
      const double x = (piece + (close ? s * s * s * (10.0 - 15.0 * s + 6.0 * s * s) : s)) / pieces;
      const double weight = (close ? rule.w[i] * 30.0 * s * s * (1.0 - s) * (1.0 - s) : rule.w[i]) / pieces;
      sum += weight * inner_integral(outer.from + x * (outer.to - outer.from), inner.from, direction, std::max(lp, lq));
    }
  }
  return parallel * sum * std::min(lp, lq);
}

}  // namespace

double exchange_area(std::span<const OutlineEdge> receiver, std::span<const OutlineEdge> source) {
  double sum = 0.0;
  for (const OutlineEdge& p : receiver) {
    for (const OutlineEdge& q : source) sum += edge_pair(p, q);
  }
  return std::max(0.0, sum / (2.0 * std::numbers::pi));
}

}  // namespace clerestory::lighting
