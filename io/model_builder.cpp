// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model_builder.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "mesh/error.h"

namespace clerestory::io {

namespace {

/// File units: 1000 km in millimetres; squares and cubes of more mean nothing.
constexpr double kFarthestCoordinate = 1e9;
constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

bool is_far(double x) { return std::abs(x) > kFarthestCoordinate; }

}  // namespace

std::uint32_t ModelBuilder::vertex(const mesh::Point& p, std::uint64_t line) {
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
    throw InputError(file_, line, "a vertex has a coordinate that is no finite number",
                     "correct or remove this vertex");
  if (is_far(p.x) || is_far(p.y) || is_far(p.z))
    throw InputError(file_, line, fmt::format("the vertex {:g} {:g} {:g} lies beyond any building", p.x, p.y, p.z),
                     "correct or remove this vertex");
  if (model_.vertices.size() >= kUnused - 1)
    throw InputError(file_, line, "the model has more vertices than 32 bits count", "split it");
  model_.vertices.push_back(p);
  return static_cast<std::uint32_t>(model_.vertices.size() - 1);
}

void ModelBuilder::check_room(std::size_t corners, std::uint64_t line) const {
  if (model_.corners.size() + corners >= kUnused)
    throw InputError(file_, line, "the model has more corners than 32 bits count", "split it");
}

void ModelBuilder::polygon(std::span<const std::uint32_t> corners, mesh::MaterialId material, mesh::PartId part,
                           std::uint64_t line) {
  check_room(corners.size(), line);
  model_.begin_polygon(material, part, static_cast<std::uint32_t>(line <= kUnused ? line : 0));
  model_.add_loop(corners);
}

void ModelBuilder::hole(std::span<const std::uint32_t> corners) {
  check_room(corners.size(), model_.polygon_line.back());
  model_.add_loop(corners);
}

void ModelBuilder::finish(ModelFile& result, const ModelFormat& format, const std::optional<ToldUnit>& told,
                          UpAxis usual_up) {
  if (model_.polygon_count() == 0)
    throw InputError(file_, 0, "there is no face in this model", "export it with its surfaces, as polygons");
  check_corners();
  drop_unused_vertices();
  result.up = format.up.value_or(usual_up);
  choose_unit(result, format, told);
  model_.material_names = materials_.take();
  model_.part_names = parts_.take();
  for (const std::string& name : model_.material_names) {
    SourceMaterial material;
    material.name = name;
    result.materials.push_back(std::move(material));
  }
  to_metres_z_up(model_, result.unit, result.up);
  result.model = std::move(model_);
}

void ModelBuilder::check_corners() const {
  for (std::size_t polygon = 0; polygon < model_.polygon_count(); ++polygon) {
    for (std::size_t which = 0; which < model_.loop_count(polygon); ++which) {
      for (const std::uint32_t vertex : model_.loop(polygon, which)) {
        if (vertex < model_.vertices.size()) continue;
        throw InputError(file_, model_.polygon_line[polygon],
                         fmt::format("vertex {} does not exist: the model has {}", std::uint64_t{vertex} + 1,
                                     model_.vertices.size()),
                         "correct or remove this face; was the file cut off?");
      }
    }
  }
}

void ModelBuilder::drop_unused_vertices() {
  std::vector<std::uint32_t> new_index(model_.vertices.size(), kUnused);
  for (const std::uint32_t vertex : model_.corners) new_index[vertex] = 0;
  std::uint32_t kept = 0;
  for (std::size_t vertex = 0; vertex < new_index.size(); ++vertex) {
    if (new_index[vertex] == kUnused) continue;
    model_.vertices[kept] = model_.vertices[vertex];
    new_index[vertex] = kept++;
  }
  model_.vertices.resize(kept);
  for (std::uint32_t& vertex : model_.corners) vertex = new_index[vertex];
  renumber_tags(new_index);
}

void ModelBuilder::renumber_tags(std::span<const std::uint32_t> new_index) {
  mesh::SubdivisionTags& tags = model_.tags;
  for (auto& crease : tags.creases) crease.edge = {new_index[crease.edge[0]], new_index[crease.edge[1]]};
  for (auto& corner : tags.corners) corner.vertex = new_index[corner.vertex];
  std::erase_if(tags.creases,
                [](const auto& crease) { return crease.edge[0] == kUnused || crease.edge[1] == kUnused; });
  std::erase_if(tags.corners, [](const auto& corner) { return corner.vertex == kUnused; });
}

/// "The unit of length is m, as line 1 of the model says: 6 x 8 x 3 m."
void ModelBuilder::choose_unit(ModelFile& result, const ModelFormat& format,
                               const std::optional<ToldUnit>& told) const {
  if (format.unit) {
    result.unit = *format.unit;
    result.unit_source = "as given";
    return;
  }
  mesh::Box box;
  for (const mesh::Point& p : model_.vertices) box.add(p);
  const mesh::Vector size = box.size();
  const double height = result.up == UpAxis::kZ ? size.z : size.y;
  const double depth = result.up == UpAxis::kZ ? size.y : size.z;
  result.unit = told ? told->unit : guess_unit(height);
  result.unit_source = told ? told->where : "guessed from the model's size";
  const double scale = metres_per(result.unit);
  const std::string why = told ? fmt::format("is {}, {}", unit_word(result.unit), told->where)
                               : fmt::format("was taken as {} from the model's size", unit_word(result.unit));
  result.notices.push_back(
      fmt::format("The unit of length {}: {:.4g} x {:.4g} x {:.4g} m. Set model.units where that is wrong.", why,
                  scale * size.x, scale * depth, scale * height));
}

void attach_materials(std::vector<SourceMaterial> told, ModelFile& result) {
  std::unordered_map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < result.materials.size(); ++i) index.emplace(result.materials[i].name, i);
  for (SourceMaterial& material : told) {
    if (material.name.empty()) material.name = kUnnamed;
    const auto used = index.find(material.name);
    if (used == index.end()) {
      result.unused_materials.push_back(material.name);
    } else {
      result.materials[used->second] = std::move(material);
    }
  }
}

}  // namespace clerestory::io
