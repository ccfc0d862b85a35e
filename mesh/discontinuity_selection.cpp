// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/discontinuity_selection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
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

/// How far from a point, along a line through it in a direction at right angles to `along`, another line is met; negative on the other
/// side, nothing where it is not met.
std::optional<double> met_at(const Point& from, const Vector& across, const Vector& along,
                             const DiscontinuityLine& other) {
  const double a = dot(other.ends[0] - from, along);
  const double b = dot(other.ends[1] - from, along);
  if ((a > 0.0) == (b > 0.0)) return std::nullopt;
  return dot(other.ends[0] + (a / (a - b)) * (other.ends[1] - other.ends[0]) - from, across);
}

/// The size of the elements across a line where others of its face are edges of the mesh.
double size_between(const DiscontinuityLine& line, const WeighedLine& weighed, std::span<const DiscontinuityLine> lines,
                    std::span<const std::uint32_t> others) {
  const Point from = midpoint(line.ends[0], line.ends[1]);
  const Vector along = line.ends[1] - line.ends[0];
  double before = weighed.size_m;
  double behind = weighed.size_m;
  for (const std::uint32_t other : others) {
    const auto at = met_at(from, weighed.across, along, lines[other]);
    if (!at) continue;
    (*at > 0.0 ? behind : before) = std::min(*at > 0.0 ? behind : before, std::abs(*at));
  }
  return std::min(weighed.size_m, before + behind);
}

}  // namespace

LineSelection select_lines(std::span<const DiscontinuityLine> lines, std::span<const WeighedLine> weighed,
                           const SelectionOptions& options) {
  LineSelection selection;
  std::vector<double> weights;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    ++selection.found[lines[i].order];
    weights.push_back(weighed[i].missed(weighed[i].size_m));
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
    if (!(weighed[i].missed(size_between(line, weighed[i], lines, there)) > 1.0)) {
      ++selection.light;
      continue;
    }
    if (there.size() >= options.most_per_face || selection.kept.size() >= options.most) {
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
