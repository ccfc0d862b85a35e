// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/element_tree.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "mesh/group_outline.h"
#include "mesh/hash.h"

namespace clerestory::mesh {

namespace {

/// Slack of point location, relative to an element's size: a hit on an edge belongs to one of its neighbours.
constexpr double kEdgeSlack = 1e-6;
/// Rays that come far and aslant hit a surface so much beside where they should [m].
constexpr double kHitSlack = 1e-4;
/// Sampled points keep off edges by a ten-thousandth of the triangle: more than rays' single precision, less than anything to be seen.
constexpr double kInside = 1.0 - 1e-4;

Point mean(const std::array<Point, 3>& c) {
  return {(c[0].x + c[1].x + c[2].x) / 3.0, (c[0].y + c[1].y + c[2].y) / 3.0, (c[0].z + c[1].z + c[2].z) / 3.0};
}

double triangle_area(const std::array<Point, 3>& c) { return 0.5 * norm(cross(c[1] - c[0], c[2] - c[0])); }

std::array<Point, 3> points_of(const Triangulation& mesh, const std::array<std::uint32_t, 3>& vertices) {
  return {mesh.vertices[vertices[0]], mesh.vertices[vertices[1]], mesh.vertices[vertices[2]]};
}

/// Of a triangle: a twelfth of the sum over its corners.
SecondMoments moments_about(const Point& centre, const std::array<Point, 3>& c, const Frame& axes) {
  SecondMoments sum;
  for (const Point& p : c) {
    const double u = dot(p - centre, axes.u);
    const double v = dot(p - centre, axes.v);
    sum = {sum.uu + u * u / 12.0, sum.uv + u * v / 12.0, sum.vv + v * v / 12.0};
  }
  return sum;
}

/// Uniform points of a triangle from the unit square, continuous and area-preserving.
/// Source: Heitz, A Low-Distortion Map Between Triangle and Square, 2019.
Point in_triangle(const std::array<Point, 3>& c, double a, double b) {
  double s = a;
  double t = b;
  if (b > a) {
    s *= 0.5;
    t -= s;
  } else {
    t *= 0.5;
    s -= t;
  }
  return c[0] + (s * (c[1] - c[0]) + t * (c[2] - c[0]));
}

}  // namespace

/// The start triangles of a region while its groups are built, numbered as the mesh has them.
struct ElementTree::Region {
  struct Part {
    double area = 0.0;
    Point centre;
    std::array<std::uint32_t, 3> across{};  ///< numbers of its neighbours
  };

  const Triangulation& mesh;
  std::uint32_t begin = 0;            ///< in start_
  std::vector<Part> parts;            ///< [numbers]
  std::vector<std::uint32_t> number;  ///< [places from begin on]
  std::vector<std::uint32_t> place;   ///< [numbers] in start_

  Region(const Triangulation& all, std::uint32_t first, std::span<const StartTriangle> triangles)
      : mesh(all), begin(first), number(triangles.size()), place(triangles.size()) {
    const auto across = triangles_across(triangles);
    parts.reserve(triangles.size());
    for (std::uint32_t k = 0; k < triangles.size(); ++k) {
      const auto c = points_of(mesh, triangles[k]);
      parts.push_back({triangle_area(c), mean(c), across[k]});
      put(k, begin + k);
    }
  }

