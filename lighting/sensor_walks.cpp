// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sensor_walks.h"

#include <algorithm>
#include <numbers>

#include "lighting/light_paths.h"
#include "lighting/luminaire_light.h"
#include "lighting/parallel.h"
#include "lighting/sampling.h"
#include "lighting/sun_light.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::Point;
using mesh::Vector;

namespace {

constexpr std::size_t kWalkers = 1024;  ///< sensors that send out walks, spread evenly over all of them
constexpr std::size_t kWalks = 32768;   ///< in all
constexpr int kBounces = 5;             ///< later ones carry under 0.5^5 of the light

/// Takes what a ray sees; panes are passed, their mirror images left out.
struct LastSurface {
  const Sky* light;
  SurfacePoint point;
  float weight = 0.0F;
  double sky_lux = 0.0;

  void surface(const SurfacePoint& p, float w, bool) {
    point = p;
    weight = w;
  }
  void sky(const Vector& direction, float w, bool) {
    sky_lux += w * std::numbers::pi * sky_luminance(*light, direction);
  }
};

SensorWalk walk(const Scene& scene, const Point& position, const Vector& normal, std::uint32_t walks,
                std::uint64_t seed) {
  SensorWalk walked;
  walked.ends.reserve(static_cast<std::size_t>(walks) * kBounces);
  for (std::uint32_t i = 0; i < walks; ++i) {
    Point at = position;
    Vector facing = normal;
    float weight = 1.0F / static_cast<float>(walks);
    for (int bounce = 0; bounce < kBounces; ++bounce) {
      const SobolPoints points(mesh::hash(seed, static_cast<std::uint64_t>(bounce)));
      const Vector d = cosine_direction(mesh::frame_around(facing), points.at(i, 0), points.at(i, 1));
      LastSurface seen{&scene.sky, {}, 0.0F, 0.0};
      follow(scene, at, d, 1.0F, PathRule{PathRule::Part::kAll, -1, false}, seen);
      walked.lux += weight * (seen.sky_lux + luminaire_guess(scene, at, facing, points.at(i, 2)));
      walked.lux += weight * sun_illuminance(scene, at, facing);
      if (seen.weight <= 0.0F) break;
      weight *= seen.weight;
      const mesh::FaceSide side = seen.point.side;
      if (scene.has_elements[side.index()] == 0) break;
      walked.ends.push_back({side, seen.point.region, seen.point.at, weight});
      walked.lux += weight * luminance(scene.side_exitance(side), scene.channel_weights);
      weight *= luminance(scene.side_reflectance(side), scene.channel_weights);
      const Vector& front = scene.faces.faces[side.face.index()].frame.w;
      facing = side.side == mesh::Side::kFront ? front : -front;
      at = seen.point.at + scene.rays->offset_m() * facing;
    }
  }
  return walked;
}

}  // namespace

std::vector<SensorWalk> walk_from_sensors(const Scene& scene, std::span<const Point> positions,
                                          std::span<const Vector> normals, std::uint64_t seed) {
  const std::size_t walkers = std::min(kWalkers, positions.size());
  std::vector<SensorWalk> walked(walkers);
  const auto walks = static_cast<std::uint32_t>(kWalks / std::max<std::size_t>(1, walkers));
  parallel_for(walkers, [&](std::size_t i) {
    const std::size_t sensor = i * positions.size() / walkers;
    // A sensor may stand on a surface.
    const Point lifted = positions[sensor] + scene.rays->offset_m() * normals[sensor];
    walked[i] = walk(scene, lifted, normals[sensor], walks, mesh::hash(seed, sensor));
    walked[i].sensor = sensor;
  });
  return walked;
}

std::vector<std::uint8_t> sides_reached(const Scene& scene, const std::vector<SensorWalk>& walks) {
  std::vector<std::uint8_t> reached(2 * scene.faces.count(), walks.empty() ? 1 : 0);
  for (const SensorWalk& walk : walks) {
    for (const SensorWalk::End& end : walk.ends) reached[end.side.index()] = 1;
  }
  return reached;
}

}  // namespace clerestory::lighting
