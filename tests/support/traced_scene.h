// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "lighting/study.h"
#include "tests/support/path_tracer.h"
#include "tests/support/validation_scenes.h"

namespace clerestory::test {

/// The scene of a study as the path tracer takes it. Every material must say its reflectance; the flux of an emission is spread
/// over all faces of the material, so each lamp must have a material of its own.
/// Throws InputError as clean() does, and std::invalid_argument for a material without a grey reflectance.
TracedScene traced_scene(const lighting::Study& study);

/// The illuminance at the points of the study's first grid by the path tracer.
/// @param paths  a sensor
Reference traced_reference(const lighting::Study& study, std::size_t paths);

}  // namespace clerestory::test
