// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/path_tracer.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <thread>

namespace clerestory::test {

using mesh::Point;
using mesh::Vector;
using std::numbers::pi;

namespace {

constexpr double kRefractiveIndex = 1.52;
/// Bounces that every path makes before Russian roulette.
constexpr int kSureBounces = 3;

class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t stream) {
    std::seed_seq seeds{seed & 0xffffffffU, seed >> 32U, stream & 0xffffffffU, stream >> 32U};
    generator_.seed(seeds);
  }
  double operator()() { return static_cast<double>(generator_() >> 11U) * 0x1p-53; }

 private:
  std::mt19937_64 generator_;
};

double luminance_beyond(const lighting::Sky& sky, const Vector& direction) {
  const double horizontal = sky.horizontal_illuminance_lux;
  if (sky.type == lighting::Sky::Type::kNone) return 0.0;
  const double by_sun = sky.sun.normal_illuminance_lux * std::max(0.0, sky.sun.towards.z);
  if (direction.z < 0.0) return sky.ground_reflectance * (horizontal + by_sun) / pi;
  if (sky.type == lighting::Sky::Type::kUniform) return horizontal / pi;
  if (sky.type == lighting::Sky::Type::kDistribution) {
    const lighting::SkyDistribution& l = sky.distribution;
    const double cosine = std::clamp(dot(direction, l.towards_sun), -1.0, 1.0);
    const double gradation = 1.0 + l.a * std::exp(l.b / std::max(direction.z, 1e-9));
    return sky.luminance_scale * gradation *
           (1.0 + l.c * (std::exp(l.d * std::acos(cosine)) - l.k) + l.e * cosine * cosine);
  }
  return 9.0 / (7.0 * pi) * horizontal * (1.0 + 2.0 * direction.z) / 3.0;
}

Vector cosine_direction(const Vector& normal, Random& random) {
  const mesh::Frame frame = mesh::frame_around(normal);
  const double radius_squared = random();
  const double radius = std::sqrt(radius_squared);
  const double angle = 2.0 * pi * random();
  return radius * std::cos(angle) * frame.u + radius * std::sin(angle) * frame.v +
         std::sqrt(1.0 - radius_squared) * normal;
}

/// Where something begins: a place on a surface, and the side on which it begins.
struct Vertex {
  Point at;
  Vector normal;
};

/// A triangle that shines, in a list with running sums of flux.
struct Emitter {
  std::array<Point, 3> corners;
  Vector normal;  // of the shining side
  double emission_lm_m2 = 0.0;
  double flux_up_to_here = 0.0;
};

class PathTracer {
 public:
  PathTracer(const TracedScene& scene, bool sample_emitters) : scene_(scene), lift_m_(scene.rays->offset_m()) {
    if (sample_emitters) list_emitters();
    list_panes();
  }

  /// One sample of the illuminance.
  double sample(Vertex vertex, Random& random) const {
    double sum = 0.0;
    double weight = 1.0;
    for (int bounce = 0;; ++bounce) {
      sum += weight * (from_emitters(vertex, random) + from_points(vertex) + from_sun(vertex));
      const double reflectance = follow(vertex, weight, sum, random);
      if (reflectance <= 0.0) return sum;
      weight *= reflectance;
      if (bounce < kSureBounces) continue;
      const double survival = std::min(0.95, reflectance);
      if (random() >= survival) return sum;
      weight /= survival;
    }
  }

 private:
  void list_emitters();
  void list_panes();
  double from_emitters(const Vertex& vertex, Random& random) const;
  double from_points(const Vertex& vertex) const;
  double from_sun(const Vertex& vertex) const;
  double mirrored(const Point& from, const Vector& image, const Vector& pane_normal) const;
  double follow(Vertex& vertex, double weight, double& sum, Random& random) const;
  double unblocked(const Vertex& from, const Point& to) const;

  /// A place on the face that a ray met, lifted off it towards a direction.
  Point lifted(const Point& at, const mesh::Face& face, const Vector& towards) const {
    const Vector& w = face.frame.w;
    const double lift = (dot(towards, w) > 0.0 ? lift_m_ : -lift_m_) - dot(at - face.origin, w);
    return at + lift * w;
  }
  const TracedSide& side_of(const mesh::Hit& hit) const {
    const TracedFace& material = scene_.materials[hit.face.index()];
    return hit.side == mesh::Side::kFront ? material.front : material.back;
  }

  const TracedScene& scene_;
  double lift_m_;
  std::vector<Emitter> emitters_;
  std::vector<Vector> panes_;  // normals, one for all parallel panes
};

void PathTracer::list_emitters() {
  const mesh::Faces& faces = scene_.faces;
  double flux = 0.0;
  for (std::size_t side = 0; side < 2 * faces.count(); ++side) {
    const mesh::FaceSide id = mesh::face_side(side);
    const bool front = id.side == mesh::Side::kFront;
    const TracedFace& material = scene_.materials[id.face.index()];
    const double emission = (front ? material.front : material.back).emission_lm_m2;
    if (emission <= 0.0) continue;
    const Vector w = faces.faces[id.face.index()].frame.w;
    for (const mesh::Triangle& triangle : faces.shape.of(id.face)) {
      std::array<Point, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) corners[k] = faces.shape.vertices[triangle.vertices[k]];
      flux += emission * 0.5 * norm(cross(corners[1] - corners[0], corners[2] - corners[0]));
      emitters_.push_back({corners, front ? w : -w, emission, flux});
    }
  }
}

