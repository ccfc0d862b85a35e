// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/study.h"
#include "tests/support/path_tracer.h"

namespace clerestory::test {

/// The scene of a study as the path tracer takes it. Every material must say its reflectance; the flux of an emission is spread
/// over all faces of the material, so each lamp must have a material of its own.
/// Throws InputError as clean() does, and std::invalid_argument for a material without a grey reflectance.
TracedScene traced_scene(const lighting::Study& study);

}  // namespace clerestory::test
