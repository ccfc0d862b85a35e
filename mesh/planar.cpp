// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/planar.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clerestory::mesh {

namespace {

Box box_around(const Point2& a, const Point2& b) {
  Box box;
  box.add(Point{a.x, a.y, 0.0});
  box.add(Point{b.x, b.y, 0.0});
  return box;
}

std::vector<Box> boxes_of(std::span<const PlanarOutline::Segment> segments) {
  std::vector<Box> boxes;
  boxes.reserve(segments.size());
  for (const PlanarOutline::Segment& s : segments) boxes.push_back(box_around(s[0], s[1]));
  return boxes;
}

double distance_to_segment(const Point2& p, const PlanarOutline::Segment& s) {
  const double dx = s[1].x - s[0].x;
  const double dy = s[1].y - s[0].y;
  const double length_squared = dx * dx + dy * dy;
  double t = 0.0;
  if (length_squared > 0.0) {
    t = std::clamp(((p.x - s[0].x) * dx + (p.y - s[0].y) * dy) / length_squared, 0.0, 1.0);
  }
  return std::hypot(p.x - s[0].x - t * dx, p.y - s[0].y - t * dy);
}

}  // namespace

bool near_plane(const Box& box, const PlaneCoordinates& plane, double distance) {
  const Vector half = 0.5 * box.size();
  const Vector& w = plane.frame.w;
  const double reach = half.x * std::abs(w.x) + half.y * std::abs(w.y) + half.z * std::abs(w.z);
  return std::abs(plane.distance(box.centre())) <= reach + distance;
}

PlanarOutline::PlanarOutline(std::vector<Segment> segments)
    : segments_(std::move(segments)), tree_(boxes_of(segments_)) {}

// Crossings of the ray to +x, up counted as one, down as minus one [Sunday 2001]; half-open in y, so that vertices count once.
int PlanarOutline::winding(const Point2& p) const {
  int count = 0;
  tree_.visit([&](const Box& box) { return box.low.y <= p.y && box.high.y >= p.y && box.high.x >= p.x; },
              [&](std::uint32_t i) {
                const auto& [a, b] = segments_[i];
                if (a.y <= p.y && b.y > p.y && doubled_area(a, b, p) > 0.0) ++count;
                if (b.y <= p.y && a.y > p.y && doubled_area(a, b, p) < 0.0) --count;
              });
  return count;
}

bool PlanarOutline::near_boundary(const Point2& p, double distance) const {
  const Box around = grown(box_around(p, p), distance);
  bool near = false;
  tree_.visit([&](const Box& box) { return !near && overlap(around, box); },
              [&](std::uint32_t i) { near = near || distance_to_segment(p, segments_[i]) <= distance; });
  return near;
}

std::vector<double> PlanarOutline::crossings(const Point2& a, const Point2& b, double tolerance) const {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const double ux = (b.x - a.x) / length;
  const double uy = (b.y - a.y) / length;
  const auto side = [&](const Point2& p) { return ux * (p.y - a.y) - uy * (p.x - a.x); };
  const auto along = [&](const Point2& p) { return (ux * (p.x - a.x) + uy * (p.y - a.y)) / length; };
  std::vector<double> parameters{0.0, 1.0};
  const auto add = [&](double t) {
    if (t > 0.0 && t < 1.0) parameters.push_back(t);
  };
  const Box around = grown(box_around(a, b), tolerance);
  tree_.visit([&](const Box& box) { return overlap(around, box); },
              [&](std::uint32_t i) {
                const auto& [c, d] = segments_[i];
                const double sc = side(c);
                const double sd = side(d);
                const bool c_on = std::abs(sc) <= tolerance;
                const bool d_on = std::abs(sd) <= tolerance;
                if (c_on) add(along(c));
                if (d_on) add(along(d));
                if (c_on || d_on || (sc > 0.0) == (sd > 0.0)) return;
                const double t = sc / (sc - sd);
                add(along(c) + t * (along(d) - along(c)));
              });
  std::sort(parameters.begin(), parameters.end());
  return parameters;
}

std::vector<Stretch> PlanarOutline::inner_stretches(const Point2& a, const Point2& b, double tolerance) const {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  std::vector<Stretch> stretches;
  if (length <= tolerance) return stretches;
  const std::vector<double> parameters = crossings(a, b, tolerance);
  double begin = parameters.front();
  for (std::size_t i = 1; i < parameters.size(); ++i) {
    const double end = parameters[i];
    if ((end - begin) * length <= tolerance) continue;
    const double t = 0.5 * (begin + end);
    const Point2 between{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    if (winding(between) != 0 && !near_boundary(between, tolerance)) stretches.push_back({begin, end});
    begin = end;
  }
  return stretches;
}

}  // namespace clerestory::mesh
