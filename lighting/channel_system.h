// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lighting/arrivals.h"
#include "lighting/clusters.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// What is the same for all channels: nodes, links and clusters of a solution, in the order in which the solver of channels goes through
/// them. Rows are the nodes that take part, parents before their children, and behind them the clusters.
struct ChannelSystem {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /// A node that takes part.
  struct Row {
    mesh::ElementId node;
    std::uint32_t parent = kNone;  ///< row
    bool is_element = false;
    bool is_closed = false;  ///< its exchange by links is scaled
    PlaceInParent<float> place;
    LinearValue closing;
    mesh::SecondMoments area;
  };
  /// Light that arrives by a link.
  struct Term {
    std::uint32_t source = 0;  ///< row
    float factor = 0.0F;
    PackedSlopes slopes;
  };
  static_assert(sizeof(Term) == 16);
  struct Cluster {
    std::uint32_t left = 0;  ///< row; of a leaf its root's
    std::uint32_t right = kNone;
    float left_share = 1.0F;
  };

  ChannelSystem(const Solution& solution, const Arrivals& arrivals, const Clusters& clusters);

  /// Of a node; kNone where it takes no part.
  [[nodiscard]] std::uint32_t row_of(mesh::ElementId node) const {
    return node.index() < row_of_.size() ? row_of_[node.index()] : kNone;
  }
  [[nodiscard]] std::size_t row_count() const { return rows.size() + clusters.size(); }

  std::vector<Row> rows;
  std::vector<Cluster> clusters;          ///< parents before children; row numbers from rows.size()
  std::vector<std::uint32_t> receivers;   ///< rows
  std::vector<std::uint32_t> first_term;  ///< [receivers + 1]
  std::vector<Term> terms;

 private:
  void add_rows(const Solution& solution);
  void add_clusters(const Clusters& all);
  void add_terms(const Arrivals& arrivals);

  std::vector<std::uint32_t> row_of_;  ///< [nodes]
};

}  // namespace clerestory::lighting
