// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "io/ifc_building.h"
#include "io/ifc_entities.h"
#include "io/ifc_step.h"

class IfcMaterial;
class IfcMaterialLayerSet;
class IfcMaterialLayerSetUsage;
class IfcMaterialSelect;
class IfcObjectDefinition;
class IfcPresentationStyleSelect;
class IfcRepresentationItem;
class IfcSurfaceStyle;

// Private to the files of the IFC reader that may name the parser's types.
namespace clerestory::io {

/// What an element is said to be made of.
struct IfcMaterials {
  std::optional<IfcLayers> layers;
  std::optional<std::size_t> material;
};

/// Styles and materials as surfaces, each once.
class IfcStyles {
 public:
  explicit IfcStyles(const StepOutline& outline) : outline_(outline) {}

  /// The surface style that the item itself has.
  std::optional<std::size_t> style_of(const IfcRepresentationItem& item);
  /// The material of an object, else of its type.
  IfcMaterials materials_of(const IfcObjectDefinition& object);
  [[nodiscard]] const std::vector<IfcSurface>& surfaces() const { return surfaces_; }

 private:
  std::size_t surface(IfcSurface surface);
  std::optional<std::size_t> surface_of(const IfcSurfaceStyle& style);
  std::optional<std::size_t> surface_of(const std::shared_ptr<IfcMaterial>& material);
  std::optional<IfcSurface> look_of(const IfcMaterial& material);
  IfcMaterials materials_of(const std::shared_ptr<IfcMaterialSelect>& select);
  IfcMaterials layers_of(const IfcMaterialLayerSetUsage& usage);
  std::optional<std::size_t> thickest_of(const IfcMaterialLayerSet& set);

  const StepOutline& outline_;
  std::vector<IfcSurface> surfaces_;
  std::map<int, std::size_t> by_entity_;
};

}  // namespace clerestory::io
