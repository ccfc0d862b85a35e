// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/box_tree.h"

#include <algorithm>

namespace clerestory::mesh {

namespace {

constexpr std::uint32_t kLeafSize = 8;

double along(const Point& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

int longest_axis(const Vector& size) {
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes) : boxes_(boxes.begin(), boxes.end()) {
  for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
    if (!boxes_[i].empty()) items_.push_back(i);
  }
  if (!items_.empty()) build(0, static_cast<std::uint32_t>(items_.size()));
}

void BoxTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node;
  Box centres;
  for (std::uint32_t i = begin; i < end; ++i) {
    node.box.add(boxes_[items_[i]]);
    centres.add(boxes_[items_[i]].centre());
  }
  node.begin = begin;
  node.end = end;
  nodes_.push_back(node);
  if (end - begin <= kLeafSize) return;
  const int axis = longest_axis(centres.size());
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto first = items_.begin();
  std::nth_element(first + begin, first + middle, first + end, [&](std::uint32_t a, std::uint32_t b) {
    const double ca = along(boxes_[a].centre(), axis);
    const double cb = along(boxes_[b].centre(), axis);
    return ca != cb ? ca < cb : a < b;
  });
  build(begin, middle);
  nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

}  // namespace clerestory::mesh
