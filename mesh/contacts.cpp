// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_set>
#include <utility>

#include "mesh/face_drafts.h"

namespace clerestory::mesh {

namespace {

using EdgeSet = std::unordered_set<Edge, EdgeHash>;

Box box_of(const FaceDrafts& drafts, const FaceDraft& face) {
  Box box;
  for (const DirectedEdge& e : face.boundary) box.add(drafts.vertices[e[0]]);
  return box;
}

/// What the search for contacts needs to know of each face; faces themselves only get lines.
class ContactSearch {
 public:
  explicit ContactSearch(FaceDrafts& drafts) : drafts_(drafts), regions_(drafts.faces.size()) {
    for (const FaceDraft& face : drafts_.faces) boxes_.push_back(box_of(drafts_, face));
    EdgeSet known;
    for (const FaceDraft& face : drafts_.faces) {
      for (const auto& [a, b] : face.boundary) {
        if (known.insert(edge_between(a, b)).second) edges_.push_back(edge_between(a, b));
      }
    }
    std::vector<Box> edge_boxes(edges_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      edge_boxes[e].add(drafts_.vertices[edges_[e][0]]);
      edge_boxes[e].add(drafts_.vertices[edges_[e][1]]);
    }
    edge_tree_ = BoxTree(edge_boxes);
    face_tree_ = BoxTree(boxes_);
  }

  void run() {
    for (std::uint32_t f = 0; f < drafts_.faces.size(); ++f) {
      add_touching_edges(f);
      add_traces(f);
    }
  }

 private:
  const PlanarRegion& region(std::uint32_t f) {
    if (!regions_[f]) regions_[f] = region_of(drafts_, drafts_.faces[f]);
    return *regions_[f];
  }

  /// Edges of other faces that lie in the plane of this one, as far as they run inside it.
  void add_touching_edges(std::uint32_t f) {
    FaceDraft& face = drafts_.faces[f];
    const double tolerance = drafts_.tolerance;
    EdgeSet own;
    for (const auto& [a, b] : face.boundary) own.insert(edge_between(a, b));
    const Box near = grown(boxes_[f], tolerance);
    std::vector<std::uint32_t> found;
    edge_tree_.visit([&](const Box& box) { return overlap(near, box) && near_plane(box, face.plane, tolerance); },
                     [&](std::uint32_t e) {
                       const auto in_plane = [&](std::uint32_t v) {
                         return std::abs(face.plane.distance(drafts_.vertices[v])) <= tolerance;
                       };
                       if (in_plane(edges_[e][0]) && in_plane(edges_[e][1]) && !own.contains(edges_[e]))
                         found.push_back(e);
                     });
    for (const std::uint32_t e : found) {
      const Point a = drafts_.vertices[edges_[e][0]];
      const Point b = drafts_.vertices[edges_[e][1]];
      for (const auto& [begin, end] : stretches_inside(region(f), {a, b}, tolerance)) {
        const std::uint32_t from = drafts_.add_end(begin);
        add_line(face, from, drafts_.add_end(end));
      }
    }
  }

  /// Lines along which later faces cross this one.
  void add_traces(std::uint32_t f) {
    const Box near = grown(boxes_[f], drafts_.tolerance);
    const PlaneCoordinates plane = drafts_.faces[f].plane;
    std::vector<std::uint32_t> others;
    face_tree_.visit([&](const Box& box) { return overlap(near, box) && near_plane(box, plane, -drafts_.tolerance); },
                     [&](std::uint32_t g) {
                       if (g > f && straddles(g, f) && straddles(f, g)) others.push_back(g);
                     });
    for (const std::uint32_t g : others) add_trace(f, g);
  }

  /// Whether face f has vertices on both sides of the plane of face g.
  bool straddles(std::uint32_t f, std::uint32_t g) const {
    bool above = false;
    bool below = false;
    for (const auto& [a, b] : drafts_.faces[f].boundary) {
      const double distance = drafts_.faces[g].plane.distance(drafts_.vertices[a]);
      above = above || distance > drafts_.tolerance;
      below = below || distance < -drafts_.tolerance;
    }
    return above && below;
  }

  void add_trace(std::uint32_t f, std::uint32_t g) {
    for (const auto& [a, b] : crossing_stretches(region(f), region(g), drafts_.tolerance)) {
      const std::uint32_t from = drafts_.add_end(a);
      const std::uint32_t to = drafts_.add_end(b);
      add_line(drafts_.faces[f], from, to);
      add_line(drafts_.faces[g], from, to);
    }
  }

  static void add_line(FaceDraft& face, std::uint32_t a, std::uint32_t b) {
    if (a != b) face.lines.push_back(edge_between(a, b));
  }

  FaceDrafts& drafts_;
  std::vector<Box> boxes_;
  std::vector<std::optional<PlanarRegion>> regions_;
  std::vector<Edge> edges_;
  BoxTree edge_tree_;
  BoxTree face_tree_;
};

}  // namespace

PlanarRegion region_of(const FaceDrafts& drafts, const FaceDraft& face) {
  std::vector<Ends> edges;
  edges.reserve(face.boundary.size());
  for (const auto& [a, b] : face.boundary) edges.push_back({drafts.vertices[a], drafts.vertices[b]});
  return {face.plane, std::move(edges)};
}

void find_contacts(FaceDrafts& drafts) { ContactSearch(drafts).run(); }

void imprint_contacts(FaceDrafts& drafts) {
  // First what touches along an edge: then an edge in common is the same edge, and no contact is sought there.
  split_at_meetings(drafts);
  find_contacts(drafts);
  split_at_meetings(drafts);
}

}  // namespace clerestory::mesh
