// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ifc.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "io/child_process.h"
#include "io/ifc_building.h"
#include "io/ifc_cut.h"
#include "io/ifc_panes.h"
#include "io/model_builder.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

/// A face of a layered element whose normal lies within this cosine of the layers' axis shows an outer layer.
constexpr double kFacesLayer = 0.9;
/// Units within this share of each other are one.
constexpr double kSameUnit = 1e-3;

/// Names of materials, one for each surface that looks different.
class MaterialNames {
 public:
  explicit MaterialNames(const IfcBuilding& building, std::string file) : building_(building), file_(std::move(file)) {}

  std::string of_surface(std::optional<std::size_t> surface, const std::string& class_name, bool pane) {
    const Key key{surface.value_or(building_.surfaces.size()), pane};
    const auto known = names_.find(key);
    if (surface && known != names_.end()) return known->second;
    SourceMaterial told;
    told.told_by = "the surface colour of the IFC";
    told.gamma_removed = true;
    if (surface) {
      const IfcSurface& look = building_.surfaces[*surface];
      told.name = look.name;
      told.diffuse = look.colour;
      if (look.transparency > 0.0) told.opacity = 1.0 - look.transparency;
      told.file = file_;
      told.line = look.line;
    }
    if (told.name.empty()) told.name = pane ? "glass" : lower(class_name);
    if (pane) make_glass(told);
    return names_[key] = add(std::move(told));
  }

  std::vector<SourceMaterial> take() { return std::move(told_); }

 private:
  using Key = std::pair<std::size_t, bool>;

  /// The pane of a window lets light pass whatever colour its style has.
  static void make_glass(SourceMaterial& told) {
    told.told_by = "the pane of a window in the IFC";
    told.diffuse.reset();
    told.opacity = 0.0;
  }

  std::string add(SourceMaterial told) {
    const std::string plain = told.name;
    for (int count = 2;; ++count) {
      const auto same =
          std::find_if(told_.begin(), told_.end(), [&](const auto& other) { return other.name == told.name; });
      if (same == told_.end()) break;
      if (same->diffuse == told.diffuse && same->opacity == told.opacity) return told.name;
      told.name = fmt::format("{} ({})", plain, count);
    }
    told_.push_back(told);
    return told.name;
  }

  const IfcBuilding& building_;
  std::string file_;
  std::map<Key, std::string> names_;
  std::vector<SourceMaterial> told_;
};

class ModelWriter {
 public:
  ModelWriter(const IfcBuilding& building, const std::string& file)
      : building_(building), builder_(file), names_(building, file) {}

  void add_elements(double scale) {
    for (const IfcElement& element : building_.elements) {
      if (element.items.empty()) continue;
      const mesh::PartId part = builder_.part(part_name(element));
      for (const IfcItem& item : element.items) add(element, item, part, scale);
    }
  }

  void finish(ModelFile& file, const ModelFormat& format) {
    builder_.finish(file, {LengthUnit::kMetre, format.up}, std::nullopt);
    attach_materials(names_.take(), file);
  }

 private:
  /// "Level 1/Wall Outside", with the number of the entity where that is taken.
  std::string part_name(const IfcElement& element) {
    std::string name = element.storey.empty() ? element.class_name : element.storey + "/" + element.class_name;
    if (!element.name.empty()) name += " " + element.name;
    if (!parts_.insert(name).second) name += fmt::format(" #{}", element.id);
    return name;
  }

  void add(const IfcElement& element, const IfcItem& item, mesh::PartId part, double scale) {
    std::vector<std::uint32_t> index;
    for (const mesh::Point& p : item.body.points) {
      const mesh::Point at = element.placement(p);
      index.push_back(builder_.vertex({scale * at.x, scale * at.y, scale * at.z}, element.line));
    }
    const bool mirrored = element.placement.determinant() < 0.0;
    for (const auto& [a, b, c] : item.body.triangles) {
      const mesh::Vector normal = mesh::normalized(
          mesh::cross(item.body.points[b] - item.body.points[a], item.body.points[c] - item.body.points[a]));
      const std::array corners{index[a], index[mirrored ? c : b], index[mirrored ? b : c]};
      builder_.polygon(corners, material_of(element, item, normal), part, element.line);
    }
  }

