// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/element_tree.h"

namespace clerestory::lighting {

/// Points brought together by the elements that they lie on: what is the same for all points of one needs to be found out once. Groups are
/// small, so that threads share them evenly.
class PointsByElement {
 public:
  /// @param elements  of the points; those on none are left out
  explicit PointsByElement(std::span<const mesh::ElementId> elements);

  /// How many groups there are, in ascending order of their elements.
  [[nodiscard]] std::size_t groups() const { return starts_.size() - 1; }
  [[nodiscard]] mesh::ElementId element(std::size_t group) const { return elements_[group]; }
  /// Numbers of a group's points, ascending.
  [[nodiscard]] std::span<const std::uint32_t> points(std::size_t group) const {
    return std::span(points_).subspan(starts_[group], starts_[group + 1] - starts_[group]);
  }

 private:
  std::vector<std::uint32_t> points_;
  std::vector<std::size_t> starts_{0};     ///< [groups + 1] into points_
  std::vector<mesh::ElementId> elements_;  ///< [groups]
};

}  // namespace clerestory::lighting
