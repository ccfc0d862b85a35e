// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/openings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "lighting/parallel.h"
#include "lighting/sampling.h"
#include "lighting/seen_factor.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::FaceId;
using mesh::Point;
using mesh::Side;
using mesh::Vector;

namespace {

constexpr std::uint32_t kProbes = 256;
/// Two sides differ when their shares of the outside do by this: three times the noise of the probes.
constexpr double kDifference = 0.02;

std::vector<std::array<Point, 3>> triangles_of(const mesh::Faces& faces, FaceId face, bool turned) {
  std::vector<std::array<Point, 3>> triangles;
  for (const mesh::Triangle& t : faces.shape.of(face)) {
    const auto& v = faces.shape.vertices;
    triangles.push_back({v[t.vertices[0]], v[t.vertices[turned ? 2 : 1]], v[t.vertices[turned ? 1 : 2]]});
  }
  return triangles;
}

/// Whether a ray gets out of the model, through any number of passable faces.
bool escapes(const Scene& scene, Point origin, const Vector& direction) {
  constexpr int kMostPanes = 32;
  for (int i = 0; i < kMostPanes; ++i) {
    const mesh::Hit hit = scene.rays->first_hit({origin, direction});
    if (!hit.face.valid()) return direction.z > 0.0;
    if (scene.passable[hit.face.index()] == 0) return false;
    const Vector& normal = scene.faces.faces[hit.face.index()].frame.w;
    const double away = dot(direction, normal) > 0.0 ? 1.0 : -1.0;
    origin = origin + hit.distance * direction + (away * scene.rays->offset_m()) * normal;
  }
  return false;
}

/// Share of the cosine-weighted hemisphere of a side that is sky.
double sky_share(const Scene& scene, FaceId face, Side side, const std::vector<std::array<Point, 3>>& triangles) {
  const mesh::Frame& front = scene.faces.faces[face.index()].frame;
  const Vector normal = side == Side::kFront ? front.w : -front.w;
  const mesh::Frame frame = mesh::frame_around(normal);
  const SobolPoints points(mesh::hash(face.value, 91));
  std::uint32_t seen = 0;
  for (std::uint32_t i = 0; i < kProbes; ++i) {
    const auto& t = triangles[i % triangles.size()];
    const double a = std::sqrt(points.at(i, 0));
    const double b = points.at(i, 1);
    const Point p = t[0] + (a * (1.0 - b) * (t[1] - t[0]) + a * b * (t[2] - t[0]));
    const Vector d = cosine_direction(frame, points.at(i, 2), points.at(i, 3));
    if (escapes(scene, p + scene.rays->offset_m() * normal, d)) ++seen;
  }
  return static_cast<double>(seen) / kProbes;
}

/// Of the sky, or the ground below, where a point sees the middle of an opening [lm/m²].
double sky_radiosity(const Scene& scene, const mesh::ShaftEnd& opening, const Point& at) {
  const Point middle = opening.corners[0] + 0.5 * (opening.corners[2] - opening.corners[0]);
  return std::numbers::pi * sky_luminance(scene.sky, normalized(middle - at));
}

}  // namespace

mesh::ShaftEnd shaft_end(const Opening& opening) {
  // The bounding rectangle in the opening's plane.
  const mesh::Frame frame = mesh::frame_around(-opening.outward);
  const Point& origin = opening.triangles[0][0];
  std::array<double, 4> box{0.0, 0.0, 0.0, 0.0};
  for (const auto& t : opening.triangles) {
    for (const Point& p : t) {
      const double u = dot(p - origin, frame.u);
      const double v = dot(p - origin, frame.v);
      box = {std::min(box[0], u), std::min(box[1], v), std::max(box[2], u), std::max(box[3], v)};
    }
  }
  const auto corner = [&](double u, double v) { return origin + (u * frame.u + v * frame.v); };
  return {.corners = {corner(box[0], box[1]), corner(box[2], box[1]), corner(box[2], box[3]), corner(box[0], box[3])},
          .count = 4,
          .normal = frame.w,
          .face = opening.face};
}

void find_openings(Scene& scene) {
  const std::size_t count = scene.faces.count();
  std::vector<double> difference(count, 0.0);  // front less back
  parallel_for(count, [&](std::size_t f) {
    if (scene.passable[f] == 0) return;
    const auto triangles = triangles_of(scene.faces, FaceId(f), false);
    difference[f] =
        sky_share(scene, FaceId(f), Side::kFront, triangles) - sky_share(scene, FaceId(f), Side::kBack, triangles);
  });

  // Curve 0 is the open air, the glazings follow.
  std::vector<mesh::TransmittanceCurve> curves(1);
  curves[0].fill(1.0F);
  for (const GlazingCurves& g : scene.glazings) curves.push_back(g.transmittance);
  std::vector<mesh::Passage> passages(count);
  scene.opening_of.assign(count, -1);
  for (std::size_t f = 0; f < count; ++f) {
    if (scene.passable[f] == 0) continue;
    passages[f].curve = scene.glazing_of[f] + 1;
    if (!scene.has_sky() || std::abs(difference[f]) < kDifference) continue;
    const Side outside = difference[f] > 0.0 ? Side::kFront : Side::kBack;
    passages[f].opening = true;
    passages[f].outside = outside;
    Opening opening;
    opening.face = FaceId(f);
    opening.inside = mesh::other(outside);
    const Vector& normal = scene.faces.faces[f].frame.w;
    opening.outward = outside == Side::kFront ? normal : -normal;
    opening.triangles = triangles_of(scene.faces, FaceId(f), outside == Side::kFront);
    opening.area_m2 = scene.faces.faces[f].area_m2;
    scene.opening_of[f] = static_cast<std::int32_t>(scene.openings.size());
    scene.openings.push_back(std::move(opening));
  }
  scene.rays->set_passages(std::move(passages), std::move(curves));
}

double full_through(const Scene& scene, const mesh::ShaftEnd& opening, const Point& at, const Receiver& receiver) {
  std::array<mesh::OutlineEdge, 4> outline;
  for (std::size_t i = 0; i < opening.count; ++i)
    outline[i] = {opening.corners[i], opening.corners[(i + 1) % opening.count]};
  return receiver.form_factor(at, std::span(outline).first(opening.count), opening.normal) *
         sky_radiosity(scene, opening, at);
}

double most_through(const Scene& scene, const mesh::ShaftEnd& opening, const Point& at, const Receiver& receiver) {
  const SeenFactor seen = seen_factor(*scene.shafts, at, receiver, opening);
  return seen.factor > 0.0 ? seen.factor * sky_radiosity(scene, opening, at) : 0.0;
}

}  // namespace clerestory::lighting
