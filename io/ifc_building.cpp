// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ifc_building.h"

#include <IfcAnnotation.h>
#include <IfcBuildingElementPart.h>
#include <IfcBuildingStorey.h>
#include <IfcCompoundPlaneAngleMeasure.h>
#include <IfcDirection.h>
#include <IfcDistributionPort.h>
#include <IfcFeatureElementSubtraction.h>
#include <IfcFlowTerminal.h>
#include <IfcGeometricRepresentationContext.h>
#include <IfcGloballyUniqueId.h>
#include <IfcGrid.h>
#include <IfcIdentifier.h>
#include <IfcLabel.h>
#include <IfcLightFixture.h>
#include <IfcLightFixtureType.h>
#include <IfcOpeningElement.h>
#include <IfcPositiveLengthMeasure.h>
#include <IfcProject.h>
#include <IfcReinforcingElement.h>
#include <IfcRelAggregates.h>
#include <IfcRelContainedInSpatialStructure.h>
#include <IfcRelDefinesByType.h>
#include <IfcRelFillsElement.h>
#include <IfcRelVoidsElement.h>
#include <IfcSite.h>
#include <IfcSpace.h>
#include <IfcStructuralActivity.h>
#include <IfcStructuralItem.h>
#include <IfcTypeObject.h>
#include <IfcVirtualElement.h>
#include <IfcWindow.h>
#include <fmt/format.h>
#include <ifcpp/model/BuildingException.h>
#include <ifcpp/reader/ReaderSTEP.h>

#include <clocale>
#include <cmath>

#include "io/ifc_entities.h"
#include "io/ifc_quantities.h"
#include "io/ifc_shapes.h"
#include "io/ifc_step.h"
#include "io/ifc_styles.h"
#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

/// The parser holds a file several times; what is larger does not fit.
constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30;
/// The parser drops entities that it does not know; if it drops more than this share, it stopped somewhere.
constexpr double kMostUnknown = 0.01;
/// Net areas leave out what stands on the floor, and some programs take off 3 % for plaster.
constexpr std::array<std::string_view, 4> kFloorAreas{"GrossFloorArea", "NetFloorArea", "GSA BIM Area", "Area"};
constexpr std::array<std::string_view, 3> kVolumes{"NetVolume", "Volume", "GrossVolume"};

void check_schema(const std::string& file, const StepOutline& outline) {
  if (outline.schema.empty())
    throw InputError(file, 0, "this is no IFC file: its header names no schema", "export the model as IFC4 or IFC2x3");
  if (outline.schema.starts_with("IFC4X"))
    throw InputError(file, 0, fmt::format("the schema {} is not read", printable(outline.schema)),
                     "export the model as IFC4 or IFC2x3");
  if (!outline.schema.starts_with("IFC2X3") && !outline.schema.starts_with("IFC4"))
    throw InputError(file, 0, fmt::format("the schema {} is not read", in_quotes(outline.schema)),
                     "export the model as IFC4 or IFC2x3");
}

/// Compares what was parsed with what is there.
void check_entities(const std::string& file, const StepOutline& outline, const BuildingModel& model,
                    std::vector<std::string>& notices) {
  const auto& parsed = model.getMapIfcEntities();
  std::size_t missing = 0;
  std::uint64_t first_line = 0;
  for (const auto& [id, line] : outline.lines) {
    const auto at = parsed.find(id);
    if (at != parsed.end() && at->second) continue;
    if (missing++ == 0 || line < first_line) first_line = line;
  }
  const std::size_t count = outline.lines.size();
  if (static_cast<double>(missing) > kMostUnknown * static_cast<double>(count))
    throw InputError(file, first_line,
                     fmt::format("{} of the {} entities cannot be read, the first here", missing, count),
                     "export the model again");
  if (missing > 0)
    notices.push_back(
        fmt::format("{} of the {} entities of the model cannot be read and were passed over, the first is in line {}.",
                    missing, count, first_line));
  if (!outline.complete) notices.push_back("The model does not end as an IFC file must: it may have been cut off.");
}

