// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mesh/geometry.h"
#include "mesh/ids.h"
#include "mesh/subdivision_tags.h"

namespace clerestory::mesh {

struct Curvature;

/// Polygons with parts and materials by name, as a file gave them; metres, z up.
/// A polygon has one outer loop and any number of holes. Structure of arrays: polygon p has the loops
/// [polygon_starts[p], polygon_starts[p+1]), loop l the corners [loop_starts[l], loop_starts[l+1]),
/// a corner is an index into vertices. Both start arrays end with the total, and hold one 0 when empty.
struct Model {
  std::vector<Point> vertices;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> loop_starts{0};
  std::vector<std::uint32_t> polygon_starts{0};
  std::vector<MaterialId> polygon_material;
  std::vector<PartId> polygon_part;
  std::vector<std::uint32_t> polygon_line;  ///< line in the source file, 0 where unknown
  std::vector<std::string> material_names;
  std::vector<std::string> part_names;
  SubdivisionTags tags;  ///< of polygons that are control cages, as the file gave them
  /// Which triangles stand for pieces of limit surfaces, once subdivide() has replaced cages; shared by the surfaces made of the model.
  std::shared_ptr<const Curvature> curvature;

  [[nodiscard]] std::size_t polygon_count() const { return polygon_starts.size() - 1; }
  [[nodiscard]] std::size_t loop_count(std::size_t polygon) const {
    return polygon_starts[polygon + 1] - polygon_starts[polygon];
  }
  /// Corners of one loop of a polygon, the outer one first.
  [[nodiscard]] std::span<const std::uint32_t> loop(std::size_t polygon, std::size_t which = 0) const {
    const std::size_t l = polygon_starts[polygon] + which;
    return std::span(corners).subspan(loop_starts[l], loop_starts[l + 1] - loop_starts[l]);
  }

  /// Begins a polygon; its loops follow by add_loop.
  void begin_polygon(MaterialId material, PartId part, std::uint32_t line = 0) {
    polygon_starts.push_back(polygon_starts.back());
    polygon_material.push_back(material);
    polygon_part.push_back(part);
    polygon_line.push_back(line);
  }
  void add_loop(std::span<const std::uint32_t> loop_corners) {
    corners.insert(corners.end(), loop_corners.begin(), loop_corners.end());
    loop_starts.push_back(static_cast<std::uint32_t>(corners.size()));
    ++polygon_starts.back();
  }
};

}  // namespace clerestory::mesh
