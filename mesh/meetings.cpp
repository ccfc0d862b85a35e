// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "mesh/face_drafts.h"
#include "mesh/plane_meetings.h"

namespace clerestory::mesh {

namespace {

/// Rounds of splitting. Each may bend lines by the tolerance, so that new meetings appear; four or five do for real models.
constexpr int kMaxRounds = 16;

/// Ends of lines are drawn to vertices within the tolerance. Those within this share of it are found on the edge all the same.
constexpr double kNearEndShare = 0.5;
/// So near to an edge an end lies on it, as a share of the tolerance: far above rounding.
constexpr double kAtEndShare = 0.1;

using EdgeSet = std::unordered_set<Edge, EdgeHash>;

/// Vertices on edges: on edges not seen before all of them, on the others those that have come since.
void find_vertices_on_edges(const FaceDrafts& drafts, EdgeSet& seen, std::size_t& seen_vertices,
                            PendingSplits& pending) {
  const std::span<const Point> points = drafts.vertices.points();
  const SegmentSearch all(points, drafts.tolerance);
  const SegmentSearch fresh(points, drafts.tolerance, seen_vertices);
  EdgeSet now;
  for (const FaceDraft& face : drafts.faces) {
    for_each_segment(face, [&](const Edge& edge) {
      if (!now.insert(edge).second) return;
      const std::vector<std::uint32_t> on = (seen.contains(edge) ? fresh : all).on(edge);
      if (!on.empty()) pending[edge] = on;
    });
  }
  seen = std::move(now);
  seen_vertices = points.size();
}

/// Edges that an end of a line lies on, and the vertex that it was drawn to.
void find_drawn_ends_on_edges(const FaceDrafts& drafts, PendingSplits& pending) {
  if (drafts.drawn_ends.empty()) return;
  std::vector<Edge> edges;
  std::vector<Box> boxes;
  EdgeSet known;
  for (const FaceDraft& face : drafts.faces) {
    for_each_segment(face, [&](const Edge& edge) {
      if (!known.insert(edge).second) return;
      edges.push_back(edge);
      Box& box = boxes.emplace_back();
      for (const std::uint32_t vertex : edge) box.add(drafts.vertices[vertex]);
    });
  }
  const BoxTree tree(boxes);
  const double near = kAtEndShare * drafts.tolerance;
  for (const FaceDrafts::DrawnEnd& drawn : drafts.drawn_ends) {
    Box around;
    around.add(drawn.end);
    around = grown(around, near);
    tree.visit([&](const Box& box) { return overlap(around, box); },
               [&](std::uint32_t e) {
                 const auto& [a, b] = edges[e];
                 if (drawn.vertex == a || drawn.vertex == b) return;
                 const Vector d = drafts.vertices[b] - drafts.vertices[a];
                 const Vector offset = drawn.end - drafts.vertices[a];
                 const double t = dot(offset, d) / dot(d, d);
                 if (t > 0.0 && t < 1.0 && norm(offset - t * d) <= near) pending[edges[e]].push_back(drawn.vertex);
               });
  }
}

/// Vertices of each edge in order along it, each once.
EdgeSplits in_order(const FaceDrafts& drafts, PendingSplits&& pending) {
  for (auto& [edge, vertices] : pending) {
    const Point& a = drafts.vertices[edge[0]];
    const Vector d = drafts.vertices[edge[1]] - a;
    const auto key = [&](std::uint32_t v) { return std::pair(dot(drafts.vertices[v] - a, d), v); };
    std::sort(vertices.begin(), vertices.end(), [&](std::uint32_t v, std::uint32_t w) { return key(v) < key(w); });
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }
  return std::move(pending);
}

/// @return whether the face changed
bool apply(FaceDraft& face, const EdgeSplits& splits) {
  std::vector<DirectedEdge> boundary;
  std::vector<Edge> lines;
  std::vector<std::uint32_t> chain;
  const auto for_each_piece = [&](std::uint32_t from, std::uint32_t to, const auto& add) {
    chain.clear();
    append_chain(from, to, splits, chain);
    chain.push_back(to);
    for (std::size_t i = 1; i < chain.size(); ++i) add(chain[i - 1], chain[i]);
  };
  for (const auto& [from, to] : face.boundary) {
    for_each_piece(from, to, [&](std::uint32_t a, std::uint32_t b) { boundary.push_back({a, b}); });
  }
  for (const auto& [from, to] : face.lines) {
    for_each_piece(from, to, [&](std::uint32_t a, std::uint32_t b) { lines.push_back(edge_between(a, b)); });
  }
  const bool changed = boundary.size() != face.boundary.size() || lines.size() != face.lines.size();
  face.boundary = std::move(boundary);
  face.lines = std::move(lines);
  return changed;
}

/// Splitting may have laid edges of the boundary on each other, both ways: those are nothing. Lines on the boundary are none.
void simplify(FaceDraft& face) {
  std::unordered_map<Edge, int, EdgeHash> net;
  for (const auto& [a, b] : face.boundary) net[edge_between(a, b)] += a < b ? 1 : -1;
  std::vector<DirectedEdge> boundary;
  for (const auto& [a, b] : face.boundary) {
    int& left = net[edge_between(a, b)];
    if (left == 0 || (left > 0) != (a < b)) continue;
    left += left > 0 ? -1 : 1;
    boundary.push_back({a, b});
  }
  face.boundary = std::move(boundary);
  EdgeSet own;
  for (const auto& [a, b] : face.boundary) own.insert(edge_between(a, b));
  std::erase_if(face.lines, [&](const Edge& edge) { return own.contains(edge); });
  std::sort(face.lines.begin(), face.lines.end());
  face.lines.erase(std::unique(face.lines.begin(), face.lines.end()), face.lines.end());
}

}  // namespace

std::uint32_t FaceDrafts::add_end(const Point& end) {
  const std::uint32_t vertex = vertices.add(end);
  if (norm(vertices[vertex] - end) > kNearEndShare * tolerance) drawn_ends.push_back({end, vertex});
  return vertex;
}

void split_at_meetings(FaceDrafts& drafts) {
  EdgeSet seen;
  std::size_t seen_vertices = 0;
  std::vector<bool> changed(drafts.faces.size(), true);
  for (int round = 0; round < kMaxRounds; ++round) {
    PendingSplits pending;
    find_vertices_on_edges(drafts, seen, seen_vertices, pending);
    if (round == 0) find_drawn_ends_on_edges(drafts, pending);
    // Planes are looked at where all vertices are in their edges already: then little is left to meet there.
    if (pending.empty()) {
      for (std::size_t f = 0; f < drafts.faces.size(); ++f) {
        if (changed[f]) find_meetings_in_plane(drafts, drafts.faces[f], pending);
        changed[f] = false;
      }
    }
    if (pending.empty()) break;
    const EdgeSplits splits = in_order(drafts, std::move(pending));
    for (std::size_t f = 0; f < drafts.faces.size(); ++f) {
      if (apply(drafts.faces[f], splits)) changed[f] = true;
    }
  }
  for (FaceDraft& face : drafts.faces) simplify(face);
  drafts.drawn_ends.clear();
}

}  // namespace clerestory::mesh
