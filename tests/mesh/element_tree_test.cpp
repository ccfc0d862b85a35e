// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/element_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "mesh/clean.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::mesh {
namespace {

constexpr double kUnrefined_m = 1e9;

/// The element tree over all sides of a model's faces.
struct Grown {
  explicit Grown(const Model& model, double max_size_m = kUnrefined_m)
      : faces(build_faces(clean(model, {}))),
        start(mesh_faces(faces, {.max_size_m = max_size_m})),
        tree(faces, start, std::vector<std::uint8_t>(2 * faces.count(), 1)) {}

  [[nodiscard]] std::vector<ElementId> all() const {
    std::vector<ElementId> found;
    for (std::size_t i = 0; i < tree.size(); ++i) found.emplace_back(i);
    return found;
  }
  /// The children of a node.
  [[nodiscard]] std::vector<ElementId> children(ElementId e) const {
    std::vector<ElementId> found;
    for (std::size_t k = 0; k < tree.child_count(e); ++k) found.emplace_back(tree.first_child(e).index() + k);
    return found;
  }
  /// Splits every triangle without children.
  void split_all() {
    for (const ElementId e : all()) {
      if (tree.is_triangle(e) && !tree.has_children(e)) tree.split(e);
    }
  }

  Faces faces;
  Triangulation start;
  ElementTree tree;
};

/// Signed area about a normal by the outline: half the sum of cross products.
double outline_area(const ElementTree& tree, ElementId e) {
  std::array<OutlineEdge, 3> scratch;
  Vector sum;
  for (const OutlineEdge& edge : tree.outline(e, scratch)) {
    sum = sum + 0.5 * cross(edge.from - tree.centroid(e), edge.to - tree.centroid(e));
  }
  return dot(sum, tree.normal(e));
}

/// Least of the three barycentric coordinates.
double least_barycentric(const std::array<Point, 3>& c, const Point& p) {
  const Vector n = cross(c[1] - c[0], c[2] - c[0]);
  double least = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    least = std::min(least, dot(cross(c[(k + 1) % 3] - c[k], p - c[k]), n) / dot(n, n));
  }
  return least;
}

/// Every node's area is that of its outline and of its children together, and roots cover their face side.
void expect_consistent_areas(const Grown& g) {
  for (const ElementId e : g.all()) {
    EXPECT_NEAR(outline_area(g.tree, e), g.tree.area(e), 1e-10);
    if (!g.tree.has_children(e)) continue;
    double below = 0.0;
    Vector moment;
    for (const ElementId child : g.children(e)) {
      below += g.tree.area(child);
      moment = moment + g.tree.area(child) * (g.tree.centroid(child) - g.tree.centroid(e));
      EXPECT_EQ(g.tree.parent(child), e);
      EXPECT_EQ(g.tree.level(child), g.tree.level(e) + 1);
      EXPECT_LE(norm(g.tree.centroid(child) - g.tree.centroid(e)), g.tree.radius(e));
    }
    EXPECT_NEAR(below, g.tree.area(e), 1e-10);
    EXPECT_NEAR(norm(moment), 0.0, 1e-9) << "the centroid of the children is the parent's";
  }
  for (std::size_t s = 0; s < 2 * g.faces.count(); ++s) {
    double sum = 0.0;
    for (const ElementId root : g.tree.roots_of(face_side(s))) sum += g.tree.area(root);
    EXPECT_NEAR(sum, g.faces.faces[s / 2].area_m2, 1e-9);
  }
}

TEST(ElementTree, AreasAddUpFromChildrenToFaces) {
  for (const Model& model : {support::l_room(), support::square_with_hole(), support::table_on_floor()}) {
    Grown g(model, 1.0);
    g.split_all();
    expect_consistent_areas(g);
  }
}

