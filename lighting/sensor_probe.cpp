// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sensor_probe.h"

#include <algorithm>
#include <cmath>

#include "lighting/dark_share.h"
#include "lighting/luminaire_light.h"
#include "lighting/parallel.h"
#include "lighting/sampling.h"
#include "lighting/sensor_looker.h"
#include "lighting/sun_light.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::Point;
using mesh::Vector;

namespace {

constexpr std::size_t kSensors = 32;  ///< of a grid, spread evenly over it
/// Of a sensor: so many that errors of far elements cancel out as they do over all rays of a sensor.
constexpr std::uint32_t kRays = 256;

}  // namespace

SensorProbe::SensorProbe(const Scene& scene, std::span<const Point> positions, std::span<const Vector> normals,
                         std::span<const std::uint32_t> grids, std::uint64_t seed) {
  std::vector<std::vector<std::size_t>> of_grid;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (grids[i] >= of_grid.size()) of_grid.resize(grids[i] + 1);
    of_grid[grids[i]].push_back(i);
  }
  for (const std::vector<std::size_t>& all : of_grid) {
    std::vector<Sensor>& some = grids_.emplace_back();
    const std::size_t count = std::min(kSensors, all.size());
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = all[k * all.size() / count];
      some.push_back({positions[i] + scene.rays->offset_m() * normals[i], normals[i], mesh::hash(seed, i)});
    }
  }
}

SensorProbe::Seen SensorProbe::look(const Solution& solution, const SolutionErrors& errors, const Sensor& sensor) {
  const Scene& scene = solution.scene();
  const mesh::Frame frame = mesh::frame_around(sensor.normal);
  const SobolPoints points(sensor.seed);
  SensorLooker looker{&solution, &errors};
  for (std::uint32_t i = 0; i < kRays; ++i) {
    const Vector d = cosine_direction(frame, points.at(i, 0), points.at(i, 1));
    follow(scene, sensor.at, d, 1.0F, PathRule{PathRule::Part::kAll, -1, true}, looker);
  }
  for (double& lux : looker.wrong) lux /= kRays;
  const double by_points =
      luminaire_glance(scene, sensor.at, sensor.normal) + sun_illuminance(scene, sensor.at, sensor.normal);
  return {looker.lux / kRays + by_points, error_of(looker.wrong)};
}

double SensorProbe::discretisation(const Solution& solution, const SolutionErrors& errors) const {
  double worst = 0.0;
  for (const std::vector<Sensor>& sensors : grids_) {
    if (sensors.empty()) continue;
    std::vector<Seen> seen(sensors.size());
    parallel_for(sensors.size(), [&](std::size_t i) { seen[i] = look(solution, errors, sensors[i]); });
    const auto count = static_cast<double>(sensors.size());
    double mean_lux = 0.0;
    for (const Seen& s : seen) mean_lux += s.lux / count;
    if (mean_lux <= 0.0) continue;
    double square = 0.0;
    for (const Seen& s : seen) {
      const double share = s.error_lux / std::max(s.lux, kDarkShare * mean_lux);
      square += share * share / count;
    }
    worst = std::max(worst, std::sqrt(square));
  }
  return worst;
}

}  // namespace clerestory::lighting
