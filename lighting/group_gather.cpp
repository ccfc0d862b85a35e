// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/group_gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lighting/openings.h"
#include "lighting/parallel.h"
#include "lighting/replicates.h"
#include "lighting/sensor_rays.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;

namespace {

/// Adds up the light along a ray by group.
struct GroupLooker {
  const Solution* solution;
  const GroupRadiosity* radiosity;
  double share;           ///< of the sums that the ray has
  std::span<double> lux;  ///< [groups]

  void surface(const SurfacePoint& seen, float weight, bool with_emission) {
    const ElementId e = solution->element_at(seen.side, seen.region, seen.at);
    if (!e.valid()) return;
    const Scene& scene = solution->scene();
    if (with_emission) {
      const double own = luminance(scene.side_exitance(seen.side), scene.channel_weights);
      lux[scene.groups.column_of(scene.side_group[seen.side.index()])] += share * weight * own;
    }
    const double factor = share * weight * shown_share(e, seen);
    if (factor > 0.0) add_reflected(e, seen.at, static_cast<float>(factor));
  }
  void sky(const Vector& direction, float weight, bool) {
    const Scene& scene = solution->scene();
    lux[scene.groups.column_of(scene.groups.of_sky(direction))] +=
        share * weight * std::numbers::pi * sky_luminance(scene.sky, direction);
  }

 private:
  /// What is left of the reflected light of a line where it is cut off at zero, band by band.
  [[nodiscard]] double shown_share(ElementId e, const SurfacePoint& seen) const {
    const Scene& scene = solution->scene();
    double cut = 0.0;
    double whole = 0.0;
    for (std::size_t c = 0; c < scene.channels; ++c) {
      const double lux_of_band = solution->illuminance_at(e, seen.at, c);
      const double reflected = scene.channel_weights[c] * scene.side_reflectance(seen.side)[c];
      whole += reflected * lux_of_band;
      cut += reflected * std::max(0.0, lux_of_band);
    }
    return whole > 0.0 ? cut / whole : 0.0;
  }

  void add_reflected(ElementId e, const Point& at, float factor) {
    const mesh::Frame& axes = solution->tree().axes(e);
    const Vector d = at - solution->tree().centroid(e);
    const auto u = factor * static_cast<float>(dot(d, axes.u));
    const auto v = factor * static_cast<float>(dot(d, axes.v));
    const std::size_t groups = lux.size();
    const float* line = radiosity->lines(e).data();
    double* sums = lux.data();
    for (std::size_t g = 0; g < groups; ++g)
      sums[g] += factor * line[g] + u * line[groups + g] + v * line[2 * groups + g];
  }
};

/// Sums of one part, by replicate and group.
class PartSums {
 public:
  PartSums(const Solution& solution, const GroupRadiosity& radiosity)
      : solution_(solution), radiosity_(radiosity), sums_(kReplicates * radiosity.groups()) {}

  void begin(const SensorPart& part, std::uint32_t own_group) {
    std::fill(sums_.begin(), sums_.end(), 0.0);
    norms_.fill(0.0);
    full_lux_ = part.full_lux;
    own_group_ = own_group;
  }
  template <class Trace, class Scale>
  void ray(std::size_t r, const Trace& trace, const Scale& scale) {
    GroupLooker looker{&solution_, &radiosity_, scale(1.0), of(r)};
    trace(looker);
    norms_[r] += 1.0;
  }
  void miss(std::size_t r) { norms_[r] += 1.0; }
  void sun(std::size_t r, double lux) {
    of(r)[own_group_] += lux;
    norms_[r] += 1.0;
  }
  void seen(std::size_t r, double kernel, double passed) {
    of(r)[own_group_] += full_lux_ * kernel * passed;
    norms_[r] += kernel;
  }
  [[nodiscard]] ReplicateMean estimate(std::size_t group) {
    std::array<double, kReplicates> values{};
    for (std::size_t r = 0; r < kReplicates; ++r) values[r] = norms_[r] > 0.0 ? of(r)[group] / norms_[r] : 0.0;
    return mean_of_replicates(values);
  }

 private:
  [[nodiscard]] std::span<double> of(std::size_t r) {
    return std::span(sums_).subspan(r * radiosity_.groups(), radiosity_.groups());
  }

