// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/scene_hash.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>

#include "lighting/scene.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

namespace {

class Digest {
 public:
  template <std::integral T>
  void add(T value) {
    state_ = mesh::hash(state_, static_cast<std::uint64_t>(value));
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(float value) { add(std::bit_cast<std::uint32_t>(value)); }
  void add(const mesh::Point& p) {
    add(p.x);
    add(p.y);
    add(p.z);
  }
  void add(const mesh::Vector& v) { add(mesh::Point{} + v); }
  template <class Range>
  void add_all(const Range& values) {
    add(values.size());
    for (const auto& value : values) add(value);
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

std::uint64_t hash_of_model(const Scene& scene) {
  Digest digest;
  const mesh::Faces& faces = scene.faces;
  digest.add(faces.origin);
  digest.add_all(faces.shape.vertices);
  for (std::size_t f = 0; f < faces.count(); ++f) {
    const auto triangles = faces.shape.of(mesh::FaceId(f));
    digest.add(triangles.size());
    for (const mesh::Triangle& t : triangles) {
      digest.add_all(t.vertices);
      digest.add(t.region);
    }
    digest.add(faces.faces[f].part.value);
  }
  digest.add_all(scene.has_elements);
  return digest.value();
}

std::uint64_t hash_of_materials(const Scene& scene) {
  Digest digest;
  digest.add(scene.channels);
  digest.add_all(scene.channel_weights);
  digest.add_all(scene.passable);
  digest.add_all(scene.glazing_of);
  digest.add_all(scene.opening_of);
  for (const GlazingCurves& g : scene.glazings) {
    digest.add_all(g.transmittance);
    digest.add_all(g.reflectance);
  }
  return digest.value();
}

void add_luminaire(const Luminaire& luminaire, Digest& digest) {
  digest.add(luminaire.at);
  digest.add(luminaire.axes.u);
  digest.add(luminaire.axes.w);
  const LuminousOpening& opening = luminaire.opening;
  digest.add(static_cast<int>(opening.shape));
  digest.add(mesh::Vector{opening.x_m, opening.y_m, opening.z_m});
  const PhotometricWeb& web = *luminaire.web;
  digest.add(web.poles().pole);
  digest.add(web.poles().zero);
  digest.add(web.poles().quarter);
  digest.add_all(web.grid().polar_deg);
  digest.add_all(web.grid().azimuth_deg);
  digest.add_all(web.grid().candela);
  digest.add(web.grid().closed);
}

std::uint64_t hash_of_reflectances(const Scene& scene) {
  Digest digest;
  digest.add_all(scene.reflectance);
  return digest.value();
}

std::uint64_t hash_of_sources(const Scene& scene) {
  Digest digest;
  for (const float exitance : scene.exitance) digest.add(exitance > 0.0F);
  for (std::size_t k = 0; k < scene.luminaires.size(); ++k) {
    add_luminaire(scene.luminaires[k], digest);
    const double dimming = scene.luminaire_dimming[k];
    digest.add(dimming > 0.0 ? std::llround(1e9 * scene.luminaires[k].factor / dimming) : 0LL);
  }
  return digest.value();
}

void add_sky(const Sky& sky, Digest& digest) {
  digest.add(static_cast<int>(sky.type));
  digest.add(sky.horizontal_illuminance_lux);
  digest.add(sky.ground_reflectance);
  const SkyDistribution& shape = sky.distribution;
  for (const double value : {shape.a, shape.b, shape.c, shape.d, shape.e, shape.k, sky.luminance_scale})
    digest.add(value);
  digest.add(shape.towards_sun);
  digest.add(sky.sun.towards);
  digest.add(sky.sun.normal_illuminance_lux);
  digest.add(sky.sun.disc);
  for (const Sky& part : sky.parts) add_sky(part, digest);
}

std::uint64_t hash_of_light(const Scene& scene) {
  Digest digest;
  digest.add_all(scene.exitance);
  add_sky(scene.sky, digest);
  for (const Luminaire& luminaire : scene.luminaires) digest.add(luminaire.factor);
  return digest.value();
}

}  // namespace

SceneHash hash_of(const Scene& scene) {
  return {hash_of_model(scene), hash_of_materials(scene), hash_of_reflectances(scene), hash_of_sources(scene),
          hash_of_light(scene)};
}

std::uint64_t source_of(const Sky& sky) {
  Digest digest;
  add_sky(sky, digest);
  return std::max<std::uint64_t>(1, digest.value());
}

std::uint64_t source_of(const Sun& sun) {
  Digest digest;
  digest.add(sun.towards);
  digest.add(sun.disc);
  return std::max<std::uint64_t>(1, digest.value());
}

}  // namespace clerestory::lighting
