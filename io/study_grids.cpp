// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "io/pts.h"
#include "io/study_tables.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 100;  // with any ending, a file name that every file system takes

/// Names of results that are there whatever the grids are called.
constexpr std::array<std::string_view, 8> kOtherResults{"summary", "surfaces", "discontinuities", "solution",
                                                        "result",  "previous", "leaks",           "observers"};

bool model_has(const mesh::Model& model, const std::string& pattern) {
  const auto fits = [&](const std::string& name) { return name == pattern || matches_glob(pattern, name); };
  return std::any_of(model.part_names.begin(), model.part_names.end(), fits) ||
         std::any_of(model.material_names.begin(), model.material_names.end(), fits);
}

void add_surface(const StudyValue& value, const mesh::Model& model, lighting::GridRequest& grid) {
  const std::string& name = value.text;
  if (name != "rooms" && !model_has(model, name)) {
    std::vector<std::string> names = model.part_names;
    names.insert(names.end(), model.material_names.begin(), model.material_names.end());
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    const auto meant = nearest(name, names);
    throw value.error(fmt::format("the model has no part and no material {}", in_quotes(name)),
                      meant ? fmt::format("did you mean \"{}\"?", printable(*meant)) : "it has " + list_names(names));
  }
  grid.surfaces.push_back(name);
}

void read_points(const StudyValue& table, const StudyValue& file, StudyPlace& place, lighting::GridRequest& grid) {
  for (const StudyValue& member : table.children) {
    if (member.key != "name" && member.key != "points" && member.key != "direction" && member.key != "modelling")
      throw member.error(fmt::format("a grid of given points has no {}", member.key), "remove it, or remove points");
  }
  const fs::path path = place.folder / file.text;
  std::error_code error;
  if (!fs::exists(path, error))
    throw file.error(fmt::format("there is no sensor file {}", in_quotes(path.string())),
                     "paths are relative to the study file");
  SensorPoints sensors = read_pts(path);
  grid.points = std::move(sensors.points);
  grid.normals = std::move(sensors.normals);
  grid.points_file = path.string();
  place.files.push_back(path);
}

void read_layout(const StudyValue& table, const mesh::Model& model, lighting::GridRequest& grid) {
  const StudyValue& surface = *table.find("surface");
  if (surface.kind == StudyValue::Kind::kText) {
    add_surface(surface, model, grid);
  } else {
    for (const StudyValue& item : surface.children) add_surface(item, model, grid);
  }
  grid.height_m = number_or(table, "height", 0.8);
  grid.en12464_spacing = table.find("spacing")->kind == StudyValue::Kind::kText;
  grid.spacing_m = number_or(table, "spacing", 0.25);
  if (table.find("margin")->is_number()) grid.margin_m = table.find("margin")->number;
}

/// Horizontal, towards a point of the compass [degrees from north to east].
mesh::Vector towards(double azimuth_deg, double north_deg) {
  const double angle = (90.0 + north_deg - azimuth_deg) * std::numbers::pi / 180.0;
  return {std::cos(angle), std::sin(angle), 0.0};
}

void read_direction(const StudyValue& table, double north_deg, lighting::GridRequest& grid) {
  constexpr std::array<std::pair<std::string_view, double>, 4> kCompass{
      {{"north", 0.0}, {"east", 90.0}, {"south", 180.0}, {"west", 270.0}}};
  const StudyValue* value = table.find("direction");
  if (value == nullptr) return;
  if (value->kind == StudyValue::Kind::kText) {
    grid.direction = value->text;
    grid.cylindrical = value->text == "cylindrical";
    for (const auto& [word, azimuth_deg] : kCompass)
      if (value->text == word) grid.look = towards(azimuth_deg, north_deg);
    return;
  }
  const auto v = numbers_of(*value, 3, "direction = [0, 1, 0]");
  const mesh::Vector look{v[0], v[1], v[2]};
  if (!(norm(look) > 1e-12)) throw value->error("the direction of this grid is zero", "write direction = [0, 1, 0]");
  grid.look = normalized(look);
  grid.direction = fmt::format("[{:g}, {:g}, {:g}]", v[0], v[1], v[2]);
}

void read_modelling(const StudyValue& table, lighting::GridRequest& grid) {
  grid.modelling = flag_or(table, "modelling", false);
  if (grid.modelling && grid.direction != "surface")
    throw table.find("modelling")->error("modelling is told of level sensors", "leave out direction");
}

/// Whether nobody asked for this grid, but at most for its spacing and the like on the command line: each room gets one then.
bool is_default(const StudyValue& grid) {
  const bool in_study = !grid.file.empty() && !grid.file.starts_with("--set ");
  return !in_study && grid.find("name")->file.empty() && grid.find("surface")->file.empty();
}

}  // namespace

void check_result_name(const StudyValue& table, std::string_view what, const std::string& name,
                       std::set<std::string>& taken) {
  const StudyValue* value = table.find("name");
  const StudyValue& at = value->file.empty() ? table : *value;
  const bool unfit =
      name.empty() || name.size() > kLongestName || name.front() == '.' ||
      name.find_first_of("/\\<>:\"|?*") != std::string::npos ||
      std::any_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }) ||
      trim(name) != name;
  if (unfit)
    throw at.error(fmt::format("the {}'s name {} cannot name a file", what, in_quotes(name)),
                   "use letters, digits, - and _");
  if (std::find(kOtherResults.begin(), kOtherResults.end(), lower(name)) != kOtherResults.end())
    throw at.error(fmt::format("the {}'s name {} belongs to another result", what, in_quotes(name)),
                   "choose another name");
  if (!taken.insert(lower(name)).second)
    throw at.error(fmt::format("two {}s have the name {}", what, in_quotes(name)), "give each a name of its own");
}

void read_grids_table(const StudyValue& root, StudyPlace& place, lighting::Study& study) {
  std::set<std::string> taken;
  for (const StudyValue& table : root.find("grids")->children) {
    lighting::GridRequest grid;
    grid.name = text_or(table, "name", "workplane");
    check_result_name(table, "grid", grid.name, taken);
    if (const StudyValue* points = table.find("points")) {
      read_points(table, *points, place, grid);
    } else {
      read_layout(table, study.model, grid);
      grid.by_room = is_default(table);
    }
    read_direction(table, study.north_deg, grid);
    read_modelling(table, grid);
    study.grids.push_back(std::move(grid));
  }
}

}  // namespace clerestory::io
