// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mesh/faces.h"
#include "mesh/geometry.h"
#include "mesh/ids.h"

namespace clerestory::mesh {

/// Transmittance of a sheet by the cosine of the angle of incidence: entry i belongs to cos = i/(size-1) [0 … 1].
using TransmittanceCurve = std::array<float, 129>;

/// Linear interpolation in a curve.
inline float transmittance_at(const TransmittanceCurve& curve, float cosine) {
  const float x = cosine * static_cast<float>(curve.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), curve.size() - 2);
  const float t = x - static_cast<float>(i);
  return curve[i] + t * (curve[i + 1] - curve[i]);
}

/// What a face does to a ray that meets it.
struct Passage {
  static constexpr std::int32_t kOpaque = -1;

  std::int32_t curve = kOpaque;  ///< index of a transmittance curve, or kOpaque
  /// A sampled opening: segments that pass it towards `outside` are not carried by segments() but by the opening's own samples.
  bool opening = false;
  Side outside =
      Side::kFront;  ///< the side that faces outwards: a ray leaves when it goes on into that side's half space
};

struct Ray {
  Point origin;
  Vector direction;  ///< need not be of unit length
};

struct Hit {
  FaceId face;  ///< invalid when nothing is hit
  Side side = Side::kFront;
  double distance = 0.0;       ///< in units of the direction's length
  std::uint32_t triangle = 0;  ///< index into Faces::shape.triangles
};

/// From a point to a point; callers lift ends that lie on a surface off it by Rays::offset_m() along its normal.
struct Segment {
  Point from;
  Point to;
};

/// Rays against the triangulated faces (Embree, robust mode). Built once; faces are two-sided.
/// Thread-safe but for set_passages().
class Rays {
 public:
  /// @param passable  [faces] non-zero where light may pass a face (glazing, openings); empty: all faces are opaque
  explicit Rays(const Faces& faces, std::span<const std::uint8_t> passable = {});
  ~Rays();
  Rays(Rays&&) noexcept;
  Rays& operator=(Rays&&) noexcept;

  /// Declares how the passable faces let light pass; one entry a face, opaque for all that are not passable.
  void set_passages(std::vector<Passage> passages, std::vector<TransmittanceCurve> curves);
  [[nodiscard]] const Passage& passage(FaceId face) const;
  [[nodiscard]] const TransmittanceCurve& curve(std::int32_t index) const;

  /// The first face along a ray, glazing and openings included. The distance is that to the face's plane in double precision.
  [[nodiscard]] Hit first_hit(const Ray& ray) const;

  /// The share of light that passes along each segment: 0 when an opaque face stands between, the product of transmittances
  /// otherwise, and 0 as well where the segment leaves through a sampled opening.
  /// @param passed  [segments] out
  void transmittance(std::span<const Segment> segments, std::span<float> passed) const;

  /// How far a point on a surface is lifted off it before a ray starts there [m]: a few units in the last place of a float at
  /// the model's extent, at least 0.01 mm.
  [[nodiscard]] double offset_m() const;

  /// Box of all faces.
  [[nodiscard]] const Box& bounds() const;

  /// What rays have cost so far, all threads together.
  struct Use {
    std::uint64_t rays = 0;
    double seconds = 0.0;  ///< about, in Embree with the setting up of its rays: some calls are timed, for all of them
  };
  [[nodiscard]] Use use() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace clerestory::mesh
