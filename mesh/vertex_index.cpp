// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/vertex_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clerestory::mesh {

namespace {
constexpr std::uint32_t kEnd = std::numeric_limits<std::uint32_t>::max();
constexpr int kFirstBits = 4;
}  // namespace

// Primes of Teschner et al., Optimized Spatial Hashing for Collision Detection of Deformable Objects, VMV 2003.
std::size_t VertexIndex::bucket_of(const Cell& cell) const {
  std::uint64_t h = static_cast<std::uint64_t>(cell.x) * 73856093U ^ static_cast<std::uint64_t>(cell.y) * 19349663U ^
                    static_cast<std::uint64_t>(cell.z) * 83492791U;
  h ^= h >> 32U;
  return static_cast<std::size_t>((h * 0x9E3779B97F4A7C15ULL) >> (64 - bits_));
}

VertexIndex::Cell VertexIndex::cell_of(const Point& p) const {
  return {static_cast<std::int64_t>(std::floor(p.x / cell_)), static_cast<std::int64_t>(std::floor(p.y / cell_)),
          static_cast<std::int64_t>(std::floor(p.z / cell_))};
}

std::optional<std::uint32_t> VertexIndex::find(const Point& p) const {
  if (points_.empty()) return std::nullopt;
  const Vector reach{tolerance_, tolerance_, tolerance_};
  const Cell low = cell_of(p - reach);
  const Cell high = cell_of(p + reach);
  double best_distance = tolerance_;
  std::uint32_t best = kEnd;
  for (std::int64_t x = low.x; x <= high.x; ++x) {
    for (std::int64_t y = low.y; y <= high.y; ++y) {
      for (std::int64_t z = low.z; z <= high.z; ++z) {
        for (std::uint32_t i = newest_[bucket_of({x, y, z})]; i != kEnd; i = next_[i]) {
          const double distance = norm(points_[i] - p);
          if (distance < best_distance || (distance == best_distance && i < best)) {
            best_distance = distance;
            best = i;
          }
        }
      }
    }
  }
  if (best == kEnd) return std::nullopt;
  return best;
}

std::uint32_t VertexIndex::add(const Point& p) {
  const std::optional<std::uint32_t> found = find(p);
  return found ? *found : append(p);
}

std::uint32_t VertexIndex::append(const Point& p) {
  const auto index = static_cast<std::uint32_t>(points_.size());
  points_.push_back(p);
  next_.push_back(kEnd);
  if (points_.size() > newest_.size())
    double_buckets();
  else
    put_into_bucket(index);
  return index;
}

void VertexIndex::put_into_bucket(std::uint32_t index) {
  std::uint32_t& newest = newest_[bucket_of(cell_of(points_[index]))];
  next_[index] = newest;
  newest = index;
}

void VertexIndex::double_buckets() {
  bits_ = std::max(kFirstBits, bits_ + 1);
  newest_.assign(std::size_t{1} << static_cast<unsigned>(bits_), kEnd);
  for (std::uint32_t i = 0; i < points_.size(); ++i) put_into_bucket(i);
}

}  // namespace clerestory::mesh
