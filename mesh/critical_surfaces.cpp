// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/critical_surfaces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/box_tree.h"

namespace clerestory::mesh {

namespace {

/// What is nearer to a source's plane than this does not shade it [m]: half the tolerance of welding.
constexpr double kInPlane = 1e-5;
/// Edges of source and occluder are parallel, or in one plane, where their angle to it is less than this [rad].
constexpr double kCoplanar = 1e-4;
/// Edges that leave the horizontal by less than this are level [rad].
constexpr double kLevel = 0.02;
/// The reveal of an opening: surfaces that are no farther from its outline than a thick wall [m].
constexpr double kReveal = 0.75;

using Ends = std::array<Point, 2>;

Vector line_between(const Point& from, const Ends& edge) { return midpoint(edge[0], edge[1]) - from; }

/// The part of an edge on the side of a plane that its normal points to.
std::optional<Ends> before_plane(const Ends& edge, const Point& origin, const Vector& normal) {
  const double a = dot(edge[0] - origin, normal) - kInPlane;
  const double b = dot(edge[1] - origin, normal) - kInPlane;
  if (a <= 0.0 && b <= 0.0) return std::nullopt;
  if (a >= 0.0 && b >= 0.0) return edge;
  const Point cut = edge[0] + (a / (a - b)) * (edge[1] - edge[0]);
  return a > 0.0 ? Ends{edge[0], cut} : Ends{cut, edge[1]};
}

Vector plane_normal(const Point& pivot, const Ends& edge) {
  return normalized(cross(edge[0] - pivot, edge[1] - pivot));
}

bool lies_in(const Vector& direction, const Vector& plane_normal) {
  return std::abs(dot(direction, plane_normal)) < kCoplanar;
}

class WedgeMaker {
 public:
  WedgeMaker(const Occluders& occluders, const ShadowSource& source, const WedgeLimit& limit,
             const std::function<void(const Wedge&)>& visit)
      : occluders_(occluders), source_(source), left_(limit.most), visit_(visit) {
    mark(limit.seen);
  }

  bool run() {
    switch (source_.kind) {
      case ShadowSource::Kind::kPoint:
      case ShadowSource::Kind::kDirection:
        shadow_edges();
        break;
      case ShadowSource::Kind::kPolygon:
        // Where the limit is reached, the no-sky line is there all the same.
        if (source_.sky) outdoor_silhouettes();
        polygon_vertices();
        polygon_edges();
        break;
    }
    return !exceeded_;
  }

 private:
  /// Spreads what is known of edges to their ends.
  void mark(const SeenEdges* seen) {
    const std::size_t edges = occluders_.edges().size();
    lit_edges_ = seen != nullptr ? seen->lit : std::vector<std::uint8_t>(edges, 1);
    around_edges_ = seen != nullptr ? seen->around : std::vector<std::uint8_t>(edges, 1);
    outdoor_edges_ = seen != nullptr ? seen->outdoors : std::vector<std::uint8_t>(edges, 1);
    lit_vertices_.assign(occluders_.vertex_count(), 0);
    for (std::size_t e = 0; e < edges; ++e) {
      for (const std::uint32_t end : occluders_.edges()[e].ends) {
        if (lit_edges_[e] != 0) lit_vertices_[end] = 1;
      }
    }
  }

  [[nodiscard]] bool is_lit(const OccluderEdge& e) const { return lit_edges_[index_of(e)] != 0; }
  [[nodiscard]] std::size_t index_of(const OccluderEdge& e) const {
    return static_cast<std::size_t>(&e - occluders_.edges().data());
  }

  void give(const Wedge& wedge) {
    if (left_ == 0) {
      exceeded_ = true;
      return;
    }
    --left_;
    visit_(wedge);
  }

  void shadow_edges() {
    Wedge wedge;
    wedge.order = 0;
    wedge.parallel = source_.kind == ShadowSource::Kind::kDirection;
    wedge.pivot = source_.at;
    wedge.towards = source_.towards;
    for (const OccluderEdge& e : occluders_.edges()) {
      if (!is_lit(e)) continue;
      wedge.edge = occluders_.ends(e);
      const auto free =
          occluders_.free_side(e, wedge.parallel ? -source_.towards : line_between(source_.at, wedge.edge));
      if (!free) continue;
      wedge.free_side = *free;
      wedge.occluder = occluders_.sheets(e)[0].face;
      give(wedge);
    }
  }

