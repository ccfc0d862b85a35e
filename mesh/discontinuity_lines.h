// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mesh/discontinuity_sources.h"
#include "mesh/faces.h"
#include "mesh/geometry.h"
#include "mesh/ids.h"
#include "mesh/rays.h"

namespace clerestory::mesh {

/// A line on a face across which the light of a source is not smooth.
struct DiscontinuityLine {
  FaceId face;
  Side side = Side::kFront;   ///< on which the light falls
  std::array<Point, 2> ends;  ///< [m, local]
  /// Of the derivative of the illuminance that jumps: 0 a shadow's edge, 1 of a source's edge parallel to the occluder's, 2 of others.
  std::uint8_t order = 2;
  bool no_sky = false;       ///< where a window's head just hides what sky shows above a roof line opposite
  std::uint32_t source = 0;  ///< as the caller numbers it
  FaceId occluder{};         ///< the largest face at the edge, or one at the corner, that casts the shadow
  /// Along the middle of the lines of light that end here: from the source to where they touch the occluder, infinite for the sun and for
  /// the sky beyond what stands outdoors; and from there to the face [m].
  double source_distance_m = 0.0;
  double receiver_distance_m = 0.0;
  /// How fast the source comes out there, where the order is 1 or 2: the jump across the line of the derivative of that order of the projected
  /// solid angle that is seen of it [sr/m^order]. Times the luminance it is the jump of the illuminance's derivative.
  double uncovering = 0.0;
};

/// A plane part of the space between a window's head and what is behind it, above which there is no sky: corners in turn [m].
using NoSkySurface = std::array<Point, 4>;

/// What one source makes.
struct FoundLines {
  std::vector<DiscontinuityLine> lines;
  std::vector<NoSkySurface> no_sky;
  std::size_t critical_surfaces = 0;  ///< traced
  bool stopped = false;               ///< the limit of critical surfaces was reached: what came after it is not there
};

struct DiscontinuityOptions {
  std::span<const std::uint8_t> passable;  ///< [faces] non-zero for faces that light passes; empty: all are opaque
  std::span<const std::uint8_t> receives;  ///< [2 a face] non-zero for sides whose lines are wanted; empty: all
  /// Where given, edges past which none of some sample rays from the source gets are left out: in a building most lie behind walls.
  const Rays* rays = nullptr;
};

/// Finds the lines of discontinuity of sources on the faces of a model: the visible traces of the vertex-edge and edge-vertex
/// critical surfaces, and of shadow edges. Those of three edges (EEE, curved) are left out.
/// Sources: Heckbert1992; LischinskiTampieriGreenberg1992; DrettakisFiume1994.
class DiscontinuityFinder {
 public:
  /// The faces and what the spans of the options show are kept by reference.
  explicit DiscontinuityFinder(const Faces& faces, const DiscontinuityOptions& options = {});
  ~DiscontinuityFinder();
  DiscontinuityFinder(DiscontinuityFinder&&) noexcept;
  DiscontinuityFinder& operator=(DiscontinuityFinder&&) noexcept;

  /// The lines of one source, in a fixed order. Several critical surfaces lie in one plane where edges are parallel, and then their
  /// lines overlap. Thread-safe.
  /// @param most_critical_surfaces  that are traced
  [[nodiscard]] FoundLines find(const ShadowSource& source, std::uint32_t number,
                                std::size_t most_critical_surfaces = 200000) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// Where a plane cuts a no-sky surface.
std::optional<std::array<Point, 2>> cut_by_plane(const NoSkySurface& surface, const Point& origin,
                                                 const Vector& normal);

}  // namespace clerestory::mesh