/// Illuminance by one point on the emitting faces, chosen by flux.
double PathTracer::from_emitters(const Vertex& vertex, Random& random) const {
  if (emitters_.empty()) return 0.0;
  const double flux = emitters_.back().flux_up_to_here;
  const auto chosen = std::upper_bound(emitters_.begin(), emitters_.end() - 1, random() * flux,
                                       [](double x, const Emitter& e) { return x < e.flux_up_to_here; });
  const double u = std::sqrt(random());
  const double v = random();
  const auto& [a, b, c] = chosen->corners;
  const Point at = a + u * (1.0 - v) * (b - a) + u * v * (c - a);
  const Vector d = at - vertex.at;
  const double r2 = dot(d, d);
  const double cosines = dot(d, vertex.normal) * -dot(d, chosen->normal);
  if (dot(d, vertex.normal) <= 0.0 || cosines <= 0.0) return 0.0;
  // L cos cos'/r² over the density emission/flux, with L = emission/pi
  const double unoccluded = flux / pi * cosines / (r2 * r2);
  return unoccluded * unblocked(vertex, at + lift_m_ * chosen->normal);
}

double PathTracer::from_points(const Vertex& vertex) const {
  double sum = 0.0;
  for (const lighting::Luminaire& luminaire : scene_.luminaires) {
    const Point at = luminaire.at - scene_.faces.origin;
    const Vector d = at - vertex.at;
    const double r = norm(d);
    const double cosine = dot(d, vertex.normal) / r;
    if (cosine <= 0.0) continue;
    sum += luminaire.intensity_cd(-d / r) * cosine / (r * r) * unblocked(vertex, at);
  }
  return sum;
}

void PathTracer::list_panes() {
  for (std::size_t f = 0; f < scene_.faces.count(); ++f) {
    if (scene_.materials[f].opening || scene_.materials[f].transmittance_normal < 0.0) continue;
    const Vector& w = scene_.faces.faces[f].frame.w;
    const bool known =
        std::any_of(panes_.begin(), panes_.end(), [&](const Vector& n) { return std::abs(dot(n, w)) > 1.0 - 1e-9; });
    if (!known) panes_.push_back(w);
  }
}

/// Illuminance by the sun, a point: straight, and mirrored once by a pane. Twice is left out: rooms of one window have none of it.
double PathTracer::from_sun(const Vertex& vertex) const {
  const lighting::Sun& sun = scene_.sky.sun;
  if (!sun.shines()) return 0.0;
  const double far_m = 2.0 * scene_.rays->bounds().diagonal();
  double sum = 0.0;
  const double cosine = dot(vertex.normal, sun.towards);
  if (cosine > 0.0) sum += cosine * unblocked(vertex, vertex.at + far_m * sun.towards);
  for (const Vector& w : panes_) {
    const Vector image = sun.towards - 2.0 * dot(sun.towards, w) * w;
    const double towards_image = dot(vertex.normal, image);
    if (towards_image > 0.0) sum += towards_image * mirrored(vertex.at, image, w);
  }
  return sun.normal_illuminance_lux * sum;
}

/// The share of the sun's light that comes from its image in panes of one plane's direction.
double PathTracer::mirrored(const Point& from, const Vector& image, const Vector& pane_normal) const {
  const Vector towards = image - 2.0 * dot(image, pane_normal) * pane_normal;
  const double far_m = 2.0 * scene_.rays->bounds().diagonal();
  double sum = 0.0;
  double passed = 1.0;
  for (Point at = from;;) {
    const mesh::Hit hit = scene_.rays->first_hit({at, image});
    if (!hit.face.valid()) return sum;
    const TracedFace& material = scene_.materials[hit.face.index()];
    if (!material.opening && material.transmittance_normal < 0.0) return sum;
    const mesh::Face& face = scene_.faces.faces[hit.face.index()];
    const Point there = at + hit.distance * image;
    if (!material.opening) {
      const double slope = std::abs(dot(image, face.frame.w));
      const PaneOptics pane = pane_optics(material.transmittance_normal, slope);
      if (std::abs(dot(face.frame.w, pane_normal)) > 1.0 - 1e-9) {
        const Point turned = lifted(there, face, towards);
        sum += passed * pane.reflectance * unblocked({turned, {}}, turned + far_m * towards);
      }
      passed *= pane.transmittance;
    }
    at = lifted(there, face, image);
  }
}

