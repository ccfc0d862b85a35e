// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/plane_meetings.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace clerestory::mesh {

namespace {

/// Vertices nearer than this in the plane, as a share of the tolerance, are one there. In space they are farther apart, so that they
/// differ by their distances from the plane alone.
constexpr double kSamePlaceShare = 0.8;

/// The segments of one face in its plane.
struct FlatFace {
  std::vector<std::uint32_t> vertices;  ///< of the drafts, ascending
  std::vector<Point> places;            ///< in the plane, z = 0
  std::vector<Edge> segments;           ///< between places, each once

  FlatFace(const FaceDrafts& drafts, const FaceDraft& face) {
    for_each_segment(face, [&](const Edge& e) { vertices.insert(vertices.end(), e.begin(), e.end()); });
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const std::uint32_t v : vertices) {
      const Point2 p = face.plane.project(drafts.vertices[v]);
      places.push_back({p.x, p.y, 0.0});
    }
    std::unordered_set<Edge, EdgeHash> known;
    for_each_segment(face, [&](const Edge& e) {
      if (known.insert(e).second) segments.push_back({place_of(e[0]), place_of(e[1])});
    });
  }

  [[nodiscard]] std::uint32_t place_of(std::uint32_t vertex) const {
    return static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin());
  }
  [[nodiscard]] Edge edge_of(const Edge& segment) const { return {vertices[segment[0]], vertices[segment[1]]}; }
};

/// Replaces vertices by the first at the same place of the plane.
/// @return whether there were any
bool merge_places(const FlatFace& flat, double distance, FaceDraft& face) {
  VertexIndex index(distance);
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> merged;
  for (std::size_t i = 0; i < flat.places.size(); ++i) {
    const std::uint32_t place = index.add(flat.places[i]);
    if (place == first.size()) first.push_back(flat.vertices[i]);
    merged.push_back(first[place]);
  }
  if (first.size() == flat.vertices.size()) return false;
  const auto first_at = [&](std::uint32_t vertex) { return merged[flat.place_of(vertex)]; };
  for (auto& [a, b] : face.boundary) {
    a = first_at(a);
    b = first_at(b);
  }
  std::erase_if(face.boundary, [](const DirectedEdge& e) { return e[0] == e[1]; });
  for (Edge& e : face.lines) e = edge_between(first_at(e[0]), first_at(e[1]));
  std::erase_if(face.lines, [](const Edge& e) { return e[0] == e[1]; });
  return true;
}

/// @return whether there are vertices on segments
bool find_vertices_on_segments(const FlatFace& flat, double least_distance, PendingSplits& pending) {
  const SegmentSearch search(flat.places, least_distance);
  bool found = false;
  for (const Edge& segment : flat.segments) {
    for (const std::uint32_t place : search.on(segment)) {
      pending[flat.edge_of(segment)].push_back(flat.vertices[place]);
      found = true;
    }
  }
  return found;
}

class CrossingSearch {
 public:
  CrossingSearch(FaceDrafts& drafts, const FlatFace& flat, PendingSplits& pending)
      : drafts_(drafts), flat_(flat), pending_(pending) {
    for (const Edge& segment : flat_.segments) {
      Box box;
      for (const std::uint32_t place : segment) box.add(flat_.places[place]);
      boxes_.push_back(box);
    }
  }

  void run() {
    const BoxTree tree(boxes_);
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
      tree.visit([&](const Box& box) { return overlap(boxes_[i], box); },
                 [&](std::uint32_t j) {
                   if (j > i) look_at(flat_.segments[i], flat_.segments[j]);
                 });
    }
  }

 private:
  [[nodiscard]] Point2 place(std::uint32_t i) const { return {flat_.places[i].x, flat_.places[i].y}; }

  void look_at(const Edge& e, const Edge& f) {
    if (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1]) return;
    const double sa = doubled_area(place(f[0]), place(f[1]), place(e[0]));
    const double sb = doubled_area(place(f[0]), place(f[1]), place(e[1]));
    const double sc = doubled_area(place(e[0]), place(e[1]), place(f[0]));
    const double sd = doubled_area(place(e[0]), place(e[1]), place(f[1]));
    if (sa * sb >= 0.0 || sc * sd >= 0.0) return;
    const Point& p = drafts_.vertices[flat_.vertices[e[0]]];
    const Point& q = drafts_.vertices[flat_.vertices[e[1]]];
    const std::uint32_t vertex = drafts_.vertices.add(p + (sa / (sa - sb)) * (q - p));
    split(flat_.edge_of(e), vertex);
    split(flat_.edge_of(f), vertex);
  }

  void split(const Edge& edge, std::uint32_t vertex) {
    if (vertex != edge[0] && vertex != edge[1]) pending_[edge].push_back(vertex);
  }

  FaceDrafts& drafts_;
  const FlatFace& flat_;
  PendingSplits& pending_;
  std::vector<Box> boxes_;
};

}  // namespace

void find_meetings_in_plane(FaceDrafts& drafts, FaceDraft& face, PendingSplits& pending) {
  const double same_place = kSamePlaceShare * drafts.tolerance;
  FlatFace flat(drafts, face);
  if (merge_places(flat, same_place, face)) flat = FlatFace(drafts, face);
  if (!find_vertices_on_segments(flat, same_place, pending)) CrossingSearch(drafts, flat, pending).run();
}

}  // namespace clerestory::mesh
