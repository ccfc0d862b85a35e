// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "io/radiance_scene.h"
#include "io/source_material.h"

namespace clerestory::io {

/// What a Radiance material says in photometric terms, by Radiance's own formulas:
/// - plastic, metal, trans and their relatives: diffuse rgb·(1 − spec), or rgb·(1 − spec)·(1 − trans) for trans; specular spec, for metal
///   times the colour; a trans transmits rgb·(1 − spec)·trans, of which the share tspec goes straight;
/// - glass: its transmissivity t becomes the transmittance at normal incidence T = (1 − r)² t / (1 − r² t²), r by Fresnel from its index
///   (1.52 where none is given): `glass 0.654` is T = 0.600;
/// - dielectric and interface: a clear pane of their index, absorption left out, since it depends on a thickness;
/// - light, glow (whatever its radius of effect) and illum: luminance 179·(0.265 R + 0.670 G + 0.065 B) [cd/m²] on the front, reflecting
///   nothing; a spotlight shines within a cone, which no luminance says, and only `shines`;
/// - mirror: specular only.
/// Nothing but name and place for other types. Where spread and straight transmission come together, the larger decides.
/// Nothing at all where numbers are missing.
/// Source: Ward, Behavior of Materials in RADIANCE, 2004; Ward Larson and Shakespeare, Rendering with Radiance, 1998.
std::optional<SourceMaterial> tell_radiance_material(const RadiancePrimitive& material);

/// T at normal incidence of one sheet of glass from its transmissivity t, both surfaces and all reflections between them.
double sheet_transmittance(double transmissivity, double refractive_index = 1.52);

}  // namespace clerestory::io
