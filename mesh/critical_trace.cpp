// SPDX-License-Identifier: GPL-3.0-or-later
// Notation. A point of a wedge's plane is p = pivot + w · (edge[0] + u · (edge[1] - edge[0]) - pivot), or, where the pivot lies at infinity,
// p = edge[0] + u · (edge[1] - edge[0]) - w · towards: u tells the line, w the place on it, w = 1 (0) at the edge.
#include "mesh/critical_trace.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mesh/planar.h"
#include "mesh/wedge_sweep.h"

namespace clerestory::mesh {

namespace {

using Ends = std::array<Point, 2>;
using Role = SweptSegment::Role;

/// Vertices nearer to the plane of a surface than this lie in it [m]: a twentieth of the tolerance of welding.
constexpr double kInPlane = 1e-6;
/// What is nearer to the edge than this, along a line, touches it and does not block [m].
constexpr double kTouch = 2e-5;
/// Shorter traces are rounding [m].
constexpr double kShortest = 1e-6;
/// Surfaces narrower than this angle, or share of their length, have no plane.
constexpr double kFlat = 1e-9;

/// A place in the plane of a wedge by two numbers that are linear in it: shares (a, b) of the two sides of the wedge, or (u, w)
/// where the pivot lies at infinity.
struct Place {
  double a = 0.0;
  double b = 0.0;
};

/// The plane of a wedge.
class WedgePlane {
 public:
  explicit WedgePlane(const Wedge& wedge) : wedge_(wedge) {
    origin_ = wedge.parallel ? wedge.edge[0] : wedge.pivot;
    const Vector s = wedge.parallel ? wedge.edge[1] - wedge.edge[0] : wedge.edge[0] - wedge.pivot;
    const Vector t = wedge.parallel ? -wedge.towards : wedge.edge[1] - wedge.pivot;
    const double ss = dot(s, s);
    const double st = dot(s, t);
    const double tt = dot(t, t);
    const double determinant = ss * tt - st * st;
    flat_ = determinant <= kFlat * kFlat * ss * tt;
    if (flat_) return;
    // The dual basis.
    to_a_ = (tt * s - st * t) / determinant;
    to_b_ = (ss * t - st * s) / determinant;
    const double height = std::sqrt(determinant) / norm(wedge.edge[1] - wedge.edge[0]);
    touch_ = wedge.parallel ? kTouch : std::min(0.5, kTouch / height);
  }

  [[nodiscard]] bool flat() const { return flat_; }
  [[nodiscard]] const Point& origin() const { return origin_; }
  /// kTouch in units of w, at the nearest place of the edge.
  [[nodiscard]] double touch() const { return touch_; }
  [[nodiscard]] double height(const Point& p) const { return dot(p - origin_, wedge_.free_side); }
  [[nodiscard]] Place place(const Point& p) const { return {dot(p - origin_, to_a_), dot(p - origin_, to_b_)}; }
  [[nodiscard]] Place direction(const Vector& d) const { return {dot(d, to_a_), dot(d, to_b_)}; }

  /// Whether a box may meet the lines of the wedge.
  [[nodiscard]] bool meets(const Box& box, bool both_ways) const {
    const Vector half = 0.5 * box.size();
    const Point centre = box.centre();
    const auto reach = [&](const Vector& n) {
      return half.x * std::abs(n.x) + half.y * std::abs(n.y) + half.z * std::abs(n.z);
    };
    if (std::abs(height(centre)) > reach(wedge_.free_side) + kInPlane) return false;
    const Place c = place(centre);
    const double a = reach(to_a_);
    if (wedge_.parallel) return c.a + a >= 0.0 && c.a - a <= 1.0;
    const double b = reach(to_b_);
    return (c.a + a >= 0.0 && c.b + b >= 0.0) || (both_ways && c.a - a <= 0.0 && c.b - b <= 0.0);
  }

 private:
  const Wedge& wedge_;
  Point origin_;
  Vector to_a_;
  Vector to_b_;
  double touch_ = 0.0;
  bool flat_ = false;
};

/// Cuts a segment to where a linear value, from `from` at its begin to `to` at its end, is not negative.
bool cut(double from, double to, Stretch& kept) {
  if (from < 0.0 && to < 0.0) return false;
  if (from >= 0.0 && to >= 0.0) return true;
  const double at = from / (from - to);
  if (from < 0.0) {
    kept.begin = std::max(kept.begin, at);
  } else {
    kept.end = std::min(kept.end, at);
  }
  return kept.begin < kept.end;
}

Place between(const Place& p, const Place& q, double t) { return {p.a + t * (q.a - p.a), p.b + t * (q.b - p.b)}; }

/// Where the plane cuts a triangle. Vertices in the plane count as not on the free side, so that a surface that passes the plane is cut
/// once and one that only touches it from behind is not.
std::optional<Ends> section(const WedgePlane& plane, const std::array<Point, 3>& corners) {
  std::array<double, 3> h{};
  for (std::size_t k = 0; k < 3; ++k) h[k] = plane.height(corners[k]);
  Ends ends;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3 && count < 2; ++k) {
    const std::size_t next = (k + 1) % 3;
    if ((h[k] > kInPlane) == (h[next] > kInPlane)) continue;
    const double from = h[k] > kInPlane ? h[k] : std::min(h[k], 0.0);
    const double to = h[next] > kInPlane ? h[next] : std::min(h[next], 0.0);
    ends[count++] = corners[k] + (from / (from - to)) * (corners[next] - corners[k]);
  }
  if (count < 2) return std::nullopt;
  return ends;
}

/// Whether the pivot lies in the plane of a triangle: then it is cut along a line of the wedge, if at all.
bool holds_pivot(const Point& pivot, const std::array<Point, 3>& corners) {
  const Vector n = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
  return std::abs(dot(pivot - corners[0], n)) <= kInPlane;
}

/// What a wedge meets, ready to be swept.
class Sections {
 public:
  Sections(const Wedge& wedge, const WedgePlane& plane) : wedge_(wedge), plane_(plane) {}

