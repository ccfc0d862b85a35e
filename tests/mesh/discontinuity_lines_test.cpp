// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/discontinuity_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "mesh/rays.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::mesh {
namespace {

constexpr double kMillimetre = 1e-3;

Faces faces_from(const Model& model) { return build_faces(clean(model, {})); }

/// A rectangle of half sides a and b at a height, turned about z, that shines down.
ShadowSource lamp(double a, double b, double height, double turn_rad = 0.0, double x = 0.0) {
  ShadowSource source;
  source.normal = {0, 0, -1};
  std::vector<Point> loop;
  for (const auto& [u, v] : {std::pair(-a, -b), std::pair(a, -b), std::pair(a, b), std::pair(-a, b)}) {
    loop.push_back(
        {x + u * std::cos(turn_rad) - v * std::sin(turn_rad), u * std::sin(turn_rad) + v * std::cos(turn_rad), height});
  }
  source.outline = {loop};
  return source;
}

void add_level_rectangle(Model& model, double x0, double y0, double x1, double y1, double z, const char* material) {
  support::add_quad(model, {x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}, {material, material});
}

Model floor_of(double half) {
  Model model;
  add_level_rectangle(model, -half, -half, half, half, 0.0, "floor");
  return model;
}

/// What a source in model coordinates makes, in model coordinates.
FoundLines find(const Faces& faces, ShadowSource source, const DiscontinuityOptions& options = {}) {
  for (auto& loop : source.outline) {
    for (Point& p : loop) p = p - faces.origin;
  }
  source.at = source.at - faces.origin;
  FoundLines found = DiscontinuityFinder(faces, options).find(source, 0);
  for (DiscontinuityLine& line : found.lines) {
    for (Point& p : line.ends) p = p + faces.origin;
  }
  for (NoSkySurface& surface : found.no_sky) {
    for (Point& p : surface) p = p + faces.origin;
  }
  return found;
}

std::vector<DiscontinuityLine> lines_on(const Faces& faces, const FoundLines& found, const char* material) {
  const auto ids = support::faces_of(faces, material);
  std::vector<DiscontinuityLine> lines;
  std::copy_if(found.lines.begin(), found.lines.end(), std::back_inserter(lines),
               [&](const DiscontinuityLine& l) { return std::find(ids.begin(), ids.end(), l.face) != ids.end(); });
  return lines;
}

double distance_to(const DiscontinuityLine& line, const Point& p) {
  const Vector along = line.ends[1] - line.ends[0];
  const double t = std::clamp(dot(p - line.ends[0], along) / dot(along, along), 0.0, 1.0);
  return norm(p - (line.ends[0] + t * along));
}

/// The largest distance of a point of a segment from the nearest line that runs along it.
double gap(std::span<const DiscontinuityLine> lines, const Point& from, const Point& to) {
  const Vector along = normalized(to - from);
  double largest = 0.0;
  for (int i = 0; i <= 200; ++i) {
    const Point p = from + (i / 200.0) * (to - from);
    double nearest = 1e9;
    for (const DiscontinuityLine& line : lines) {
      if (norm(cross(normalized(line.ends[1] - line.ends[0]), along)) > 1e-3) continue;
      nearest = std::min(nearest, distance_to(line, p));
    }
    largest = std::max(largest, nearest);
  }
  return largest;
}

double polygon_gap(std::span<const DiscontinuityLine> lines, std::span<const Point> corners) {
  double largest = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    largest = std::max(largest, gap(lines, corners[i], corners[(i + 1) % corners.size()]));
  }
  return largest;
}

std::vector<Point> rectangle(double x, double y) { return {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}; }

/// A convex polygon cut by another (Sutherland and Hodgman), both counter-clockwise, at z = 0.
std::vector<Point> cut_convex(std::vector<Point> polygon, std::span<const Point> by) {
  for (std::size_t i = 0; i < by.size(); ++i) {
    const Point& a = by[i];
    const Vector along = by[(i + 1) % by.size()] - a;
    const auto inside = [&](const Point& p) { return cross(along, p - a).z; };
    std::vector<Point> next;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point& p = polygon[k];
      const Point& q = polygon[(k + 1) % polygon.size()];
      if (inside(p) >= 0.0) next.push_back(p);
      if ((inside(p) > 0.0) != (inside(q) > 0.0)) next.push_back(p + inside(p) / (inside(p) - inside(q)) * (q - p));
    }
    polygon = std::move(next);
  }
  return polygon;
}