  void put(std::uint32_t own, std::uint32_t at) {
    number[at - begin] = own;
    place[own] = at;
  }
  [[nodiscard]] const Part& at(std::uint32_t position) const { return parts[number[position - begin]]; }
};

ElementTree::ElementTree(const Faces& faces, const Triangulation& mesh, std::span<const std::uint8_t> has_side) {
  assert(has_side.size() == 2 * faces.count());
  roots_start_.push_back(0);
  for (std::size_t s = 0; s < 2 * faces.count(); ++s) {
    const FaceSide side = mesh::face_side(s);
    const Face& face = faces.faces[side.face.index()];
    const bool back = side.side == Side::kBack;
    side_axes_.push_back(back ? Frame{face.frame.v, face.frame.u, -face.frame.w} : face.frame);
    side_origin_.push_back(face.origin);
    if (has_side[s] != 0) {
      std::vector<std::vector<Triangle>> regions;
      for (const Triangle& t : mesh.of(side.face)) {
        if (t.region >= regions.size()) regions.resize(t.region + 1);
        regions[t.region].push_back(t);
      }
      for (auto& region : regions) {
        if (!region.empty()) add_region(mesh, std::move(region), side);
      }
    }
    roots_start_.push_back(static_cast<std::uint32_t>(roots_.size()));
  }
}

void ElementTree::add_region(const Triangulation& mesh, std::vector<Triangle> triangles, FaceSide side) {
  Node root;
  root.face_side = static_cast<std::uint32_t>(side.index());
  root.begin = static_cast<std::uint32_t>(start_.size());
  root.end = root.begin + static_cast<std::uint32_t>(triangles.size());
  root.key = hash(hash(side.face.value, static_cast<std::uint64_t>(side.side)), triangles.front().region);
  for (const Triangle& t : triangles) {
    auto v = t.vertices;
    if (side.side == Side::kBack) std::swap(v[1], v[2]);
    start_.push_back(v);
  }
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(root);
  roots_.push_back(ElementId(id));
  Region region(mesh, root.begin, std::span(start_).subspan(root.begin));
  build_groups(region, id);
  add_up_areas(id);
  add_grid(id);
}

void ElementTree::add_up_areas(std::uint32_t root) {
  start_node_.resize(start_.size());
  area_before_.resize(start_.size());
  for (std::uint32_t n = root; n < nodes_.size(); ++n) {
    if (nodes_[n].triangle) start_node_[nodes_[n].begin] = n;
  }
  double area = 0.0;
  for (std::uint32_t i = nodes_[root].begin; i < nodes_[root].end; ++i) {
    area_before_[i] = area;
    area += nodes_[start_node_[i]].area;
  }
}

void ElementTree::add_grid(std::uint32_t root) {
  const Node& all = nodes_[root];
  std::vector<std::array<Point, 3>> triangles;
  triangles.reserve(all.end - all.begin);
  for (std::uint32_t i = all.begin; i < all.end; ++i) triangles.push_back(corners_[nodes_[start_node_[i]].shape]);
  grids_.add(side_axes_[all.face_side], triangles, all.begin, kHitSlack + 2.0 * kEdgeSlack * all.radius);
}

void ElementTree::build_groups(Region& region, std::uint32_t root) {
  for (std::uint32_t n = root; n < nodes_.size(); ++n) {
    if (nodes_[n].end - nodes_[n].begin == 1) {
      finish_triangle(nodes_[n], points_of(region.mesh, start_[nodes_[n].begin]));
    } else {
      finish_group(region, nodes_[n]);
      split_group(region, n);
    }
  }
}

void ElementTree::finish_triangle(Node& triangle, const std::array<Point, 3>& corners) {
  triangle.triangle = true;
  triangle.area = triangle_area(corners);
  triangle.centroid = mean(corners);
  triangle.moments = moments_about(triangle.centroid, corners, side_axes_[triangle.face_side]);
  for (const Point& c : corners) triangle.radius = std::max(triangle.radius, norm(c - triangle.centroid));
  triangle.shape = static_cast<std::uint32_t>(corners_.size());
  corners_.push_back(corners);
}

void ElementTree::finish_group(const Region& region, Node& group) {
  // Area and centroid.
  Vector moment;
  const Point& origin = side_origin_[group.face_side];
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const Region::Part& part = region.at(i);
    group.area += part.area;
    moment = moment + part.area * (part.centre - origin);
  }
  group.centroid = origin + moment / group.area;
  add_second_moments(region, group);

