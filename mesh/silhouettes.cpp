// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/silhouettes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "mesh/t_junctions.h"

namespace clerestory::mesh {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// Directions that differ by less are one [rad]: ten times the rounding of a vertex of a metre-long edge in files with six decimals.
constexpr double kSameDirection = 1e-5;
constexpr double kTurn = 2.0 * std::numbers::pi;

/// An edge of the shape with what ends at it.
struct RawEdge {
  Edge ends;
  Vector direction;
  std::vector<Sheet> sheets;
};

/// Where the gaps between angles (sorted here) are wider than a limit.
bool has_gap(std::vector<double>& angles, double limit) {
  if (angles.empty()) return true;
  std::sort(angles.begin(), angles.end());
  double before = angles.back() - kTurn;
  for (const double angle : angles) {
    if (angle - before > limit) return true;
    before = angle;
  }
  return false;
}

/// Whether there is an open half space beside the edge: else lines are shut on both sides of it wherever they come from.
bool can_be_silhouette(const RawEdge& edge) {
  const Frame frame = frame_around(edge.direction);
  std::vector<double> angles;
  for (const Sheet& s : edge.sheets) angles.push_back(std::atan2(dot(s.away, frame.v), dot(s.away, frame.u)));
  return has_gap(angles, std::numbers::pi + kSameDirection);
}

/// The edges of opaque faces at boundaries and contacts. Others lie inside one plane.
std::vector<RawEdge> collect_edges(const Faces& faces, std::span<const std::uint8_t> passable) {
  std::map<Edge, std::vector<Sheet>> sheets;
  const std::vector<Point>& v = faces.shape.vertices;
  for (std::size_t f = 0; f < faces.count(); ++f) {
    if (!passable.empty() && passable[f] != 0) continue;
    for (const Triangle& t : faces.shape.of(FaceId(f))) {
      for (std::size_t k = 0; k < 3; ++k) {
        if ((t.constrained >> k & 1U) == 0) continue;
        const Edge edge = edge_between(t.vertices[k], t.vertices[(k + 1) % 3]);
        const Vector along = normalized(v[edge[1]] - v[edge[0]]);
        const Vector to_third = v[t.vertices[(k + 2) % 3]] - v[edge[0]];
        const Vector away = normalized(to_third - dot(to_third, along) * along);
        if (norm(away) > 0.0) sheets[edge].push_back({away, FaceId(f)});
      }
    }
  }
  std::vector<RawEdge> edges;
  for (auto& [ends, at] : sheets) {
    RawEdge edge{ends, normalized(v[ends[1]] - v[ends[0]]), std::move(at)};
    if (can_be_silhouette(edge)) edges.push_back(std::move(edge));
  }
  return edges;
}

/// Whether surfaces leave both edges in the same directions, of whatever face.
bool same_sheets(const RawEdge& a, const RawEdge& b) {
  if (a.sheets.size() != b.sheets.size()) return false;
  return std::all_of(a.sheets.begin(), a.sheets.end(), [&](const Sheet& s) {
    return std::any_of(b.sheets.begin(), b.sheets.end(),
                       [&](const Sheet& t) { return norm(s.away - t.away) < kSameDirection; });
  });
}

/// Edges in line that continue each other are joined.
class EdgeChains {
 public:
  explicit EdgeChains(const std::vector<RawEdge>& edges) : edges_(edges), next_(edges.size(), {kNone, kNone}) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> at;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      for (const std::uint32_t end : edges[e].ends) at[end].push_back(e);
    }
    for (const auto& [vertex, around] : at) {
      for (std::size_t i = 0; i < around.size(); ++i) {
        for (std::size_t j = i + 1; j < around.size(); ++j) link(vertex, around[i], around[j]);
      }
    }
  }

  /// Calls visit(edge, from, to) for each chain, by its first edge and its two outer vertices.
  template <class Visit>
  void for_each(const Visit& visit) const {
    std::vector<bool> seen(edges_.size(), false);
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      if (seen[e]) continue;
      const std::uint32_t from = walk(e, 0, seen);
      const std::uint32_t to = walk(e, 1, seen);
      if (from != to) visit(edges_[e], from, to);
    }
  }

 private:
  [[nodiscard]] std::size_t end_of(std::uint32_t edge, std::uint32_t vertex) const {
    return edges_[edge].ends[0] == vertex ? 0 : 1;
  }

  void link(std::uint32_t vertex, std::uint32_t a, std::uint32_t b) {
    const std::size_t end_a = end_of(a, vertex);
    const std::size_t end_b = end_of(b, vertex);
    const double turned = end_a == end_b ? -1.0 : 1.0;
    if (norm(edges_[a].direction - turned * edges_[b].direction) > kSameDirection) return;
    if (next_[a][end_a] != kNone || next_[b][end_b] != kNone || !same_sheets(edges_[a], edges_[b])) return;
    next_[a][end_a] = b;
    next_[b][end_b] = a;
  }

  /// The vertex at which the chain ends that leaves an edge by one of its ends.
  std::uint32_t walk(std::uint32_t edge, std::size_t end, std::vector<bool>& seen) const {
    seen[edge] = true;
    std::uint32_t vertex = edges_[edge].ends[end];
    while (next_[edge][end] != kNone) {
      const std::uint32_t next = next_[edge][end];
      if (seen[next]) break;
      seen[next] = true;
      end = 1 - end_of(next, vertex);
      vertex = edges_[next].ends[end];
      edge = next;
    }
    return vertex;
  }

  const std::vector<RawEdge>& edges_;
  std::vector<std::array<std::uint32_t, 2>> next_;
};

