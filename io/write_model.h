// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/source_material.h"
#include "mesh/model.h"

namespace clerestory::io {

/// A model to be written: metres, z up.
struct WrittenModel {
  const mesh::Model& model;
  std::span<const SourceMaterial> materials;  ///< what is told of the model's materials, in its order
};

/// Writes a model in the format that the file's extension names, and gives the files written, the model first. All keep the names of
/// parts and materials, and say metres and z up where the format does not.
/// .obj: with the materials in an .mtl beside it; numbers come back to the last bit; polygons with holes as triangles.
/// .ply: binary, in double; `part` and `material` a face, their names as comments; polygons with holes as triangles.
/// .gltf (with a .bin beside it) and .glb: triangles in single precision around a centre, which a node places.
/// .vtp: VTK XML polygons in double; `part` and `material` a cell, `part_names` and `material_names` as field arrays; polygons with
/// holes as triangles.
/// Throws InputError for any other extension and MachineError when a file cannot be written whole.
std::vector<std::filesystem::path> write_model(const std::filesystem::path& file, const WrittenModel& written);

/// The files that write_model() writes for a model, the model first. Throws its InputError, for a check before long work.
std::vector<std::filesystem::path> model_files(const std::filesystem::path& file);

/// The polygons by part, then by material, each in the model's order.
std::vector<std::size_t> polygons_by_part(const mesh::Model& model);

/// A name without control characters, so that it stands in one line.
std::string one_line(const std::string& name);

}  // namespace clerestory::io
