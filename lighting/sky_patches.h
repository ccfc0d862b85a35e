// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/geometry.h"

namespace clerestory::lighting {

/// The sky in patches of about equal solid angle: rows of equal height from the horizon up and a cap at the zenith, each row in
/// patches of equal width. Patches are numbered from the horizon up and in a row from north to east; the first of a row has north in its
/// middle. Source: Tregenza 1987 for one part a patch, Reinhart 2001 for more.
class SkyPatches {
 public:
  /// @param parts      of a Tregenza patch, along either side: 1 gives 145 patches, 2 gives 577
  /// @param north_deg  from +y, counter-clockwise
  explicit SkyPatches(std::size_t parts = 1, double north_deg = 0.0);

  [[nodiscard]] std::size_t count() const { return rows_.back().first + rows_.back().patches; }
  /// The patch of a direction of unit length that does not point down.
  [[nodiscard]] std::size_t of(const mesh::Vector& direction) const;
  [[nodiscard]] double solid_angle_sr(std::size_t patch) const;
  /// The direction of a place in a patch, by coordinates in the unit square: equal areas of it are equal solid angles.
  [[nodiscard]] mesh::Vector direction(std::size_t patch, double a, double b) const;
  [[nodiscard]] mesh::Vector centre(std::size_t patch) const;

 private:
  struct Row {
    std::size_t first = 0;    ///< patch
    std::size_t patches = 1;  ///< in the row
    double low = 0.0;         ///< sine of the altitude
    double high = 1.0;
  };
  [[nodiscard]] const Row& row_of(std::size_t patch) const;

  std::vector<Row> rows_;
  double north_rad_;
};

}  // namespace clerestory::lighting
