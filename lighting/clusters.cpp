// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/clusters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clerestory::lighting {

using mesh::Box;
using mesh::ElementId;
using mesh::Point;

namespace {

/// Normals whose mean is shorter have no direction in common.
constexpr double kOneWay = 0.01;

Box box_of(const mesh::ElementTree& tree, ElementId e) {
  std::array<Point, 4> corners;
  const std::size_t count = tree.hull(e, corners);
  Box box;
  for (std::size_t i = 0; i < count; ++i) box.add(corners[i]);
  return box;
}

/// Which of the six directions of the axes a surface looks at most.
int direction_of(const mesh::Vector& n) {
  const double x = std::abs(n.x);
  const double y = std::abs(n.y);
  const double z = std::abs(n.z);
  if (z >= x && z >= y) return n.z > 0.0 ? 0 : 1;
  if (y >= x) return n.y > 0.0 ? 2 : 3;
  return n.x > 0.0 ? 4 : 5;
}

}  // namespace

Clusters::Clusters(const Scene& scene, const mesh::ElementTree& tree) {
  order_.assign(tree.roots().begin(), tree.roots().end());
  const auto kind_of = [&](ElementId e) {
    const mesh::FaceSide side = tree.face_side(e);
    const Kind kind = scene.is_pane(side) ? Kind::kPanes : (scene.shines(side) ? Kind::kShining : Kind::kPlain);
    return direction_of(tree.normal(e)) + kDirections * static_cast<int>(kind);
  };
  // Surfaces that look the same way first: what a receiver sees of a cluster are those that face it, and they must shine as its mean
  // does. Bundles of fronts and backs would hand on the mean of lit and dark sides.
  std::stable_sort(order_.begin(), order_.end(), [&](ElementId a, ElementId b) { return kind_of(a) < kind_of(b); });
  for (const ElementId root : order_) order_kind_.push_back(kind_of(root));
  if (!order_.empty()) build(tree, 0, static_cast<std::uint32_t>(order_.size()));
  area_before_.push_back(0.0);
  for (const ElementId root : order_) area_before_.push_back(area_before_.back() + tree.area(root));
}

std::vector<std::uint32_t> Clusters::leaves() const {
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t c = 0; c < nodes_.size(); ++c) {
    if (is_leaf(c)) leaves.push_back(c);
  }
  return leaves;
}

std::vector<std::uint32_t> Clusters::tops() const {
  std::vector<std::uint32_t> found;
  if (nodes_.empty()) return found;
  std::vector<std::uint32_t> waiting{0};
  while (!waiting.empty()) {
    const std::uint32_t c = waiting.back();
    waiting.pop_back();
    const auto& node = nodes_[c];
    if (order_kind_[node.begin] / kDirections == order_kind_[node.begin + node.count - 1] / kDirections) {
      found.push_back(c);
    } else {
      waiting.push_back(right(c));
      waiting.push_back(left(c));
    }
  }
  return found;
}

void Clusters::build(const mesh::ElementTree& tree, std::uint32_t begin, std::uint32_t end) {
  const std::size_t id = nodes_.size();
  nodes_.emplace_back();
  Node node;
  node.begin = begin;
  node.count = end - begin;
  Box centres;
  mesh::Vector facing;
  for (std::uint32_t i = begin; i < end; ++i) {
    node.box.add(box_of(tree, order_[i]));
    node.area += tree.area(order_[i]);
    centres.add(tree.centroid(order_[i]));
    facing = facing + tree.area(order_[i]) * tree.normal(order_[i]);
  }
  node.centre = node.box.centre();
  node.radius = 0.5 * node.box.diagonal();
  node.axis = norm(facing) > kOneWay * node.area ? normalized(facing) : tree.normal(order_[begin]);
  for (std::uint32_t i = begin; i < end; ++i)
    node.half_angle =
        std::max(node.half_angle, std::acos(std::clamp(dot(node.axis, tree.normal(order_[i])), -1.0, 1.0)));
  nodes_[id] = node;
  if (node.count == 1) return;

  const std::uint32_t middle = part(tree, begin, end, centres.size());
  build(tree, begin, middle);
  nodes_[id].right = static_cast<std::uint32_t>(nodes_.size());
  build(tree, middle, end);
}

