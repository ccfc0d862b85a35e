// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ifc_entities.h"

#include <IfcAxis2Placement2D.h>
#include <IfcAxis2Placement3D.h>
#include <IfcCartesianPoint.h>
#include <IfcCartesianTransformationOperator3DnonUniform.h>
#include <IfcDirection.h>
#include <IfcLengthMeasure.h>
#include <IfcLocalPlacement.h>
#include <IfcReal.h>

namespace clerestory::io {

namespace {

/// Placements are seldom nested deeper than ten; a circle never ends.
constexpr int kDeepestPlacement = 1000;

void append_utf8(std::string& text, char32_t c) {
  if (c < 0x80) {
    text += static_cast<char>(c);
  } else if (c < 0x800) {
    text += static_cast<char>(0xC0 | (c >> 6));
    text += static_cast<char>(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    text += static_cast<char>(0xE0 | (c >> 12));
    text += static_cast<char>(0x80 | ((c >> 6) & 0x3F));
    text += static_cast<char>(0x80 | (c & 0x3F));
  } else if (c < 0x110000) {
    text += static_cast<char>(0xF0 | (c >> 18));
    text += static_cast<char>(0x80 | ((c >> 12) & 0x3F));
    text += static_cast<char>(0x80 | ((c >> 6) & 0x3F));
    text += static_cast<char>(0x80 | (c & 0x3F));
  }
}

/// Axes from a z axis and a direction that x should be near to.
mesh::Affine axes(const mesh::Point& origin, mesh::Vector z, const mesh::Vector& x_wanted) {
  z = mesh::normalized(z);
  if (mesh::norm(z) == 0.0) z = {0.0, 0.0, 1.0};
  mesh::Vector x = mesh::normalized(x_wanted - mesh::dot(x_wanted, z) * z);
  if (mesh::norm(x) == 0.0) x = mesh::frame_around(z).u;
  return {x, mesh::cross(z, x), z, origin};
}

}  // namespace

std::string utf8(const std::wstring& text) {
  std::string result;
  for (const wchar_t c : text) append_utf8(result, static_cast<char32_t>(c));
  return result;
}

mesh::Point point_of(const std::shared_ptr<IfcCartesianPoint>& point, double metres_per_unit) {
  if (!point) return {};
  const auto at = [&](std::size_t axis) {
    return axis < point->m_Coordinates.size() ? metres_per_unit * value_of(point->m_Coordinates[axis]) : 0.0;
  };
  return {at(0), at(1), at(2)};
}

mesh::Vector direction_of(const std::shared_ptr<IfcDirection>& direction, const mesh::Vector& otherwise) {
  if (!direction) return otherwise;
  const auto at = [&](std::size_t axis) {
    return axis < direction->m_DirectionRatios.size() ? value_of(direction->m_DirectionRatios[axis]) : 0.0;
  };
  return {at(0), at(1), at(2)};
}

mesh::Affine placement_of(const std::shared_ptr<IfcAxis2Placement>& placement, double metres_per_unit) {
  constexpr mesh::Vector kX{1.0, 0.0, 0.0};
  constexpr mesh::Vector kZ{0.0, 0.0, 1.0};
  if (const auto flat = as<IfcAxis2Placement2D>(placement))
    return axes(point_of(flat->m_Location, metres_per_unit), kZ, direction_of(flat->m_RefDirection, kX));
  const auto placed = as<IfcAxis2Placement3D>(placement);
  if (!placed) return {};
  return axes(point_of(placed->m_Location, metres_per_unit), direction_of(placed->m_Axis, kZ),
              direction_of(placed->m_RefDirection, kX));
}

mesh::Affine transformation_of(const std::shared_ptr<IfcCartesianTransformationOperator>& transformation,
                               double metres_per_unit) {
  if (!transformation) return {};
  const auto solid = as<IfcCartesianTransformationOperator3D>(transformation);
  const mesh::Vector z = solid ? direction_of(solid->m_Axis3, {0.0, 0.0, 1.0}) : mesh::Vector{0.0, 0.0, 1.0};
  mesh::Affine map = axes(point_of(transformation->m_LocalOrigin, metres_per_unit), z,
                          direction_of(transformation->m_Axis1, {1.0, 0.0, 0.0}));
  if (mesh::dot(direction_of(transformation->m_Axis2, map.y), map.y) < 0.0) map.y = -map.y;
  const double scale = value_of(transformation->m_Scale, 1.0);
  const auto uneven = as<IfcCartesianTransformationOperator3DnonUniform>(transformation);
  map.x = scale * map.x;
  map.y = (uneven ? value_of(uneven->m_Scale2, scale) : scale) * map.y;
  map.z = (uneven ? value_of(uneven->m_Scale3, scale) : scale) * map.z;
  return map;
}

mesh::Affine world_placement_of(const std::shared_ptr<IfcObjectPlacement>& placement, double metres_per_unit) {
  mesh::Affine map;
  auto local = as<IfcLocalPlacement>(placement);
  for (int depth = 0; local && depth < kDeepestPlacement; ++depth) {
    map = placement_of(local->m_RelativePlacement, metres_per_unit) * map;
    local = as<IfcLocalPlacement>(local->m_PlacementRelTo);
  }
  return map;
}

}  // namespace clerestory::io