  void add(const Ends& ends, std::uint32_t item) {
    const Place p = plane_.place(ends[0]);
    const Place q = plane_.place(ends[1]);
    if (wedge_.parallel) {
      add_parallel(p, q, item);
      return;
    }
    add_cone(p, q, false, item);
    if (both_ways()) add_cone({-p.a, -p.b}, {-q.a, -q.b}, true, item);
  }

  /// Whether lines matter on both sides of the pivot.
  [[nodiscard]] bool both_ways() const { return wedge_.kind == Wedge::Kind::kEdgeVertex || wedge_.sky_behind; }

  [[nodiscard]] std::vector<SweptSegment>& segments() { return segments_; }

  /// The point at which a line meets a swept segment.
  [[nodiscard]] Point point(const SweptSegment& s, double u) const {
    const Point on_edge = wedge_.edge[0] + u * (wedge_.edge[1] - wedge_.edge[0]);
    const double depth = s.depth_at(u);
    if (wedge_.parallel) return on_edge - depth * wedge_.towards;
    const double w = wedge_.kind == Wedge::Kind::kEdgeVertex ? 1.0 / depth : -1.0 / depth;
    return wedge_.pivot + w * (on_edge - wedge_.pivot);
  }

 private:
  void add_parallel(const Place& p, const Place& q, std::uint32_t item) {
    Stretch kept{0.0, 1.0};
    if (!cut(p.a, q.a, kept) || !cut(1.0 - p.a, 1.0 - q.a, kept)) return;
    push(between(p, q, kept.begin), between(p, q, kept.end), 0.0, false, item);
  }

  /// The part of a segment between the lines of the wedge, on one side of the pivot.
  void add_cone(const Place& p, const Place& q, bool beyond_pivot, std::uint32_t item) {
    Stretch kept{0.0, 1.0};
    if (!cut(p.a, q.a, kept) || !cut(p.b, q.b, kept)) return;
    const auto flattened = [](const Place& s) {
      const double w = s.a + s.b;
      return Place{s.b / w, -1.0 / w};
    };
    push(flattened(between(p, q, kept.begin)), flattened(between(p, q, kept.end)), -1.0, beyond_pivot, item);
  }

  /// Adds a segment; in two parts where it passes the edge, since before the edge it shuts lines and behind it takes them.
  /// @param edge_depth  of the wedge's edge
  void push(Place p, Place q, double edge_depth, bool beyond_pivot, std::uint32_t item) {
    if (p.a > q.a) std::swap(p, q);
    if (!(q.a - p.a > kFlat) || !std::isfinite(p.b) || !std::isfinite(q.b)) return;
    const double from = p.b - edge_depth;
    const double to = q.b - edge_depth;
    if (!beyond_pivot && from * to < 0.0) {
      const Place at = between(p, q, from / (from - to));
      push_part(p, at, edge_depth, false, item);
      push_part(at, q, edge_depth, false, item);
    } else {
      push_part(p, q, edge_depth, beyond_pivot, item);
    }
  }

  void push_part(const Place& p, const Place& q, double edge_depth, bool beyond_pivot, std::uint32_t item) {
    const double from_edge = 0.5 * (p.b + q.b) - edge_depth;
    const bool before_edge = from_edge < -plane_.touch();
    SweptSegment s{p.a, p.b, q.a, q.b, item, Role::kReceives};
    if (wedge_.kind == Wedge::Kind::kVertexEdge) {
      if (beyond_pivot || before_edge) s.role = Role::kBlocks;
    } else if (!beyond_pivot) {
      const bool before_sky = wedge_.sky_behind && from_edge > plane_.touch();
      if (!before_edge && !before_sky) return;
      s.role = Role::kBlocks;
    }
    if (s.u1 > s.u0) segments_.push_back(s);
  }