/// The parser sets the process's LC_NUMERIC and leaves it so.
class NumericLocale {
 public:
  NumericLocale() : before_(std::setlocale(LC_NUMERIC, nullptr)) {}
  ~NumericLocale() { std::setlocale(LC_NUMERIC, before_.c_str()); }
  NumericLocale(const NumericLocale&) = delete;
  NumericLocale& operator=(const NumericLocale&) = delete;

 private:
  std::string before_;
};

std::shared_ptr<BuildingModel> parse(const std::string& file, const std::string& text, const StepOutline& outline,
                                     std::vector<std::string>& notices) {
  auto model = std::make_shared<BuildingModel>();
  ReaderSTEP reader;
  std::string errors;
  // NOLINTNEXTLINE(performance-unnecessary-value-param): the library's signature
  reader.setMessageCallBack(&errors, [](void* text_of_errors, std::shared_ptr<StatusCallback::Message> message) {
    if (message->m_message_type == StatusCallback::MESSAGE_TYPE_ERROR)
      *static_cast<std::string*>(text_of_errors) = utf8(message->m_message_text);
  });
  std::string content = text;
  const NumericLocale restored;
  try {
    reader.loadModelFromString(content, model);
  } catch (const BuildingException& error) {
    throw InputError(file, 0, "the model cannot be read: " + printable(error.what()), "export it again");
  }
  check_entities(file, outline, *model, notices);
  if (!errors.empty()) notices.push_back(fmt::format("IfcPlusPlus says of the model: {}.", printable(errors)));
  return model;
}

std::optional<double> degrees_of(const std::shared_ptr<IfcCompoundPlaneAngleMeasure>& angle) {
  if (!angle || angle->m_vec.size() < 3) return std::nullopt;
  constexpr std::array kParts{1.0, 60.0, 3600.0, 3600.0e6};
  double sum = 0.0;
  for (std::size_t i = 0; i < std::min(angle->m_vec.size(), kParts.size()); ++i) sum += angle->m_vec[i] / kParts[i];
  return sum;
}

std::optional<double> north_of(const BuildingModel& model) {
  for (const auto& [id, entity] : model.getMapIfcEntities()) {
    const auto context = as<IfcGeometricRepresentationContext>(entity);
    if (!context || !context->m_TrueNorth) continue;
    const mesh::Vector north = direction_of(context->m_TrueNorth, {0.0, 1.0, 0.0});
    if (mesh::norm(north) > 0.0) return std::atan2(-north.x, north.y) * 180.0 / M_PI;
  }
  return std::nullopt;
}

bool has_no_surface(const std::shared_ptr<IfcProduct>& product) {
  return as<IfcAnnotation>(product) || as<IfcGrid>(product) || as<IfcVirtualElement>(product) || as<IfcPort>(product) ||
         as<IfcStructuralItem>(product) || as<IfcStructuralActivity>(product) || as<IfcReinforcingElement>(product) ||
         (as<IfcSpatialElement>(product) && !as<IfcSite>(product));
}

std::string class_of(const IfcProduct& product) {
  std::string name = product.className();
  if (name.starts_with("Ifc")) name.erase(0, 3);
  for (const std::string_view suffix : {"StandardCase", "ElementedCase"})
    if (name.ends_with(suffix)) name.erase(name.size() - suffix.size());
  return name;
}

class BuildingReader {
 public:
  BuildingReader(const std::filesystem::path& path, const std::string& text)
      : outline_(outline_step(text)), styles_(outline_) {
    check_schema(path.string(), outline_);
    building_.schema = outline_.schema;
    model_ = parse(path.string(), text, outline_, building_.notices);
    units_ = units_of(model_->getIfcProject());
    building_.metres_per_unit = units_.metre;
    shapes_ = std::make_unique<IfcShapes>(model_, styles_, units_.metre);
    file_ = path.string();
  }

