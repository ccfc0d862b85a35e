// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

// Private to mesh/.
namespace clerestory::mesh {

/// Sets of the numbers below a count, each alone at first, that grow by joins. Of two roots the smaller stays, so that the root of a
/// set is its smallest member, in whatever order it was joined.
/// Source: Galler, Fischer, An Improved Equivalence Algorithm, CACM 1964; path halving by Tarjan, van Leeuwen, JACM 1984.
template <class Index>
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }

  /// The smallest member of the set that i is in. i is below the count.
  [[nodiscard]] Index root(Index i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }

  void join(Index a, Index b) {
    a = root(a);
    b = root(b);
    parent(std::max(a, b)) = std::min(a, b);
  }

 private:
  [[nodiscard]] Index& parent(Index i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<Index> parent_;
};

}  // namespace clerestory::mesh