TEST(ElementTree, TrianglesOfANodeCoverItAndFaceItsSide) {
  Grown g(support::square_with_hole(), 1.0);
  g.split_all();
  for (const ElementId e : g.all()) {
    const auto triangles = g.tree.triangles(e);
    EXPECT_EQ(triangles.size(), g.tree.is_triangle(e) ? 1U : g.tree.start_triangle_count(e));
    double area = 0.0;
    Vector moment;
    for (const auto& t : triangles) {
      const double own = 0.5 * dot(cross(t[1] - t[0], t[2] - t[0]), g.tree.normal(e));
      EXPECT_GT(own, 0.0) << "counter-clockwise seen from its side";
      area += own;
      for (const Point& corner : t) moment = moment + (own / 3.0) * (corner - g.tree.centroid(e));
    }
    EXPECT_NEAR(area, g.tree.area(e), 1e-10);
    EXPECT_NEAR(norm(moment), 0.0, 1e-9) << "about the node's centroid";
  }
}

TEST(ElementTree, BothSidesOfAFaceHaveTheirOwnNodesAndOppositeNormals) {
  const Grown g(support::facing_squares());
  const FaceId lower = support::faces_of(g.faces, "lower").at(0);
  const auto front = g.tree.roots_of({lower, Side::kFront});
  const auto back = g.tree.roots_of({lower, Side::kBack});
  ASSERT_EQ(front.size(), 1U);
  ASSERT_EQ(back.size(), 1U);
  EXPECT_NE(front[0], back[0]);
  EXPECT_NEAR(g.tree.normal(front[0]).z, 1.0, 1e-12);
  EXPECT_NEAR(g.tree.normal(back[0]).z, -1.0, 1e-12);
  for (const ElementId e : g.all()) {
    const Frame& axes = g.tree.axes(e);
    EXPECT_NEAR(dot(cross(axes.u, axes.v), axes.w), 1.0, 1e-12) << "axes are right-handed on either side";
    if (!g.tree.is_triangle(e)) continue;
    const auto c = g.tree.corners(e);
    EXPECT_GT(dot(cross(c[1] - c[0], c[2] - c[0]), g.tree.normal(e)), 0.0) << "counter-clockwise seen from its side";
  }
}

TEST(ElementTree, SidesWithoutElementsHaveNoRoots) {
  const Faces faces = build_faces(clean(support::facing_squares(), {}));
  std::vector<std::uint8_t> has_side(2 * faces.count(), 1);
  has_side[1] = 0;
  const ElementTree tree(faces, mesh_faces(faces, {}), has_side);
  EXPECT_TRUE(tree.roots_of(face_side(1)).empty());
  EXPECT_FALSE(tree.find(face_side(1), faces.faces[0].origin).valid());
  EXPECT_EQ(tree.roots().size(), 3U);
}

TEST(ElementTree, EachRegionOfAFaceHasItsRoot) {
  // The partition cuts the floor in two.
  const Grown g(support::two_rooms_with_thin_wall());
  const FaceId floor = support::faces_of(g.faces, "floor").at(0);
  const auto roots = g.tree.roots_of({floor, Side::kFront});
  ASSERT_EQ(roots.size(), 2U);
  for (const ElementId root : roots) EXPECT_NEAR(g.tree.area(root), 12.0, 1e-9);
}

TEST(ElementTree, SecondMomentsOfARectangleAreTheTextbooks) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0});
  const Grown g(model, 0.7);
  for (const ElementId root : g.tree.roots()) {
    const SecondMoments& m = g.tree.second_moments(root);
    EXPECT_NEAR(m.uu + m.vv, (9.0 + 4.0) / 12.0, 1e-10);
    EXPECT_NEAR(m.uu * m.vv - m.uv * m.uv, 9.0 * 4.0 / 144.0, 1e-10);
    // Along x, whatever the axes: w^2/12.
    const Frame& axes = g.tree.axes(root);
    EXPECT_NEAR(axes.u.x * axes.u.x * m.uu + 2.0 * axes.u.x * axes.v.x * m.uv + axes.v.x * axes.v.x * m.vv, 9.0 / 12.0,
                1e-10);
  }
}

