// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cmath>
#include <new>
#include <utility>

#include "mesh/error.h"
#include "mesh/hash.h"

namespace clerestory::mesh {

namespace {

/// Rays are counted in this many places, so that threads do not wait for each other.
constexpr std::size_t kCounters = 64;

/// One call in so many is timed: the clock costs as much as a tenth of a ray.
constexpr std::uint64_t kTimedCalls = 64;
/// A call that took longer than this for a ray [ns] was not tracing: its thread had to wait for others.
constexpr std::int64_t kWaited = 10'000;

struct alignas(64) Counter {
  std::atomic<std::uint64_t> rays{0};
  std::atomic<std::int64_t> timed_ns{0};
};

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// What two looks at the clock cost without anything in between [ns].
std::int64_t cost_of_clock_ns() {
  constexpr int kLooks = 64;
  const std::int64_t begin = now_ns();
  for (int i = 1; i < kLooks; ++i) now_ns();
  return (now_ns() - begin) / kLooks;
}

/// By chance: every so many rays of a low-discrepancy sequence look the same way.
bool is_timed_call() {
  thread_local std::uint64_t calls = 0;
  return mix(++calls) % kTimedCalls == 0;
}

std::size_t this_thread_counter() {
  static std::atomic<std::size_t> next{0};
  thread_local std::size_t mine = next++ % kCounters;
  return mine;
}

/// Two hits of one face closer than this share of the distance are one: a ray met the edge between two triangles.
constexpr float kSameHit = 1e-5F;

float largest_coordinate(const Box& box) {
  if (box.empty()) return 0.0F;
  const double x = std::max({std::abs(box.low.x), std::abs(box.low.y), std::abs(box.low.z), std::abs(box.high.x),
                             std::abs(box.high.y), std::abs(box.high.z)});
  return static_cast<float>(x);
}

double lift(const Box& box) {
  constexpr double kLeast = 1e-5;  // metres: below any gap that a model leaves on purpose
  const float extent = largest_coordinate(box);
  const double ulp = std::nextafter(extent, std::numeric_limits<float>::infinity()) - extent;
  return std::max(kLeast, 4.0 * ulp);
}

}  // namespace

struct Rays::Data {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  Box bounds;
  double offset = 1e-5;
  std::int64_t clock_ns = cost_of_clock_ns();
  std::vector<Face> planes;  // frames and origins of the faces, loops left out
  /// Embree geometry 0 holds the opaque triangles, geometry 1 the passable ones: primitive → face.
  std::array<std::vector<FaceId>, 2> face_of;
  std::array<std::vector<std::uint32_t>, 2> triangle_of;  // and primitive → triangle of Faces::shape
  std::vector<Passage> passages;
  std::vector<TransmittanceCurve> curves;
  mutable std::array<Counter, kCounters> counters;

  ~Data() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  /// Casts so many rays by a call, counts them, and times it now and then.
  template <class Cast>
  void cast(std::size_t rays, const Cast& call) const {
    Counter& counter = counters[this_thread_counter()];
    counter.rays.fetch_add(rays, std::memory_order_relaxed);
    if (rays == 0 || !is_timed_call()) {
      call();
      return;
    }
    const std::int64_t begin = now_ns();
    call();
    const std::int64_t took = std::max<std::int64_t>(0, now_ns() - begin - clock_ns);
    if (took < kWaited * static_cast<std::int64_t>(rays)) counter.timed_ns.fetch_add(took, std::memory_order_relaxed);
  }
  void build(const Faces& faces, std::span<const std::uint8_t> passable);
  void attach(const Faces& faces, std::span<const std::uint8_t> passable, unsigned geometry_id);
};

namespace {

/// What the filter of passable triangles works on while one shadow ray is traced.
struct ShadowContext {
  RTCIntersectContext context;
  const std::vector<FaceId>* face_of;
  const std::vector<Passage>* passages;
  const std::vector<TransmittanceCurve>* curves;
  const std::vector<Face>* planes;
  float passed;
  FaceId last_face;
  float last_t;
};

/// Lets a shadow ray pass glazing and openings, with their transmittance; stops it where it leaves through a sampled opening.
void filter_passable(const RTCFilterFunctionNArguments* args) {
  assert(args->N == 1);
  if (args->valid[0] != -1) return;
  auto& shadow = *reinterpret_cast<ShadowContext*>(args->context);
  const auto* ray = reinterpret_cast<const RTCRay*>(args->ray);
  const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);

