// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/simple_pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "mesh/disjoint_sets.h"

namespace clerestory::mesh {

namespace {

using Loop = std::vector<std::uint32_t>;

/// Corners of a piece up to which it grows, so that joining costs no more for polygons with very many holes.
constexpr std::size_t kMostCorners = 64;

/// An edge between two triangles.
struct Seam {
  double height = 0.0;  ///< of the lower triangle over the edge [m]
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t left = 0;   ///< triangle
  std::uint32_t right = 0;  ///< triangle

  [[nodiscard]] auto key() const { return std::tuple(height, from, to); }
};

double height_over(const PlanarMesh& mesh, std::uint32_t from, std::uint32_t to, std::uint32_t triangle) {
  const auto& [i, j, k] = mesh.triangles[triangle].vertices;
  const Point2& a = mesh.points[from];
  const Point2& b = mesh.points[to];
  return doubled_area(mesh.points[i], mesh.points[j], mesh.points[k]) / std::hypot(b.x - a.x, b.y - a.y);
}

/// All seams, those of the lowest triangles first.
std::vector<Seam> seams_of(const PlanarMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> left_of;
  std::vector<Seam> seams;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t].vertices;
    for (std::size_t k = 0; k < 3; ++k) left_of[{corners[k], corners[(k + 1) % 3]}] = t;
  }
  for (const auto& [edge, left] : left_of) {
    const auto& [from, to] = edge;
    const auto other = left_of.find({to, from});
    if (from > to || other == left_of.end()) continue;
    const double height = std::min(height_over(mesh, from, to, left), height_over(mesh, from, to, other->second));
    seams.push_back({height, from, to, left, other->second});
  }
  std::sort(seams.begin(), seams.end(), [](const Seam& a, const Seam& b) { return a.key() < b.key(); });
  return seams;
}

/// Two loops as one, without the edge that one walks from `from` to `to` and the other back; nothing where they have more than its two
/// ends in common.
Loop joined(Loop a, Loop b, std::uint32_t from, std::uint32_t to) {
  const auto is_shared = [&](std::uint32_t corner) { return std::find(a.begin(), a.end(), corner) != a.end(); };
  if (a.size() + b.size() > kMostCorners || std::count_if(b.begin(), b.end(), is_shared) != 2) return {};
  std::rotate(a.begin(), std::find(a.begin(), a.end(), to), a.end());
  std::rotate(b.begin(), std::find(b.begin(), b.end(), from), b.end());
  // Now a goes from `to` to `from`, and b from `from` to `to`.
  a.insert(a.end(), b.begin() + 1, b.end() - 1);
  return a;
}

}  // namespace

std::vector<Loop> simple_pieces(const PlanarMesh& mesh) {
  std::vector<Loop> loops;
  for (const PlanarTriangle& t : mesh.triangles) loops.emplace_back(t.vertices.begin(), t.vertices.end());
  DisjointSets<std::uint32_t> pieces(loops.size());
  for (const Seam& seam : seams_of(mesh)) {
    const std::uint32_t left = pieces.root(seam.left);
    const std::uint32_t right = pieces.root(seam.right);
    Loop both = joined(loops[left], loops[right], seam.from, seam.to);
    if (both.empty()) continue;
    loops[left].clear();
    loops[right].clear();
    pieces.join(left, right);
    loops[pieces.root(left)] = std::move(both);
  }
  std::erase_if(loops, [](const Loop& loop) { return loop.empty(); });
  return loops;
}

}  // namespace clerestory::mesh