  /// The part of an edge that the polygon shines on.
  [[nodiscard]] std::optional<Ends> lit_part(const Ends& edge) const {
    if (source_.two_sided) return edge;
    return before_plane(edge, source_.outline[0][0], source_.normal);
  }

  void polygon_vertices() {
    for (const std::vector<Point>& loop : source_.outline) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::array<Point, 2> neighbours{loop[(i + loop.size() - 1) % loop.size()], loop[(i + 1) % loop.size()]};
        for (const OccluderEdge& e : occluders_.edges()) {
          if (is_lit(e)) source_vertex(loop[i], neighbours, e);
        }
      }
    }
  }

  void source_vertex(const Point& vertex, const std::array<Point, 2>& neighbours, const OccluderEdge& e) {
    const std::optional<Ends> part = lit_part(occluders_.ends(e));
    if (!part) return;
    Wedge wedge;
    wedge.pivot = vertex;
    wedge.edge = *part;
    const auto free = occluders_.free_side(e, line_between(vertex, *part));
    if (!free) return;
    wedge.free_side = *free;
    for (std::size_t k = 0; k < 2; ++k) {
      wedge.corner[k] = normalized(neighbours[k] - vertex);
      if (!lies_in(wedge.corner[k], wedge.free_side)) continue;
      wedge.order = 1;
      wedge.along = {vertex, neighbours[k]};
    }
    wedge.occluder = occluders_.sheets(e)[0].face;
    give(wedge);
  }