  const FaceId face = (*shadow.face_of)[hit->primID];
  if (face == shadow.last_face && std::abs(ray->tfar - shadow.last_t) <= kSameHit * (1.0F + shadow.last_t)) {
    args->valid[0] = 0;
    return;
  }
  shadow.last_face = face;
  shadow.last_t = ray->tfar;

  const Passage& passage = (*shadow.passages)[face.index()];
  const Vector direction{ray->dir_x, ray->dir_y, ray->dir_z};
  const double slope = dot(direction, (*shadow.planes)[face.index()].frame.w);
  const bool towards_front = slope > 0.0;
  if (passage.opening && towards_front == (passage.outside == Side::kFront)) return;
  const double cosine = std::abs(slope) / norm(direction);
  shadow.passed *=
      transmittance_at((*shadow.curves)[static_cast<std::size_t>(passage.curve)], static_cast<float>(cosine));
  if (shadow.passed > 0.0F) args->valid[0] = 0;
}

}  // namespace

void Rays::Data::attach(const Faces& faces, std::span<const std::uint8_t> passable, unsigned geometry_id) {
  auto& mine = face_of[geometry_id];
  std::vector<const Triangle*> triangles;
  for (std::size_t f = 0; f < faces.count(); ++f) {
    const bool passes = !passable.empty() && passable[f] != 0;
    if (passes != (geometry_id == 1)) continue;
    for (const Triangle& t : faces.shape.of(FaceId(f))) {
      triangles.push_back(&t);
      mine.push_back(FaceId(f));
      triangle_of[geometry_id].push_back(static_cast<std::uint32_t>(&t - faces.shape.triangles.data()));
    }
  }
  if (triangles.empty()) return;

  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
  const auto& points = faces.shape.vertices;
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), points.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), triangles.size()));
  if (vertices == nullptr || indices == nullptr) throw std::bad_alloc();
  for (std::size_t i = 0; i < points.size(); ++i) {
    vertices[3 * i] = static_cast<float>(points[i].x);
    vertices[3 * i + 1] = static_cast<float>(points[i].y);
    vertices[3 * i + 2] = static_cast<float>(points[i].z);
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) indices[3 * i + k] = triangles[i]->vertices[k];
  }
  if (geometry_id == 1) rtcSetGeometryOccludedFilterFunction(geometry, filter_passable);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, geometry_id);
  rtcReleaseGeometry(geometry);
}