  IfcBuilding read() {
    read_site();
    read_openings();
    for (const auto& [id, entity] : model_->getMapIfcEntities()) {
      const auto product = as<IfcProduct>(entity);
      if (!product || as<IfcFeatureElementSubtraction>(product)) continue;
      if (const auto space = as<IfcSpace>(product)) {
        read_room(*space);
      } else if (!has_no_surface(product)) {
        read_element(product);
        read_fixture(product);
      }
    }
    link_parts();
    building_.surfaces = styles_.surfaces();
    check_bodies();
    return std::move(building_);
  }

 private:
  mesh::Affine placement_of_product(const IfcProduct& product) const {
    return world_placement_of(product.m_ObjectPlacement, units_.metre);
  }

  void read_site() {
    building_.site.north_deg = north_of(*model_);
    for (const auto& [id, entity] : model_->getMapIfcEntities()) {
      const auto site = as<IfcSite>(entity);
      if (!site) continue;
      building_.site.latitude_deg = degrees_of(site->m_RefLatitude);
      building_.site.longitude_deg = degrees_of(site->m_RefLongitude);
      return;
    }
  }

  void read_openings() {
    for (const auto& [id, entity] : model_->getMapIfcEntities()) {
      const auto cut = as<IfcFeatureElementSubtraction>(entity);
      if (!cut) continue;
      IfcOpening opening{id, placement_of_product(*cut), {}, {}};
      for (IfcItem& item : shapes_->items_of(*cut)) opening.bodies.push_back(std::move(item.body));
      opening_of_[id] = building_.openings.size();
      building_.openings.push_back(std::move(opening));
    }
  }

  void read_room(const IfcSpace& space) {
    IfcRoom room;
    const std::string number = text_of(space.m_Name);
    const std::string name = text_of(space.m_LongName);
    room.name = name.empty() || name == number ? number : number.empty() ? name : number + " " + name;
    room.placement = placement_of_product(space);
    for (const IfcItem& item : shapes_->items_of(space)) mesh::append(room.body, item.body);
    room.floor_area_m2 = stated_area(space, kFloorAreas, units_);
    room.volume_m3 = stated_volume(space, kVolumes, units_);
    if (room.body.empty()) {
      building_.notices.push_back(fmt::format("The space {} has no body and was left out.", in_quotes(room.name)));
    } else {
      building_.rooms.push_back(std::move(room));
    }
  }

  void read_element(const std::shared_ptr<IfcProduct>& product) {
    IfcElement element;
    element.id = product->m_entity_id;
    const auto line = outline_.lines.find(element.id);
    if (line != outline_.lines.end()) element.line = line->second;
    element.class_name = class_of(*product);
    element.name = text_of(product->m_Name);
    element.placement = placement_of_product(*product);
    element.items = shapes_->items_of(*product);
    const IfcMaterials materials = styles_.materials_of(*product);
    element.layers = materials.layers;
    element.material = materials.material;
    element.stated_volume_m3 = stated_volume(*product, kVolumes, units_);
    if (const auto ifc_element = as<::IfcElement>(product)) read_relations(*ifc_element, element);
    if (const auto window = as<IfcWindow>(product)) {
      element.width_m = value_of(window->m_OverallWidth) * units_.metre;
      element.height_m = value_of(window->m_OverallHeight) * units_.metre;
    }
    element_of_[element.id] = building_.elements.size();
    building_.elements.push_back(std::move(element));
    products_.push_back(product);
  }

  /// Light fixtures are elements too: they may have a body.
  void read_fixture(const std::shared_ptr<IfcProduct>& product) {
    const auto terminal = as<IfcFlowTerminal>(product);
    if (!terminal) return;
    std::shared_ptr<IfcTypeObject> type;
    for (const auto& weak : terminal->m_IsTypedBy_inverse)
      if (const auto relation = weak.lock()) type = relation->m_RelatingType;
    if (!as<IfcLightFixture>(product) && !as<IfcLightFixtureType>(type)) return;
    IfcFixture fixture;
    fixture.name = text_of(product->m_Name);
    fixture.type = type ? text_of(type->m_Name) : std::string();
    if (fixture.type.empty()) fixture.type = text_of(product->m_ObjectType);
    if (fixture.type.empty()) fixture.type = fixture.name;
    fixture.placement = placement_of_product(*product);
    building_.fixtures.push_back(std::move(fixture));
  }

