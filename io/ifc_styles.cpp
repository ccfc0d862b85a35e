// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ifc_styles.h"

#include <IfcColourRgb.h>
#include <IfcDirectionSenseEnum.h>
#include <IfcLabel.h>
#include <IfcLayerSetDirectionEnum.h>
#include <IfcMaterial.h>
#include <IfcMaterialConstituent.h>
#include <IfcMaterialConstituentSet.h>
#include <IfcMaterialDefinitionRepresentation.h>
#include <IfcMaterialLayer.h>
#include <IfcMaterialLayerSet.h>
#include <IfcMaterialLayerSetUsage.h>
#include <IfcMaterialList.h>
#include <IfcMaterialProfile.h>
#include <IfcMaterialProfileSet.h>
#include <IfcMaterialProfileSetUsage.h>
#include <IfcNonNegativeLengthMeasure.h>
#include <IfcNormalisedRatioMeasure.h>
#include <IfcObject.h>
#include <IfcPresentationStyleAssignment.h>
#include <IfcRelAssociatesMaterial.h>
#include <IfcRelDefinesByType.h>
#include <IfcRepresentation.h>
#include <IfcRepresentationItem.h>
#include <IfcStyledItem.h>
#include <IfcStyledRepresentation.h>
#include <IfcSurfaceStyle.h>
#include <IfcSurfaceStyleRendering.h>
#include <IfcTypeObject.h>

#include <cmath>