/// What passes on the straight way: 0 behind an opaque face, the product of transmittances otherwise.
double PathTracer::unblocked(const Vertex& from, const Point& to) const {
  Point at = from.at;
  double passed = 1.0;
  for (;;) {
    const Vector d = to - at;
    const mesh::Hit hit = scene_.rays->first_hit({at, d});
    if (!hit.face.valid() || hit.distance >= 1.0) return passed;
    const TracedFace& material = scene_.materials[hit.face.index()];
    if (!material.opening && material.transmittance_normal < 0.0) return 0.0;
    const mesh::Face& face = scene_.faces.faces[hit.face.index()];
    if (!material.opening)
      passed *= pane_optics(material.transmittance_normal, std::abs(dot(d, face.frame.w)) / norm(d)).transmittance;
    at = lifted(at + hit.distance * d, face, d);
    if (dot(to - at, d) <= 0.0) return passed;
  }
}

/// Goes on in a random direction to the next diffuse surface and adds what the path meets on its way: sky, ground, and emission
/// that from_emitters() has not counted. Moves `vertex` there and returns its reflectance, or 0 where the path ends.
double PathTracer::follow(Vertex& vertex, double weight, double& sum, Random& random) const {
  mesh::Ray ray{vertex.at, cosine_direction(vertex.normal, random)};
  bool straight = true;
  for (;;) {
    const mesh::Hit hit = scene_.rays->first_hit(ray);
    if (!hit.face.valid()) {
      sum += weight * pi * luminance_beyond(scene_.sky, ray.direction);
      return 0.0;
    }
    const TracedFace& material = scene_.materials[hit.face.index()];
    const mesh::Face& face = scene_.faces.faces[hit.face.index()];
    const double slope = dot(ray.direction, face.frame.w);
    const Point at = ray.origin + hit.distance * ray.direction;
    if (!material.opening && material.transmittance_normal < 0.0) {
      if (!straight || emitters_.empty()) sum += weight * side_of(hit).emission_lm_m2;
      vertex = {lifted(at, face, -ray.direction), slope < 0.0 ? face.frame.w : -face.frame.w};
      return side_of(hit).reflectance;
    }
    if (!material.opening) {
      const PaneOptics pane = pane_optics(material.transmittance_normal, std::abs(slope));
      const double choice = random();
      if (choice >= pane.reflectance + pane.transmittance) return 0.0;
      if (choice < pane.reflectance) {
        ray.direction = ray.direction - 2.0 * slope * face.frame.w;
        straight = false;
      }
    }
    ray.origin = lifted(at, face, ray.direction);
  }
}

Traced trace_sensor(const PathTracer& tracer, const Vertex& sensor, std::size_t paths, Random& random) {
  double mean = 0.0;
  double squares = 0.0;  // of deviations from the running mean [Welford 1962]
  for (std::size_t i = 0; i < paths; ++i) {
    const double value = tracer.sample(sensor, random);
    const double deviation = value - mean;
    mean += deviation / static_cast<double>(i + 1);
    squares += deviation * (value - mean);
  }
  const auto n = static_cast<double>(paths);
  return {mean, std::sqrt(squares / (n * (n - 1.0)))};
}

}  // namespace

std::vector<Traced> trace_illuminance(const TracedScene& scene, std::span<const mesh::Point> positions,
                                      std::span<const mesh::Vector> normals, const TraceOptions& options) {
  assert(positions.size() == normals.size() && scene.materials.size() == scene.faces.count() && options.paths > 1);
  const PathTracer tracer(scene, options.sample_emitters);
  std::vector<Traced> results(positions.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < positions.size(); i = next++) {
      Random random(options.seed, i);
      const Vertex sensor{positions[i] - scene.faces.origin, normals[i]};
      results[i] = trace_sensor(tracer, sensor, options.paths, random);
    }
  };
  std::vector<std::thread> threads;
  for (int t = 1; t < options.threads; ++t) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  return results;
}

PaneOptics pane_optics(double transmittance_normal, double cosine) {
  const double n = kRefractiveIndex;
  const double r0 = (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0));
  const double most = (1.0 - r0) / (1.0 + r0);  // transmittance of a pane that absorbs nothing
  double t = 1.0;                               // transmissivity: the share that survives one crossing
  double scale = 1.0;
  if (transmittance_normal >= most) {
    scale = transmittance_normal / most;
  } else {
    // T = (1 − r0)² t / (1 − r0² t²), solved for t
    const double k = (1.0 - r0) * (1.0 - r0);
    const double q = 2.0 * transmittance_normal * r0;
    t = 2.0 * transmittance_normal / (k + std::sqrt(k * k + q * q));
  }
  const double c = std::clamp(cosine, 1e-9, 1.0);
  const double c_inside = std::sqrt(1.0 - (1.0 - c * c) / (n * n));
  const double a = std::pow(t, 1.0 / c_inside);
  const std::array amplitudes{(c - n * c_inside) / (c + n * c_inside), (n * c - c_inside) / (n * c + c_inside)};
  PaneOptics pane;
  for (const double amplitude : amplitudes) {
    const double r = amplitude * amplitude;
    const double between = 1.0 - r * r * a * a;
    pane.transmittance += 0.5 * scale * (1.0 - r) * (1.0 - r) * a / between;
    pane.reflectance += 0.5 * r * (1.0 + (1.0 - 2.0 * r) * a * a) / between;
  }
  pane.reflectance = std::min(pane.reflectance, 1.0 - pane.transmittance);
  return pane;
}

}  // namespace clerestory::test