  const Solution& solution_;
  const GroupRadiosity& radiosity_;
  std::vector<double> sums_;
  std::array<double, kReplicates> norms_{};
  double full_lux_ = 0.0;
  std::uint32_t own_group_ = 0;
};

/// Means and variances of one sensor, by group.
struct SensorGroups {
  explicit SensorGroups(std::size_t groups) : mean(groups, 0.0), variance(groups, 0.0) {}
  std::vector<double> mean;
  std::vector<double> variance;
};

class GroupGatherer {
 public:
  GroupGatherer(const Solution& solution, const GroupRadiosity& radiosity, std::uint64_t seed)
      : solution_(solution), radiosity_(radiosity), rays_(solution, seed) {}

  [[nodiscard]] SensorGroups gather(const SensorRecord& record, const SensorPlace& place) const {
    SensorGroups result(radiosity_.groups());
    PartSums sums(solution_, radiosity_);
    for (const SensorPart& part : record.parts) {
      const std::uint32_t group = group_of(part, place);
      sums.begin(part, group);
      SensorPart from_the_first = part;
      from_the_first.rays = 0;
      rays_.cast(from_the_first, part.rays, place, sums);
      double lit = 0.0;
      for (std::size_t g = 0; g < result.mean.size(); ++g) {
        const ReplicateMean lux = sums.estimate(g);
        result.mean[g] += lux.mean;
        result.variance[g] += lux.variance;
        lit += lux.mean;
      }
      // As where all light is gathered: none is no proof of nothing.
      const double missed = part.most_lux / (static_cast<double>(kReplicates) * part.rays);
      if (lit <= 0.0) result.variance[group] += missed * missed;
    }
    for (const GroupLight& light : record.exact)
      result.mean[solution_.scene().groups.column_of(light.group)] += light.lux;
    return result;
  }

 private:
  /// Of an emitter, of the sun; of an opening that of the sky in its middle.
  [[nodiscard]] std::uint32_t group_of(const SensorPart& part, const SensorPlace& place) const {
    const Scene& scene = solution_.scene();
    if (part.kind == SensorPart::Kind::kEmitter)
      return scene.groups.column_of(
          scene.side_group[solution_.tree().face_side(rays_.emitters()[part.which].root).index()]);
    if (part.kind == SensorPart::Kind::kSun) return scene.groups.column_of(scene.groups.of_sun());
    if (part.kind == SensorPart::Kind::kHemisphere || !scene.has_sky()) return 0;
    const mesh::ShaftEnd end = shaft_end(scene.openings[part.which]);
    return scene.groups.column_of(scene.groups.of_sky(normalized(midpoint(end.corners[0], end.corners[2]) - place.at)));
  }

  const Solution& solution_;
  const GroupRadiosity& radiosity_;
  SensorRays rays_;
};

}  // namespace

std::vector<GroupColumn> gather_groups(const Solution& solution, const GroupRadiosity& radiosity,
                                       const Gathered& gathered, const SensorSet& sensors, std::uint64_t seed) {
  const SourceGroups& groups = solution.scene().groups;
  std::vector<GroupColumn> columns;
  for (std::size_t c = 0; c < groups.column_count(); ++c)
    columns.push_back(
        {groups.column_name(c), std::vector<float>(sensors.count()), std::vector<float>(sensors.count())});
  const GroupGatherer gatherer(solution, radiosity, seed);
  const double lift = solution.scene().rays->offset_m();
  parallel_for(sensors.count(), [&](std::size_t i) {
    const SensorRecord& record = gathered.records[i];
    const SensorGroups own =
        gatherer.gather(record, {i, sensors.positions[i] + lift * sensors.axes[i], sensors.receiver(i)});
    const double all = gathered.illuminance_lux[i];
    for (std::size_t g = 0; g < columns.size(); ++g) {
      const double lux = std::max(0.0, own.mean[g]);
      const double share = all > 0.0 ? std::sqrt(std::min(1.0, lux / all)) : 0.0;
      columns[g].illuminance_lux[i] = static_cast<float>(lux);
      columns[g].error_lux[i] =
          static_cast<float>(std::hypot(kStudent * std::sqrt(own.variance[g]), share * record.discretisation_lux));
    }
  });
  return columns;
}

}  // namespace clerestory::lighting
