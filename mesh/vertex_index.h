// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/geometry.h"

namespace clerestory::mesh {

/// Points, no two of them closer than a tolerance: a point that is near one already there becomes that one, without moving it.
/// So nothing moves by more than the tolerance, however long a chain of near points is, and the result does not change when it
/// goes through again. The order in which points come decides which stay.
class VertexIndex {
 public:
  /// @param tolerance  distance up to which points are one [m], > 0
  explicit VertexIndex(double tolerance) : tolerance_(tolerance), cell_(kCellOverTolerance * tolerance) {}

  /// The nearest point within the tolerance (the first of equally near ones), or a new one.
  std::uint32_t add(const Point& p);
  /// A new point, however near to others.
  std::uint32_t append(const Point& p);
  [[nodiscard]] std::optional<std::uint32_t> find(const Point& p) const;
  [[nodiscard]] std::span<const Point> points() const { return points_; }
  [[nodiscard]] const Point& operator[](std::uint32_t index) const { return points_[index]; }

 private:
  struct Cell {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;
  };

  [[nodiscard]] Cell cell_of(const Point& p) const;
  [[nodiscard]] std::size_t bucket_of(const Cell& cell) const;
  void put_into_bucket(std::uint32_t index);
  void double_buckets();

  /// A few times the tolerance, so that what is near a point lies in its own cell as a rule, and in eight at most.
  static constexpr double kCellOverTolerance = 8.0;

  double tolerance_;  ///< [m]
  double cell_;       ///< side of a cell [m]
  std::vector<Point> points_;
  int bits_ = 0;                       ///< of a bucket's number
  std::vector<std::uint32_t> newest_;  ///< [buckets] the point that came last to one of the cells of a bucket
  std::vector<std::uint32_t> next_;    ///< [points] the next older one of the same bucket
};

}  // namespace clerestory::mesh