  Group shape;
  const Frame& axes = side_axes_[group.face_side];
  shape.rectangle = {1e300, 1e300, -1e300, -1e300};
  const std::span<const StartTriangle> own = std::span(start_).subspan(group.begin, group.end - group.begin);
  for (const StartTriangle& t : own) {
    for (const std::uint32_t v : t) {
      const Point& p = region.mesh.vertices[v];
      const double u = dot(p - origin, axes.u);
      const double w = dot(p - origin, axes.v);
      shape.rectangle = {std::min(shape.rectangle[0], u), std::min(shape.rectangle[1], w),
                         std::max(shape.rectangle[2], u), std::max(shape.rectangle[3], w)};
      group.radius = std::max(group.radius, norm(p - group.centroid));
    }
  }
  shape.first_edge = static_cast<std::uint32_t>(edges_.size());
  add_outline(region, group);
  shape.edge_count = static_cast<std::uint32_t>(edges_.size()) - shape.first_edge;
  group.shape = static_cast<std::uint32_t>(groups_.size());
  groups_.push_back(shape);
}

void ElementTree::add_outline(const Region& region, const Node& group) {
  std::vector<std::array<std::uint32_t, 2>> boundary;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const auto& across = region.at(i).across;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t other = across[k] == kNoTriangle ? group.end : region.place[across[k]];
      if (other < group.begin || other >= group.end) boundary.push_back({start_[i][k], start_[i][(k + 1) % 3]});
    }
  }
  const std::vector<Point>& vertices = region.mesh.vertices;
  for (const auto& [from, to] : group_outline(vertices, boundary)) edges_.push_back({vertices[from], vertices[to]});
}

void ElementTree::add_second_moments(const Region& region, Node& group) {
  const Frame& axes = side_axes_[group.face_side];
  SecondMoments& sum = group.moments;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const Region::Part& part = region.at(i);
    const SecondMoments own = moments_about(part.centre, points_of(region.mesh, start_[i]), axes);
    const double share = part.area / group.area;
    const double u = dot(part.centre - group.centroid, axes.u);
    const double v = dot(part.centre - group.centroid, axes.v);
    sum = {sum.uu + share * (own.uu + u * u), sum.uv + share * (own.uv + u * v), sum.vv + share * (own.vv + v * v)};
  }
}

void ElementTree::split_group(Region& region, std::uint32_t group) {
  const Node parent = nodes_[group];
  const Frame& axes = side_axes_[parent.face_side];
  const auto& box = groups_[parent.shape].rectangle;
  const Vector axis = box[2] - box[0] >= box[3] - box[1] ? axes.u : axes.v;
  const Point& origin = side_origin_[parent.face_side];
  struct Placed {
    double along;
    StartTriangle triangle;
    std::uint32_t number;
  };
  std::vector<Placed> placed;
  placed.reserve(parent.end - parent.begin);
  for (std::uint32_t i = parent.begin; i < parent.end; ++i) {
    placed.push_back({dot(region.at(i).centre - origin, axis), start_[i], region.number[i - region.begin]});
  }
  std::ranges::sort(placed, [](const Placed& a, const Placed& b) {
    return a.along != b.along ? a.along < b.along : a.triangle < b.triangle;
  });
  for (std::uint32_t i = parent.begin; i < parent.end; ++i) {
    start_[i] = placed[i - parent.begin].triangle;
    region.put(placed[i - parent.begin].number, i);
  }

  const std::uint32_t middle = parent.begin + (parent.end - parent.begin) / 2;
  nodes_[group].first_child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[group].child_count = 2;
  for (std::uint32_t k = 0; k < 2; ++k) {
    Node child;
    child.parent = group;
    child.face_side = parent.face_side;
    child.level = static_cast<std::uint8_t>(parent.level + 1);
    child.begin = k == 0 ? parent.begin : middle;
    child.end = k == 0 ? middle : parent.end;
    child.key = hash(parent.key, k);
    nodes_.push_back(child);
  }
}

std::span<const ElementId> ElementTree::roots_of(FaceSide side) const {
  const std::uint32_t begin = roots_start_[side.index()];
  return std::span(roots_).subspan(begin, roots_start_[side.index() + 1] - begin);
}

ElementId ElementTree::root(ElementId e) const {
  while (parent(e).valid()) e = parent(e);
  return e;
}

std::array<Point, 3> ElementTree::corners(ElementId e) const {
  assert(is_triangle(e));
  return corners_[node(e).shape];
}