  mesh::MaterialId material_of(const IfcElement& element, const IfcItem& item, const mesh::Vector& normal) {
    std::optional<std::size_t> surface = item.style;
    if (element.layers && !item.pane) {
      const double along = mesh::dot(normal, element.layers->axis);
      surface = along > kFacesLayer    ? element.layers->last
                : along < -kFacesLayer ? element.layers->first
                                       : element.layers->thickest;
      if (item.style && !building_.surfaces[*surface].colour) surface = item.style;
    }
    if (!surface || building_.surfaces[*surface].name.empty()) surface = element.material ? element.material : surface;
    return builder_.material(names_.of_surface(surface, element.class_name, item.pane));
  }

  const IfcBuilding& building_;
  ModelBuilder builder_;
  MaterialNames names_;
  std::set<std::string> parts_;
};

std::vector<ModelSpace> spaces_of(const IfcBuilding& building, double scale) {
  std::vector<ModelSpace> spaces;
  for (const IfcRoom& room : building.rooms) {
    ModelSpace space{room.name, {}, room.floor_area_m2, room.volume_m3};
    for (const mesh::Point& p : room.body.points) {
      const mesh::Point at = room.placement(p);
      space.boundary.vertices.push_back({scale * at.x, scale * at.y, scale * at.z});
    }
    space.boundary.material_names = {kUnnamed};
    space.boundary.part_names = {kUnnamed};
    for (const auto& corners : room.body.triangles) {
      space.boundary.begin_polygon(mesh::MaterialId(0U), mesh::PartId(0U));
      space.boundary.add_loop(corners);
    }
    spaces.push_back(std::move(space));
  }
  return spaces;
}

std::vector<ModelFixture> fixtures_of(const IfcBuilding& building, double scale) {
  std::vector<ModelFixture> fixtures;
  for (const IfcFixture& fixture : building.fixtures) {
    fixtures.push_back({fixture.type, fixture.name, fixture.placement});
    mesh::Point& at = fixtures.back().placement.origin;
    at = {scale * at.x, scale * at.y, scale * at.z};
  }
  return fixtures;
}

/// The program's unit that the file is in; metres for any that it has no word for.
LengthUnit unit_of(double metres_per_unit) {
  for (const LengthUnit unit :
       {LengthUnit::kMetre, LengthUnit::kCentimetre, LengthUnit::kMillimetre, LengthUnit::kInch, LengthUnit::kFoot})
    if (std::abs(metres_per(unit) / metres_per_unit - 1.0) < kSameUnit) return unit;
  return LengthUnit::kMetre;
}

ModelFile import_ifc(const std::filesystem::path& path, const ModelFormat& format) {
  IfcBuilding building = read_ifc_building(path);
  cut_openings(building);
  find_panes(building);
  // Bodies are in metres by the file's own unit; a unit that the user gives instead scales them.
  const double scale = format.unit ? metres_per(*format.unit) / building.metres_per_unit : 1.0;
  ModelFile file;
  file.format = building.schema;
  file.files.push_back(path);
  ModelWriter writer(building, path.string());
  writer.add_elements(scale);
  writer.finish(file, format);
  file.spaces = spaces_of(building, scale);
  file.fixtures = fixtures_of(building, scale);
  file.site = building.site;
  file.unit = format.unit.value_or(unit_of(building.metres_per_unit));
  file.unit_source = format.unit ? "as given" : "as the IFC says";
  file.notices = std::move(building.notices);
  return file;
}

}  // namespace

bool is_ifc(std::string_view head) {
  const std::size_t begin = head.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && head.substr(begin).starts_with("ISO-10303-21");
}

ModelFile read_ifc(const std::filesystem::path& path, const ModelFormat& format) {
  return read_in_child(path, format, &import_ifc);
}

}  // namespace clerestory::io