std::vector<Point> hull_of(std::vector<Point> points) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
  std::vector<Point> hull;
  for (const int pass : {0, 1}) {
    const std::size_t base = hull.size();
    for (const Point& p : points) {
      while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()).z <= 1e-12)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    if (pass == 0) std::reverse(points.begin(), points.end());
  }
  return hull;
}

TEST(DiscontinuityLines, UmbraAndPenumbraOfAParallelPlateAreWithinAMillimetre) {
  Model model = floor_of(5);
  add_level_rectangle(model, -0.5, -0.4, 0.5, 0.4, 1.5, "plate");
  const Faces faces = faces_from(model);
  const FoundLines found = find(faces, lamp(0.6, 0.3, 3.0));
  const auto lines = lines_on(faces, found, "floor");
  EXPECT_LT(polygon_gap(lines, rectangle(0.4, 0.5)), kMillimetre);
  EXPECT_LT(polygon_gap(lines, rectangle(1.6, 1.1)), kMillimetre);
  for (const DiscontinuityLine& line : lines) {
    EXPECT_EQ(line.order, 1);
    EXPECT_EQ(line.side, Side::kFront);
    for (const Point& p : line.ends) {
      EXPECT_LE(std::abs(p.x), 1.6 + 1e-9);
      EXPECT_LE(std::abs(p.y), 1.1 + 1e-9);
    }
  }
}

TEST(DiscontinuityLines, UmbraAndPenumbraOfATurnedPlateAreWithinAMillimetre) {
  Model model = floor_of(5);
  add_level_rectangle(model, -0.7, -0.6, 0.7, 0.6, 1.5, "plate");
  const Faces faces = faces_from(model);
  const ShadowSource source = lamp(0.4, 0.2, 3.0, 0.5);
  const auto lines = lines_on(faces, find(faces, source), "floor");
  // The shadow of a point L of the lamp is the plate, doubled, less L.
  std::vector<Point> umbra = rectangle(10, 10);
  std::vector<Point> shadows;
  for (const Point& l : source.outline[0]) {
    std::vector<Point> shadow;
    for (const Point& p : rectangle(1.4, 1.2)) shadow.push_back({p.x - l.x, p.y - l.y, 0});
    umbra = cut_convex(umbra, shadow);
    shadows.insert(shadows.end(), shadow.begin(), shadow.end());
  }
  EXPECT_EQ(hull_of(shadows).size(), 8U);
  EXPECT_LT(polygon_gap(lines, umbra), kMillimetre);
  EXPECT_LT(polygon_gap(lines, hull_of(shadows)), kMillimetre);
  EXPECT_TRUE(std::all_of(lines.begin(), lines.end(), [](const DiscontinuityLine& l) { return l.order == 2; }));
}

TEST(DiscontinuityLines, BlockersThatTouchCastTheShadowOfOne) {
  Model model = floor_of(5);
  add_level_rectangle(model, -0.5, -0.4, 0.1, 0.4, 1.5, "plate");
  add_level_rectangle(model, 0.1, -0.4, 0.5, 0.4, 1.5, "other plate");
  const Faces faces = faces_from(model);
  const auto lines = lines_on(faces, find(faces, lamp(0.6, 0.3, 3.0)), "floor");
  EXPECT_LT(polygon_gap(lines, rectangle(0.4, 0.5)), kMillimetre);
  EXPECT_LT(polygon_gap(lines, rectangle(1.6, 1.1)), kMillimetre);
  const auto inner = [](const DiscontinuityLine& l) {
    const double x = l.ends[0].x;
    return std::abs(x - l.ends[1].x) < 1e-6 && std::abs(std::abs(x) - 0.4) > 1e-6 && std::abs(std::abs(x) - 1.6) > 1e-6;
  };
  EXPECT_TRUE(std::none_of(lines.begin(), lines.end(), inner));
}

TEST(DiscontinuityLines, ShadowsOfAScreenOnTheFloorBeginAtItsFoot) {
  Model model = floor_of(5);
  support::add_quad(model, {-0.5, 1, 0}, {0.5, 1, 0}, {0.5, 1, 1}, {-0.5, 1, 1}, {"screen", "screen"});
  const Faces faces = faces_from(model);
  EXPECT_EQ(faces.contact_count, 1U);  // the D0 line is there already
  const auto lines = lines_on(faces, find(faces, lamp(0.3, 0.2, 3.0)), "floor");
  // From a corner L of the lamp, the upright edge at x = ±0.5 casts a line from its foot to 1.5 · (x, 1) - 0.5 · L.
  for (const double x : {-0.5, 0.5}) {
    for (const double lx : {-0.3, 0.3}) {
      for (const double ly : {-0.2, 0.2}) {
        const Point tip{1.5 * x - 0.5 * lx, 1.5 - 0.5 * ly, 0};
        EXPECT_LT(gap(lines, {x, 1, 0}, tip), kMillimetre);
      }
    }
  }
  // The upper edge is parallel to the lamp's.
  EXPECT_LT(gap(lines, {-0.9, 1.6, 0}, {0.9, 1.6, 0}), kMillimetre);
  EXPECT_LT(gap(lines, {-0.6, 1.4, 0}, {0.6, 1.4, 0}), kMillimetre);
}

