// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "lighting/study.h"
#include "tests/support/path_tracer.h"
#include "tests/support/shapes.h"

namespace clerestory::test {

/// A vector or point turned about a unit axis through the origin, right-handed [Rodrigues 1840].
mesh::Vector turned(const mesh::Vector& v, const mesh::Vector& axis, double angle_rad);
mesh::Point turned(const mesh::Point& p, const mesh::Vector& axis, double angle_rad);

/// Two rooms of one reflectance (0.7), a lamp under the ceiling of the one and 18 sensors that look up in the other, with a wall between them that
/// ends above the floor; all turned as the wall says.
lighting::Study rooms_with_short_wall(const support::ThinWall& wall);

inline constexpr double kSlit_m = 0.05;
/// The sensors' illuminance where a wall without thickness ends so far above the floor, by 6 000 000 paths each of the plain tracer of these tests:
/// what benchmarks/slit_reference prints.
extern const std::array<Traced, 18> kSlitReference;

}  // namespace clerestory::test