void Rays::Data::build(const Faces& faces, std::span<const std::uint8_t> passable) {
  device = rtcNewDevice(nullptr);
  if (rtcGetDeviceError(device) == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (device == nullptr) throw MachineError("the ray tracing library does not start on this processor");
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  attach(faces, passable, 0);
  attach(faces, passable, 1);
  rtcCommitScene(scene);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
    throw std::bad_alloc();  // nothing else can go wrong with sound triangles
  for (const Face& face : faces.faces) {
    planes.push_back({.origin = face.origin,
                      .frame = face.frame,
                      .area_m2 = face.area_m2,
                      .material = face.material,
                      .back_material = face.back_material,
                      .part = face.part,
                      .loops = {},
                      .facets = {}});
  }
  for (const Point& p : faces.shape.vertices) bounds.add(p);
  offset = lift(bounds);
}

Rays::Rays(const Faces& faces, std::span<const std::uint8_t> passable) : data_(std::make_unique<Data>()) {
  assert(passable.empty() || passable.size() == faces.count());
  data_->build(faces, passable);
  data_->passages.resize(faces.count());
  data_->curves.resize(1);
  data_->curves[0].fill(1.0F);
  for (std::size_t f = 0; f < passable.size(); ++f) {
    if (passable[f] != 0) data_->passages[f].curve = 0;
  }
}

Rays::~Rays() = default;
Rays::Rays(Rays&&) noexcept = default;
Rays& Rays::operator=(Rays&&) noexcept = default;

void Rays::set_passages(std::vector<Passage> passages, std::vector<TransmittanceCurve> curves) {
  assert(passages.size() == data_->passages.size());
  for (std::size_t f = 0; f < passages.size(); ++f) {
    assert((passages[f].curve == Passage::kOpaque) == (data_->passages[f].curve == Passage::kOpaque));
    assert(passages[f].curve < static_cast<std::int32_t>(curves.size()));
  }
  data_->passages = std::move(passages);
  data_->curves = std::move(curves);
}

const Passage& Rays::passage(FaceId face) const { return data_->passages[face.index()]; }

const TransmittanceCurve& Rays::curve(std::int32_t index) const {
  return data_->curves[static_cast<std::size_t>(index)];
}

Hit Rays::first_hit(const Ray& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(ray.origin.x);
  query.ray.org_y = static_cast<float>(ray.origin.y);
  query.ray.org_z = static_cast<float>(ray.origin.z);
  query.ray.dir_x = static_cast<float>(ray.direction.x);
  query.ray.dir_y = static_cast<float>(ray.direction.y);
  query.ray.dir_z = static_cast<float>(ray.direction.z);
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = 0xFFFFFFFFU;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  data_->cast(1, [&] { rtcIntersect1(data_->scene, &context, &query); });
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};

  const FaceId face = data_->face_of[query.hit.geomID][query.hit.primID];
  const Face& plane = data_->planes[face.index()];
  const double slope = dot(ray.direction, plane.frame.w);
  const double exact = dot(plane.origin - ray.origin, plane.frame.w) / slope;
  // Where the ray lies almost in the plane, the division says nothing: the single-precision distance does.
  const double coarse = query.ray.tfar;
  const bool sound = std::abs(exact - coarse) <= 1e-3 * coarse + data_->offset / norm(ray.direction);
  return {.face = face,
          .side = slope < 0.0 ? Side::kFront : Side::kBack,
          .distance = sound ? exact : coarse,
          .triangle = data_->triangle_of[query.hit.geomID][query.hit.primID]};
}

void Rays::transmittance(std::span<const Segment> segments, std::span<float> passed) const {
  assert(segments.size() == passed.size());
  ShadowContext shadow{};
  rtcInitIntersectContext(&shadow.context);
  shadow.face_of = &data_->face_of[1];
  shadow.passages = &data_->passages;
  shadow.curves = &data_->curves;
  shadow.planes = &data_->planes;
  data_->cast(segments.size(), [&] {
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const Vector d = segments[i].to - segments[i].from;
      RTCRay ray{};
      ray.org_x = static_cast<float>(segments[i].from.x);
      ray.org_y = static_cast<float>(segments[i].from.y);
      ray.org_z = static_cast<float>(segments[i].from.z);
      ray.dir_x = static_cast<float>(d.x);
      ray.dir_y = static_cast<float>(d.y);
      ray.dir_z = static_cast<float>(d.z);
      ray.tfar = 1.0F;
      ray.mask = 0xFFFFFFFFU;
      shadow.passed = 1.0F;
      shadow.last_face = FaceId();
      rtcOccluded1(data_->scene, &shadow.context, &ray);
      passed[i] = ray.tfar < 0.0F ? 0.0F : shadow.passed;
    }
  });
}

double Rays::offset_m() const { return data_->offset; }

const Box& Rays::bounds() const { return data_->bounds; }

Rays::Use Rays::use() const {
  Use use;
  for (const Counter& c : data_->counters) {
    use.rays += c.rays.load(std::memory_order_relaxed);
    use.seconds +=
        1e-9 * static_cast<double>(kTimedCalls) * static_cast<double>(c.timed_ns.load(std::memory_order_relaxed));
  }
  return use;
}

}  // namespace clerestory::mesh