  const Wedge& wedge_;
  const WedgePlane& plane_;
  std::vector<SweptSegment> segments_;
};

/// Lines of the wedge along which surfaces at the pivot lie.
std::vector<double> cuts_at_pivot(const Wedge& wedge, const WedgePlane& plane, const Occluders& occluders) {
  std::vector<double> cuts;
  if (wedge.pivot_vertex == Wedge::kNone) return cuts;
  for (const auto& [p, q] : occluders.corners_at(wedge.pivot_vertex)) {
    const double hp = dot(p, wedge.free_side);
    const double hq = dot(q, wedge.free_side);
    if ((hp > 0.0) == (hq > 0.0)) continue;
    const Place d = plane.direction(p + (hp / (hp - hq)) * (q - p));
    if (d.a * d.b > 0.0) cuts.push_back(d.b / (d.a + d.b));
  }
  return cuts;
}

Vector direction_of_light(const Wedge& wedge, double u) {
  if (wedge.parallel) return -wedge.towards;
  const Vector line = wedge.edge[0] + u * (wedge.edge[1] - wedge.edge[0]) - wedge.pivot;
  return wedge.kind == Wedge::Kind::kVertexEdge ? line : -line;
}

/// Appends pieces; triangles of one face go on from each other.
class Pieces {
 public:
  explicit Pieces(std::vector<TracedPiece>& pieces) : pieces_(pieces), first_(pieces.size()) {}

  void add(const TracedPiece& piece) {
    if (pieces_.size() > first_) {
      TracedPiece& last = pieces_.back();
      const bool goes_on = last.face == piece.face && last.side == piece.side &&
                           norm(last.far[1] - piece.far[0]) <= kShortest &&
                           norm(last.near[1] - piece.near[0]) <= kShortest;
      if (goes_on) {
        last.far[1] = piece.far[1];
        last.near[1] = piece.near[1];
        return;
      }
    }
    pieces_.push_back(piece);
  }

  void finish() {
    const auto too_short = [](const TracedPiece& p) { return norm(p.far[1] - p.far[0]) < kShortest; };
    pieces_.erase(std::remove_if(pieces_.begin() + static_cast<std::ptrdiff_t>(first_), pieces_.end(), too_short),
                  pieces_.end());
  }

 private:
  std::vector<TracedPiece>& pieces_;
  std::size_t first_;
};

}  // namespace

WedgeTracer::WedgeTracer(const Faces& faces, std::span<const std::uint8_t> passable, const Occluders& occluders)
    : faces_(faces), occluders_(occluders) {
  std::vector<Box> boxes;
  for (std::size_t f = 0; f < faces.count(); ++f) {
    if (!passable.empty() && passable[f] != 0) continue;
    for (std::uint32_t t = faces.shape.starts[f]; t < faces.shape.starts[f + 1]; ++t) {
      Box box;
      for (const std::uint32_t v : faces.shape.triangles[t].vertices) box.add(faces.shape.vertices[v]);
      triangles_.push_back(t);
      face_of_.emplace_back(f);
      boxes.push_back(box);
    }
  }
  tree_ = BoxTree(boxes);
}

void WedgeTracer::trace(const Wedge& wedge, std::vector<TracedPiece>& pieces) const {
  const WedgePlane plane(wedge);
  if (plane.flat()) return;
  Sections sections(wedge, plane);
  const std::vector<Point>& points = faces_.shape.vertices;
  tree_.visit([&](const Box& box) { return plane.meets(box, sections.both_ways()); },
              [&](std::uint32_t item) {
                const auto& v = faces_.shape.triangles[triangles_[item]].vertices;
                const std::array<Point, 3> corners{points[v[0]], points[v[1]], points[v[2]]};
                const auto ends = section(plane, corners);
                if (ends && (wedge.parallel || !holds_pivot(wedge.pivot, corners))) sections.add(*ends, item);
              });
  Pieces found(pieces);
  std::vector<SweptSegment>& segments = sections.segments();
  for (const LitStretch& lit : sweep(segments, cuts_at_pivot(wedge, plane, occluders_))) {
    const Vector light = direction_of_light(wedge, 0.5 * (lit.u0 + lit.u1));
    if (wedge.pivot_vertex != Wedge::kNone && !occluders_.is_contour(wedge.pivot_vertex, light)) continue;
    const SweptSegment& segment = segments[lit.segment];
    const FaceId face = face_of_[segment.item];
    const bool front = dot(light, faces_.faces[face.index()].frame.w) < 0.0;
    TracedPiece piece{{wedge.pivot, wedge.pivot},
                      {sections.point(segment, lit.u0), sections.point(segment, lit.u1)},
                      face,
                      front ? Side::kFront : Side::kBack};
    if (wedge.kind == Wedge::Kind::kVertexEdge) {
      const Vector along = wedge.edge[1] - wedge.edge[0];
      piece.near = {wedge.edge[0] + lit.u0 * along, wedge.edge[0] + lit.u1 * along};
    }
    found.add(piece);
  }
  found.finish();
}

}  // namespace clerestory::mesh