std::uint32_t Clusters::part(const mesh::ElementTree& tree, std::uint32_t begin, std::uint32_t end,
                             const mesh::Vector& extent) {
  const auto first = order_.begin() + begin;
  const auto last = order_.begin() + end;
  const int low = order_kind_[begin];
  const int high = order_kind_[end - 1];
  if (low != high) {
    // Still sorted: one kind to one side, or else half of the directions to either.
    const int last_kind = high / kDirections;
    const int cut = low / kDirections != last_kind ? last_kind * kDirections : (low + high + 1) / 2;
    const auto found = std::lower_bound(order_kind_.begin() + begin, order_kind_.begin() + end, cut);
    return static_cast<std::uint32_t>(found - order_kind_.begin());
  }
  const auto along = [&](ElementId e) {
    const Point& c = tree.centroid(e);
    return extent.x >= extent.y && extent.x >= extent.z ? c.x : (extent.y >= extent.z ? c.y : c.z);
  };
  std::stable_sort(first, last, [&](ElementId a, ElementId b) { return along(a) < along(b); });
  return begin + (end - begin) / 2;
}

bool Clusters::is_turned_away(const mesh::ElementTree& tree, std::uint32_t c, ElementId element) const {
  const Node& node = nodes_[c];
  const mesh::Vector& normal = tree.normal(element);
  const Point& at = tree.centroid(element);
  const Point farthest_in_front{normal.x > 0.0 ? node.box.high.x : node.box.low.x,
                                normal.y > 0.0 ? node.box.high.y : node.box.low.y,
                                normal.z > 0.0 ? node.box.high.z : node.box.low.z};
  if (dot(farthest_in_front - at, normal) <= 0.0) return true;
  // From any point of the one to any of the other, directions differ from that between the centres by `spread` at most.
  const mesh::Vector to = at - node.centre;
  const double distance = norm(to);
  const double reach = node.radius + tree.radius(element);
  if (reach >= distance) return false;
  const double spread = std::asin(reach / distance);
  const double between = std::acos(std::clamp(dot(node.axis, to) / distance, -1.0, 1.0));
  return between - node.half_angle - spread >= 0.5 * std::numbers::pi;
}

ClusterPoint Clusters::sample(const mesh::ElementTree& tree, std::uint32_t c, double a, double b) const {
  const Node& node = nodes_[c];
  const double first = area_before_[node.begin];
  const double wanted = first + a * node.area;
  const auto begin = area_before_.begin() + node.begin;
  const auto found = std::upper_bound(begin + 1, begin + node.count, wanted);
  const auto i = static_cast<std::size_t>(found - area_before_.begin()) - 1;
  const ElementId root = order_[i];
  const double stretched = std::clamp((wanted - area_before_[i]) / tree.area(root), 0.0, std::nextafter(1.0, 0.0));
  return {tree.sample(root, stretched, b), tree.normal(root), root};
}

void Clusters::pull(const Solution& solution) {
  channels_ = solution.channels();
  radiosity_.assign(size() * channels_, 0.0F);
  mean_.assign(size(), 0.0F);
  deviation_.assign(size(), 0.0F);
  std::vector<double> square(size(), 0.0);
  for (std::size_t i = size(); i-- > 0;) {
    const auto c = static_cast<std::uint32_t>(i);
    if (is_leaf(c)) {
      const auto b = solution.radiosity(root(c));
      std::copy(b.begin(), b.end(), radiosity_.begin() + static_cast<std::ptrdiff_t>(i * channels_));
      mean_[i] = solution.radiosity_mean(root(c));
      deviation_[i] = std::sqrt(solution.radiosity_variance(root(c)));
    } else {
      const auto share = static_cast<float>(area(left(c)) / area(c));
      for (std::size_t k = 0; k < channels_; ++k) {
        radiosity_[i * channels_ + k] =
            share * radiosity_[left(c) * channels_ + k] + (1.0F - share) * radiosity_[right(c) * channels_ + k];
      }
      mean_[i] = share * mean_[left(c)] + (1.0F - share) * mean_[right(c)];
      const double below = share * square[left(c)] + (1.0 - share) * square[right(c)];
      deviation_[i] = static_cast<float>(std::sqrt(std::max(0.0, below - double{mean_[i]} * mean_[i])));
    }
    square[i] = double{mean_[i]} * mean_[i] + double{deviation_[i]} * deviation_[i];
  }
}

}  // namespace clerestory::lighting
