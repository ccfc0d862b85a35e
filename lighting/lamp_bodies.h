// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lighting/emitters.h"
#include "lighting/solution.h"
#include "mesh/shafts.h"

namespace clerestory::lighting {

/// A flat part of a lamp body, as points see it that are far away against its size.
struct BodyFacet {
  std::uint32_t emitter = 0;  ///< its number
  mesh::Point centre;
  mesh::Vector normal;  ///< of the side that shines
  double area_m2 = 0.0;
  double radius_m = 0.0;
};

/// Surfaces that shine, hang together by their edges and are many: the facets of a globe or of a tube.
struct LampBody {
  std::uint32_t number = 0;  ///< among the bodies
  std::vector<BodyFacet> facets;
  /// From outside of its box no facet hides another, and nothing else is in the box.
  bool convex = false;
  std::array<mesh::ShaftEnd, 6> walls;  ///< of its box, looking outwards
};

/// What is proven of the sight from somewhere to a body.
enum class BodySight : std::uint8_t { kPartial, kClear, kHidden };

/// The emitters of a scene as bodies, and those that are none: lamps of thousands of facets are asked for as one.
class LampBodies {
 public:
  LampBodies() = default;
  /// @param emitters  of the solution
  LampBodies(const Solution& solution, std::span<const Emitter> emitters);

  [[nodiscard]] std::span<const LampBody> bodies() const { return bodies_; }
  /// Numbers of the emitters that belong to no body.
  [[nodiscard]] std::span<const std::uint32_t> others() const { return others_; }

  /// Of a body from all points of an end: clear where all its facets that face a point are wholly seen from there.
  [[nodiscard]] BodySight sight(const Solution& solution, const LampBody& body, const mesh::ShaftEnd& from) const;

 private:
  std::vector<LampBody> bodies_;
  std::vector<std::uint32_t> others_;
  std::vector<std::uint32_t> body_of_face_;  ///< [faces] number of a body; kNoBody for others
};

/// Form factor of a point to a facet if nothing stood before it: of the facet's middle where it is far, else exact.
double full_factor(const Solution& solution, std::span<const Emitter> emitters, const BodyFacet& facet,
                   const mesh::Point& at, const Receiver& receiver);

}  // namespace clerestory::lighting
