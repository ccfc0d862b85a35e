// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "mesh/geometry.h"

namespace clerestory::io {

/// A layer of a drawing.
struct DxfLayer {
  std::string name;     ///< as first written; case does not count
  bool frozen = false;  ///< nothing of it shows, nor of the blocks inserted on it
  bool off = false;     ///< its own faces do not show
};

/// A block set into another one or into the model space, in rows and columns.
struct DxfInsert {
  std::string block;  ///< in lower case
  std::uint32_t layer = 0;
  mesh::Point at;  ///< as scale and rotation, in the axes that belong to the extrusion
  mesh::Vector scale{1.0, 1.0, 1.0};
  double rotation_deg = 0.0;
  std::int64_t columns = 1;
  std::int64_t rows = 1;
  double column_spacing = 0.0;
  double row_spacing = 0.0;
  mesh::Vector extrusion{0.0, 0.0, 1.0};  ///< of any length
  std::uint64_t line = 0;
};

/// The faces of the model space or of a block; polygon p has the corners [starts[p], starts[p+1]).
struct DxfContent {
  std::string name;  ///< of the block, as first written
  mesh::Point base;  ///< what an insert puts at its place
  std::vector<mesh::Point> points;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> starts{0};
  std::vector<std::uint32_t> layers;  ///< one a polygon
  std::vector<std::uint32_t> lines;   ///< one a polygon
  std::vector<DxfInsert> inserts;

  [[nodiscard]] std::size_t polygon_count() const { return starts.size() - 1; }
};

/// What a DXF file holds of surfaces.
struct DxfDrawing {
  std::int64_t unit_code = 0;  ///< $INSUNITS; 0 where the file does not say
  std::uint64_t unit_line = 0;
  std::vector<DxfLayer> layers;  ///< layer "0", whose faces take the layer of the insert, comes first
  std::unordered_map<std::string, DxfContent> blocks;  ///< by name in lower case
  DxfContent model_space;
  std::map<std::string, std::uint64_t> left_out;  ///< entities that are no faces, by type
  std::uint64_t faces_without_area = 0;           ///< faces with under three different corners, left out
  std::uint64_t smooth_meshes = 0;                ///< of MESH entities, those that are to be drawn smoothed
};

/// Reads 3DFACE, polyface and polygon meshes (POLYLINE), MESH and INSERT, in the drawing's own unit and coordinates. Paper space and
/// invisible entities are left out.
/// Throws InputError with the line for: a binary DXF, a file that breaks off, a code or number that is none, coordinates that are missing
/// or not finite, corners and counts that do not fit.
/// Source: Autodesk, DXF Reference, 2012.
DxfDrawing read_dxf_drawing(const std::filesystem::path& path);

}  // namespace clerestory::io
