// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ifcpp/model/BasicTypes.h>
#include <ifcpp/model/BuildingModel.h>

#include <memory>
#include <string>
#include <vector>

#include "mesh/affine.h"

// Private to the files of the IFC reader that may name the parser's types. Any attribute of a broken file may be null.
class IfcAxis2Placement;
class IfcCartesianPoint;
class IfcCartesianTransformationOperator;
class IfcDirection;
class IfcObjectPlacement;

namespace clerestory::io {

template <class To, class From>
std::shared_ptr<To> as(const std::shared_ptr<From>& from) {
  return std::dynamic_pointer_cast<To>(from);
}

template <class To, class From>
std::shared_ptr<To> as(const std::weak_ptr<From>& from) {
  return std::dynamic_pointer_cast<To>(from.lock());
}

/// The first of many references that is of a type; null where none is.
template <class To, class References>
std::shared_ptr<To> first_as(const References& references) {
  for (const auto& reference : references)
    if (auto found = as<To>(reference)) return found;
  return nullptr;
}

/// Wide characters in UTF-8.
std::string utf8(const std::wstring& text);

/// The text of a label, identifier or such; empty for none.
template <class Label>
std::string text_of(const std::shared_ptr<Label>& label) {
  return label ? utf8(label->m_value) : std::string();
}

/// The value of a measure; `otherwise` for none.
template <class Measure>
double value_of(const std::shared_ptr<Measure>& measure, double otherwise = 0.0) {
  return measure ? measure->m_value : otherwise;
}

/// Whether a flag is set; an absent one is.
template <class Flag>
bool is_set(const std::shared_ptr<Flag>& flag) {
  return !flag || flag->m_value;
}

mesh::Point point_of(const std::shared_ptr<IfcCartesianPoint>& point, double metres_per_unit);
/// Not normalised; `otherwise` for none.
mesh::Vector direction_of(const std::shared_ptr<IfcDirection>& direction, const mesh::Vector& otherwise);
/// An axis placement in two or three dimensions; the identity for none. Degenerate axes are completed.
mesh::Affine placement_of(const std::shared_ptr<IfcAxis2Placement>& placement, double metres_per_unit);
/// With scale and mirror.
mesh::Affine transformation_of(const std::shared_ptr<IfcCartesianTransformationOperator>& transformation,
                               double metres_per_unit);
/// To the model's coordinates, through all placements that it is relative to. A circle of placements is cut where it closes.
mesh::Affine world_placement_of(const std::shared_ptr<IfcObjectPlacement>& placement, double metres_per_unit);

}  // namespace clerestory::io
