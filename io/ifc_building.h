// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/model_file.h"
#include "mesh/affine.h"
#include "mesh/solids.h"

// Private to io/: what the IFC reader hands from stage to stage, free of the parser's types.
namespace clerestory::io {

/// A surface style or a material.
struct IfcSurface {
  std::string name;                             ///< empty where the file gives none
  std::optional<std::array<double, 3>> colour;  ///< linear
  double transparency = 0.0;                    ///< 1 invisible
  std::uint64_t line = 0;

  bool operator==(const IfcSurface&) const = default;
};

/// A body of an element, in the element's coordinates [m].
struct IfcItem {
  mesh::Solid body;
  std::optional<std::size_t> style;  ///< a surface
  bool pane = false;                 ///< of a window: lets light pass
};

/// The layers that an element is built of, as surfaces.
struct IfcLayers {
  mesh::Vector axis;  ///< from the first layer to the last, in the element's coordinates
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t thickest = 0;
};

struct IfcElement {
  int id = 0;
  std::uint64_t line = 0;
  std::string class_name;  ///< without "Ifc": "Wall", "Window"
  std::string name;
  std::string storey;
  mesh::Affine placement;  ///< from the element's coordinates to the model's
  std::vector<IfcItem> items;
  std::optional<IfcLayers> layers;
  std::optional<std::size_t> material;  ///< a surface
  std::vector<std::size_t> openings;    ///< that are cut from it
  std::optional<std::size_t> fills;     ///< the opening that it stands in
  std::optional<std::size_t> whole;     ///< the element that it is a part of
  std::optional<double> stated_volume_m3;
  double width_m = 0.0;   ///< of a window's opening, 0 where not stated
  double height_m = 0.0;  ///< as width_m
};

struct IfcOpening {
  int id = 0;
  mesh::Affine placement;
  std::vector<mesh::Solid> bodies;      ///< in its own coordinates [m]
  std::optional<mesh::Vector> through;  ///< the way that it goes through what it was cut from, in its own coordinates
};

struct IfcRoom {
  std::string name;
  mesh::Affine placement;
  mesh::Solid body;  ///< in its own coordinates [m]
  std::optional<double> floor_area_m2;
  std::optional<double> volume_m3;
};

/// An IfcLightFixture, or an IfcFlowTerminal whose type is one.
struct IfcFixture {
  std::string type;  ///< the name of its type, else its ObjectType, else its name
  std::string name;
  mesh::Affine placement;  ///< to the model's coordinates [m]
};

/// A building as an IFC file tells it: bodies uncut, half-spaces apart.
struct IfcBuilding {
  std::string schema;  ///< "IFC2X3", "IFC4"
  std::vector<IfcSurface> surfaces;
  std::vector<IfcElement> elements;  ///< in the order of their ids, those without a body too
  std::vector<IfcOpening> openings;
  std::vector<IfcRoom> rooms;
  std::vector<IfcFixture> fixtures;  ///< in the order of their ids
  ModelSite site;
  double metres_per_unit = 1.0;
  std::vector<std::string> notices;  ///< what was lost, one sentence each
};

/// Parses a file and converts the bodies in it. Throws InputError for a file that is no IFC2X3 or IFC4, is cut off, or holds no
/// element. Changes LC_NUMERIC while it works, with a library that may crash: for a child process.
IfcBuilding read_ifc_building(const std::filesystem::path& path);

}  // namespace clerestory::io
