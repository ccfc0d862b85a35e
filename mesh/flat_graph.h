// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "mesh/triangulate.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Segments between some of a mesh's vertices as a graph in a plane, which has points of its own numbers.
class FlatGraph {
 public:
  /// @param points  of the mesh; they are read by add(), not later
  FlatGraph(std::span<const Point> points, const PlaneCoordinates& plane) : points_(points), plane_(plane) {}

  /// Adds the segment from one vertex to another.
  /// @return its ends as points of the graph
  std::array<std::uint32_t, 2> add(std::uint32_t from, std::uint32_t to) {
    const std::uint32_t first = number(from);
    graph_.segments.push_back({first, number(to)});
    return graph_.segments.back();
  }

  [[nodiscard]] const PlanarGraph& graph() const { return graph_; }
  /// [points of the graph] The vertex that each is, in the order in which they came.
  [[nodiscard]] const std::vector<std::uint32_t>& vertices() const { return vertices_; }

 private:
  std::uint32_t number(std::uint32_t vertex) {
    const auto [place, fresh] = numbers_.try_emplace(vertex, static_cast<std::uint32_t>(vertices_.size()));
    if (fresh) {
      vertices_.push_back(vertex);
      graph_.points.push_back(plane_.project(points_[vertex]));
    }
    return place->second;
  }

  std::span<const Point> points_;
  PlaneCoordinates plane_;
  PlanarGraph graph_;
  std::vector<std::uint32_t> vertices_;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers_;
};

}  // namespace clerestory::mesh
