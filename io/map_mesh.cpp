// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/map_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace clerestory::io {

namespace {

/// Corners are one node when they are closer than this share of the shortest edge of a cell, or than a micrometre [m].
constexpr double kSameCorner = 1e-3;
constexpr double kMicrometre = 1e-6;

std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  std::uint64_t h = (a ^ (b + 0x9E3779B97F4A7C15ULL + (a << 6) + (a >> 2))) * 0xBF58476D1CE4E5B9ULL;  // splitmix64's
  return h ^ (h >> 31);
}

/// Nodes that several cells share, found by place or by the ends of their edge, with the mean of what is added.
class SharedNodes {
 public:
  SharedNodes(MapMesh& mesh, double tolerance) : mesh_(mesh), tolerance_(tolerance) {}

  std::uint32_t corner(const MapPoint& p, std::uint32_t zone) {
    const double column = std::floor(p.x / tolerance_ - 0.5);
    const double row = std::floor(p.y / tolerance_ - 0.5);
    for (const double dx : {0.0, 1.0}) {
      for (const double dy : {0.0, 1.0}) {  // the four bins that a point within the tolerance may lie in
        const auto found = corners_.find(bin(column + dx, row + dy, zone));
        if (found != corners_.end() && close(mesh_.nodes[found->second], p)) return found->second;
      }
    }
    return corners_[bin(std::floor(p.x / tolerance_), std::floor(p.y / tolerance_), zone)] = new_node(p);
  }

  std::uint32_t edge(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
    const auto [entry, is_new] = edges_.try_emplace(key, 0U);
    if (is_new) {
      const MapPoint p = mesh_.nodes[a];
      const MapPoint q = mesh_.nodes[b];
      entry->second = new_node({0.5 * (p.x + q.x), 0.5 * (p.y + q.y)});
    }
    return entry->second;
  }

  std::uint32_t new_node(const MapPoint& p) {
    mesh_.nodes.push_back(p);
    sums_.push_back(0.0);
    counts_.push_back(0);
    return static_cast<std::uint32_t>(mesh_.nodes.size() - 1);
  }

  void add(std::uint32_t node, double value) {
    sums_[node] += value;
    ++counts_[node];
  }

  /// The mean of what was added to a node, and how much that was.
  [[nodiscard]] double mean(std::uint32_t node) const { return sums_[node] / std::max(counts_[node], 1U); }
  [[nodiscard]] std::uint32_t count(std::uint32_t node) const { return counts_[node]; }

  /// Gives the nodes their means, held within the range of the sensors' values.
  void set_means(float low, float high) {
    for (std::uint32_t i = 0; i < sums_.size(); ++i) {
      mesh_.values.push_back(std::clamp(static_cast<float>(mean(i)), low, high));
    }
  }

 private:
  static std::uint64_t bin(double column, double row, std::uint32_t zone) {
    const auto whole = [](double v) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(v)); };
    return mixed(mixed(whole(column), whole(row)), zone);
  }
  [[nodiscard]] bool close(const MapPoint& a, const MapPoint& b) const {
    return std::hypot(a.x - b.x, a.y - b.y) <= tolerance_;
  }

  MapMesh& mesh_;
  double tolerance_;
  std::vector<double> sums_;
  std::vector<std::uint32_t> counts_;
  std::unordered_map<std::uint64_t, std::uint32_t> corners_;
  std::unordered_map<std::uint64_t, std::uint32_t> edges_;
};

struct CellNodes {
  std::uint32_t centre = 0;
  std::array<std::uint32_t, 4> corners{};
  std::array<std::uint32_t, 4> middles{};  ///< of the edge from corner k to k + 1
};

CellNodes nodes_of(const MapPlan& plan, std::size_t i, SharedNodes& nodes) {
  CellNodes cell;
  for (std::size_t k = 0; k < 4; ++k) cell.corners[k] = nodes.corner(plan.cells[i][k], plan.zone[i]);
  for (std::size_t k = 0; k < 4; ++k) cell.middles[k] = nodes.edge(cell.corners[k], cell.corners[(k + 1) % 4]);
  cell.centre = nodes.new_node(plan.positions[i]);
  return cell;
}

/// The middle of an edge that has no cell beyond it goes on from the middle of the edge opposite through the centre.
void extrapolate_to_border(const CellNodes& cell, SharedNodes& nodes) {
  const double centre = nodes.mean(cell.centre);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::uint32_t opposite = cell.middles[(k + 2) % 4];
    if (nodes.count(cell.middles[k]) != 1 || nodes.count(opposite) != 2) continue;
    // Counted twice, so that the mean, of the centre's value until now, becomes 2 centre - opposite.
    nodes.add(cell.middles[k], 3.0 * centre - 2.0 * nodes.mean(opposite));
  }
}

double shortest_edge(const MapPlan& plan) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& cell : plan.cells) {
    for (std::size_t k = 0; k < 4; ++k) {
      const MapPoint& a = cell[k];
      const MapPoint& b = cell[(k + 1) % 4];
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      if (length > 0.0) shortest = std::min(shortest, length);
    }
  }
  return std::isfinite(shortest) ? shortest : 1.0;
}

/// Chains segments, given by the edges that they join, to lines.
class LineJoiner {
 public:
  using EdgeKey = std::uint64_t;

