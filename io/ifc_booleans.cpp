// SPDX-License-Identifier: GPL-3.0-or-later
#include <IfcBooleanOperator.h>
#include <IfcBooleanResult.h>
#include <IfcBoundedCurve.h>
#include <IfcElementarySurface.h>
#include <IfcPolygonalBoundedHalfSpace.h>
#include <ifcpp/geometry/Carve/RepresentationConverter.h>

#include <cmath>

#include "io/ifc_shapes.h"

namespace clerestory::io {

namespace {

/// Bodies stand out of what a half-space leaves by more than this, or are not cut: planes that a file means to be one lie so near [m].
constexpr double kTouch = 5e-6;
/// The tools that stand for half-spaces go beyond the body by this [m].
constexpr double kBeyond = 1.0;
/// Sine of the angle between a half-space's plane and the walls of its boundary, below which they are parallel.
constexpr double kParallel = 0.01;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

/// The range of a body along a direction, from a point.
Range range_of(const mesh::Solid& body, const mesh::Point& from, const mesh::Vector& along) {
  Range range;
  for (const mesh::Point& p : body.points) {
    range.low = std::min(range.low, mesh::dot(p - from, along));
    range.high = std::max(range.high, mesh::dot(p - from, along));
  }
  return range;
}

/// The box over a plane that goes beyond a body; empty where the body lies outside of the half-space.
mesh::Solid box_over(const mesh::Affine& plane, const mesh::Vector& into, const mesh::Solid& around) {
  const Range u = range_of(around, plane.origin, plane.x);
  const Range v = range_of(around, plane.origin, plane.y);
  const Range w = range_of(around, plane.origin, into);
  if (w.high <= kTouch) return {};
  std::vector<mesh::Point> loop;
  for (const auto& [a, b] :
       {std::pair{u.low - kBeyond, v.low - kBeyond}, std::pair{u.high + kBeyond, v.low - kBeyond},
        std::pair{u.high + kBeyond, v.high + kBeyond}, std::pair{u.low - kBeyond, v.high + kBeyond}})
    loop.push_back(plane.origin + a * plane.x + b * plane.y);
  return mesh::prism({&loop, 1}, (w.high + kBeyond) * into);
}

}  // namespace

mesh::Solid IfcShapes::boolean(const IfcBooleanResult& result, int depth) {
  mesh::Solid body = mesh::outward(mesh::snapped(body_of(as<IfcRepresentationItem>(result.m_FirstOperand), depth)));
  if (body.empty() || !result.m_Operator) return body;
  const auto half = as<IfcHalfSpaceSolid>(result.m_SecondOperand);
  const auto other = as<IfcRepresentationItem>(result.m_SecondOperand);
  const mesh::Solid tool = half ? half_space(*half, body) : mesh::outward(mesh::snapped(body_of(other, depth)));
  std::optional<mesh::Solid> answer;
  switch (result.m_Operator->m_enum) {
    case IfcBooleanOperator::ENUM_DIFFERENCE:
      if (tool.empty() || !mesh::interiors_overlap(mesh::box_of(body), mesh::box_of(tool))) return body;
      answer = mesh::is_closed(body) ? mesh::difference(body, tool) : mesh::clipped(body, tool);
      break;
    case IfcBooleanOperator::ENUM_INTERSECTION:
      if (tool.empty() || !mesh::interiors_overlap(mesh::box_of(body), mesh::box_of(tool))) return {};
      answer = mesh::intersection(body, tool);
      break;
    case IfcBooleanOperator::ENUM_UNION:
      if (tool.empty()) return body;
      answer = mesh::united(body, tool);
      if (!answer) mesh::append(body, tool);
      break;
  }
  if (!answer) lose("the second operand of IfcBooleanResult");
  return answer ? std::move(*answer) : body;
}

/// As a body that goes beyond another; empty where it leaves that alone.
mesh::Solid IfcShapes::half_space(const IfcHalfSpaceSolid& half, const mesh::Solid& around) {
  const auto surface = as<IfcElementarySurface>(half.m_BaseSurface);
  if (!surface) {
    lose("IfcHalfSpaceSolid");
    return {};
  }
  const mesh::Affine plane = placement_of(surface->m_Position, metres_per_unit_);
  // With the flag set, the half-space is where the normal points away from.
  const mesh::Vector into = is_set(half.m_AgreementFlag) ? -plane.z : plane.z;
  const auto* bounded = dynamic_cast<const IfcPolygonalBoundedHalfSpace*>(&half);
  if (bounded == nullptr) return box_over(plane, into, around);

  std::vector<vec2> flat;
  std::vector<vec2> segment_starts;
  if (bounded->m_PolygonalBoundary)
    library_->getCurveConverter()->convertIfcCurve2D(bounded->m_PolygonalBoundary, flat, segment_starts);
  ProfileConverter::deleteLastPointIfEqualToFirst(flat);
  std::vector<mesh::Point> boundary;
  for (const vec2& p : flat) boundary.push_back({p.x, p.y, 0.0});
  const mesh::Affine at = placement_of(bounded->m_Position, metres_per_unit_);
  return bounded_half_space(boundary, at, plane, into, around);
}

mesh::Solid IfcShapes::bounded_half_space(const std::vector<mesh::Point>& boundary, const mesh::Affine& at,
                                          const mesh::Affine& plane, const mesh::Vector& into,
                                          const mesh::Solid& around) {
  const Range height = range_of(around, at.origin, at.z);
  std::vector<mesh::Point> loop;
  for (const mesh::Point& p : boundary) loop.push_back(at({p.x, p.y, height.low - kBeyond}));
  mesh::Solid column = mesh::prism({&loop, 1}, (height.high - height.low + 2.0 * kBeyond) * at.z);
  if (column.empty()) {
    lose("IfcPolygonalBoundedHalfSpace");
    return {};
  }
  if (range_of(around, plane.origin, into).high <= kTouch) return {};
  if (range_of(column, plane.origin, into).low >= -kTouch) return column;
  const double slope = mesh::dot(into, at.z);
  if (std::abs(slope) < kParallel) {
    const mesh::Solid box = box_over(plane, into, column);
    if (box.empty()) return {};
    auto both = mesh::intersection(column, box);
    if (!both) lose("IfcPolygonalBoundedHalfSpace");
    return both.value_or(mesh::Solid{});
  }
  // The end of the column that lies outside of the half-space goes onto its plane, the other beyond all.
  const mesh::Point middle = at({0.0, 0.0, 0.5 * (height.low + height.high)});
  double farthest = 0.0;
  for (const mesh::Point& p : column.points)
    farthest = std::max(farthest, std::abs(mesh::dot(plane.origin - p, into) / slope));
  for (mesh::Point& p : column.points) {
    const bool is_far_end = (mesh::dot(p - middle, at.z) > 0.0) == (slope > 0.0);
    if (!is_far_end) p = p + (mesh::dot(plane.origin - p, into) / slope) * at.z;
    if (is_far_end) p = p + std::copysign(farthest, slope) * at.z;
  }
  return column;
}

}  // namespace clerestory::io