TEST(ElementTree, SecondMomentsOfATriangleAreTheTextbooks) {
  Model model;
  support::add_triangle(model, {0, 0, 0}, {3, 0, 0}, {0, 2, 0});
  const Grown g(model);
  const SecondMoments& m = g.tree.second_moments(g.tree.roots()[0]);
  EXPECT_NEAR(m.uu + m.vv, (9.0 + 4.0) / 18.0, 1e-12);
  EXPECT_NEAR(m.uu * m.vv - m.uv * m.uv, 9.0 * 4.0 / 432.0, 1e-12);
}

TEST(ElementTree, SecondMomentsOfChildrenMakeThoseOfTheirParent) {
  Grown g(support::l_room(), 1.0);
  g.split_all();
  for (const ElementId e : g.all()) {
    if (!g.tree.has_children(e)) continue;
    SecondMoments sum;
    for (const ElementId child : g.children(e)) {
      const Vector d = g.tree.centroid(child) - g.tree.centroid(e);
      const double u = dot(d, g.tree.axes(e).u);
      const double v = dot(d, g.tree.axes(e).v);
      const double share = g.tree.area(child) / g.tree.area(e);
      const SecondMoments& m = g.tree.second_moments(child);
      sum = {sum.uu + share * (m.uu + u * u), sum.uv + share * (m.uv + u * v), sum.vv + share * (m.vv + v * v)};
    }
    EXPECT_NEAR(sum.uu, g.tree.second_moments(e).uu, 1e-10);
    EXPECT_NEAR(sum.uv, g.tree.second_moments(e).uv, 1e-10);
    EXPECT_NEAR(sum.vv, g.tree.second_moments(e).vv, 1e-10);
  }
}

TEST(ElementTree, HullHoldsTheOutline) {
  const Grown g(support::square_with_hole(), 1.0);
  for (const ElementId e : g.all()) {
    std::array<Point, 4> hull;
    const std::size_t n = g.tree.hull(e, hull);
    std::array<OutlineEdge, 3> scratch;
    for (const OutlineEdge& edge : g.tree.outline(e, scratch)) {
      for (std::size_t k = 0; k < n; ++k) {
        const Vector side = hull[(k + 1) % n] - hull[k];
        EXPECT_GE(dot(cross(side, edge.from - hull[k]), g.tree.normal(e)), -1e-9);
      }
    }
  }
}

TEST(ElementTree, SplitGivesFourSimilarTriangles) {
  Grown g(support::l_room());
  for (const ElementId e : g.all()) {
    if (!g.tree.is_triangle(e)) continue;
    g.tree.split(e);
    ASSERT_EQ(g.tree.child_count(e), 4U);
    for (const ElementId child : g.children(e)) {
      EXPECT_NEAR(g.tree.area(child), 0.25 * g.tree.area(e), 1e-12);
      EXPECT_NEAR(g.tree.radius(child), 0.5 * g.tree.radius(e), 1e-12);
      EXPECT_EQ(g.tree.root(child), g.tree.root(e));
    }
  }
}

/// Splits some triangles again and again at random.
void split_at_random(Grown& g, std::mt19937& random, std::size_t times) {
  for (std::size_t i = 0; i < times; ++i) {
    const ElementId e(std::size_t{random()} % g.tree.size());
    if (g.tree.is_triangle(e) && !g.tree.has_children(e)) g.tree.split(e);
  }
}

void expect_found(const Grown& g, FaceSide side, const Point& p) {
  const ElementId found = g.tree.find(side, p);
  ASSERT_TRUE(found.valid());
  EXPECT_EQ(g.tree.face_side(found), side);
  ASSERT_TRUE(g.tree.is_triangle(found));
  EXPECT_FALSE(g.tree.has_children(found));
  EXPECT_GE(least_barycentric(g.tree.corners(found), p), -1e-5);
}

TEST(ElementTree, FindReturnsTheDeepestElementThatHoldsAPoint) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const Model& model : {support::l_room(), support::square_with_hole(), support::table_on_floor()}) {
    Grown g(model, 2.0);
    split_at_random(g, random, 400);
    for (int i = 0; i < 2000; ++i) {
      const ElementId root = g.tree.roots()[random() % g.tree.roots().size()];
      expect_found(g, g.tree.face_side(root), g.tree.sample(root, uniform(random), uniform(random)));
    }
  }
}

