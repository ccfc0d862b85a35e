// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/hemisphere_links.h"

#include <array>
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

  void surface(const SurfacePoint& point, float weight, bool beyond) {
    if (beyond || !solution->scene().shines(point.side)) {
      view->seen.push_back(seen_surface(*solution, point, factor * weight));
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
      const Point at =
          tree.sample(node, numbers.at(i, 0), numbers.at(i, 1)) + scene.rays->offset_m() * tree.normal(node);
      follow(scene, at, cosine_direction(tree.axes(node), numbers.at(i, 2), numbers.at(i, 3)), 1.0F,
             PathRule{PathRule::Part::kGather, -1, true}, collector);
    }
  }
  view.starts[HemisphereView::kSets] = view.seen.size();
  view.mirrored_groups = groups.lit();
  return view;
}

HemisphereView::Estimate HemisphereView::estimate(const Solution& solution) const {
  std::array<double, kSets> lux{};
  for (std::size_t set = 0; set < kSets; ++set) {
    const auto own = std::span(seen).subspan(starts[set], starts[set + 1] - starts[set]);
    lux[set] = kSets * illuminance_by(solution, own);
  }
  const ReplicateMean all = mean_of_replicates(lux);
  return {all.mean, all.standard_error()};
}

}  // namespace clerestory::lighting
