// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

// Private to mesh/.
namespace clerestory::mesh {

/// A segment that a critical surface meets, over the lines of the surface: u [0, 1] says where a line meets the edge, `depth` grows
/// along the line. The map from the plane is projective, so that segments stay straight.
struct SweptSegment {
  enum class Role : std::uint8_t {
    kBlocks,    ///< shuts the lines that meet it
    kReceives,  ///< takes the lines that meet it first
  };

  double u0 = 0.0;
  double depth0 = 0.0;
  double u1 = 0.0;
  double depth1 = 0.0;  ///< u1 > u0
  std::uint32_t item = 0;
  Role role = Role::kReceives;

  [[nodiscard]] double depth_at(double u) const { return depth0 + (u - u0) / (u1 - u0) * (depth1 - depth0); }
};

/// Lines from u0 to u1 that nothing blocks, and the segment that takes them.
struct LitStretch {
  double u0 = 0.0;
  double u1 = 0.0;
  std::uint32_t segment = 0;  ///< index into the swept segments
};

/// The lower envelope of the receiving segments where none blocks, in order of u. Neither role lasts where segments touch at ends
/// alone. Segments may touch, and where they cross one of them is taken for the whole stretch between two ends.
/// @param cuts  further places at which stretches end
/// Sorts the segments by u0. O(n log n + number of segments over each stretch).
std::vector<LitStretch> sweep(std::vector<SweptSegment>& segments, std::span<const double> cuts);

}  // namespace clerestory::mesh