  void polygon_edges() {
    for (const std::vector<Point>& loop : source_.outline) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Ends edge{loop[i], loop[(i + 1) % loop.size()]};
        for (std::uint32_t v = 0; v < occluders_.vertex_count(); ++v) {
          if (lit_vertices_[v] == 0) continue;
          const Point& p = occluders_.point(v);
          const double height = dot(p - source_.outline[0][0], source_.normal);
          if (std::abs(height) <= kInPlane || (height < 0.0 && !source_.two_sided)) continue;
          occluder_vertex(edge, v);
        }
      }
    }
  }

  /// The EV surface of a source's edge. The vertex must end a silhouette as seen from an end of the edge or its middle.
  /// @param outdoors_free  the free side of an edge before the sky; nothing for an edge of the source itself
  void occluder_vertex(const Ends& edge, std::uint32_t vertex, const std::optional<Vector>& outdoors_free = {}) {
    const Point& p = occluders_.point(vertex);
    Wedge wedge;
    wedge.kind = Wedge::Kind::kEdgeVertex;
    wedge.pivot = p;
    wedge.pivot_vertex = vertex;
    wedge.edge = edge;
    wedge.sky_behind = outdoors_free.has_value();
    const Vector normal = plane_normal(p, edge);
    if (norm(normal) == 0.0) return;
    double beside = 0.0;
    std::size_t silhouettes = 0;
    for (const std::uint32_t i : occluders_.edges_at(vertex)) {
      const OccluderEdge& e = occluders_.edges()[i];
      bool silhouette = false;
      for (const Point& from : {edge[0], midpoint(edge[0], edge[1]), edge[1]}) {
        const auto free = occluders_.free_side(e, p - from);
        if (!free) continue;
        silhouette = true;
        beside += dot(*free, normal);
        wedge.occluder = occluders_.sheets(e)[0].face;
        if (lies_in(e.direction, normal)) {
          wedge.order = 1;
          wedge.along = occluders_.ends(e);
          wedge.no_sky = wedge.no_sky || (wedge.sky_behind && is_no_sky(e, edge, *free));
        }
      }
      if (silhouette) wedge.corner[std::min<std::size_t>(silhouettes++, 1)] = e.direction;
    }
    if (silhouettes == 0) return;
    if (outdoors_free) beside = dot(*outdoors_free, normal);
    wedge.free_side = beside < 0.0 ? -normal : normal;
    give(wedge);
  }

  /// A window's head (what shuts is above it) and a level line outdoors.
  static bool is_no_sky(const OccluderEdge& head, const Ends& outdoors, const Vector& free_at_head) {
    const Vector along = normalized(outdoors[1] - outdoors[0]);
    return std::abs(head.direction.z) < kLevel && std::abs(along.z) < kLevel && free_at_head.z < 0.0;
  }

  /// What stands outdoors before the sky is the source's outline, and the surfaces round the opening are the occluders.
  void outdoor_silhouettes() {
    Box around;
    for (const std::vector<Point>& loop : source_.outline) {
      for (const Point& p : loop) around.add(p);
    }
    around = grown(around, kReveal);
    std::vector<const OccluderEdge*> frame;
    std::vector<bool> in_frame(occluders_.vertex_count(), false);
    for (const OccluderEdge& e : occluders_.edges()) {
      if (around_edges_[index_of(e)] == 0) continue;
      Box box;
      for (const Point& p : occluders_.ends(e)) box.add(p);
      if (overlap(around, box)) frame.push_back(&e);
      for (const std::uint32_t end : e.ends) {
        Box place;
        place.add(occluders_.point(end));
        in_frame[end] = overlap(around, place);
      }
    }
    std::vector<bool> seen(occluders_.vertex_count(), false);
    for (const OccluderEdge& outdoors : occluders_.edges()) {
      if (outdoor_edges_[index_of(outdoors)] == 0) continue;
      const std::optional<Ends> part = before_plane(occluders_.ends(outdoors), source_.outline[0][0], -source_.normal);
      if (!part || std::max((*part)[0].z, (*part)[1].z) <= around.low.z) continue;
      for (std::uint32_t v = 0; v < occluders_.vertex_count(); ++v) {
        if (in_frame[v] && v != outdoors.ends[0] && v != outdoors.ends[1]) outdoor_edge(outdoors, *part, v);
      }
      for (const std::uint32_t end : outdoors.ends) {
        if (seen[end] || dot(occluders_.point(end) - source_.outline[0][0], source_.normal) > -kInPlane) continue;
        seen[end] = true;
        Box place;
        place.add(occluders_.point(end));
        for (const OccluderEdge* e : frame) outdoor_vertex(end, *e, overlap(around, place));
      }
    }
  }

  void outdoor_edge(const OccluderEdge& outdoors, const Ends& part, std::uint32_t vertex) {
    const Point& p = occluders_.point(vertex);
    if (std::max(part[0].z, part[1].z) <= p.z) return;  // no sky below the horizon
    const auto free = occluders_.free_side(outdoors, line_between(p, part));
    if (free) occluder_vertex(part, vertex, free);
  }

  /// @param at_opening  the vertex is one of what surrounds the opening: past that some sky may be seen beside what stands farther off
  void outdoor_vertex(std::uint32_t vertex, const OccluderEdge& e, bool at_opening) {
    if (e.ends[0] == vertex || e.ends[1] == vertex) return;
    const Point& p = occluders_.point(vertex);
    Wedge wedge;
    wedge.pivot = p;
    wedge.pivot_vertex = vertex;
    wedge.edge = occluders_.ends(e);
    wedge.sky_behind = true;
    if (std::min(wedge.edge[0].z, wedge.edge[1].z) >= p.z) return;
    const Vector line = line_between(p, wedge.edge);
    const auto free = occluders_.free_side(e, line);
    if (!free) return;
    wedge.free_side = *free;
    std::size_t silhouettes = 0;
    for (const std::uint32_t i : occluders_.edges_at(vertex)) {
      const OccluderEdge& outdoors = occluders_.edges()[i];
      if (!occluders_.free_side(outdoors, -line)) continue;
      wedge.corner[std::min<std::size_t>(silhouettes++, 1)] = outdoors.direction;
      if (!lies_in(outdoors.direction, wedge.free_side)) continue;
      wedge.order = 1;
      wedge.along = occluders_.ends(outdoors);
      wedge.no_sky = wedge.no_sky || (!at_opening && is_no_sky(e, occluders_.ends(outdoors), wedge.free_side));
    }
    if (silhouettes == 0) return;
    wedge.occluder = occluders_.sheets(e)[0].face;
    give(wedge);
  }

  const Occluders& occluders_;
  const ShadowSource& source_;
  std::vector<std::uint8_t> lit_edges_;      ///< [edges]
  std::vector<std::uint8_t> around_edges_;   ///< [edges]
  std::vector<std::uint8_t> outdoor_edges_;  ///< [edges]
  std::vector<std::uint8_t> lit_vertices_;   ///< [vertices] at such an edge
  std::size_t left_;
  const std::function<void(const Wedge&)>& visit_;
  bool exceeded_ = false;
};

}  // namespace

bool for_each_wedge(const Occluders& occluders, const ShadowSource& source, const WedgeLimit& limit,
                    const std::function<void(const Wedge&)>& visit) {
  return WedgeMaker(occluders, source, limit, visit).run();
}

}  // namespace clerestory::mesh
