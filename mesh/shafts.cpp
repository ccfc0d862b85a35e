// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/shafts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "mesh/box_tree.h"

namespace clerestory::mesh {

namespace {

/// What reaches into a shaft by less than this blocks nothing that could be measured [m]. It absorbs the rounding of planes
/// through shared vertices, some 1e-13 of the model's size. Boxes are grown by it, so that flat ones overlap what they lie in.
constexpr double kTouch = 1e-7;
constexpr std::uint32_t kLeafSize = 4;
/// So many possible blockers are tried as covers before a shaft is called partial.
constexpr int kCoverTries = 6;

/// Points with normal·p <= offset lie inside.
struct Plane {
  Vector normal;
  double offset = 0.0;
};

double side_of(const Plane& plane, const Point& p) {
  return plane.normal.x * p.x + plane.normal.y * p.y + plane.normal.z * p.z - plane.offset;
}

Plane plane_through(const Point& p, const Vector& normal) { return {normal, dot(normal, p - Point{})}; }

/// Least value of normal·p - offset over a box.
double least_over(const Plane& plane, const Box& box) {
  const Point p{plane.normal.x > 0.0 ? box.low.x : box.high.x, plane.normal.y > 0.0 ? box.low.y : box.high.y,
                plane.normal.z > 0.0 ? box.low.z : box.high.z};
  return side_of(plane, p);
}

/// True when q lies inside a convex loop seen from the tip of its normal.
bool inside(std::span<const Point> loop, const Vector& normal, const Point& q) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point& a = loop[i];
    const Vector edge = loop[(i + 1) % loop.size()] - a;
    if (dot(cross(edge, q - a), normal) < kTouch * norm(edge)) return false;
  }
  return true;
}

constexpr std::size_t kBins = 16;
/// Nodes so deep are halved, so that no tree is deeper than the stack of visit().
constexpr int kMostUneven = 32;

double along(const Point& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

double half_area(const Box& box) {
  const Vector s = box.size();
  return s.x * s.y + s.y * s.z + s.z * s.x;
}

Box box_of(const std::array<Point, 3>& corners) {
  Box box;
  for (const Point& c : corners) box.add(c);
  return box;
}

/// A node's pieces parted by where their boxes' centres lie along an axis: in bins before `bin`, and from there on.
struct Split {
  int axis = 0;
  double low = 0.0;
  double bins_per_metre = 0.0;
  std::size_t bin = 0;  ///< 0: there is none

  [[nodiscard]] std::size_t bin_of(const Box& box) const {
    return std::min(kBins - 1, static_cast<std::size_t>((along(box.centre(), axis) - low) * bins_per_metre));
  }
};

/// The split with the least sum of area times number [Wald 2007].
template <class Piece>
Split best_split(std::span<const Piece> pieces) {
  Box centres;
  for (const Piece& piece : pieces) centres.add(box_of(piece.corners).centre());
  Split best;
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double low = along(centres.low, axis);
    const double size = along(centres.high, axis) - low;
    if (!(size > kTouch)) continue;
    Split split{axis, low, static_cast<double>(kBins) / size, 0};
    std::array<Box, kBins> boxes;
    std::array<double, kBins> counts{};
    for (const Piece& piece : pieces) {
      const Box box = box_of(piece.corners);
      const std::size_t bin = split.bin_of(box);
      boxes[bin].add(box);
      counts[bin] += 1.0;
    }
    std::array<double, kBins> behind{};  ///< area times number of what lies in a bin and behind it
    Box box;
    double count = 0.0;
    for (std::size_t bin = kBins; bin-- > 1;) {
      box.add(boxes[bin]);
      count += counts[bin];
      behind[bin] = half_area(box) * count;
    }
    box = {};
    count = 0.0;
    for (split.bin = 1; split.bin < kBins; ++split.bin) {
      box.add(boxes[split.bin - 1]);
      count += counts[split.bin - 1];
      const double cost = half_area(box) * count + behind[split.bin];
      if (count > 0.0 && count < static_cast<double>(pieces.size()) && cost < least) {
        least = cost;
        best = split;
      }
    }
  }
  return best;
}

}  // namespace

/// The hull of two ends, as planes that it lies behind.
struct Shafts::Shaft {
  std::array<Plane, 34> planes;
  std::size_t count = 0;
  std::array<Point, 8> corners;
  std::size_t corner_count = 0;
  Box box;
  std::array<FaceId, 2> faces;  ///< of the ends

  Shaft(const ShaftEnd& a, const ShaftEnd& b) : faces{a.face, b.face} {
    for (const ShaftEnd* end : {&a, &b}) {
      for (std::size_t i = 0; i < end->count; ++i) {
        corners[corner_count++] = end->corners[i];
        box.add(end->corners[i]);
      }
      // Light leaves and arrives in front of an end: what lies behind its plane is outside.
      if (end->count >= 3) planes[count++] = plane_through(end->corners[0], -end->normal);
    }
    box = grown(box, kTouch);
    add_supporting_planes(a, b);
    add_supporting_planes(b, a);
  }

