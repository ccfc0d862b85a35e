// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/straight_vertices.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <utility>
#include <vector>

namespace clerestory::mesh {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// How far a vertex may lie beside the line that does without it [m]: rounding of coordinates as files write them, and much less than the
/// distance at which vertices are one.
constexpr double kStraight = 1e-6;

/// What the faces' boundaries do at a vertex.
struct Passed {
  std::array<std::uint32_t, 2> neighbours{kNone, kNone};
  bool ends = false;  ///< more than two lines meet here, or a face that keeps its vertices has it

  void add(std::uint32_t neighbour) {
    if (neighbours[0] == neighbour || neighbours[1] == neighbour) return;
    if (neighbours[0] == kNone) {
      neighbours[0] = neighbour;
    } else if (neighbours[1] == kNone) {
      neighbours[1] = neighbour;
    } else {
      ends = true;
    }
  }
  [[nodiscard]] std::uint32_t beyond(std::uint32_t from) const { return neighbours[neighbours[0] == from ? 1 : 0]; }
};

double distance_to(const Point& a, const Point& b, const Point& p) {
  const Vector line = b - a;
  const double size2 = dot(line, line);
  const double along = size2 > 0.0 ? std::clamp(dot(p - a, line) / size2, 0.0, 1.0) : 0.0;
  return norm(p - (a + along * line));
}

class Straightening {
 public:
  Straightening(FaceDrafts& drafts, std::span<const std::uint8_t> stays)
      : drafts_(drafts), points_(drafts.vertices.points()), passed_(points_.size()), kept_(points_.size(), 0) {
    for (std::size_t f = 0; f < drafts.faces.size(); ++f) {
      for (const auto& [a, b] : drafts.faces[f].boundary) {
        passed_[a].add(b);
        passed_[b].add(a);
        if (stays[f] != 0) passed_[a].ends = passed_[b].ends = true;
      }
    }
    for (Passed& passed : passed_) passed.ends = passed.ends || passed.neighbours[1] == kNone;
  }

  void run() {
    std::vector<std::uint8_t> reached(points_.size(), 0);
    for (std::uint32_t v = 0; v < passed_.size(); ++v) {
      if (passed_[v].ends) reached[v] = kept_[v] = 1;
    }
    for (const FaceDraft& face : drafts_.faces) {
      for (const auto& [a, b] : face.boundary) {
        if (passed_[a].ends && reached[b] == 0) keep_corners(way_from(a, b, reached));
      }
    }
    for (std::uint32_t v = 0; v < passed_.size(); ++v) {
      if (reached[v] == 0) keep_corners(way_round(v, reached));
    }
    if (std::find(kept_.begin(), kept_.end(), 0) != kept_.end()) drop_others();
  }

 private:
  /// From a vertex where lines end to the next such vertex, both included.
  std::vector<std::uint32_t> way_from(std::uint32_t end, std::uint32_t next, std::vector<std::uint8_t>& reached) const {
    std::vector<std::uint32_t> way{end};
    while (!passed_[next].ends) {
      reached[next] = 1;
      way.push_back(next);
      next = passed_[next].beyond(way[way.size() - 2]);
    }
    way.push_back(next);
    return way;
  }

  /// Round a line that ends nowhere, from a corner of it and back to there.
  std::vector<std::uint32_t> way_round(std::uint32_t first, std::vector<std::uint8_t>& reached) {
    std::vector<std::uint32_t> way{first};
    for (std::uint32_t next = passed_[first].neighbours[0]; next != first;
         next = passed_[next].beyond(way[way.size() - 2]))
      way.push_back(next);
    for (const std::uint32_t v : way) reached[v] = 1;
    // What is farthest from any point is a corner.
    const auto corner = std::max_element(way.begin(), way.end(), [&](std::uint32_t a, std::uint32_t b) {
      return norm(points_[a] - points_[first]) < norm(points_[b] - points_[first]);
    });
    std::rotate(way.begin(), corner, way.end());
    way.push_back(way.front());
    kept_[way.front()] = 1;
    return way;
  }

  /// Keeps the vertices without which the line would be another: the farthest one first, then those of either part [DouglasPeucker1973].
  void keep_corners(const std::vector<std::uint32_t>& way) {
    std::vector<std::array<std::size_t, 2>> stretches{{0, way.size() - 1}};
    while (!stretches.empty()) {
      const auto [first, last] = stretches.back();
      stretches.pop_back();
      double farthest = kStraight;
      std::size_t corner = first;
      for (std::size_t i = first + 1; i < last; ++i) {
        const double distance = distance_to(points_[way[first]], points_[way[last]], points_[way[i]]);
        if (distance <= farthest) continue;
        farthest = distance;
        corner = i;
      }
      if (corner == first) continue;
      kept_[way[corner]] = 1;
      stretches.push_back({first, corner});
      stretches.push_back({corner, last});
    }
  }

  void drop_others() {
    VertexIndex vertices(drafts_.tolerance);
    std::vector<std::uint32_t> index(points_.size(), kNone);
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
      if (kept_[v] != 0) index[v] = vertices.append(points_[v]);
    }
    for (FaceDraft& face : drafts_.faces) {
      std::vector<DirectedEdge> boundary;
      for (const auto& [a, b] : face.boundary) {
        if (kept_[a] != 0) boundary.push_back({index[a], index[next_kept(a, b)]});
      }
      face.boundary = std::move(boundary);
    }
    drafts_.vertices = std::move(vertices);
  }

  [[nodiscard]] std::uint32_t next_kept(std::uint32_t from, std::uint32_t next) const {
    while (kept_[next] == 0) {
      const std::uint32_t beyond = passed_[next].beyond(from);
      from = std::exchange(next, beyond);
    }
    return next;
  }

  FaceDrafts& drafts_;
  std::span<const Point> points_;
  std::vector<Passed> passed_;
  std::vector<std::uint8_t> kept_;
};

}  // namespace

void drop_straight_vertices(FaceDrafts& drafts, std::span<const std::uint8_t> stays) {
  assert(stays.size() == drafts.faces.size());
  Straightening(drafts, stays).run();
}

}  // namespace clerestory::mesh
