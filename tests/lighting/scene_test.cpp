// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/scene.h"

#include <gtest/gtest.h>

#include "mesh/error.h"
#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::lighting {
namespace {

/// A room of 4 m × 4 m × 3 m with a slab at mid height: "floor" looks up, "ceiling" lies on it and looks down.
Study storeys(bool floor_first) {
  mesh::Model model;
  support::add_box(model, {0, 0, 0}, {4, 4, 3}, {"wall", "shell"});
  const auto floor = [&] { support::add_quad(model, {1, 1, 1}, {3, 1, 1}, {3, 3, 1}, {1, 3, 1}, {"floor", "slab"}); };
  if (floor_first) floor();
  support::add_quad(model, {1, 3, 1}, {3, 3, 1}, {3, 1, 1}, {1, 1, 1}, {"ceiling", "slab"});
  if (!floor_first) floor();
  Study study = test::study_of(std::move(model), 0.5, {2, 2, 1});
  for (Material& material : study.materials) {
    if (material.name == "floor") material.front.reflectance = Spectrum{0.2F};
    if (material.name == "ceiling") material.front.reflectance = Spectrum{0.8F};
  }
  return study;
}

/// The side of the slab that looks up, or down.
mesh::FaceSide slab(const Scene& scene, bool up) {
  for (std::size_t f = 0; f < scene.faces.count(); ++f) {
    const mesh::Face& face = scene.faces.faces[f];
    if (!face.back_material.valid()) continue;
    return {mesh::FaceId(f), (face.frame.w.z > 0.0) == up ? mesh::Side::kFront : mesh::Side::kBack};
  }
  throw std::logic_error("no slab");
}

TEST(Scene, PolygonsBackToBackReflectEachOnItsSide) {
  for (const bool floor_first : {false, true}) {
    const Scene scene = build_scene(storeys(floor_first));
    EXPECT_EQ(scene.faces.count(), 7U);
    EXPECT_EQ(scene.side_reflectance(slab(scene, true))[0], 0.2F);
    EXPECT_EQ(scene.side_reflectance(slab(scene, false))[0], 0.8F);
  }
}

TEST(Scene, OfPolygonsBackToBackOneMayShine) {
  Study study = storeys(true);
  for (Material& material : study.materials) {
    if (material.name == "ceiling") material.front.emission = Emission{.flux_lm = 400.0, .luminance_cd_m2 = {}};
  }
  const Scene scene = build_scene(study);
  EXPECT_EQ(scene.side_exitance(slab(scene, true))[0], 0.0F);
  EXPECT_FLOAT_EQ(scene.side_exitance(slab(scene, false))[0], 100.0F);
}

TEST(Scene, AFluxIsSharedByBothSidesOfItsSurface) {
  Study study = storeys(true);
  for (Material& material : study.materials) {
    if (material.name != "wall") continue;
    material.front.emission = Emission{.flux_lm = 660.0, .luminance_cd_m2 = {}};
    material.back.emission = material.front.emission;
  }
  const Scene scene = build_scene(study);  // a shell of 80 m², seen from both sides
  const mesh::FaceId wall = support::faces_of(scene.faces, "wall").at(0);
  for (const mesh::Side side : {mesh::Side::kFront, mesh::Side::kBack})
    EXPECT_FLOAT_EQ(scene.side_exitance({wall, side})[0], 660.0F / 160.0F);
}

TEST(Scene, LampsAreInTheGroupsThatTheyNameAndDimmedWithThem) {
  Study study = test::furnished_room_study();
  study.columns = Columns::kGroups;
  study.luminaires.push_back(clerestory::test::isotropic_lamp({2, 2, 2}, 8.0));
  study.luminaires.back().group = "desk";
  study.dimming = {{"lamp", 0.5}, {"desk", 0.25}};
  const Scene scene = build_scene(study);
  ASSERT_EQ(scene.groups.count(), 3U);
  EXPECT_EQ(scene.groups[0].name, "sky");
  EXPECT_EQ(scene.groups[scene.luminaire_group[0]].name, "desk");
  EXPECT_EQ(scene.luminaires[0].peak_cd(), 2.0);
  const mesh::FaceId lamp = support::faces_of(scene.faces, "lamp").at(0);
  const mesh::FaceSide shining{lamp, scene.shines({lamp, mesh::Side::kFront}) ? mesh::Side::kFront : mesh::Side::kBack};
  EXPECT_EQ(scene.groups[scene.side_group[shining.index()]].name, "lamp");
  EXPECT_FLOAT_EQ(scene.side_exitance(shining)[0], 500.0F);
  study.dimming = {{"lmap", 0.5}};
  EXPECT_THROW(build_scene(study), InputError);
}

}  // namespace
}  // namespace clerestory::lighting