std::span<const OutlineEdge> ElementTree::outline(ElementId e, std::array<OutlineEdge, 3>& scratch) const {
  if (is_triangle(e)) {
    const auto& c = corners_[node(e).shape];
    scratch = {{{c[0], c[1]}, {c[1], c[2]}, {c[2], c[0]}}};
    return scratch;
  }
  const Group& group = groups_[node(e).shape];
  return std::span(edges_).subspan(group.first_edge, group.edge_count);
}

std::size_t ElementTree::hull(ElementId e, std::array<Point, 4>& corners) const {
  if (is_triangle(e)) {
    const auto& c = corners_[node(e).shape];
    std::copy(c.begin(), c.end(), corners.begin());
    return 3;
  }
  const auto& box = groups_[node(e).shape].rectangle;
  const Frame& frame = axes(e);
  const Point& origin = side_origin_[node(e).face_side];
  corners = {origin + (box[0] * frame.u + box[1] * frame.v), origin + (box[2] * frame.u + box[1] * frame.v),
             origin + (box[2] * frame.u + box[3] * frame.v), origin + (box[0] * frame.u + box[3] * frame.v)};
  return 4;
}

std::vector<std::array<Point, 3>> ElementTree::triangles(ElementId e) const {
  std::vector<std::array<Point, 3>> found;
  std::vector<ElementId> waiting{e};
  while (!waiting.empty()) {
    const ElementId next = waiting.back();
    waiting.pop_back();
    if (is_triangle(next)) {
      found.push_back(corners(next));
      continue;
    }
    for (std::size_t k = 0; k < child_count(next); ++k) waiting.emplace_back(first_child(next).index() + k);
  }
  return found;
}

Point ElementTree::sample(ElementId e, double a, double b) const {
  const Node* n = &node(e);
  if (!n->triangle) {
    // The first coordinate chooses the triangle by area and is stretched again.
    const double wanted = area_before_[n->begin] + a * n->area;
    const auto before = area_before_.begin();
    const auto i = std::upper_bound(before + n->begin + 1, before + n->end, wanted) - before - 1;
    n = &nodes_[start_node_[static_cast<std::size_t>(i)]];
    a = std::clamp((wanted - area_before_[static_cast<std::size_t>(i)]) / n->area, 0.0, 1.0);
  }
  return n->centroid + kInside * (in_triangle(corners_[n->shape], a, b) - n->centroid);
}

void ElementTree::split(ElementId e) {
  assert(is_triangle(e) && !has_children(e));
  const auto c = corners(e);
  const std::array<Point, 3> m{midpoint(c[0], c[1]), midpoint(c[1], c[2]), midpoint(c[2], c[0])};
  const std::array<std::array<Point, 3>, kPartsOfTriangle> parts{
      {{c[0], m[0], m[2]}, {m[0], c[1], m[1]}, {m[2], m[1], c[2]}, {m[0], m[1], m[2]}}};
  nodes_[e.index()].first_child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[e.index()].child_count = kPartsOfTriangle;
  const Node above = nodes_[e.index()];
  for (std::uint32_t k = 0; k < kPartsOfTriangle; ++k) {
    Node child;
    child.parent = e.value;
    child.face_side = above.face_side;
    child.level = static_cast<std::uint8_t>(above.level + 1);
    child.begin = above.begin;
    child.end = above.end;
    child.key = hash(above.key, k);
    finish_triangle(child, parts[k]);
    nodes_.push_back(child);
  }
}

bool ElementTree::triangle_holds(const Node& node, const Point& point, double slack) const {
  const auto& c = corners_[node.shape];
  const Vector& normal = side_axes_[node.face_side].w;
  const double least = -slack * 2.0 * node.area;
  return dot(cross(c[1] - c[0], point - c[0]), normal) >= least &&
         dot(cross(c[2] - c[1], point - c[1]), normal) >= least &&
         dot(cross(c[0] - c[2], point - c[2]), normal) >= least;
}