namespace clerestory::io {

namespace {

/// Colours are those of screens. Source: IEC 61966-2-1.
double linear(double encoded) {
  const double c = std::clamp(encoded, 0.0, 1.0);
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// The surface style among the styles of an item, which IFC2x3 wraps up once more.
std::shared_ptr<IfcSurfaceStyle> surface_style_of(const IfcStyledItem& item) {
  for (const auto& style : item.m_Styles) {
    if (auto surface = as<IfcSurfaceStyle>(style)) return surface;
    if (const auto assignment = as<IfcPresentationStyleAssignment>(style))
      if (auto surface = first_as<IfcSurfaceStyle>(assignment->m_Styles)) return surface;
  }
  return nullptr;
}

void read_colour(const IfcSurfaceStyleShading& shading, IfcSurface& surface) {
  surface.transparency = std::clamp(value_of(shading.m_Transparency), 0.0, 1.0);
  if (!shading.m_SurfaceColour) return;
  const IfcColourRgb& colour = *shading.m_SurfaceColour;
  double factor = 1.0;
  if (const auto* rendering = dynamic_cast<const IfcSurfaceStyleRendering*>(&shading))
    if (const auto share = as<IfcNormalisedRatioMeasure>(rendering->m_DiffuseColour)) factor = share->m_value;
  const std::array<double, 3> bands{factor * linear(value_of(colour.m_Red)), factor * linear(value_of(colour.m_Green)),
                                    factor * linear(value_of(colour.m_Blue))};
  // Nothing real is all black: programs write that where nobody chose a colour.
  if (bands != std::array<double, 3>{}) surface.colour = bands;
}

}  // namespace

std::size_t IfcStyles::surface(IfcSurface surface) {
  surfaces_.push_back(std::move(surface));
  return surfaces_.size() - 1;
}

std::optional<std::size_t> IfcStyles::surface_of(const IfcSurfaceStyle& style) {
  const auto known = by_entity_.find(style.m_entity_id);
  if (known != by_entity_.end()) return known->second;
  IfcSurface look;
  look.name = text_of(style.m_Name);
  const auto line = outline_.lines.find(style.m_entity_id);
  if (line != outline_.lines.end()) look.line = line->second;
  if (const auto shading = first_as<IfcSurfaceStyleShading>(style.m_Styles)) read_colour(*shading, look);
  return by_entity_[style.m_entity_id] = surface(std::move(look));
}

std::optional<std::size_t> IfcStyles::style_of(const IfcRepresentationItem& item) {
  for (const auto& weak : item.m_StyledByItem_inverse)
    if (const auto styled = weak.lock())
      if (const auto style = surface_style_of(*styled)) return surface_of(*style);
  return std::nullopt;
}

/// The style that a material has of its own.
std::optional<IfcSurface> IfcStyles::look_of(const IfcMaterial& material) {
  for (const auto& weak : material.m_HasRepresentation_inverse) {
    const auto definition = weak.lock();
    if (!definition) continue;
    for (const auto& representation : definition->m_Representations) {
      if (!representation) continue;
      for (const auto& item : representation->m_Items) {
        const auto styled = as<IfcStyledItem>(item);
        const auto style = styled ? surface_style_of(*styled) : nullptr;
        if (style) return surfaces_[*surface_of(*style)];
      }
    }
  }
  return std::nullopt;
}

std::optional<std::size_t> IfcStyles::surface_of(const std::shared_ptr<IfcMaterial>& material) {
  if (!material) return std::nullopt;
  const auto known = by_entity_.find(material->m_entity_id);
  if (known != by_entity_.end()) return known->second;
  IfcSurface look = look_of(*material).value_or(IfcSurface{});
  look.name = text_of(material->m_Name);
  const auto line = outline_.lines.find(material->m_entity_id);
  if (line != outline_.lines.end()) look.line = line->second;
  return by_entity_[material->m_entity_id] = surface(std::move(look));
}

IfcMaterials IfcStyles::materials_of(const IfcObjectDefinition& object) {
  for (const auto& weak : object.m_HasAssociations_inverse)
    if (const auto association = as<IfcRelAssociatesMaterial>(weak)) {
      const IfcMaterials found = materials_of(association->m_RelatingMaterial);
      if (found.material) return found;
    }
  const auto* occurrence = dynamic_cast<const IfcObject*>(&object);
  if (occurrence == nullptr) return {};
  for (const auto& weak : occurrence->m_IsTypedBy_inverse) {
    const auto typed = weak.lock();
    if (typed && typed->m_RelatingType) return materials_of(*typed->m_RelatingType);
  }
  return {};
}

IfcMaterials IfcStyles::materials_of(const std::shared_ptr<IfcMaterialSelect>& select) {
  if (const auto usage = as<IfcMaterialLayerSetUsage>(select)) return layers_of(*usage);
  if (const auto set = as<IfcMaterialLayerSet>(select)) return {std::nullopt, thickest_of(*set)};
  if (const auto layer = as<IfcMaterialLayer>(select)) return {std::nullopt, surface_of(layer->m_Material)};
  if (const auto material = as<IfcMaterial>(select)) return {std::nullopt, surface_of(material)};
  if (const auto list = as<IfcMaterialList>(select))
    return {std::nullopt, surface_of(first_as<IfcMaterial>(list->m_Materials))};
  if (const auto set = as<IfcMaterialConstituentSet>(select)) {
    const auto first = first_as<IfcMaterialConstituent>(set->m_MaterialConstituents);
    return {std::nullopt, first ? surface_of(first->m_Material) : std::nullopt};
  }
  auto profiles = as<IfcMaterialProfileSet>(select);
  if (const auto usage = as<IfcMaterialProfileSetUsage>(select)) profiles = usage->m_ForProfileSet;
  const auto first = profiles ? first_as<IfcMaterialProfile>(profiles->m_MaterialProfiles) : nullptr;
  return {std::nullopt, first ? surface_of(first->m_Material) : std::nullopt};
}

std::optional<std::size_t> IfcStyles::thickest_of(const IfcMaterialLayerSet& set) {
  std::optional<std::size_t> thickest;
  double most = -1.0;
  for (const auto& layer : set.m_MaterialLayers) {
    if (!layer || !layer->m_Material || value_of(layer->m_LayerThickness) <= most) continue;
    most = value_of(layer->m_LayerThickness);
    thickest = surface_of(layer->m_Material);
  }
  return thickest;
}

IfcMaterials IfcStyles::layers_of(const IfcMaterialLayerSetUsage& usage) {
  if (!usage.m_ForLayerSet) return {};
  const auto& layers = usage.m_ForLayerSet->m_MaterialLayers;
  const auto thickest = thickest_of(*usage.m_ForLayerSet);
  if (!thickest) return {};
  const auto surface_at = [&](const std::shared_ptr<IfcMaterialLayer>& layer) {
    return (layer ? surface_of(layer->m_Material) : std::nullopt).value_or(*thickest);
  };
  IfcLayers result{{0.0, 1.0, 0.0}, surface_at(layers.front()), surface_at(layers.back()), *thickest};
  if (usage.m_LayerSetDirection && usage.m_LayerSetDirection->m_enum == IfcLayerSetDirectionEnum::ENUM_AXIS1)
    result.axis = {1.0, 0.0, 0.0};
  if (usage.m_LayerSetDirection && usage.m_LayerSetDirection->m_enum == IfcLayerSetDirectionEnum::ENUM_AXIS3)
    result.axis = {0.0, 0.0, 1.0};
  if (usage.m_DirectionSense && usage.m_DirectionSense->m_enum == IfcDirectionSenseEnum::ENUM_NEGATIVE)
    result.axis = -result.axis;
  return {result, thickest};
}

}  // namespace clerestory::io
