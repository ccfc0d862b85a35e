// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/source_material.h"
#include "io/units.h"
#include "mesh/affine.h"
#include "mesh/model.h"

namespace clerestory::io {

/// What a model file may leave open.
struct ModelFormat {
  std::optional<LengthUnit> unit = {};  ///< none: what the file says, else guessed from the size
  std::optional<UpAxis> up = {};        ///< none: what the file says, else what its format is used with, else z
};

/// A volume that a file calls a room, as IfcSpace does: it blocks no light.
struct ModelSpace {
  std::string name;
  mesh::Model boundary;  ///< closed polygons [m, z up, model coordinates]; materials and parts mean nothing
  std::optional<double> floor_area_m2;  ///< as the file states it
  std::optional<double> volume_m3;      ///< as the file states it
};

/// Where a file says that the building stands.
struct ModelSite {
  std::optional<double> latitude_deg;   ///< north
  std::optional<double> longitude_deg;  ///< east
  std::optional<double> north_deg;      ///< of true north, from +y, counter-clockwise
};

/// A light fixture that a file places, whose light a study maps to a photometric file. What body it has is part of the model as any other.
struct ModelFixture {
  std::string type;  ///< the name of its type, else what it is said to be, else its own name
  std::string name;
  mesh::Affine placement;  ///< from the fixture's coordinates, in which it shines along -z, to the model's [m]
};

/// A model file as read, with all files that it names.
struct ModelFile {
  std::string format;                     ///< "OBJ", "IFC4", …
  mesh::Model model;                      ///< metres, z up; only vertices that a polygon uses
  std::vector<SourceMaterial> materials;  ///< one a model material, in the model's order
  /// Names that the file defines and no polygon uses.
  std::vector<std::string> unused_materials;
  std::vector<ModelSpace> spaces;
  std::vector<ModelFixture> fixtures;
  ModelSite site;
  LengthUnit unit = LengthUnit::kMetre;  ///< that was taken
  std::string unit_source;               ///< "as line 1 of the model says", "guessed from the model's size", "as given"
  UpAxis up = UpAxis::kZ;                ///< that was taken
  std::vector<std::string> notices;      ///< how the unit was found, what was left out; one sentence each
  std::vector<std::filesystem::path> files;  ///< that were read, the model first
};

/// Reads a model of any format that the program knows: by the file's content where that tells, else by its extension.
/// Throws InputError with file and line for what is wrong with it, an unknown format included.
ModelFile read_model(const std::filesystem::path& path, const ModelFormat& format = {});

/// The formats' names and extensions, for messages and help: "OBJ (.obj)", …
std::vector<std::string> model_format_words();

}  // namespace clerestory::io