TEST(DiscontinuityLines, LouvreOfFortySlatsCastsEachOfItsEdges) {
  Model model = floor_of(5);
  for (int i = 0; i < 40; ++i) {
    const double x = -2.0 + 0.1 * i;
    add_level_rectangle(model, x, -1, x + 0.05, 1, 1.0, "slat");
  }
  const Faces faces = faces_from(model);
  const auto lines = lines_on(faces, find(faces, lamp(0.31, 0.2, 3.0)), "floor");
  for (int i = 0; i < 80; ++i) {
    const double edge = -2.0 + 0.05 * i;
    for (const double lx : {-0.31, 0.31}) {
      const double x = 1.5 * edge - 0.5 * lx;
      EXPECT_LT(gap(lines, {x, -1.6, 0}, {x, 1.6, 0}), kMillimetre) << "slat edge " << i;
    }
  }
}

TEST(DiscontinuityLines, SunThroughAWindowCastsTheWindow) {
  Model model = floor_of(5);
  support::add_polygon(model, {{-3, 0, 0}, {3, 0, 0}, {3, 0, 3}, {-3, 0, 3}}, {"wall", "wall"},
                       {{{-1, 0, 1}, {-1, 0, 2}, {1, 0, 2}, {1, 0, 1}}});
  const Faces faces = faces_from(model);
  ShadowSource sun;
  sun.kind = ShadowSource::Kind::kDirection;
  sun.towards = normalized({0.3, -1.0, 0.8});
  const auto lines = lines_on(faces, find(faces, sun), "floor");
  const auto shadow = [](double x, double z) { return Point{x - 0.3 * z / 0.8, z / 0.8, 0}; };
  const std::array<Point, 4> patch{shadow(-1, 1), shadow(1, 1), shadow(1, 2), shadow(-1, 2)};
  EXPECT_LT(polygon_gap(lines, patch), kMillimetre);
  for (const DiscontinuityLine& line : lines) EXPECT_EQ(line.order, 0);
}

TEST(DiscontinuityLines, PointLightCastsTheExactShadow) {
  Model model = floor_of(5);
  support::add_box(model, {0.2, 0.2, 0.5}, {0.6, 0.6, 1.0}, {"box", "box"});
  const Faces faces = faces_from(model);
  ShadowSource point;
  point.kind = ShadowSource::Kind::kPoint;
  point.at = {0, 0, 3};
  const auto lines = lines_on(faces, find(faces, point), "floor");
  std::vector<Point> shadow;
  for (const double x : {0.2, 0.6}) {
    for (const double y : {0.2, 0.6}) {
      for (const double z : {0.5, 1.0}) shadow.push_back({3 * x / (3 - z), 3 * y / (3 - z), 0});
    }
  }
  const std::vector<Point> hull = hull_of(shadow);
  EXPECT_LT(polygon_gap(lines, hull), kMillimetre);
  for (const DiscontinuityLine& line : lines) {
    const Point middle = midpoint(line.ends[0], line.ends[1]);
    double nearest = 1e9;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      DiscontinuityLine side;
      side.ends = {hull[i], hull[(i + 1) % hull.size()]};
      nearest = std::min(nearest, distance_to(side, middle));
    }
    EXPECT_LT(nearest, kMillimetre);
  }
}

