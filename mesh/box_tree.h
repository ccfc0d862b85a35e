// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/geometry.h"

// Private to mesh/.
namespace clerestory::mesh {

/// The box, grown by a margin on all sides [m].
inline Box grown(const Box& box, double margin) {
  if (box.empty()) return box;
  const Vector m{margin, margin, margin};
  return {box.low - m, box.high + m};
}

/// Whether two boxes share a point.
constexpr bool overlap(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// A tree of axis-aligned boxes for searches by any test that a box contains what it is asked for.
/// Deterministic: the order of visits depends on the boxes alone.
class BoxTree {
 public:
  BoxTree() = default;
  /// O(n log n). Empty boxes are never visited.
  explicit BoxTree(std::span<const Box> boxes);

  /// Calls visit(item) for every item whose own box passes accept(box); whole branches whose box does not are left out, so
  /// accept must hold for a box that holds an accepted one.
  template <class Accept, class Visit>
  void visit(const Accept& accept, const Visit& visit) const {
    if (!nodes_.empty()) descend(0, accept, visit);
  }

 private:
  struct Node {
    Box box;
    std::uint32_t begin = 0;  ///< of items_, for a leaf
    std::uint32_t end = 0;
    std::uint32_t right = 0;  ///< the second child; the first follows its parent. 0 for a leaf.
  };

  void build(std::uint32_t begin, std::uint32_t end);

  template <class Accept, class Visit>
  void descend(std::uint32_t index, const Accept& accept, const Visit& visit) const {
    const Node& node = nodes_[index];
    if (!accept(node.box)) return;
    if (node.right != 0) {
      descend(index + 1, accept, visit);
      descend(node.right, accept, visit);
      return;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      if (accept(boxes_[items_[i]])) visit(items_[i]);
    }
  }

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> items_;
  std::vector<Node> nodes_;
};

}  // namespace clerestory::mesh
