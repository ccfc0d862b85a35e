// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/wedge_sweep.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace clerestory::mesh {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// Stretches shorter than this are rounding.
constexpr double kShortest = 1e-9;

std::vector<double> breakpoints(std::span<const SweptSegment> segments, std::span<const double> cuts) {
  std::vector<double> places{0.0, 1.0};
  for (const SweptSegment& s : segments) {
    places.push_back(s.u0);
    places.push_back(s.u1);
  }
  for (const double u : cuts) {
    if (u > 0.0 && u < 1.0) places.push_back(u);
  }
  std::sort(places.begin(), places.end());
  return places;
}

/// The nearest receiving segment at a place, none where one blocks.
std::uint32_t nearest(std::span<const SweptSegment> segments, std::span<const std::uint32_t> over, double u) {
  std::uint32_t found = kNone;
  double depth = std::numeric_limits<double>::infinity();
  for (const std::uint32_t i : over) {
    const SweptSegment& s = segments[i];
    if (u < s.u0 || u > s.u1) continue;
    if (s.role == SweptSegment::Role::kBlocks) return kNone;
    if (const double here = s.depth_at(u); here < depth) {
      depth = here;
      found = i;
    }
  }
  return found;
}

}  // namespace

std::vector<LitStretch> sweep(std::vector<SweptSegment>& segments, std::span<const double> cuts) {
  std::sort(segments.begin(), segments.end(), [](const SweptSegment& a, const SweptSegment& b) {
    return std::tie(a.u0, a.item, a.depth0) < std::tie(b.u0, b.item, b.depth0);
  });
  const std::vector<double> places = breakpoints(segments, cuts);
  std::vector<std::uint32_t> over;
  std::uint32_t next = 0;
  std::vector<LitStretch> lit;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double begin = places[i];
    const double end = places[i + 1];
    if (end - begin < kShortest) continue;
    const double middle = 0.5 * (begin + end);
    while (next < segments.size() && segments[next].u0 <= middle) over.push_back(next++);
    std::erase_if(over, [&](std::uint32_t s) { return segments[s].u1 < middle; });
    const std::uint32_t segment = nearest(segments, over, middle);
    if (segment != kNone) lit.push_back({begin, end, segment});
  }
  return lit;
}

}  // namespace clerestory::mesh
