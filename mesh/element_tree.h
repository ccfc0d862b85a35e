// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/faces.h"
#include "mesh/geometry.h"
#include "mesh/ids.h"
#include "mesh/triangle_grids.h"

namespace clerestory::mesh {

/// A directed edge of an outline; the surface lies on its left, seen from the side that the element belongs to.
struct OutlineEdge {
  Point from;
  Point to;
};

/// Second moments of a planar piece about its centroid, per area [m²], along the axes of its side.
struct SecondMoments {
  double uu = 0.0;
  double uv = 0.0;
  double vv = 0.0;
};

/// The hierarchy of planar elements. Under each region of a face side stands a binary tree of groups of start triangles (the
/// constrained triangulation); under each start triangle a quadtree of triangles that grows by split(). Every node, group or
/// triangle, is a planar surface with an outline, so that all of them exchange light by the same formulas.
/// Node ids are given in the order of creation, which is serial; keys depend on (face, side, path) alone.
class ElementTree {
 public:
  /// @param mesh      start triangles of all faces, local coordinates
  /// @param has_side  [2 a face] non-zero for face sides that carry elements
  ElementTree(const Faces& faces, const Triangulation& mesh, std::span<const std::uint8_t> has_side);

  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  /// One root for each region of each face side that carries elements.
  [[nodiscard]] std::span<const ElementId> roots() const { return roots_; }
  /// Roots of one face side; empty where it carries no elements.
  [[nodiscard]] std::span<const ElementId> roots_of(FaceSide side) const;

  [[nodiscard]] ElementId parent(ElementId e) const { return ElementId(node(e).parent); }
  [[nodiscard]] bool has_children(ElementId e) const { return node(e).first_child != ElementId::kNone; }
  /// Children are consecutive: first_child(e) … + child_count(e) - 1. Always after their parent.
  [[nodiscard]] ElementId first_child(ElementId e) const { return ElementId(node(e).first_child); }
  [[nodiscard]] std::size_t child_count(ElementId e) const { return node(e).child_count; }
  [[nodiscard]] ElementId root(ElementId e) const;

  [[nodiscard]] FaceSide face_side(ElementId e) const { return mesh::face_side(node(e).face_side); }
  /// Unit normal of the element's side.
  [[nodiscard]] const Vector& normal(ElementId e) const { return axes(e).w; }
  /// In-plane axes and normal of the element's side.
  [[nodiscard]] const Frame& axes(ElementId e) const { return side_axes_[node(e).face_side]; }
  [[nodiscard]] double area(ElementId e) const { return node(e).area; }
  [[nodiscard]] const Point& centroid(ElementId e) const { return node(e).centroid; }
  /// Largest distance of a corner from the centroid [m].
  [[nodiscard]] double radius(ElementId e) const { return node(e).radius; }
  [[nodiscard]] const SecondMoments& second_moments(ElementId e) const { return node(e).moments; }
  [[nodiscard]] int level(ElementId e) const { return node(e).level; }
  [[nodiscard]] std::uint64_t key(ElementId e) const { return node(e).key; }
  [[nodiscard]] bool is_triangle(ElementId e) const { return node(e).triangle; }
  /// Corners of a triangle node, counter-clockwise seen from its side.
  [[nodiscard]] std::array<Point, 3> corners(ElementId e) const;
  /// The triangles that a node consists of: itself, or the start triangles of a group.
  [[nodiscard]] std::vector<std::array<Point, 3>> triangles(ElementId e) const;
  /// Outline of any node; `scratch` backs the answer where it is not stored.
  [[nodiscard]] std::span<const OutlineEdge> outline(ElementId e, std::array<OutlineEdge, 3>& scratch) const;
  /// A convex set of corners in the plane that holds the node: 3 for a triangle, a rectangle for a group. Returns the count.
  std::size_t hull(ElementId e, std::array<Point, 4>& corners) const;
  /// Start triangles below (or, for parts of one, above) a node: consecutive ones, from this number on.
  [[nodiscard]] std::size_t first_start_triangle(ElementId e) const { return node(e).begin; }
  [[nodiscard]] std::size_t start_triangle_count(ElementId e) const { return node(e).end - node(e).begin; }
  [[nodiscard]] std::size_t start_triangle_count() const { return start_.size(); }

  /// The point of the node that belongs to (a, b) in the unit square, uniform by area but for a hair along the edges: rays that start
  /// there stay on their side of whatever stands on an edge.
  [[nodiscard]] Point sample(ElementId e, double a, double b) const;

  static constexpr std::size_t kPartsOfTriangle = 4;
  /// Splits a triangle without children into four by its edges' midpoints. Serial.
  void split(ElementId e);

