// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/smooth_regions.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

namespace clerestory::mesh {

namespace {

/// A triangle's edge in the shape, by whom it belongs to.
struct EdgeOfRegion {
  std::array<std::uint32_t, 2> edge{};
  std::uint32_t face = 0;
  std::uint32_t region = 0;
};

/// All edges of curved faces' regions that are no diagonals, and those of other faces.
std::vector<EdgeOfRegion> constrained_edges(const Faces& faces) {
  std::vector<EdgeOfRegion> edges;
  for (std::uint32_t f = 0; f < faces.count(); ++f) {
    for (const Triangle& t : faces.shape.of(FaceId(f))) {
      for (std::size_t k = 0; k < 3; ++k) {
        if ((t.constrained >> k & 1U) == 0) continue;
        const std::uint32_t a = t.vertices[k];
        const std::uint32_t b = t.vertices[(k + 1) % 3];
        edges.push_back({{std::min(a, b), std::max(a, b)}, f, t.region});
      }
    }
  }
  std::sort(edges.begin(), edges.end(), [](const EdgeOfRegion& a, const EdgeOfRegion& b) {
    return std::tie(a.edge, a.face, a.region) < std::tie(b.edge, b.face, b.region);
  });
  return edges;
}

bool are_one_part(const Face& a, const Face& b) {
  return !a.facets.empty() && !b.facets.empty() && a.part == b.part && a.material == b.material;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> smooth_regions(const Faces& faces) {
  std::vector<std::vector<std::uint32_t>> number(faces.count());
  std::uint32_t count = 0;
  for (std::uint32_t f = 0; f < faces.count(); ++f) {
    if (faces.faces[f].facets.empty()) continue;
    std::uint32_t regions = 0;
    for (const Triangle& t : faces.shape.of(FaceId(f))) regions = std::max(regions, t.region + 1);
    for (std::uint32_t r = 0; r < regions; ++r) number[f].push_back(count++);
  }
  std::vector<std::uint32_t> owner(count);
  std::iota(owner.begin(), owner.end(), 0U);
  const auto find = [&](std::uint32_t i) {
    while (owner[i] != i) i = owner[i] = owner[owner[i]];
    return i;
  };
  const std::vector<EdgeOfRegion> edges = constrained_edges(faces);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].edge == edges[i].edge) ++end;
    if (end - i == 2 && edges[i].face != edges[i + 1].face &&
        are_one_part(faces.faces[edges[i].face], faces.faces[edges[i + 1].face])) {
      owner[find(number[edges[i].face][edges[i].region])] = find(number[edges[i + 1].face][edges[i + 1].region]);
    }
    i = end;
  }
  for (std::vector<std::uint32_t>& of_face : number) {
    for (std::uint32_t& n : of_face) n = find(n);
  }
  return number;
}

}  // namespace clerestory::mesh