  void add(EdgeKey a, EdgeKey b) {
    const std::size_t segment = segments_.size();
    segments_.push_back({a, b});
    for (const EdgeKey key : {a, b}) {
      auto& pair = at_edge_.try_emplace(key, Pair{kNone, kNone}).first->second;
      (pair[0] == kNone ? pair[0] : pair[1]) = segment;
    }
  }

  std::vector<std::vector<EdgeKey>> lines() {
    used_.assign(segments_.size(), false);
    std::vector<std::vector<EdgeKey>> lines;
    // Open lines first, from their ends; what remains is closed.
    for (const bool open : {true, false}) {
      for (std::size_t s = 0; s < segments_.size(); ++s) {
        for (std::size_t end = 0; end < 2 && !used_[s]; ++end) {
          if (open && at_edge_.at(segments_[s][end])[1] != kNone) continue;
          lines.push_back(follow(s, segments_[s][end]));
        }
      }
    }
    return lines;
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  using Pair = std::array<std::size_t, 2>;

  std::vector<EdgeKey> follow(std::size_t segment, EdgeKey from) {
    std::vector<EdgeKey> line{from};
    while (segment != kNone && !used_[segment]) {
      used_[segment] = true;
      const auto& ends = segments_[segment];
      from = ends[0] == from ? ends[1] : ends[0];
      line.push_back(from);
      const Pair& pair = at_edge_.at(from);
      segment = pair[0] == segment ? pair[1] : pair[0];
    }
    return line;
  }

  std::vector<std::array<EdgeKey, 2>> segments_;
  std::unordered_map<EdgeKey, Pair> at_edge_;
  std::vector<bool> used_;
};

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

/// The point of an edge that has the value; the edge's ends lie on either side of it.
MapPoint crossing(const MapMesh& mesh, std::uint64_t key, double value) {
  const auto a = static_cast<std::size_t>(key >> 32);
  const auto b = static_cast<std::size_t>(key & 0xFFFFFFFFU);
  const double t = (value - static_cast<double>(mesh.values[a])) /
                   (static_cast<double>(mesh.values[b]) - static_cast<double>(mesh.values[a]));
  return {std::lerp(mesh.nodes[a].x, mesh.nodes[b].x, t), std::lerp(mesh.nodes[a].y, mesh.nodes[b].y, t)};
}

void add_segments(const MapMesh& mesh, const std::array<std::uint32_t, 4>& quad, double value, LineJoiner& lines) {
  std::array<std::uint64_t, 4> crossed{};
  std::size_t count = 0;
  const auto above = [&](std::size_t k) { return static_cast<double>(mesh.values[quad[k % 4]]) >= value; };
  for (std::size_t k = 0; k < 4; ++k) {
    if (above(k) != above(k + 1)) crossed[count++] = edge_key(quad[k], quad[(k + 1) % 4]);
  }
  if (count == 2) lines.add(crossed[0], crossed[1]);
  if (count != 4) return;
  double centre = 0.0;
  for (const std::uint32_t node : quad) centre += 0.25 * static_cast<double>(mesh.values[node]);
  // A saddle: the two corners that lie on the centre's side are joined, the others are cut off.
  const bool cut_first = above(0) != (centre >= value);
  lines.add(crossed[0], crossed[cut_first ? 3 : 1]);
  lines.add(crossed[2], crossed[cut_first ? 1 : 3]);
}

}  // namespace

MapMesh interpolate(const MapPlan& plan, std::span<const float> values) {
  MapMesh mesh;
  if (plan.cells.empty()) return mesh;
  SharedNodes nodes(mesh, std::max(kMicrometre, kSameCorner * shortest_edge(plan)));
  std::vector<CellNodes> cells;
  for (std::size_t i = 0; i < plan.cells.size(); ++i) {
    const CellNodes& cell = cells.emplace_back(nodes_of(plan, i, nodes));
    nodes.add(cell.centre, static_cast<double>(values[i]));
    for (const std::uint32_t middle : cell.middles) nodes.add(middle, static_cast<double>(values[i]));
    for (std::size_t k = 0; k < 4; ++k) {
      mesh.quads.push_back({cell.centre, cell.middles[(k + 3) % 4], cell.corners[k], cell.middles[k]});
    }
  }
  for (const CellNodes& cell : cells) extrapolate_to_border(cell, nodes);
  for (const CellNodes& cell : cells) {
    const double centre = nodes.mean(cell.centre);
    for (std::size_t k = 0; k < 4; ++k) {  // the plane through the centre and the two middles next to the corner
      nodes.add(cell.corners[k], nodes.mean(cell.middles[(k + 3) % 4]) + nodes.mean(cell.middles[k]) - centre);
    }
  }
  const auto [low, high] = std::ranges::minmax(values);
  nodes.set_means(low, high);
  return mesh;
}

std::vector<std::vector<MapPoint>> isolines(const MapMesh& mesh, double value) {
  LineJoiner joiner;
  for (const auto& quad : mesh.quads) add_segments(mesh, quad, value, joiner);
  std::vector<std::vector<MapPoint>> lines;
  for (const auto& keys : joiner.lines()) {
    std::vector<MapPoint> line;
    line.reserve(keys.size());
    for (const std::uint64_t key : keys) line.push_back(crossing(mesh, key, value));
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace clerestory::io
