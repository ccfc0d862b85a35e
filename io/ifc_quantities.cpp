// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ifc_quantities.h"

#include <IfcAreaMeasure.h>
#include <IfcConversionBasedUnit.h>
#include <IfcElementQuantity.h>
#include <IfcIdentifier.h>
#include <IfcInteger.h>
#include <IfcLabel.h>
#include <IfcLengthMeasure.h>
#include <IfcMeasureWithUnit.h>
#include <IfcObject.h>
#include <IfcProject.h>
#include <IfcPropertySet.h>
#include <IfcPropertySingleValue.h>
#include <IfcQuantityArea.h>
#include <IfcQuantityVolume.h>
#include <IfcRatioMeasure.h>
#include <IfcReal.h>
#include <IfcRelDefinesByProperties.h>
#include <IfcSIPrefix.h>
#include <IfcSIUnit.h>
#include <IfcUnitAssignment.h>
#include <IfcUnitEnum.h>
#include <IfcVolumeMeasure.h>

#include <cmath>

namespace clerestory::io {

namespace {

/// Units of units end here.
constexpr int kDeepestUnit = 8;

double prefix_of(const IfcSIUnit& unit) {
  constexpr std::array kPowers{18, 15, 12, 9, 6, 3, 2, 1, -1, -2, -3, -6, -9, -12, -15, -18};
  if (!unit.m_Prefix) return 1.0;
  const auto which = static_cast<std::size_t>(unit.m_Prefix->m_enum);
  return which < kPowers.size() ? std::pow(10.0, kPowers[which]) : 1.0;
}

/// The number of any measure of a value select.
std::optional<double> number_of(const std::shared_ptr<IfcValue>& value) {
  if (const auto length = as<IfcLengthMeasure>(value)) return length->m_value;
  if (const auto area = as<IfcAreaMeasure>(value)) return area->m_value;
  if (const auto volume = as<IfcVolumeMeasure>(value)) return volume->m_value;
  if (const auto ratio = as<IfcRatioMeasure>(value)) return ratio->m_value;
  if (const auto real = as<IfcReal>(value)) return real->m_value;
  if (const auto whole = as<IfcInteger>(value)) return whole->m_value;
  return std::nullopt;
}

/// A unit of length, area or volume in metres to the power that it has.
double size_of(const std::shared_ptr<IfcUnit>& unit, int power, int depth = 0) {
  if (const auto si = as<IfcSIUnit>(unit)) return std::pow(prefix_of(*si), power);
  const auto converted = as<IfcConversionBasedUnit>(unit);
  if (!converted || !converted->m_ConversionFactor || depth > kDeepestUnit) return 1.0;
  const IfcMeasureWithUnit& factor = *converted->m_ConversionFactor;
  return number_of(factor.m_ValueComponent).value_or(1.0) * size_of(factor.m_UnitComponent, power, depth + 1);
}

/// Calls visit(set) for each set of quantities or properties that the object has.
template <class Set, class Visit>
void for_each_set(const IfcObject& object, const Visit& visit) {
  for (const auto& weak : object.m_IsDefinedBy_inverse) {
    const auto relation = weak.lock();
    if (const auto set = relation ? as<Set>(relation->m_RelatingPropertyDefinition) : nullptr) visit(*set);
  }
}

template <class Quantity, class Measure, class Value>
std::optional<double> stated(const IfcObject& object, std::span<const std::string_view> names, const Value& value) {
  for (const std::string_view name : names) {
    std::optional<double> found;
    for_each_set<IfcElementQuantity>(object, [&](const IfcElementQuantity& set) {
      for (const auto& any : set.m_Quantities)
        if (const auto quantity = as<Quantity>(any); quantity && !found && text_of(quantity->m_Name) == name)
          found = value(*quantity);
    });
    for_each_set<IfcPropertySet>(object, [&](const IfcPropertySet& set) {
      for (const auto& any : set.m_HasProperties)
        if (const auto property = as<IfcPropertySingleValue>(any); property && text_of(property->m_Name) == name)
          if (const auto measure = as<Measure>(property->m_NominalValue); measure && !found) found = measure->m_value;
    });
    if (found) return found;
  }
  return std::nullopt;
}

}  // namespace

IfcUnits units_of(const std::shared_ptr<IfcProject>& project) {
  IfcUnits units;
  if (!project || !project->m_UnitsInContext) return units;
  for (const auto& any : project->m_UnitsInContext->m_Units) {
    const auto unit = as<IfcNamedUnit>(any);
    if (!unit || !unit->m_UnitType) continue;
    if (unit->m_UnitType->m_enum == IfcUnitEnum::ENUM_LENGTHUNIT) units.metre = size_of(unit, 1);
    if (unit->m_UnitType->m_enum == IfcUnitEnum::ENUM_AREAUNIT) units.square_metre = size_of(unit, 2);
    if (unit->m_UnitType->m_enum == IfcUnitEnum::ENUM_VOLUMEUNIT) units.cubic_metre = size_of(unit, 3);
  }
  return units;
}

std::optional<double> stated_area(const IfcObject& object, std::span<const std::string_view> names,
                                  const IfcUnits& units) {
  const auto found = stated<IfcQuantityArea, IfcAreaMeasure>(
      object, names, [](const IfcQuantityArea& quantity) { return value_of(quantity.m_AreaValue); });
  return found ? std::optional(*found * units.square_metre) : std::nullopt;
}

std::optional<double> stated_volume(const IfcObject& object, std::span<const std::string_view> names,
                                    const IfcUnits& units) {
  const auto found = stated<IfcQuantityVolume, IfcVolumeMeasure>(
      object, names, [](const IfcQuantityVolume& quantity) { return value_of(quantity.m_VolumeValue); });
  return found ? std::optional(*found * units.cubic_metre) : std::nullopt;
}

}  // namespace clerestory::io
