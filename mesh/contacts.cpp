// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_set>
#include <utility>

#include "mesh/face_drafts.h"

namespace clerestory::mesh {

namespace {

/// Planes at a smaller angle than this have no line of intersection worth the name [rad].
constexpr double kParallelSine = 1e-6;

using EdgeSet = std::unordered_set<Edge, EdgeHash>;

Box box_of(const FaceDrafts& drafts, const FaceDraft& face) {
  Box box;
  for (const DirectedEdge& e : face.boundary) box.add(drafts.vertices[e[0]]);
  return box;
}

/// Whether a box comes within a distance of a plane.
bool near_plane(const Box& box, const PlaneCoordinates& plane, double distance) {
  const Vector half = 0.5 * box.size();
  const Vector& w = plane.frame.w;
  const double reach = half.x * std::abs(w.x) + half.y * std::abs(w.y) + half.z * std::abs(w.z);
  return std::abs(plane.distance(box.centre())) <= reach + distance;
}

Point between(const Point& a, const Point& b, double t) { return a + t * (b - a); }

/// What the search for contacts needs to know of each face; faces themselves only get lines.
class ContactSearch {
 public:
  explicit ContactSearch(FaceDrafts& drafts) : drafts_(drafts), outlines_(drafts.faces.size()) {
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
  const PlanarOutline& outline(std::uint32_t f) {
    if (!outlines_[f]) outlines_[f] = outline_of(drafts_, drafts_.faces[f]);
    return *outlines_[f];
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
      for (const Stretch& s : outline(f).inner_stretches(face.plane.project(a), face.plane.project(b), tolerance)) {
        add_line(face, drafts_.vertices.add(between(a, b, s.begin)), drafts_.vertices.add(between(a, b, s.end)));
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

  /// The stretch of the line of two planes that lies within the convex hull of face g.
  std::optional<std::pair<Point, Point>> common_line(std::uint32_t f, std::uint32_t g) const {
    const PlaneCoordinates& plane = drafts_.faces[f].plane;
    Vector direction = cross(plane.frame.w, drafts_.faces[g].plane.frame.w);
    if (norm(direction) < kParallelSine) return std::nullopt;
    direction = normalized(direction);
    std::pair<Point, Point> ends;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const auto& [a, b] : drafts_.faces[g].boundary) {
      const double da = plane.distance(drafts_.vertices[a]);
      const double db = plane.distance(drafts_.vertices[b]);
      if ((da > 0.0) == (db > 0.0)) continue;
      const Point p = between(drafts_.vertices[a], drafts_.vertices[b], da / (da - db));
      const double t = dot(p - plane.origin, direction);
      if (t < low) ends.first = p;
      if (t > high) ends.second = p;
      low = std::min(low, t);
      high = std::max(high, t);
    }
    if (high - low <= drafts_.tolerance) return std::nullopt;
    return ends;
  }

  void add_trace(std::uint32_t f, std::uint32_t g) {
    const auto line = common_line(f, g);
    if (!line) return;
    const Point& a = line->first;
    const Point& b = line->second;
    const auto inside = [&](std::uint32_t face) {
      const PlaneCoordinates& plane = drafts_.faces[face].plane;
      return outline(face).inner_stretches(plane.project(a), plane.project(b), drafts_.tolerance);
    };
    const std::vector<Stretch> in_f = inside(f);
    const std::vector<Stretch> in_g = inside(g);
    for (const Stretch& s : in_f) {
      for (const Stretch& t : in_g) {
        const double begin = std::max(s.begin, t.begin);
        const double end = std::min(s.end, t.end);
        if ((end - begin) * norm(b - a) <= drafts_.tolerance) continue;
        const std::uint32_t from = drafts_.vertices.add(between(a, b, begin));
        const std::uint32_t to = drafts_.vertices.add(between(a, b, end));
        add_line(drafts_.faces[f], from, to);
        add_line(drafts_.faces[g], from, to);
      }
    }
  }

  static void add_line(FaceDraft& face, std::uint32_t a, std::uint32_t b) {
    if (a != b) face.lines.push_back(edge_between(a, b));
  }

  FaceDrafts& drafts_;
  std::vector<Box> boxes_;
  std::vector<std::optional<PlanarOutline>> outlines_;
  std::vector<Edge> edges_;
  BoxTree edge_tree_;
  BoxTree face_tree_;
};

}  // namespace

PlanarOutline outline_of(const FaceDrafts& drafts, const FaceDraft& face) {
  std::vector<PlanarOutline::Segment> segments;
  segments.reserve(face.boundary.size());
  for (const auto& [a, b] : face.boundary) {
    segments.push_back({face.plane.project(drafts.vertices[a]), face.plane.project(drafts.vertices[b])});
  }
  return PlanarOutline(std::move(segments));
}

void find_contacts(FaceDrafts& drafts) { ContactSearch(drafts).run(); }

void imprint_contacts(FaceDrafts& drafts) {
  // First what touches along an edge: then an edge in common is the same edge, and no contact is sought there.
  split_at_meetings(drafts);
  find_contacts(drafts);
  split_at_meetings(drafts);
}

}  // namespace clerestory::mesh