TEST(ElementTree, FindReturnsANeighbourForPointsOnEdgesAndCorners) {
  std::mt19937 random(8);
  Grown g(support::l_room(), 2.0);
  split_at_random(g, random, 300);
  for (const ElementId e : g.all()) {
    if (!g.tree.is_triangle(e)) continue;
    const auto c = g.tree.corners(e);
    for (std::size_t k = 0; k < 3; ++k) {
      expect_found(g, g.tree.face_side(e), c[k]);
      expect_found(g, g.tree.face_side(e), midpoint(c[k], c[(k + 1) % 3]));
    }
  }
}

TEST(ElementTree, FindForgivesPointsJustOutsideTheFace) {
  const Grown g(support::facing_squares());
  const FaceSide lower{support::faces_of(g.faces, "lower").at(0), Side::kFront};
  const ElementId found = g.tree.find(lower, Point{1.0005, 0.5, 1e-5} - g.faces.origin);
  ASSERT_TRUE(found.valid());
  EXPECT_EQ(g.tree.face_side(found), lower);
}

/// Groups and start triangles that cover the regions, chosen from the roots down at random; [start triangles] the one above each.
std::vector<ElementId> cover_at_random(const Grown& g, std::mt19937& random) {
  std::vector<ElementId> above(g.tree.start_triangle_count());
  const auto put = [&](ElementId e) {
    std::fill_n(above.begin() + static_cast<std::ptrdiff_t>(g.tree.first_start_triangle(e)),
                g.tree.start_triangle_count(e), e);
  };
  for (const ElementId root : g.tree.roots()) put(root);
  for (const ElementId e : g.all()) {
    if (g.tree.is_triangle(e) || above[g.tree.first_start_triangle(e)] != e || random() % 4 == 0) continue;
    for (const ElementId child : g.children(e)) put(child);
  }
  return above;
}

TEST(ElementTree, FindReturnsTheGivenNodeAboveAPoint) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const Model& model : {support::l_room(), support::square_with_hole(), support::table_on_floor()}) {
    Grown g(model, 0.5);
    split_at_random(g, random, 400);
    const std::vector<ElementId> above = cover_at_random(g, random);
    for (int i = 0; i < 2000; ++i) {
      const ElementId root = g.tree.roots()[random() % g.tree.roots().size()];
      const FaceSide side = g.tree.face_side(root);
      const auto region =
          static_cast<std::uint32_t>(std::ranges::find(g.tree.roots_of(side), root) - g.tree.roots_of(side).begin());
      const Point p = g.tree.sample(root, uniform(random), uniform(random));
      EXPECT_EQ(g.tree.find(side, region, p, above), above[g.tree.first_start_triangle(g.tree.find(side, p))]);
    }
  }
}

TEST(ElementTree, NodesHoldTheirOwnPointsAndNoOthers) {
  std::mt19937 random(10);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Grown g(support::square_with_hole(), 0.5);
  const ElementId root = g.tree.roots()[0];
  for (int i = 0; i < 500; ++i) {
    const Point p = g.tree.sample(root, uniform(random), uniform(random));
    const ElementId found = g.tree.find(g.tree.face_side(root), p);
    for (const ElementId e : g.all()) {
      if (g.tree.root(e) != root) continue;
      bool is_above = e == found;
      for (ElementId up = found; up.valid(); up = g.tree.parent(up)) is_above = is_above || up == e;
      EXPECT_EQ(g.tree.holds(e, p), is_above);
    }
  }
}