/// Lists of items by vertex as one array with starts.
template <class Item>
void flatten(const std::vector<std::vector<Item>>& lists, std::vector<Item>& items,
             std::vector<std::uint32_t>& starts) {
  starts.assign(1, 0);
  for (const std::vector<Item>& list : lists) {
    items.insert(items.end(), list.begin(), list.end());
    starts.push_back(static_cast<std::uint32_t>(items.size()));
  }
}

}  // namespace

Occluders::Occluders(const Faces& faces, std::span<const std::uint8_t> passable) {
  const std::vector<RawEdge> raw = collect_edges(faces, passable);
  std::vector<std::uint32_t> number(faces.shape.vertices.size(), kNone);
  const auto numbered = [&](std::uint32_t vertex) {
    if (number[vertex] == kNone) {
      number[vertex] = static_cast<std::uint32_t>(points_.size());
      points_.push_back(faces.shape.vertices[vertex]);
    }
    return number[vertex];
  };
  EdgeChains(raw).for_each([&](const RawEdge& edge, std::uint32_t from, std::uint32_t to) {
    const auto first = static_cast<std::uint32_t>(sheets_.size());
    sheets_.insert(sheets_.end(), edge.sheets.begin(), edge.sheets.end());
    std::stable_sort(sheets_.begin() + first, sheets_.end(), [&](const Sheet& s, const Sheet& t) {
      return faces.faces[s.face.index()].area_m2 > faces.faces[t.face.index()].area_m2;
    });
    const std::uint32_t a = numbered(from);
    edges_.push_back({{a, numbered(to)},
                      normalized(faces.shape.vertices[to] - faces.shape.vertices[from]),
                      first,
                      static_cast<std::uint32_t>(sheets_.size())});
  });

  std::vector<std::vector<std::uint32_t>> edges_at(points_.size());
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    for (const std::uint32_t end : edges_[e].ends) edges_at[end].push_back(e);
  }
  flatten(edges_at, edges_at_, edges_start_);
  std::vector<std::vector<std::array<Vector, 2>>> corners_at(points_.size());
  for (std::size_t f = 0; f < faces.count(); ++f) {
    if (!passable.empty() && passable[f] != 0) continue;
    for (const Triangle& t : faces.shape.of(FaceId(f))) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = number[t.vertices[k]];
        if (vertex == kNone) continue;
        corners_at[vertex].push_back({faces.shape.vertices[t.vertices[(k + 1) % 3]] - points_[vertex],
                                      faces.shape.vertices[t.vertices[(k + 2) % 3]] - points_[vertex]});
      }
    }
  }
  flatten(corners_at, corners_at_, corners_start_);
}

std::optional<Vector> Occluders::free_side(const OccluderEdge& e, const Vector& line) const {
  const Vector across = cross(e.direction, line);
  if (norm(across) <= kSameDirection * norm(line)) return std::nullopt;
  const Vector n = normalized(across);
  bool before = false;
  bool behind = false;
  for (const Sheet& s : sheets(e)) {
    const double side = dot(s.away, n);
    before = before || side > kSameDirection;
    behind = behind || side < -kSameDirection;
  }
  if (before == behind) return std::nullopt;
  return before ? -n : n;
}

bool Occluders::is_contour(std::uint32_t vertex, const Vector& line) const {
  // Seen along the line, each triangle hides a sector of less than half a turn.
  const Frame frame = frame_around(normalized(line));
  std::vector<std::array<double, 2>> sectors;
  for (const auto& [p, q] : corners_at(vertex)) {
    double from = std::atan2(dot(p, frame.v), dot(p, frame.u));
    double to = std::atan2(dot(q, frame.v), dot(q, frame.u));
    if (to < from) std::swap(from, to);
    if (to - from <= std::numbers::pi) {
      sectors.push_back({from, to});
    } else {
      sectors.push_back({to, from + kTurn});
    }
  }
  if (sectors.empty()) return true;
  std::sort(sectors.begin(), sectors.end());
  double reached = sectors.front()[0];
  const double full = reached + kTurn - kSameDirection;
  // A second round, for sectors that begin before the first one and reach over it.
  for (const double shift : {0.0, kTurn}) {
    for (const auto& [from, to] : sectors) {
      if (from + shift > reached + kSameDirection) return true;
      reached = std::max(reached, to + shift);
      if (reached >= full) return false;
    }
  }
  return false;
}

}  // namespace clerestory::mesh
