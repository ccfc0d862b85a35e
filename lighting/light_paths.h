// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/scene.h"
#include "mesh/geometry.h"

namespace clerestory::lighting {

/// Which light a ray backwards from a receiver carries, so that each path counts once (docs/theory/transport.md).
struct PathRule {
  enum class Part {
    kGather,   ///< all but what leaves through a sampled opening, and emission seen straight
    kOpening,  ///< what is seen straight through one sampled opening, if that is the first that the ray leaves by
    kAll,      ///< everything, emission included
  };

  Part part = Part::kAll;
  std::int32_t opening = -1;  ///< for kOpening
  bool mirrors = true;        ///< panes reflect specularly; where the solution stands in for it by diffuse panes: false
};

/// Where a path meets an opaque surface.
struct SurfacePoint {
  mesh::FaceSide side;
  std::uint32_t region = 0;  ///< of the face
  mesh::Point at;
};

/// Weights below this share of the start are dropped.
inline constexpr float kLeastWeight = 1e-4F;
inline constexpr int kMostPanes = 16;

/// Follows a ray backwards through panes to what it sees. The visitor gets
///   surface(const SurfacePoint&, float weight, bool beyond)  and  sky(const Vector& direction, float weight, bool beyond),
/// where `beyond` tells that the path has left the part that it began with, by an opening or a mirror: emission counts there.
/// @param direction  of unit length
template <class Visitor>
void follow(const Scene& scene, mesh::Point origin, const mesh::Vector& direction, float weight, PathRule rule,
            Visitor& visitor, int panes = 0) {
  using Part = PathRule::Part;
  const float least = kLeastWeight;
  for (; panes < kMostPanes && weight > least; ++panes) {
    const mesh::Hit hit = scene.rays->first_hit({origin, direction});
    if (!hit.face.valid()) {
      if (rule.part != Part::kOpening && scene.has_sky()) visitor.sky(direction, weight, rule.part == Part::kAll);
      return;
    }
    const std::size_t f = hit.face.index();
    const mesh::Point at = origin + hit.distance * direction;
    if (scene.passable[f] == 0) {
      if (rule.part != Part::kOpening) {
        const std::uint32_t region = scene.faces.shape.triangles[hit.triangle].region;
        visitor.surface(SurfacePoint{{hit.face, hit.side}, region, at}, weight, rule.part == Part::kAll);
      }
      return;
    }
    const mesh::Vector& front = scene.faces.faces[f].frame.w;
    const mesh::Vector facing = hit.side == mesh::Side::kFront ? front : -front;
    const double cosine = -dot(direction, facing);
    float transmittance = 1.0F;
    if (scene.glazing_of[f] >= 0) {
      const GlazingCurves& g = scene.glazings[static_cast<std::size_t>(scene.glazing_of[f])];
      transmittance = mesh::transmittance_at(g.transmittance, static_cast<float>(cosine));
      const float mirrored = weight * mesh::transmittance_at(g.reflectance, static_cast<float>(cosine));
      if (rule.mirrors && rule.part != Part::kOpening && mirrored > least) {
        const mesh::Vector reflected = normalized(direction + (2.0 * cosine) * facing);
        follow(scene, at + scene.rays->offset_m() * facing, reflected, mirrored, PathRule{Part::kAll, -1, rule.mirrors},
               visitor, panes + 1);
      }
    }
    const std::int32_t opening = scene.opening_of[f];
    const bool leaves = opening >= 0 && dot(direction, scene.openings[static_cast<std::size_t>(opening)].outward) > 0.0;
    if (leaves && rule.part != Part::kAll) {
      if (rule.part == Part::kGather || opening != rule.opening) return;
      rule.part = Part::kAll;
    }
    weight *= transmittance;
    origin = at - scene.rays->offset_m() * facing;
  }
}

}  // namespace clerestory::lighting
