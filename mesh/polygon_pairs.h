// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/planar_region.h"
#include "mesh/progress.h"
#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Two polygons that share more than a boundary.
struct PolygonPair {
  enum class Kind {
    kOverlap,   ///< lie on each other in one plane
    kCrossing,  ///< poke through each other
    kSelf       ///< one polygon, whose sides cross; both indices are its
  };

  Kind kind = Kind::kOverlap;
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  Ends where;  ///< the longest stretch of a side of one in the other, or of the line along which they cross
};

/// Lengths, distances and depths up to this many tolerances are no overlap and no crossing: vertices of polygons that were cut at each
/// other lie within half of that of their planes.
constexpr double kMeetingOverTolerance = 3.0;

/// A polygon's inside, in its mean plane. It must have one.
PlanarRegion region_of(const Soup& soup, const SoupPolygon& polygon);

/// The pairs with at least one polygon that is not marked as checked, in order; polygons without a plane are in none. O(n log n)
/// where polygons are near few others: boxes, then distances in floating point; only what passes is looked at in full.
/// @param progress  hears which share is done; may be null
std::vector<PolygonPair> find_polygon_pairs(const Soup& soup, double tolerance, Progress* progress = nullptr);

}  // namespace clerestory::mesh
