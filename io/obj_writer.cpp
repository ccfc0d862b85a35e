// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/obj_writer.h"

#include <fmt/format.h>

#include <iterator>
#include <optional>

#include "io/whole_file.h"
#include "mesh/model_triangles.h"

namespace clerestory::io {

namespace {

/// What the rules for materials take for clear, of a glass whose transmittance alone is told.
std::optional<double> opacity_of(const SourceMaterial& material) {
  if (material.opacity || !material.transmittance_normal) return material.opacity;
  return 1.0 - *material.transmittance_normal;
}

std::string mtl_text(const WrittenModel& written) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const SourceMaterial& material : written.materials) {
    fmt::format_to(out, "newmtl {}\n", one_line(material.name));
    if (material.diffuse) fmt::format_to(out, "Kd {}\n", fmt::join(*material.diffuse, " "));
    if (const auto opacity = opacity_of(material)) fmt::format_to(out, "d {}\n", *opacity);
    if (material.shines || material.luminance_cd_m2) fmt::format_to(out, "Ke 1 1 1\n");
  }
  return text;
}

std::string obj_text(const mesh::Model& model, const std::string& mtl) {
  std::string text = fmt::format("# metres, z up\nmtllib {}\n", mtl);
  const auto out = std::back_inserter(text);
  for (const mesh::Point& p : model.vertices) fmt::format_to(out, "v {} {} {}\n", p.x, p.y, p.z);
  mesh::PartId part;
  mesh::MaterialId material;
  for (const std::size_t polygon : polygons_by_part(model)) {
    if (model.polygon_part[polygon] != part) {
      part = model.polygon_part[polygon];
      fmt::format_to(out, "o {}\n", one_line(model.part_names[part.index()]));
    }
    if (model.polygon_material[polygon] != material) {
      material = model.polygon_material[polygon];
      fmt::format_to(out, "usemtl {}\n", one_line(model.material_names[material.index()]));
    }
    text += 'f';
    for (const std::uint32_t corner : model.loop(polygon)) fmt::format_to(out, " {}", std::uint64_t{corner} + 1);
    text += '\n';
  }
  return text;
}

}  // namespace

std::vector<std::filesystem::path> write_obj(const std::filesystem::path& file, const WrittenModel& written) {
  const std::filesystem::path mtl = std::filesystem::path(file).replace_extension(".mtl");
  const mesh::Model model = cut_at_holes(written.model);
  write_whole_file(mtl, mtl_text(written));
  write_whole_file(file, obj_text(model, mtl.filename().string()));
  return {file, mtl};
}

}  // namespace clerestory::io
