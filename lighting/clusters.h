// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lighting/solution.h"

namespace clerestory::lighting {

/// A place on a cluster's surfaces.
struct ClusterPoint {
  mesh::Point at;
  mesh::Vector normal;
  mesh::ElementId root;
};

/// A binary tree of clusters over the roots of the element tree: bundles of surfaces that send light as one source to receivers
/// for which their detail does not matter [Smits, Arvo, Greenberg 1994; Sillion 1995]. Surfaces that look the same way are bundled
/// first, neighbours next; panes, which mirror, and surfaces that shine by themselves are bundled apart from all else. Leaves hold one root each.
class Clusters {
 public:
  Clusters() = default;
  Clusters(const Scene& scene, const mesh::ElementTree& tree);

  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  /// So few surfaces that all of them may link to each other: sampling bundles of them would spare nothing.
  [[nodiscard]] bool are_few() const { return order_.size() <= kFew; }
  /// The cluster of everything is number 0; there is none when the tree has no roots.
  [[nodiscard]] bool is_leaf(std::uint32_t c) const { return nodes_[c].count == 1; }
  [[nodiscard]] std::uint32_t left(std::uint32_t c) const { return c + 1; }
  [[nodiscard]] std::uint32_t right(std::uint32_t c) const { return nodes_[c].right; }
  enum class Kind { kPlain, kPanes, kShining };
  /// The biggest clusters of one kind each.
  [[nodiscard]] std::vector<std::uint32_t> tops() const;
  /// The clusters of one surface each.
  [[nodiscard]] std::vector<std::uint32_t> leaves() const;
  /// Of a cluster that one of the tops holds.
  [[nodiscard]] Kind kind(std::uint32_t c) const {
    return static_cast<Kind>(order_kind_[nodes_[c].begin] / kDirections);
  }
  /// The root of a leaf.
  [[nodiscard]] mesh::ElementId root(std::uint32_t c) const { return order_[nodes_[c].begin]; }
  [[nodiscard]] double area(std::uint32_t c) const { return nodes_[c].area; }
  [[nodiscard]] const mesh::Point& centre(std::uint32_t c) const { return nodes_[c].centre; }
  /// Half the diagonal of the box [m].
  [[nodiscard]] double radius(std::uint32_t c) const { return nodes_[c].radius; }
  [[nodiscard]] const mesh::Box& box(std::uint32_t c) const { return nodes_[c].box; }
  /// Whether no point of the cluster's surfaces can face one of a flat element's, by the cluster's box and the cone that its normals
  /// lie in [Shirman, Abi-Ezzi 1993]; a cluster that is not may be turned away all the same.
  [[nodiscard]] bool is_turned_away(const mesh::ElementTree& tree, std::uint32_t c, mesh::ElementId element) const;

  /// A place on the cluster's surfaces, uniform by area, from (a, b) in the unit square.
  [[nodiscard]] ClusterPoint sample(const mesh::ElementTree& tree, std::uint32_t c, double a, double b) const;

  /// Takes over the roots' radiosities: area means per channel, luminance means and deviations.
  void pull(const Solution& solution);
  [[nodiscard]] std::span<const float> radiosity(std::uint32_t c) const {
    return std::span(radiosity_).subspan(c * channels_, channels_);
  }
  [[nodiscard]] float radiosity_mean(std::uint32_t c) const { return mean_[c]; }
  [[nodiscard]] float radiosity_deviation(std::uint32_t c) const { return deviation_[c]; }

 private:
  struct Node {
    mesh::Box box;
    mesh::Point centre;
    double radius = 0.0;
    mesh::Vector axis;        ///< of the cone of the normals
    double half_angle = 0.0;  ///< between the axis and the farthest normal [rad]
    double area = 0.0;
    std::uint32_t begin = 0;
    std::uint32_t count = 0;
    std::uint32_t right = 0;
  };

  static constexpr int kDirections = 6;
  static constexpr std::size_t kFew = 32;

  void build(const mesh::ElementTree& tree, std::uint32_t begin, std::uint32_t end);
  /// Parts a range of roots in two; gives where the second part begins.
  std::uint32_t part(const mesh::ElementTree& tree, std::uint32_t begin, std::uint32_t end, const mesh::Vector& extent);

  std::vector<Node> nodes_;  ///< parents before children, the left child next to its parent
  std::vector<mesh::ElementId> order_;
  std::vector<int> order_kind_;      ///< [roots, as in order_] direction + kind · kDirections
  std::vector<double> area_before_;  ///< [roots + 1] of all roots ahead in order_
  std::size_t channels_ = 1;
  std::vector<float> radiosity_;
  std::vector<float> mean_;
  std::vector<float> deviation_;
};

}  // namespace clerestory::lighting
