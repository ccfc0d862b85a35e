// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/face_loops.h"

#include <array>
#include <map>
#include <utility>

namespace clerestory::mesh {

namespace {

using Directed = std::pair<std::uint32_t, std::uint32_t>;

/// What comes after an edge on the way round the triangles: the boundary edge that is met by turning about the edge's end through the
/// triangles on its left. So a loop never leaps over a vertex that it only touches.
class BoundaryWalk {
 public:
  explicit BoundaryWalk(std::span<const Triangle> triangles) {
    for (const Triangle& t : triangles) {
      for (std::size_t k = 0; k < 3; ++k) opposite_[{t.vertices[k], t.vertices[(k + 1) % 3]}] = t.vertices[(k + 2) % 3];
    }
  }

  [[nodiscard]] bool on_boundary(const Directed& edge) const { return !opposite_.contains({edge.second, edge.first}); }

  [[nodiscard]] Directed next(Directed edge) const {
    const std::uint32_t pivot = edge.second;
    for (;;) {
      const Directed out{pivot, opposite_.at(edge)};
      if (on_boundary(out)) return out;
      edge = {out.second, out.first};
    }
  }

  [[nodiscard]] const std::map<Directed, std::uint32_t>& edges() const { return opposite_; }

 private:
  std::map<Directed, std::uint32_t> opposite_;  ///< the third vertex of the triangle on the left of an edge
};

}  // namespace

std::vector<std::vector<std::uint32_t>> boundary_loops(std::span<const Triangle> triangles) {
  const BoundaryWalk walk(triangles);
  std::map<Directed, bool> done;
  std::vector<std::vector<std::uint32_t>> loops;
  for (const auto& [first, opposite] : walk.edges()) {
    if (!walk.on_boundary(first) || done[first]) continue;
    std::vector<std::uint32_t> loop;
    for (Directed edge = first; !done[edge]; edge = walk.next(edge)) {
      done[edge] = true;
      loop.push_back(edge.first);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace clerestory::mesh