  /// Whether a point of its plane lies in a node.
  [[nodiscard]] bool holds(ElementId e, const Point& point) const;
  /// Barycentric coordinates of a point in a triangle, in the order of its corners.
  using Barycentric = std::array<double, 3>;
  [[nodiscard]] Barycentric barycentric(ElementId triangle, const Point& point) const;
  /// The number of a triangle's child that holds the point at these coordinates, or is nearest, and its coordinates there.
  static std::uint32_t step_down(Barycentric& at);
  /// The node below a triangle, or itself, that holds a point of it, as deep as enter(ElementId) allows.
  template <class Enter>
  [[nodiscard]] ElementId descend(ElementId e, const Point& point, Enter enter) const {
    if (!has_children(e) || !enter(e)) return e;
    Barycentric at = barycentric(e, point);
    do e = ElementId(node(e).first_child + step_down(at));
    while (has_children(e) && enter(e));
    return e;
  }
  /// The deepest node of a face side that holds a point of its plane; invalid where the side carries no elements.
  [[nodiscard]] ElementId find(FaceSide side, const Point& point) const;
  /// The same where the region is known, as from a ray's triangle: a point that is rounded across a contact stays on its side of it.
  [[nodiscard]] ElementId find(FaceSide side, std::uint32_t region, const Point& point) const;
  /// The one of given nodes above the start triangle that holds a point.
  /// @param above  [start triangles] the node asked for: the triangle's own, or a group that it belongs to
  [[nodiscard]] ElementId find(FaceSide side, std::uint32_t region, const Point& point,
                               std::span<const ElementId> above) const;

 private:
  struct Node {
    Point centroid;
    double area = 0.0;
    double radius = 0.0;
    SecondMoments moments;
    std::uint64_t key = 0;
    std::uint32_t parent = ElementId::kNone;
    std::uint32_t first_child = ElementId::kNone;
    std::uint32_t face_side = 0;
    std::uint32_t begin = 0;  ///< start triangles [begin, end) in start_
    std::uint32_t end = 0;
    std::uint32_t shape = 0;  ///< triangle: index into corners_; group: into groups_
    std::uint8_t child_count = 0;
    std::uint8_t level = 0;
    bool triangle = false;
  };
  struct Group {
    std::uint32_t first_edge = 0;
    std::uint32_t edge_count = 0;
    std::array<double, 4> rectangle{};  ///< low u, low v, high u, high v from the face's origin
  };
  using StartTriangle = std::array<std::uint32_t, 3>;

  [[nodiscard]] const Node& node(ElementId e) const { return nodes_[e.index()]; }
  struct Region;
  void add_region(const Triangulation& mesh, std::vector<Triangle> triangles, FaceSide side);
  void build_groups(Region& region, std::uint32_t root);
  void add_up_areas(std::uint32_t root);
  void finish_group(const Region& region, Node& group);
  void add_second_moments(const Region& region, Node& group);
  void add_outline(const Region& region, const Node& group);
  void finish_triangle(Node& triangle, const std::array<Point, 3>& corners);
  void split_group(Region& region, std::uint32_t group);
  void add_grid(std::uint32_t root);
  [[nodiscard]] bool triangle_holds(const Node& node, const Point& point, double slack) const;
  [[nodiscard]] bool start_holds(std::uint32_t start, const Point& point, double slack) const {
    return triangle_holds(nodes_[start_node_[start]], point, slack);
  }
  /// The one of a root's start triangles near a point that holds it. What is left when the others do not is taken untried: a region
  /// has no gaps.
  [[nodiscard]] std::uint32_t start_among(std::span<const std::uint32_t> near, std::size_t root,
                                          const Point& point) const;
  /// The start triangle of consecutive roots that holds a point, or is nearest to do so.
  [[nodiscard]] std::uint32_t nearest_start(std::size_t first_root, std::size_t end_root, const Point& point) const;
  /// The deepest node below a start triangle that holds a point.
  [[nodiscard]] ElementId descend_all(std::uint32_t start, const Point& point) const {
    return descend(ElementId(start_node_[start]), point, [](ElementId) { return true; });
  }

  std::vector<Node> nodes_;
  std::vector<ElementId> roots_;
  std::vector<std::uint32_t> roots_start_;  ///< [2 a face + 1] into roots_
  std::vector<Frame> side_axes_;            ///< [2 a face]
  std::vector<Point> side_origin_;          ///< [2 a face]
  std::vector<std::array<Point, 3>> corners_;
  std::vector<Group> groups_;
  std::vector<OutlineEdge> edges_;
  std::vector<StartTriangle> start_;
  TriangleGrids grids_;                    ///< [roots] of their start triangles
  std::vector<std::uint32_t> start_node_;  ///< [start triangles] the node of each
  std::vector<double> area_before_;        ///< [start triangles] of those ahead of it in its region
};

}  // namespace clerestory::mesh
