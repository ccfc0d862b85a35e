// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/luminaire.h"
#include "mesh/geometry.h"

namespace clerestory::test {

/// A point that shines alike in all directions.
lighting::Luminaire isotropic_lamp(const mesh::Point& at, double intensity_cd);

/// A point whose intensity is that on its axis times the cosine of the angle from it, to 4e-7 of it.
lighting::Luminaire lambertian_lamp(const mesh::Point& at, const mesh::Vector& aim, double intensity_cd);

}  // namespace clerestory::test