  void read_relations(const ::IfcElement& from, IfcElement& element) const {
    for (const auto& weak : from.m_ContainedInStructure_inverse)
      if (const auto relation = weak.lock())
        if (const auto storey = as<IfcBuildingStorey>(relation->m_RelatingStructure))
          element.storey = text_of(storey->m_Name);
    for (const auto& weak : from.m_HasOpenings_inverse) {
      const auto relation = weak.lock();
      if (!relation || !relation->m_RelatedOpeningElement) continue;
      const auto opening = opening_of_.find(relation->m_RelatedOpeningElement->m_entity_id);
      if (opening != opening_of_.end()) element.openings.push_back(opening->second);
    }
    for (const auto& weak : from.m_FillsVoids_inverse) {
      const auto relation = weak.lock();
      if (!relation || !relation->m_RelatingOpeningElement) continue;
      const auto opening = opening_of_.find(relation->m_RelatingOpeningElement->m_entity_id);
      if (opening != opening_of_.end()) element.fills = opening->second;
    }
  }

  /// What a whole has, its parts have too: storey, openings, material; parts that only repeat the whole's body go.
  void link_parts() {
    for (std::size_t i = 0; i < building_.elements.size(); ++i) {
      for (const auto& weak : products_[i]->m_Decomposes_inverse) {
        const auto relation = weak.lock();
        if (!relation || !relation->m_RelatingObject) continue;
        const auto whole = element_of_.find(relation->m_RelatingObject->m_entity_id);
        if (whole != element_of_.end() && whole->second != i) building_.elements[i].whole = whole->second;
      }
    }
    for (std::size_t i = 0; i < building_.elements.size(); ++i) {
      IfcElement& part = building_.elements[i];
      auto whole = part.whole;
      for (std::size_t step = 0; whole && step < building_.elements.size(); ++step) {
        const IfcElement& above = building_.elements[*whole];
        if (part.storey.empty()) part.storey = above.storey;
        if (!part.material) part.material = above.material;
        part.openings.insert(part.openings.end(), above.openings.begin(), above.openings.end());
        if (as<IfcBuildingElementPart>(products_[i]) && !above.items.empty()) part.items.clear();
        whole = above.whole;
      }
      std::sort(part.openings.begin(), part.openings.end());
      part.openings.erase(std::unique(part.openings.begin(), part.openings.end()), part.openings.end());
    }
  }

  void check_bodies() {
    for (const auto& [kind, count] : shapes_->lost())
      building_.notices.push_back(fmt::format("Geometry was lost: {} of kind {} could not be converted.", count, kind));
    for (const auto& [text, count] : shapes_->messages())
      building_.notices.push_back(fmt::format("IfcPlusPlus says {}: {}.",
                                              count == 1 ? "once" : fmt::format("{} times", count), printable(text)));
    for (const IfcElement& element : building_.elements)
      if (!element.items.empty()) return;
    const std::string why = building_.notices.empty() ? std::string() : " (" + building_.notices.front() + ")";
    throw InputError(file_, 0, "no element of this model has a body that can be read" + why,
                     "export it with the bodies of its walls, slabs and windows");
  }

  std::string file_;
  StepOutline outline_;
  IfcStyles styles_;
  IfcBuilding building_;
  std::shared_ptr<BuildingModel> model_;
  IfcUnits units_;
  std::unique_ptr<IfcShapes> shapes_;
  std::map<int, std::size_t> opening_of_;
  std::map<int, std::size_t> element_of_;
  std::vector<std::shared_ptr<IfcProduct>> products_;
};

}  // namespace

IfcBuilding read_ifc_building(const std::filesystem::path& path) {
  return BuildingReader(path, read_text_file(path, "model", kLargestFile)).read();
}

}  // namespace clerestory::io
