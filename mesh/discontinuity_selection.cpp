// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/discontinuity_selection.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <unordered_map>

namespace clerestory::mesh {

namespace {

bool is_near(const Point& p, const DiscontinuityLine& line, double distance) {
  const Vector along = line.ends[1] - line.ends[0];
  const double squared = dot(along, along);
  const double t = squared > 0.0 ? std::clamp(dot(p - line.ends[0], along) / squared, 0.0, 1.0) : 0.0;
  return norm(p - (line.ends[0] + t * along)) <= distance;
}

bool runs_along(const DiscontinuityLine& line, const DiscontinuityLine& other, double distance) {
  return is_near(line.ends[0], other, distance) && is_near(line.ends[1], other, distance);
}

std::vector<std::uint32_t> by_weight(std::span<const double> weights) {
  std::vector<std::uint32_t> order(weights.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return weights[a] > weights[b]; });
  return order;
}

}  // namespace

LineSelection select_lines(std::span<const DiscontinuityLine> lines,
                           const std::function<double(const DiscontinuityLine&)>& weight,
                           const SelectionOptions& options) {
  LineSelection selection;
  std::vector<double> weights;
  for (const DiscontinuityLine& line : lines) {
    ++selection.found[line.order];
    weights.push_back(weight(line));
  }
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> of_face;
  std::set<FaceId> capped;
  for (const std::uint32_t i : by_weight(weights)) {
    const DiscontinuityLine& line = lines[i];
    if (!(weights[i] > 1.0)) {
      ++selection.light;
      continue;
    }
    std::vector<std::uint32_t>& there = of_face[line.face.value];
    if (std::any_of(there.begin(), there.end(),
                    [&](std::uint32_t other) { return runs_along(line, lines[other], options.distance_m); })) {
      ++selection.merged;
      continue;
    }
    if (there.size() >= options.most_per_face) {
      ++selection.over_cap;
      capped.insert(line.face);
      continue;
    }
    there.push_back(i);
    selection.kept.push_back(i);
    ++selection.kept_count[line.order];
  }
  selection.cap_faces.assign(capped.begin(), capped.end());
  return selection;
}

}  // namespace clerestory::mesh
