// SPDX-License-Identifier: GPL-3.0-or-later
// Rays a CPU second against 51,600 triangles. `occluded` is the machine's own figure, by which limits on CPU time scale; the others
// are what the program gets out of it.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <array>
#include <random>
#include <vector>

#include "mesh/faces.h"
#include "mesh/rays.h"

namespace {

using clerestory::mesh::Face;
using clerestory::mesh::Faces;
using clerestory::mesh::Point;
using clerestory::mesh::Segment;
using clerestory::mesh::Triangle;
using clerestory::mesh::Vector;

constexpr int kBoxes = 4300;
constexpr Vector kHall{24.0, 24.0, 10.0};  // metres

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Point somewhere(Random& random) {
  return {uniform(random, 0.0, kHall.x), uniform(random, 0.0, kHall.y), uniform(random, 0.0, kHall.z)};
}

void add_quad(Faces& faces, const std::array<Point, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(faces.shape.vertices.size());
  faces.shape.vertices.insert(faces.shape.vertices.end(), corners.begin(), corners.end());
  faces.shape.triangles.push_back({.vertices = {first, first + 1, first + 2}});
  faces.shape.triangles.push_back({.vertices = {first, first + 2, first + 3}});
  faces.shape.starts.push_back(static_cast<std::uint32_t>(faces.shape.triangles.size()));
  const Vector normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
  Face& face = faces.faces.emplace_back();
  face.origin = corners[0];
  face.frame = clerestory::mesh::frame_around(normal);
}

/// Boxes of furniture's size, anywhere in a hall.
Faces clutter() {
  Faces faces;
  Random random(1);
  for (int b = 0; b < kBoxes; ++b) {
    const Point p = somewhere(random);
    const Vector s{uniform(random, 0.05, 0.8), uniform(random, 0.05, 0.8), uniform(random, 0.05, 0.8)};
    const auto corner = [&](int x, int y, int z) { return p + Vector{x * s.x, y * s.y, z * s.z}; };
    add_quad(faces, {corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0)});
    add_quad(faces, {corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)});
    add_quad(faces, {corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)});
    add_quad(faces, {corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0)});
    add_quad(faces, {corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0)});
    add_quad(faces, {corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1)});
  }
  return faces;
}

/// Segments without any order among them.
std::vector<Segment> incoherent_segments(std::size_t count) {
  Random random(2);
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < count; ++i) segments.push_back({somewhere(random), somewhere(random)});
  return segments;
}

RTCScene embree_scene(RTCDevice device, const Faces& faces) {
  RTCScene scene = rtcNewScene(device);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), faces.shape.vertices.size()));
  for (const Point& p : faces.shape.vertices)
    for (const double x : {p.x, p.y, p.z}) *vertices++ = static_cast<float>(x);
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), faces.shape.triangles.size()));
  for (const Triangle& triangle : faces.shape.triangles)
    for (const std::uint32_t v : triangle.vertices) *indices++ = v;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

RTCRay embree_ray(const Segment& segment) {
  const Vector d = segment.to - segment.from;
  RTCRay ray{};
  ray.org_x = static_cast<float>(segment.from.x);
  ray.org_y = static_cast<float>(segment.from.y);
  ray.org_z = static_cast<float>(segment.from.z);
  ray.dir_x = static_cast<float>(d.x);
  ray.dir_y = static_cast<float>(d.y);
  ray.dir_z = static_cast<float>(d.z);
  ray.tfar = 1.0F;
  ray.mask = 0xFFFFFFFFU;
  return ray;
}

constexpr std::size_t kRays = 100'000;

void count_rays(benchmark::State& state) {
  state.SetItemsProcessed(static_cast<std::int64_t>(kRays) * state.iterations());
}

void occluded(benchmark::State& state) {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = embree_scene(device, clutter());
  std::vector<RTCRay> rays;
  for (const Segment& segment : incoherent_segments(kRays)) rays.push_back(embree_ray(segment));
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (auto _ : state) {
    for (const RTCRay& ray : rays) {
      RTCRay shot = ray;
      rtcOccluded1(scene, &context, &shot);
      benchmark::DoNotOptimize(shot.tfar);
    }
  }
  count_rays(state);
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}
BENCHMARK(occluded)->Unit(benchmark::kMillisecond);

void transmittance(benchmark::State& state) {
  const Faces faces = clutter();
  const clerestory::mesh::Rays rays(faces);
  const auto segments = incoherent_segments(kRays);
  std::vector<float> passed(kRays);
  for (auto _ : state) {
    rays.transmittance(segments, passed);
    benchmark::DoNotOptimize(passed.data());
  }
  count_rays(state);
}
BENCHMARK(transmittance)->Unit(benchmark::kMillisecond);

void first_hit(benchmark::State& state) {
  const Faces faces = clutter();
  const clerestory::mesh::Rays rays(faces);
  const auto segments = incoherent_segments(kRays);
  for (auto _ : state)
    for (const Segment& s : segments) benchmark::DoNotOptimize(rays.first_hit({s.from, s.to - s.from}));
  count_rays(state);
}
BENCHMARK(first_hit)->Unit(benchmark::kMillisecond);

}  // namespace
