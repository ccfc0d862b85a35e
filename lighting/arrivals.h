// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lighting/links.h"
#include "mesh/element_tree.h"

namespace clerestory::lighting {

/// Links in the order in which light arrives by them: mutual links arrive at both ends.
class Arrivals {
 public:
  Arrivals() = default;
  /// @param links  must stay where they are as long as this is used
  Arrivals(const std::vector<Link>& links, const mesh::ElementTree& tree);

  /// How many nodes receive.
  [[nodiscard]] std::size_t receivers() const { return starts_.empty() ? 0 : starts_.size() - 1; }
  [[nodiscard]] mesh::ElementId receiver(std::size_t i) const { return arrivals_[starts_[i]].receiver; }

  /// What arrives at the i-th receiver, in the order of the links: f(const Link&), each link with that node as its receiver.
  template <typename F>
  void visit(std::size_t i, F&& f) const {
    for (std::size_t k = starts_[i]; k < starts_[i + 1]; ++k) f(arriving(arrivals_[k]));
  }
  /// What arrives at a node.
  template <typename F>
  void visit(mesh::ElementId node, F&& f) const {
    if (const std::size_t i = index_of(node); i < receivers()) visit(i, f);
  }

 private:
  struct Arrival {
    mesh::ElementId receiver;
    std::uint32_t link = 0;
    bool back = false;
  };

  [[nodiscard]] Link arriving(const Arrival& arrival) const;
  /// receivers() for a node at which nothing arrives.
  [[nodiscard]] std::size_t index_of(mesh::ElementId node) const;

  const std::vector<Link>* links_ = nullptr;
  const mesh::ElementTree* tree_ = nullptr;
  std::vector<Arrival> arrivals_;    ///< by receiver
  std::vector<std::size_t> starts_;  ///< [receivers + 1]
};

}  // namespace clerestory::lighting
