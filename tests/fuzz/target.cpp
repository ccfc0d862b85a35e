// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/target.h"

#include <cstdlib>
#include <fstream>
#include <iostream>

#include "mesh/error.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::fuzz {

namespace {

void demand(bool holds, const char* what) {
  if (holds) return;
  std::cerr << "does not hold: " << what << '\n';
  std::abort();
}

void check_polygon(const mesh::Model& model, std::size_t polygon) {
  demand(model.polygon_material[polygon].index() < model.material_names.size(), "materials exist");
  demand(model.polygon_part[polygon].index() < model.part_names.size(), "parts exist");
  for (std::size_t loop = 0; loop < model.loop_count(polygon); ++loop) {
    demand(model.loop(polygon, loop).size() >= 3, "loops have three corners");
    for (const std::uint32_t corner : model.loop(polygon, loop))
      demand(corner < model.vertices.size(), "corners exist");
  }
}

}  // namespace

std::filesystem::path folder() {
  static test::ScratchFolder scratch;
  return scratch.path();
}

int read_bytes(const std::uint8_t* data, std::size_t size, const std::string& name,
               const std::function<void(const std::filesystem::path&)>& read) {
  const std::filesystem::path file = folder() / name;
  std::filesystem::remove(file);  // a file that is cut to nothing and written anew is flushed to the disk by ext4
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    read(file);
  } catch (const InputError& error) {
    const std::string text = error.what();
    demand(!text.empty() && text.find_first_of("\r\n") == std::string::npos, "a refusal has one line");
  }
  return 0;
}

void check(const io::ModelFile& file) {
  const mesh::Model& model = file.model;
  demand(model.polygon_count() > 0, "a model has polygons");
  demand(file.materials.size() == model.material_names.size(), "each material is described");
  for (const mesh::Point& p : model.vertices) demand(mesh::is_finite(p), "coordinates are finite");
  for (std::size_t polygon = 0; polygon < model.polygon_count(); ++polygon) check_polygon(model, polygon);
}

}  // namespace clerestory::fuzz
