// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sun_sampler.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "lighting/sampled_mean.h"
#include "lighting/sun_light.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;

namespace {

constexpr double kPlaceArea = 0.01;  ///< of which one place is looked at [m²]
constexpr std::uint32_t kLeastPlaces = 64;
constexpr std::uint32_t kMostPlaces = 16384;
constexpr std::uint32_t kPlacesOfWhole = 8;
/// Light that differs by more from place to place has an edge.
constexpr double kEven = 0.8;
constexpr std::uint32_t kFirstRays = 8;  ///< of each set
constexpr std::uint32_t kMostRays = 512;

}  // namespace

double SunSampler::lux(ElementId e, const Point& p, double a, double b) const {
  const Scene& scene = solution_.scene();
  const mesh::Vector& normal = solution_.tree().normal(e);
  return sun_illuminance(scene, sun_, p + scene.rays->offset_m() * normal, normal, sun_direction(sun_, a, b));
}

SunSurvey SunSampler::survey(ElementId e, SunView known) const {
  SunSurvey result;
  if (known == SunView::kNone || !sun_.shines()) return result;
  const mesh::ElementTree& tree = solution_.tree();
  const auto wanted = static_cast<std::uint32_t>(std::min<double>(kMostPlaces, tree.area(e) / kPlaceArea));
  const std::uint32_t places = known == SunView::kWhole ? kPlacesOfWhole : std::max(kLeastPlaces, wanted);
  const SobolPoints numbers(mesh::hash(mesh::hash(seed_, tree.key(e)), 0x5A1));
  std::vector<PlaneSample> samples;
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (std::uint32_t i = 0; i < places; ++i) {
    const Point p = tree.sample(e, numbers.at(i, 0), numbers.at(i, 1));
    const mesh::Vector d = p - tree.centroid(e);
    const double value = lux(e, p, numbers.at(i, 2), numbers.at(i, 3));
    samples.push_back({dot(d, tree.axes(e).u), dot(d, tree.axes(e).v), value, 0.0});
    least = std::min(least, value);
    most = std::max(most, value);
    if (samples.size() >= kLeastPlaces && least < kEven * most) break;
  }
  if (most <= 0.0) return result;
  for (PlaneSample& s : samples) s.weight = 1.0 / static_cast<double>(samples.size());
  result.view = least < kEven * most ? SunView::kPartly : SunView::kWhole;
  result.fit = fit_line(samples);
  result.mean_lux = result.fit.line.value;
  return result;
}

ReplicateMean SunSampler::mean(ElementId e, SunView view, double tolerance_lux) const {
  if (view == SunView::kNone || view == SunView::kUnknown) return {};
  const mesh::ElementTree& tree = solution_.tree();
  const std::uint64_t key = mesh::hash(mesh::hash(seed_, tree.key(e)), 0x5A2);
  return sampled_mean(
      key, kFirstRays, kMostRays,
      [&](const SobolPoints& numbers, std::uint32_t i) {
        return lux(e, tree.sample(e, numbers.at(i, 0), numbers.at(i, 1)), numbers.at(i, 2), numbers.at(i, 3));
      },
      [&](const ReplicateMean& mean, std::uint32_t rays) {
        const bool enough = view == SunView::kWhole || rays >= 4 * kFirstRays;
        return enough && mean.standard_error() <= tolerance_lux;
      });
}

}  // namespace clerestory::lighting
