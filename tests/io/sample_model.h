// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "io/model_file.h"

namespace clerestory::test {

/// A slab, and a wall with a hole, with something in every field of a ModelFile.
inline io::ModelFile sample_model_file() {
  io::ModelFile file;
  file.format = "IFC4";
  mesh::Model& model = file.model;
  model.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}, {0, 0, 3},
                    {4, 0, 3}, {1, 0, 1}, {2, 0, 1}, {2, 0, 2}, {1, 0, 2}};
  model.material_names = {"concrete", "glass"};
  model.part_names = {"slab", "wall"};
  model.begin_polygon(mesh::MaterialId(0U), mesh::PartId(0U), 3);
  model.add_loop(std::array<std::uint32_t, 4>{0, 1, 2, 3});
  model.begin_polygon(mesh::MaterialId(1U), mesh::PartId(1U), 4);
  model.add_loop(std::array<std::uint32_t, 4>{0, 1, 5, 4});
  model.add_loop(std::array<std::uint32_t, 4>{6, 9, 8, 7});
  io::SourceMaterial concrete;
  concrete.name = "concrete";
  concrete.file = "house.ifc";
  concrete.line = 7;
  concrete.told_by = "IFC's surface colour";
  concrete.photometric = true;
  concrete.diffuse = {0.1, 0.2, 0.3};
  concrete.specular = 0.04;
  concrete.textured = true;
  io::SourceMaterial glass;
  glass.name = "glass";
  glass.gamma_removed = true;
  glass.opacity = 0.25;
  glass.transmittance_normal = 0.6;
  glass.translucent = 0.1;
  glass.luminance_cd_m2 = 1000.0;
  glass.shines = true;
  file.materials = {concrete, glass};
  file.unused_materials = {"brick"};
  io::ModelSpace room;
  room.name = "kitchen";
  room.boundary.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  room.boundary.begin_polygon({}, {});
  room.boundary.add_loop(std::array<std::uint32_t, 3>{0, 1, 2});
  room.floor_area_m2 = 12.5;
  file.spaces = {room};
  file.site.latitude_deg = 48.1;
  file.unit = io::LengthUnit::kFoot;
  file.unit_source = "as the IFC says";
  file.up = io::UpAxis::kY;
  file.notices = {"The unit of length is ft."};
  file.files = {"house.ifc", "wall \xc3\xa4.bin"};
  return file;
}

}  // namespace clerestory::test