  /// Planes through an edge of one end and a corner of the other that have all corners on one side.
  void add_supporting_planes(const ShaftEnd& edges, const ShaftEnd& tips) {
    if (edges.count < 2) return;
    for (std::size_t i = 0; i < edges.count; ++i) {
      const Point& p = edges.corners[i];
      const Vector edge = edges.corners[(i + 1) % edges.count] - p;
      for (std::size_t j = 0; j < tips.count; ++j) {
        const Vector normal = cross(edge, tips.corners[j] - p);
        const double length = norm(normal);
        if (length < 1e-12) continue;
        add_if_supporting(plane_through(p, normal / length));
      }
    }
  }

  void add_if_supporting(Plane plane) {
    double least = 0.0;
    double most = 0.0;
    for (std::size_t k = 0; k < corner_count; ++k) {
      const double s = side_of(plane, corners[k]);
      least = std::min(least, s);
      most = std::max(most, s);
    }
    if (most <= kTouch) {
      planes[count++] = plane;
    } else if (least >= -kTouch) {
      planes[count++] = {-plane.normal, -plane.offset};
    }
  }

  [[nodiscard]] bool misses(const Box& other) const {
    if (!interiors_overlap(box, other)) return true;
    return std::any_of(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(count),
                       [&](const Plane& p) { return least_over(p, other) >= -kTouch; });
  }

  [[nodiscard]] bool misses(const Piece& piece) const {
    if (FaceId(piece.face) == faces[0] || FaceId(piece.face) == faces[1]) return true;
    for (std::size_t i = 0; i < count; ++i) {
      if (side_of(planes[i], piece.corners[0]) >= -kTouch && side_of(planes[i], piece.corners[1]) >= -kTouch &&
          side_of(planes[i], piece.corners[2]) >= -kTouch) {
        return true;
      }
    }
    const Plane own = plane_through(piece.corners[0], piece.normal);
    double least = 0.0;
    double most = 0.0;
    for (std::size_t k = 0; k < corner_count; ++k) {
      const double s = side_of(own, corners[k]);
      least = std::min(least, s);
      most = std::max(most, s);
    }
    return most <= kTouch || least >= -kTouch || !interiors_overlap(box, box_of(piece.corners));
  }
};

/// What lies in a box, by boxes.
struct Shafts::InBox {
  Box box;

  [[nodiscard]] bool misses(const Box& other) const { return !interiors_overlap(box, other); }
  [[nodiscard]] bool misses(const Piece& piece) const { return misses(box_of(piece.corners)); }
};

bool is_convex(std::span<const Point> loop, const Vector& normal) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector a = loop[(i + 1) % n] - loop[i];
    const Vector b = loop[(i + 2) % n] - loop[(i + 1) % n];
    if (dot(cross(a, b), normal) < -1e-9 * norm(a) * norm(b)) return false;
  }
  return n >= 3;
}

ShaftEnd shaft_end(const ElementTree& tree, ElementId e) {
  ShaftEnd end;
  end.count = tree.hull(e, end.corners);
  end.normal = tree.normal(e);
  end.face = tree.face_side(e).face;
  return end;
}

Shafts::Shafts(const Faces& faces, std::span<const std::uint8_t> passable) {
  convex_outline_.resize(faces.count());
  for (std::size_t f = 0; f < faces.count(); ++f) {
    const Face& face = faces.faces[f];
    const bool passes = !passable.empty() && passable[f] != 0;
    for (const Triangle& t : faces.shape.of(FaceId(f))) {
      const auto& v = faces.shape.vertices;
      pieces_.push_back({.corners = {v[t.vertices[0]], v[t.vertices[1]], v[t.vertices[2]]},
                         .normal = face.frame.w,
                         .face = static_cast<std::uint32_t>(f),
                         .passable = passes});
    }
    if (face.loops.size() != 1) continue;
    std::vector<Point> loop;
    for (const std::uint32_t i : face.loops[0]) loop.push_back(faces.shape.vertices[i]);
    if (is_convex(loop, face.frame.w)) convex_outline_[f] = std::move(loop);
  }
  if (!pieces_.empty()) build(0, static_cast<std::uint32_t>(pieces_.size()), 0);
}