/// A room of 4 m × 6 m × 3 m behind a facade of some thickness along y = 0 with a window from x = 1 to 3, z = 1 to 2.5, and a building
/// of 8 m opposite, 10 m before the room.
Model office(double thickness) {
  Model model;
  add_level_rectangle(model, 0, 0, 4, 6, 0, "floor");
  add_level_rectangle(model, 0, 0, 4, 6, 3, "ceiling");
  support::add_quad(model, {0, 0, 0}, {0, 6, 0}, {0, 6, 3}, {0, 0, 3}, {"wall", "wall"});
  support::add_quad(model, {4, 0, 0}, {4, 6, 0}, {4, 6, 3}, {4, 0, 3}, {"wall", "wall"});
  support::add_quad(model, {0, 6, 0}, {4, 6, 0}, {4, 6, 3}, {0, 6, 3}, {"wall", "wall"});
  const auto facade = [&](double y) {
    support::add_polygon(model, {{0, y, 0}, {4, y, 0}, {4, y, 3}, {0, y, 3}}, {"facade", "facade"},
                         {{{1, y, 1}, {1, y, 2.5}, {3, y, 2.5}, {3, y, 1}}});
  };
  facade(0);
  if (thickness > 0.0) {
    facade(-thickness);
    support::add_quad(model, {1, 0, 1}, {3, 0, 1}, {3, -thickness, 1}, {1, -thickness, 1}, {"reveal", "reveal"});
    support::add_quad(model, {1, 0, 2.5}, {3, 0, 2.5}, {3, -thickness, 2.5}, {1, -thickness, 2.5},
                      {"reveal", "reveal"});
    support::add_quad(model, {1, 0, 1}, {1, 0, 2.5}, {1, -thickness, 2.5}, {1, -thickness, 1}, {"reveal", "reveal"});
    support::add_quad(model, {3, 0, 1}, {3, 0, 2.5}, {3, -thickness, 2.5}, {3, -thickness, 1}, {"reveal", "reveal"});
  }
  support::add_box(model, {-20, -20, -1}, {24, -10, 8}, {"opposite", "opposite"});
  return model;
}

ShadowSource window_at(double y) {
  ShadowSource source;
  source.outline = {{{1, y, 1}, {3, y, 1}, {3, y, 2.5}, {1, y, 2.5}}};
  source.normal = {0, 1, 0};
  source.sky = true;
  return source;
}

/// The stretch in x, and the range in y, of the no-sky surfaces' cuts at a height.
Box no_sky_at(const FoundLines& found, double height) {
  Box box;
  for (const NoSkySurface& surface : found.no_sky) {
    const auto cut = cut_by_plane(surface, {0, 0, height}, {0, 0, 1});
    if (!cut) continue;
    box.add((*cut)[0]);
    box.add((*cut)[1]);
  }
  return box;
}

TEST(DiscontinuityLines, NoSkyLineOfAnOfficeIsWhereRoofAndWindowHeadMeetInView) {
  for (const double thickness : {0.0, 0.3}) {
    const Faces faces = faces_from(office(thickness));
    const FoundLines found = find(faces, window_at(-0.5 * thickness));
    // The roof is 5.5 m above the head, which ends 10 m less the thickness behind it.
    const double fall = 5.5 / (10.0 - thickness);
    for (const double height : {0.0, 0.8}) {
      const double y = (2.5 - height) / fall - thickness;
      const Box box = no_sky_at(found, height + 1e-9);
      EXPECT_NEAR(box.low.y, y, 1e-6);
      EXPECT_NEAR(box.high.y, y, 1e-6);
      EXPECT_NEAR(box.low.x, 0.0, 1e-6);
      EXPECT_NEAR(box.high.x, 4.0, 1e-6);
    }
    double length = 0.0;
    for (const DiscontinuityLine& line : lines_on(faces, found, "floor")) {
      if (!line.no_sky) continue;
      EXPECT_EQ(line.order, 1);
      length += norm(line.ends[1] - line.ends[0]);
    }
    EXPECT_GT(length, 4.0 - 1e-6);
  }
}

/// Whether all points along a lamp's outline are seen from a point of the floor.
bool is_lit(const Faces& faces, const Rays& rays, const ShadowSource& source, const Point& p) {
  constexpr int kPointsAnEdge = 40;
  const Point from = p - faces.origin + Vector{0, 0, rays.offset_m()};
  std::vector<Segment> segments;
  for (std::size_t k = 0; k < 4; ++k) {
    const Point& a = source.outline[0][k];
    const Vector along = source.outline[0][(k + 1) % 4] - a;
    for (int i = 0; i < kPointsAnEdge; ++i) {
      segments.push_back({from, a + (1.0 * i / kPointsAnEdge) * along - faces.origin});
    }
  }
  std::vector<float> passed(segments.size());
  rays.transmittance(segments, passed);
  return std::all_of(passed.begin(), passed.end(), [](float t) { return t > 0.0F; });
}

