// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/element_tree.h"
#include "mesh/faces.h"
#include "mesh/geometry.h"

namespace clerestory::mesh {

/// What is known of the sight between two convex planar pieces. Visible and hidden are proven; all else is partial.
enum class Visibility : std::uint8_t { kPartial, kVisible, kHidden };

/// One end of a shaft: corners of a convex planar piece and the unit normal of the side that takes part.
struct ShaftEnd {
  std::array<Point, 4> corners{};
  std::size_t count = 0;  ///< 1 (a point: no plane of its own, the normal is zero) to 4
  Vector normal;
  /// The face of which it is a part, if it is: what is flat does not stand before itself, though corners of a polygon as it was drawn
  /// may lie off its plane, before the piece.
  FaceId face = {};
};

/// A point as an end.
[[nodiscard]] inline ShaftEnd point_end(const Point& at) { return {.corners = {at}, .count = 1, .normal = {}}; }

/// The hull of a node, of its own side.
ShaftEnd shaft_end(const ElementTree& tree, ElementId e);

/// Whether a planar loop turns one way all along, to the left as seen from the tip of its normal, but for rounding.
bool is_convex(std::span<const Point> loop, const Vector& normal);

/// Conservative visibility between planar pieces: the convex hull of both ends against a tree of the faces' triangles
/// [Haines, Wallace 1994], hidden when one convex blocker covers the hull.
class Shafts {
 public:
  /// @param passable  [faces] non-zero for glazing and openings: they make a shaft partial, never hidden; empty: none
  Shafts(const Faces& faces, std::span<const std::uint8_t> passable);

  [[nodiscard]] Visibility classify(const ShaftEnd& a, const ShaftEnd& b) const;
  /// Whether it is proven that no faces but those of one group reach into the hull of two ends.
  /// @param group  [faces] the group of each
  [[nodiscard]] bool is_clear(const ShaftEnd& a, const ShaftEnd& b, std::span<const std::uint32_t> group,
                              std::uint32_t own) const;
  /// The same of a box, by the boxes of the faces' triangles.
  [[nodiscard]] bool is_clear(const Box& box, std::span<const std::uint32_t> group, std::uint32_t own) const;
  /// From here on all is partial: to tell what proofs are worth.
  void prove_nothing() { proves_ = false; }

  /// What stands between two ends.
  struct Blockers {
    /// Opaque faces that reach into the hull of both ends, as convex polygons that may reach out of it: faces whose outline is convex, of
    /// others the triangles that do. One that hides the ends from each other stands alone. The spans are of the shafts.
    std::vector<std::span<const Point>> polygons;
    bool all = true;  ///< false: there are more of them, or a passable face reaches in too
  };
  /// @param most  polygons that are wanted
  [[nodiscard]] Blockers blockers(const ShaftEnd& a, const ShaftEnd& b, std::size_t most) const;

 private:
  struct Node {
    Box box;
    std::uint32_t begin = 0;  ///< leaf: pieces [begin, begin + count)
    std::uint32_t count = 0;
    std::uint32_t right = 0;  ///< inner: the left child follows its parent
  };
  /// A triangle of a face.
  struct Piece {
    std::array<Point, 3> corners{};
    Vector normal;
    std::uint32_t face = 0;
    bool passable = false;
  };
  struct Shaft;
  struct InBox;

  /// Calls visit(piece) for those that reach into a region, as long as it returns true.
  template <class Region, class Visit>
  void visit(const Region& region, const Visit& visit) const;
  template <class Region>
  [[nodiscard]] bool holds_only(const Region& region, std::span<const std::uint32_t> group, std::uint32_t own) const;
  void build(std::uint32_t begin, std::uint32_t end, int depth);
  std::uint32_t part(std::uint32_t begin, std::uint32_t end, int depth);
  [[nodiscard]] bool covers(const Piece& piece, const ShaftEnd& a, const ShaftEnd& b) const;

  bool proves_ = true;
  std::vector<Piece> pieces_;
  std::vector<Node> nodes_;
  /// Faces whose outline is one convex loop, as blockers that cover more than one of their triangles could.
  std::vector<std::vector<Point>> convex_outline_;
};

}  // namespace clerestory::mesh