ElementTree::Barycentric ElementTree::barycentric(ElementId triangle, const Point& point) const {
  const auto& c = corners_[node(triangle).shape];
  const Vector& normal = axes(triangle).w;
  const double scale = 0.5 / node(triangle).area;
  const double first = scale * dot(cross(c[2] - c[1], point - c[1]), normal);
  const double second = scale * dot(cross(c[0] - c[2], point - c[2]), normal);
  return {first, second, 1.0 - first - second};
}

std::uint32_t ElementTree::step_down(Barycentric& at) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (at[k] < 0.5) continue;
    for (double& b : at) b *= 2.0;
    at[k] -= 1.0;
    return k;
  }
  // The corners of the middle child are the midpoints of the first, second and third edge.
  at = {1.0 - 2.0 * at[2], 1.0 - 2.0 * at[0], 1.0 - 2.0 * at[1]};
  return 3;
}

bool ElementTree::holds(ElementId e, const Point& point) const {
  const Node& n = node(e);
  if (n.triangle) return triangle_holds(n, point, kEdgeSlack);
  const std::uint32_t first = roots_start_[n.face_side];
  const auto after = std::upper_bound(roots_.begin() + first, roots_.begin() + roots_start_[n.face_side + 1], n.begin,
                                      [&](std::uint32_t start, ElementId root) { return start < node(root).begin; });
  return std::ranges::any_of(
      grids_.near(static_cast<std::size_t>(after - roots_.begin()) - 1, point),
      [&](std::uint32_t i) { return i >= n.begin && i < n.end && start_holds(i, point, kEdgeSlack); });
}

ElementId ElementTree::find(FaceSide side, const Point& point) const {
  const auto roots = roots_of(side);
  if (roots.size() == 1) return find(side, 0, point);
  if (roots.empty()) return {};
  return descend_all(nearest_start(roots_start_[side.index()], roots_start_[side.index() + 1], point), point);
}

ElementId ElementTree::find(FaceSide side, std::uint32_t region, const Point& point) const {
  if (roots_of(side).empty()) return {};
  const std::size_t root = roots_start_[side.index()] + region;
  assert(region < roots_of(side).size());
  return descend_all(start_among(grids_.near(root, point), root, point), point);
}

ElementId ElementTree::find(FaceSide side, std::uint32_t region, const Point& point,
                            std::span<const ElementId> above) const {
  if (roots_of(side).empty()) return {};
  const std::size_t root = roots_start_[side.index()] + region;
  assert(region < roots_of(side).size());
  const ElementId last = above[node(roots_[root]).end - 1];
  if (last == roots_[root]) return last;
  const auto near = grids_.near(root, point);
  // Mostly one node is above all of them, and it does not matter which of them it is.
  const auto same = [&](std::uint32_t i) { return above[i] == above[near.front()]; };
  const bool any = !near.empty() && std::ranges::all_of(near, same);
  return above[any ? near.front() : start_among(near, root, point)];
}

std::uint32_t ElementTree::start_among(std::span<const std::uint32_t> near, std::size_t root,
                                       const Point& point) const {
  if (near.empty()) return nearest_start(root, root + 1, point);
  const auto others = near.first(near.size() - 1);
  const auto found = std::ranges::find_if(others, [&](std::uint32_t i) { return start_holds(i, point, kEdgeSlack); });
  return found != others.end() ? *found : near.back();
}

std::uint32_t ElementTree::nearest_start(std::size_t first_root, std::size_t end_root, const Point& point) const {
  std::uint32_t found = node(roots_[first_root]).begin;
  // Slack grows until something holds the point: hits are rounded, and may lie just outside the face.
  for (double slack = kEdgeSlack; slack < 1.0; slack *= 30.0) {
    for (std::size_t r = first_root; r < end_root; ++r) {
      const auto holds = [&](std::span<const std::uint32_t> near) {
        const auto held = std::ranges::find_if(near, [&](std::uint32_t i) { return start_holds(i, point, slack); });
        if (held != near.end()) found = *held;
        return held != near.end();
      };
      if (grids_.any_within(r, point, 2.0 * slack * node(roots_[r]).radius, holds)) return found;
    }
  }
  return found;
}

}  // namespace clerestory::mesh
