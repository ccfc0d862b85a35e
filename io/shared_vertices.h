// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <unordered_map>

#include "mesh/geometry.h"
#include "mesh/hash.h"

namespace clerestory::io {

/// Vertices of formats that repeat the coordinates at each face: equal coordinates are one vertex.
class SharedVertices {
 public:
  /// The index of a point: that which make() returned for it the first time.
  template <class Make>
  std::uint32_t index(const mesh::Point& p, const Make& make) {
    const auto known = indices_.find(p);
    if (known != indices_.end()) return known->second;
    const std::uint32_t index = make();
    indices_.emplace(p, index);
    return index;
  }

 private:
  struct Hash {
    std::size_t operator()(const mesh::Point& p) const {
      // 0.0 is added because -0.0 equals 0.0 and has other bits.
      const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
      return mesh::hash(mesh::hash(bits(p.x), bits(p.y)), bits(p.z));
    }
  };

  std::unordered_map<mesh::Point, std::uint32_t, Hash> indices_;
};

}  // namespace clerestory::io