TEST(DiscontinuityLines, LightAndPenumbraOfManyBlockersMeetAtLinesOnly) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  std::uniform_real_distribution<double> size(0.1, 0.5);
  Model model = floor_of(4);
  for (int i = 0; i < 12; ++i) {
    const Point low{place(random), place(random), 0.3 + 0.5 * size(random)};
    Model box;
    support::add_box(box, low, low + Vector{size(random), size(random), size(random)}, {"box", "box"});
    support::append(model, support::rotated(box, {0, 0, 1}, place(random)));
  }
  const Faces faces = faces_from(model);
  const Rays rays(faces);
  const ShadowSource source = lamp(0.5, 0.2, 2.5, 0.3);
  const auto lines = lines_on(faces, find(faces, source), "floor");
  constexpr double kStep = 0.01;
  int edges = 0;
  for (double y = -3.0; y < 3.0; y += 0.3) {
    bool before = is_lit(faces, rays, source, {-3.5, y, 0});
    for (double x = -3.5 + kStep; x < 3.5; x += kStep) {
      const bool lit = is_lit(faces, rays, source, {x, y, 0});
      if (lit != before) {
        ++edges;
        const Point between{x - 0.5 * kStep, y, 0};
        const bool near = std::any_of(lines.begin(), lines.end(), [&](const DiscontinuityLine& l) {
          return distance_to(l, between) < 1.5 * kStep;
        });
        EXPECT_TRUE(near) << "at " << x << " " << y;
      }
      before = lit;
    }
  }
  EXPECT_GT(edges, 40);
}

TEST(DiscontinuityLines, SourceInThePlaneOfItsOccluderCastsNothing) {
  Model model = floor_of(5);
  add_level_rectangle(model, 1, -0.4, 2, 0.4, 3.0, "plate");
  const Faces faces = faces_from(model);
  EXPECT_TRUE(lines_on(faces, find(faces, lamp(0.6, 0.3, 3.0)), "floor").empty());
}

TEST(DiscontinuityLines, LampInsideOfASolidLightsItsInsideAlone) {
  Model model = floor_of(5);
  support::add_box(model, {-1, -1, 1}, {1, 1, 2}, {"box", "box"});
  add_level_rectangle(model, -0.1, -0.1, 0.1, 0.1, 0.5, "plate");
  const Faces faces = faces_from(model);
  const FoundLines found = find(faces, lamp(0.3, 0.2, 1.5));
  EXPECT_TRUE(lines_on(faces, found, "floor").empty());
}

TEST(DiscontinuityLines, CoincidentAndDegenerateOccludersCastTheShadowOfOne) {
  Model model = floor_of(5);
  add_level_rectangle(model, -0.5, -0.4, 0.5, 0.4, 1.5, "plate");
  support::add_quad(model, {-0.5, -0.4, 1.5}, {0.5, -0.4, 1.5}, {0.5, 0.4, 1.5}, {-0.5, 0.4, 1.5}, {"plate", "twin"});
  support::add_triangle(model, {-0.5, -0.4, 1.5}, {0.0, -0.4, 1.5}, {0.5, -0.4, 1.5}, {"plate", "nothing"});
  const Faces faces = faces_from(model);
  const auto lines = lines_on(faces, find(faces, lamp(0.6, 0.3, 3.0)), "floor");
  EXPECT_LT(polygon_gap(lines, rectangle(0.4, 0.5)), kMillimetre);
  EXPECT_LT(polygon_gap(lines, rectangle(1.6, 1.1)), kMillimetre);
  for (const DiscontinuityLine& line : lines) {
    EXPECT_EQ(line.order, 1);
    EXPECT_TRUE(std::isfinite(line.uncovering));
  }
}

TEST(DiscontinuityLines, ThousandsOfTinyPartsEndAtTheLimit) {
  Model model = floor_of(5);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const Point p{place(random), place(random), 1.5 + 0.2 * place(random)};
    support::add_triangle(model, p, p + Vector{0.01, 0, 0}, p + Vector{0, 0.01, 0.003}, {"leaf", "leaf"});
  }
  const Faces faces = faces_from(model);
  const FoundLines found = DiscontinuityFinder(faces).find(lamp(0.3, 0.2, 3.0), 0, 3000);
  EXPECT_TRUE(found.stopped);
  EXPECT_EQ(found.critical_surfaces, 3000U);
  for (const DiscontinuityLine& line : found.lines) {
    EXPECT_TRUE(is_finite(line.ends[0]));
    EXPECT_TRUE(is_finite(line.ends[1]));
  }
}

}  // namespace
}  // namespace clerestory::mesh