void Shafts::build(std::uint32_t begin, std::uint32_t end, int depth) {
  const std::size_t id = nodes_.size();
  nodes_.emplace_back();
  Box box;
  for (std::uint32_t i = begin; i < end; ++i) box.add(box_of(pieces_[i].corners));
  nodes_[id].box = grown(box, kTouch);
  if (end - begin <= kLeafSize) {
    nodes_[id].begin = begin;
    nodes_[id].count = end - begin;
    return;
  }
  const std::uint32_t middle = part(begin, end, depth);
  build(begin, middle, depth + 1);
  nodes_[id].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end, depth + 1);
}

/// Brings the pieces of the first child to the front, and gives the number of the first of the second. Parts by the surface area heuristic:
/// floors and walls come apart from what is small, whose nodes would all be as large otherwise.
std::uint32_t Shafts::part(std::uint32_t begin, std::uint32_t end, int depth) {
  const std::span<Piece> pieces(&pieces_[begin], end - begin);
  const Split split = depth < kMostUneven ? best_split(std::span<const Piece>(pieces)) : Split{};
  const auto first = pieces_.begin() + begin;
  if (split.bin == 0) return begin + (end - begin) / 2;  // all in one place, or halves that end soon
  const auto second = std::stable_partition(
      first, pieces_.begin() + end, [&](const Piece& p) { return split.bin_of(box_of(p.corners)) < split.bin; });
  return static_cast<std::uint32_t>(second - pieces_.begin());
}

bool Shafts::covers(const Piece& piece, const ShaftEnd& a, const ShaftEnd& b) const {
  if (piece.passable) return false;
  const auto& outline = convex_outline_[piece.face];
  const std::span<const Point> loop = outline.empty() ? std::span<const Point>(piece.corners) : outline;
  const Plane plane = plane_through(piece.corners[0], piece.normal);
  for (std::size_t i = 0; i < a.count; ++i) {
    const double sa = side_of(plane, a.corners[i]);
    for (std::size_t j = 0; j < b.count; ++j) {
      const double sb = side_of(plane, b.corners[j]);
      if (sa * sb >= 0.0 || std::min(std::abs(sa), std::abs(sb)) < kTouch) return false;
      const Point q = a.corners[i] + (sa / (sa - sb)) * (b.corners[j] - a.corners[i]);
      if (!inside(loop, piece.normal, q)) return false;
    }
  }
  return true;
}

template <class Region, class Visit>
void Shafts::visit(const Region& region, const Visit& visit) const {
  if (nodes_.empty()) return;
  std::array<std::uint32_t, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t id = stack[--depth];
    const Node& node = nodes_[id];
    if (region.misses(node.box)) continue;
    if (node.count == 0) {
      stack[depth++] = node.right;
      stack[depth++] = id + 1;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.begin + node.count; ++i) {
      if (!region.misses(pieces_[i]) && !visit(pieces_[i])) return;
    }
  }
}

Visibility Shafts::classify(const ShaftEnd& a, const ShaftEnd& b) const {
  if (!proves_) return Visibility::kPartial;
  Visibility seen = Visibility::kVisible;
  int tries = 0;
  visit(Shaft(a, b), [&](const Piece& piece) {
    seen = covers(piece, a, b) ? Visibility::kHidden : Visibility::kPartial;
    return seen == Visibility::kPartial && ++tries < kCoverTries;
  });
  return seen;
}

template <class Region>
bool Shafts::holds_only(const Region& region, std::span<const std::uint32_t> group, std::uint32_t own) const {
  if (!proves_) return false;
  bool only = true;
  visit(region, [&](const Piece& piece) {
    only = group[piece.face] == own;
    return only;
  });
  return only;
}

bool Shafts::is_clear(const ShaftEnd& a, const ShaftEnd& b, std::span<const std::uint32_t> group,
                      std::uint32_t own) const {
  return holds_only(Shaft(a, b), group, own);
}

bool Shafts::is_clear(const Box& box, std::span<const std::uint32_t> group, std::uint32_t own) const {
  return holds_only(InBox{grown(box, kTouch)}, group, own);
}

Shafts::Blockers Shafts::blockers(const ShaftEnd& a, const ShaftEnd& b, std::size_t most) const {
  Blockers found;
  visit(Shaft(a, b), [&](const Piece& piece) {
    const auto& outline = convex_outline_[piece.face];
    const std::span<const Point> polygon = outline.empty() ? std::span<const Point>(piece.corners) : outline;
    const auto same = [&](std::span<const Point> other) { return other.data() == polygon.data(); };
    if (std::any_of(found.polygons.begin(), found.polygons.end(), same)) return true;
    if (most > 0 && covers(piece, a, b)) {
      found = {{polygon}, true};
      return false;
    }
    const bool wanted = !piece.passable && found.polygons.size() < most;
    found.all = found.all && wanted;
    if (wanted) found.polygons.push_back(polygon);
    return found.polygons.size() < most || found.all;
  });
  return found;
}

}  // namespace clerestory::mesh
