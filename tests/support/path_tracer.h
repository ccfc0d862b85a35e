// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lighting/sky.h"
#include "lighting/study.h"
#include "mesh/faces.h"
#include "mesh/rays.h"

namespace clerestory::test {

/// What one side of a face does to light in the path tracer.
struct TracedSide {
  double reflectance = 0.0;     ///< diffuse [0 … 1)
  double emission_lm_m2 = 0.0;  ///< radiosity that the side sends out by itself, Lambert's law
};

/// What a face does to light: two diffuse sides, or a pane of clear glass, or nothing at all.
struct TracedFace {
  TracedSide front;
  TracedSide back;
  double transmittance_normal = -1.0;  ///< of a pane of clear glass (n = 1.52); negative where the face is none
  bool opening = false;                ///< an air polygon, which does nothing to light
};

/// A scene as the path tracer takes it; one `material` a face.
struct TracedScene {
  mesh::Faces faces;
  std::unique_ptr<mesh::Rays> rays;
  std::vector<TracedFace> materials;
  lighting::Sky sky;
  std::vector<lighting::Luminaire> luminaires;
};

struct TraceOptions {
  std::size_t paths = 1024;  ///< a sensor
  std::uint64_t seed = 1;
  int threads = 2;  ///< no influence on the values
  /// Emitting faces are sampled at every bounce: right for lamps; without, they count where a path meets them: right for
  /// large emitters that touch what they light.
  bool sample_emitters = true;
};

/// An estimate with its standard error.
struct Traced {
  double illuminance_lux = 0.0;
  double standard_error_lux = 0.0;
};

/// Illuminance at sensors by plain path tracing, unbiased: no clamping, no cut-off, Russian roulette. The sun, as a point, is sampled at every
/// bounce, straight and mirrored once by a pane. Each sensor has random
/// numbers of its own.
/// @param positions  [m, model coordinates]
/// @param normals    unit vectors
std::vector<Traced> trace_illuminance(const TracedScene& scene, std::span<const mesh::Point> positions,
                                      std::span<const mesh::Vector> normals, const TraceOptions& options);

/// Reflectance and transmittance of a pane at an angle of incidence.
struct PaneOptics {
  double reflectance = 0.0;
  double transmittance = 0.0;
};

/// A pane of n = 1.52 with inner reflections, mean of both polarisations, from the Fresnel equations.
/// Above the transmittance of a pane that absorbs nothing (0.918), the whole curve of that pane is scaled.
PaneOptics pane_optics(double transmittance_normal, double cosine);

}  // namespace clerestory::test
