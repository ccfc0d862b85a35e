// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/box_tree.h"
#include "mesh/disjoint_sets.h"

namespace clerestory::mesh {

namespace {

/// Parts this near to each other belong together, as a lamp to the ceiling that it hangs from [m].
constexpr double kGroupGap = 1.0;

struct PartExtents {
  std::vector<Box> boxes;
  std::vector<std::size_t> polygons;
};

PartExtents extents_of_parts(const Soup& soup) {
  PartExtents parts;
  for (const SoupPolygon& polygon : soup.polygons) {
    const std::size_t part = polygon.part.valid() ? polygon.part.index() : 0;
    if (part >= parts.boxes.size()) {
      parts.boxes.resize(part + 1);
      parts.polygons.resize(part + 1, 0);
    }
    ++parts.polygons[part];
    for_each_edge(polygon, [&](std::uint32_t corner, std::uint32_t) { parts.boxes[part].add(soup.points[corner]); });
  }
  return parts;
}

/// The box around the connected group of parts with the most polygons; the first of equal ones.
Box largest_group(const PartExtents& parts) {
  const std::size_t count = parts.boxes.size();
  DisjointSets<std::uint32_t> joined(count);
  const BoxTree tree(parts.boxes);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Box near = grown(parts.boxes[i], kGroupGap);
    tree.visit([&](const Box& box) { return overlap(near, box); }, [&](std::uint32_t other) { joined.join(i, other); });
  }
  std::vector<std::size_t> polygons(count, 0);
  std::vector<Box> boxes(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t root = joined.root(i);
    polygons[root] += parts.polygons[i];
    boxes[root].add(parts.boxes[i]);
  }
  const auto largest = std::max_element(polygons.begin(), polygons.end());
  return largest == polygons.end() ? Box{} : boxes[static_cast<std::size_t>(largest - polygons.begin())];
}

double distance(const Box& a, const Box& b) {
  const auto gap = [](double low_a, double high_a, double low_b, double high_b) {
    return std::max({0.0, low_b - high_a, low_a - high_b});
  };
  return norm({gap(a.low.x, a.high.x, b.low.x, b.high.x), gap(a.low.y, a.high.y, b.low.y, b.high.y),
               gap(a.low.z, a.high.z, b.low.z, b.high.z)});
}

}  // namespace

void leave_out_far_parts(Soup& soup, double far_away_m, const std::vector<std::string>& part_names,
                         std::vector<std::string>& notices) {
  const PartExtents parts = extents_of_parts(soup);
  const Box main = largest_group(parts);
  std::vector<bool> far(parts.boxes.size(), false);
  for (std::size_t i = 0; i < far.size(); ++i) {
    if (parts.boxes[i].empty()) continue;
    const double away = distance(parts.boxes[i], main);
    far[i] = away > far_away_m;
    if (!far[i]) continue;
    notices.push_back(fmt::format("part {} lies {:.1f} km from the rest of the model and was left out",
                                  i < part_names.size() ? part_names[i] : std::to_string(i), away / 1000.0));
  }
  std::erase_if(soup.polygons,
                [&](const SoupPolygon& polygon) { return far[polygon.part.valid() ? polygon.part.index() : 0]; });
}

Vector recentre(Soup& soup) {
  const Box box = largest_group(extents_of_parts(soup));
  if (box.empty()) return {};
  const Point centre = box.centre();
  const Vector shift{std::floor(centre.x + 0.5), std::floor(centre.y + 0.5), std::floor(centre.z + 0.5)};
  for (Point& p : soup.points) p = p - shift;
  return shift;
}

}  // namespace clerestory::mesh