TEST(ElementTree, SamplesAreUniformByArea) {
  Grown g(support::l_room(), 1.5);
  const FaceId floor = support::faces_of(g.faces, "floor").at(0);
  const ElementId root = g.tree.roots_of({floor, Side::kFront})[0];
  constexpr int kPoints = 100'000;
  std::map<std::uint32_t, int> counts;
  for (int i = 0; i < kPoints; ++i) {
    // Roberts' R2 sequence.
    const Point p = g.tree.sample(root, std::fmod(0.7548776662466927 * i, 1.0), std::fmod(0.5698402909980532 * i, 1.0));
    ++counts[g.tree.find({floor, Side::kFront}, p).value];
  }
  double area = 0.0;
  for (const auto& [e, count] : counts) {
    const double share = g.tree.area(ElementId(e)) / g.tree.area(root);
    EXPECT_NEAR(static_cast<double>(count) / kPoints, share, 0.01 * share);
    area += g.tree.area(ElementId(e));
  }
  EXPECT_NEAR(area, 12.0, 1e-9) << "every triangle of the floor gets samples";
}

TEST(ElementTree, SamplesHaveTheMomentsOfTheirNode) {
  Grown g(support::l_room(), 1.5);
  g.split_all();
  constexpr int kSteps = 128;
  for (const ElementId e : g.all()) {
    Vector mean;
    SecondMoments m;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        const Point p = g.tree.sample(e, (i + 0.5) / kSteps, (j + 0.5) / kSteps);
        const Vector d = p - g.tree.centroid(e);
        const double u = dot(d, g.tree.axes(e).u);
        const double v = dot(d, g.tree.axes(e).v);
        mean = mean + d / (kSteps * kSteps);
        m = {m.uu + u * u / (kSteps * kSteps), m.uv + u * v / (kSteps * kSteps), m.vv + v * v / (kSteps * kSteps)};
      }
    }
    const double r = g.tree.radius(e);
    EXPECT_NEAR(norm(mean), 0.0, 0.02 * r);
    EXPECT_NEAR(m.uu, g.tree.second_moments(e).uu, 0.01 * r * r);
    EXPECT_NEAR(m.uv, g.tree.second_moments(e).uv, 0.01 * r * r);
    EXPECT_NEAR(m.vv, g.tree.second_moments(e).vv, 0.01 * r * r);
  }
}

TEST(ElementTree, CornersOfTheUnitSquareStayInsideTheNode) {
  const Grown g(support::square_with_hole(), 1.0);
  const ElementId root = g.tree.roots()[0];
  for (const double a : {0.0, 0.5, 1.0}) {
    for (const double b : {0.0, 0.5, 1.0}) {
      const Point p = g.tree.sample(root, a, b) + g.faces.origin;
      EXPECT_TRUE(p.x >= -1e-9 && p.x <= 4.0 + 1e-9 && p.y >= -1e-9 && p.y <= 4.0 + 1e-9);
      EXPECT_FALSE(p.x > 1.0 + 1e-9 && p.x < 3.0 - 1e-9 && p.y > 1.0 + 1e-9 && p.y < 3.0 - 1e-9) << "in the hole";
    }
  }
}

/// Centroids by key.
std::map<std::uint64_t, Point> keyed(const Grown& g) {
  std::map<std::uint64_t, Point> found;
  for (const ElementId e : g.all()) found[g.tree.key(e)] = g.tree.centroid(e);
  return found;
}

TEST(ElementTree, KeysBelongToPlacesWhateverTheOrderOfSplitting) {
  Grown forwards(support::l_room(), 2.0);
  Grown backwards(support::l_room(), 2.0);
  const auto triangles = [](const Grown& g) {
    std::vector<ElementId> found;
    for (const ElementId e : g.all()) {
      if (g.tree.is_triangle(e)) found.push_back(e);
    }
    return found;
  };
  const auto order = triangles(forwards);
  for (const ElementId e : order) forwards.tree.split(e);
  for (auto e = order.rbegin(); e != order.rend(); ++e) backwards.tree.split(*e);
  const auto a = keyed(forwards);
  const auto b = keyed(backwards);
  ASSERT_EQ(a.size(), forwards.tree.size()) << "keys differ from each other";
  EXPECT_EQ(a, b);
}

}  // namespace
}  // namespace clerestory::mesh
