// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/hemisphere_links.h"

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "lighting/light_paths.h"
#include "lighting/replicates.h"
#include "lighting/sampling.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;

namespace {

/// Keeps what the node's other light does not hold: sky and openings are direct light, shining surfaces have links.
struct Collector {
  const Solution* solution;
  HemisphereView* view;
  GroupSums* groups;
  float factor;
  std::array<float, 2> from{};

  void surface(const SurfacePoint& point, float weight, bool beyond) {
    if (beyond || !solution->scene().shines(point.side)) {
      view->seen.push_back(seen_surface(*solution, point, factor * weight));
      view->from.push_back(from);
    }
  }
  void sky(const Vector& direction, float weight, bool beyond) {
    if (!beyond) return;
    const double per_luminance = factor * weight * std::numbers::pi;
    const double lux = per_luminance * sky_luminance(solution->scene().sky, direction);
    view->mirrored_sky_lux += lux;
    add_sky_light(solution->scene(), direction, lux, per_luminance, *groups);
  }
};

/// Slopes of a line over a node along its axes [lux/m].
struct Line {
  double u = 0.0;
  double v = 0.0;
};

/// Mean square of what a line makes of the light over a node [lux²].
double square_of(const Line& line, const mesh::SecondMoments& area) {
  return area.uu * line.u * line.u + 2.0 * area.uv * line.u * line.v + area.vv * line.v * line.v;
}

/// The slopes of the line that fits best to what the rays of one set bring, who begin evenly all over the node.
Line line_by(const Solution& solution, std::span<const SeenSurface> seen, std::span<const std::array<float, 2>> from,
             const mesh::SecondMoments& area) {
  const double determinant = area.uu * area.vv - area.uv * area.uv;
  if (determinant <= 0.0) return {};
  double u = 0.0;
  double v = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double lux = HemisphereView::kSets * illuminance_by(solution, seen.subspan(i, 1));
    u += lux * from[i][0];
    v += lux * from[i][1];
  }
  return {(u * area.vv - v * area.uv) / determinant, (v * area.uu - u * area.uv) / determinant};
}

}  // namespace

HemisphereView look_around(const Solution& solution, ElementId node, std::uint32_t rays, std::uint64_t seed) {
  const Scene& scene = solution.scene();
  const mesh::ElementTree& tree = solution.tree();
  HemisphereView view;
  GroupSums groups(scene.groups);
  view.rays = rays;
  const auto each = static_cast<std::uint32_t>(rays / HemisphereView::kSets);
  for (std::size_t set = 0; set < HemisphereView::kSets; ++set) {
    view.starts[set] = view.seen.size();
    const SobolPoints numbers(mesh::hash(mesh::hash(tree.key(node), seed), 0x4E0 + set));
    Collector collector{&solution, &view, &groups, 1.0F / static_cast<float>(each * HemisphereView::kSets)};
    for (std::uint32_t i = 0; i < each; ++i) {
      const Point place = tree.sample(node, numbers.at(i, 0), numbers.at(i, 1));
      const Point at = place + scene.rays->offset_m() * tree.normal(node);
      const Vector d = place - tree.centroid(node);
      collector.from = {static_cast<float>(dot(d, tree.axes(node).u)), static_cast<float>(dot(d, tree.axes(node).v))};
      follow(scene, at, cosine_direction(tree.axes(node), numbers.at(i, 2), numbers.at(i, 3)), 1.0F,
             PathRule{PathRule::Part::kGather, -1, true}, collector);
    }
  }
  view.starts[HemisphereView::kSets] = view.seen.size();
  view.mirrored_groups = groups.lit();
  return view;
}

HemisphereView::Estimate HemisphereView::estimate(const Solution& solution, ElementId node) const {
  std::array<double, kSets> lux{};
  std::array<Line, kSets> lines;
  const mesh::SecondMoments& area = solution.tree().second_moments(node);
  for (std::size_t set = 0; set < kSets; ++set) {
    const std::size_t count = starts[set + 1] - starts[set];
    const auto own = std::span(seen).subspan(starts[set], count);
    lux[set] = kSets * illuminance_by(solution, own);
    lines[set] = line_by(solution, own, std::span(from).subspan(starts[set], count), area);
  }
  const ReplicateMean all = mean_of_replicates(lux);
  Line mean;
  for (const Line& line : lines) mean = {mean.u + line.u / kSets, mean.v + line.v / kSets};
  double scatter = 0.0;
  for (const Line& line : lines) scatter += square_of({line.u - mean.u, line.v - mean.v}, area);
  Estimate estimate{all.mean, {}, all.standard_error(), std::sqrt(scatter / (kSets * (kSets - 1)))};
  if (all.mean > 0.0)
    estimate.slope = {1.0F, static_cast<float>(mean.u / all.mean), static_cast<float>(mean.v / all.mean)};
  return estimate;
}

}  // namespace clerestory::lighting
