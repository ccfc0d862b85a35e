// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/ids.h"

namespace clerestory::mesh {

enum class SubdivisionScheme : std::uint8_t { kCatmullClark, kLoop };

/// The rules of a subdivision that hold for a whole part. Source: OpenSubdiv 3.5, Sdc::Options.
struct SubdivisionRules {
  enum class Boundary : std::uint8_t {
    kNone,          ///< faces at the boundary have no limit
    kEdgeOnly,      ///< boundary edges are sharp
    kEdgeAndCorner  ///< … and so are corners of one face
  };
  Boundary boundary = Boundary::kEdgeAndCorner;
  bool chaikin_creases = false;   ///< fractional sharpness is averaged along a crease [DeRose, Kass, Truong 1998]
  bool smooth_triangles = false;  ///< other weights for the triangles of a Catmull-Clark cage

  bool operator==(const SubdivisionRules&) const = default;
};

/// What a file says of the polygons that are cages of limit surfaces.
struct SubdivisionTags {
  /// Sharpness: 0 smooth, the number of steps for which the rule of a sharp edge holds, 10 and more for ever.
  struct Crease {
    std::array<std::uint32_t, 2> edge{};  ///< vertices of the model
    float sharpness = 0.0F;
  };
  struct Corner {
    std::uint32_t vertex = 0;
    float sharpness = 0.0F;
  };
  struct PartRules {
    PartId part;
    SubdivisionRules rules;
  };
  std::vector<Crease> creases;
  std::vector<Corner> corners;
  std::vector<std::uint32_t> holes;  ///< polygons that shape the surface and are no part of it
  std::vector<PartRules> rules;      ///< of parts that differ from the default, or are marked by having rules

  [[nodiscard]] bool empty() const { return creases.empty() && corners.empty() && holes.empty() && rules.empty(); }
};

}  // namespace clerestory::mesh
