// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lighting/channels.h"
#include "lighting/glazing.h"
#include "lighting/results.h"
#include "lighting/study.h"
#include "mesh/faces.h"
#include "mesh/progress.h"
#include "mesh/rays.h"
#include "mesh/rooms.h"
#include "mesh/shafts.h"
#include "mesh/slits.h"

namespace clerestory::lighting {

/// A glazed or open face through which a darker space looks at a brighter one. Its light is sampled at the receiver by solid angle.
struct Opening {
  mesh::FaceId face;
  mesh::Side inside = mesh::Side::kBack;  ///< the side that looks into the darker space
  mesh::Vector outward;                   ///< unit normal that points into the brighter space
  std::vector<std::array<mesh::Point, 3>> triangles;
  double area_m2 = 0.0;
};

/// Faces, materials, sources, sky and openings, ready for light. Local coordinates [m]; per-side arrays are indexed by
/// FaceSide::index() and, where they hold values per channel, by side · channels + channel.
struct Scene {
  mesh::Faces faces;
  mesh::CleanReport clean_report;
  std::size_t channels = 1;            ///< of all light together: its bands
  std::vector<float> channel_weights;  ///< of each channel in luminance; their sum is 1

  std::vector<float> reflectance;       ///< [sides × channels] diffuse; of glazing its hemispherical reflectance
  std::vector<float> exitance;          ///< [sides × channels] emitted [lm/m²]
  std::vector<std::uint8_t> reachable;  ///< [sides] light or the outside can get there
  std::vector<std::uint8_t> reachable_triangles;  ///< [2 a triangle of the shape] the same, piece by piece
  std::vector<std::uint8_t> has_elements;         ///< [sides] takes part in the solution
  std::vector<std::uint8_t> passable;             ///< [faces] glazing or opening
  std::vector<std::int32_t> glazing_of;           ///< [faces] index into glazings, -1 for the others
  std::vector<GlazingCurves> glazings;
  std::vector<mesh::FaceId> panes;  ///< faces of glazing, ascending
  std::vector<Opening> openings;
  std::vector<std::int32_t> opening_of;  ///< [faces] index into openings, -1 for the others
  std::vector<mesh::Slit> slits;         ///< before sides with elements
  mesh::Rooms rooms;

  Sky sky;
  std::vector<mesh::Vector> pane_normals;              ///< in which the sun is mirrored; one of those that are parallel
  std::vector<Luminaire> luminaires;                   ///< local coordinates
  std::vector<std::vector<mesh::FaceId>> flush_faces;  ///< [luminaires] what they are mounted in
  SourceGroups groups;                                 ///< of sky, sun and lamps
  std::vector<std::uint32_t> side_group;               ///< [sides] of those that shine
  std::vector<std::uint32_t> luminaire_group;          ///< [luminaires]
  std::vector<double> luminaire_dimming;               ///< [luminaires] in their factors
  std::unique_ptr<mesh::Rays> rays;
  std::unique_ptr<mesh::Shafts> shafts;
  std::vector<Results::MaterialUse> materials;
  std::vector<std::string> assumptions;
  std::vector<std::string> notices;

  [[nodiscard]] std::span<const float> side_reflectance(mesh::FaceSide s) const {
    return std::span(reflectance).subspan(s.index() * channels, channels);
  }
  [[nodiscard]] std::span<const float> side_exitance(mesh::FaceSide s) const {
    return std::span(exitance).subspan(s.index() * channels, channels);
  }
  /// Whether a side is glass, and so a mirror.
  [[nodiscard]] bool is_pane(mesh::FaceSide s) const { return glazing_of[s.face.index()] >= 0; }
  /// Whether light comes from outdoors: of the sky, or of the sun and the ground that it lights.
  [[nodiscard]] bool has_sky() const { return sky.ground_illuminance_lux() > 0.0; }
  [[nodiscard]] bool shines(mesh::FaceSide s) const {
    for (const float m : side_exitance(s)) {
      if (m > 0.0F) return true;
    }
    return false;
  }
};

/// Cleans the model of a study, builds its faces, and finds openings, reachable sides and the materials of every side.
/// Throws InputError: nothing left of the model, a reflectance of one or more, an emission without area, dimming of lamps that are not there,
/// columns of the patches of the sky of several moments.
/// @param progress  hears of the steps as phases; may be null
Scene build_scene(const Study& study, Progress* progress = nullptr);

/// Flux of all luminaires [lm].
double luminaire_flux(const Scene& scene);

/// Puts another sky with its sun in the place of a scene's. Lamps keep their groups, by name.
/// @param groups  of that sky and sun, without lamps
void set_sky(Scene& scene, const Sky& sky, SourceGroups groups);

/// Adds the light that a ray brings from the sky or the ground to the sums of those groups that it is of.
/// @param lux  by the scene's sky
/// @param weight  lux over the luminance, π included
void add_sky_light(const Scene& scene, const mesh::Vector& direction, double lux, double weight, GroupSums& sums);

/// What each material of a study became, and why.
std::vector<Results::MaterialUse> material_uses(const Study& study);

/// The rooms of a scene in model coordinates.
std::vector<mesh::Room> rooms_in_model(const Scene& scene);

}  // namespace clerestory::lighting
