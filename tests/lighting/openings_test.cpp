// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/openings.h"

#include <gtest/gtest.h>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::lighting {
namespace {

using support::add_polygon;
using support::add_quad;

/// Two rooms of 4 m × 4 m × 3 m along x. Panes: "window" in the wall x = 0, looking out; "inner" in the wall x = 4 between the rooms.
/// The far room has a window "far" at x = 8 where asked.
mesh::Model two_rooms(bool far_window, bool window_faces_out) {
  mesh::Model model;
  const auto wall_with_pane = [&](double x, const std::string& pane, bool front_to_negative) {
    const std::vector<mesh::Point> hole{{x, 0.5, 0.5}, {x, 3.5, 0.5}, {x, 3.5, 2.5}, {x, 0.5, 2.5}};
    std::vector<std::vector<mesh::Point>> holes;
    if (!pane.empty()) holes.push_back(hole);
    add_polygon(model, {{x, 0, 0}, {x, 4, 0}, {x, 4, 3}, {x, 0, 3}}, {}, holes);
    if (pane.empty()) return;
    if (front_to_negative) {
      add_quad(model, hole[3], hole[2], hole[1], hole[0], {pane, pane});
    } else {
      add_quad(model, hole[0], hole[1], hole[2], hole[3], {pane, pane});
    }
  };
  wall_with_pane(0, "window", window_faces_out);
  wall_with_pane(4, "inner", false);
  wall_with_pane(8, far_window ? "far" : "", false);
  add_quad(model, {0, 0, 0}, {8, 0, 0}, {8, 4, 0}, {0, 4, 0});
  add_quad(model, {0, 0, 3}, {0, 4, 3}, {8, 4, 3}, {8, 0, 3});
  add_quad(model, {0, 0, 0}, {0, 0, 3}, {8, 0, 3}, {8, 0, 0});
  add_quad(model, {0, 4, 0}, {8, 4, 0}, {8, 4, 3}, {0, 4, 3});
  return model;
}

Study glazed(mesh::Model model) {
  Study study = test::study_of(std::move(model), 0.5, {2, 2, 1});
  for (Material& m : study.materials) {
    if (m.name != "wall") m.glazing = Glazing{};
  }
  study.sky.type = Sky::Type::kCieOvercast;
  return study;
}

const Opening* opening_of(const Scene& scene, const std::string& material) {
  const std::int32_t k = scene.opening_of[support::faces_of(scene.faces, material).at(0).index()];
  return k < 0 ? nullptr : &scene.openings[static_cast<std::size_t>(k)];
}

TEST(Openings, WindowLooksOutWhateverItsWinding) {
  for (const bool faces_out : {false, true}) {
    const Scene scene = build_scene(glazed(two_rooms(false, faces_out)));
    const Opening* window = opening_of(scene, "window");
    ASSERT_NE(window, nullptr);
    EXPECT_NEAR(window->outward.x, -1.0, 1e-12);
    EXPECT_NEAR(window->area_m2, 6.0, 1e-9);
    EXPECT_EQ(window->inside, faces_out ? mesh::Side::kBack : mesh::Side::kFront);
    for (const auto& t : window->triangles) {
      EXPECT_GT(cross(t[1] - t[0], t[2] - t[0]).x, 0.0) << "triangles face inwards";
    }
  }
}

TEST(Openings, PaneFromADarkRoomIntoALitOneLooksIntoTheLitOne) {
  const Scene scene = build_scene(glazed(two_rooms(false, true)));
  const Opening* inner = opening_of(scene, "inner");
  ASSERT_NE(inner, nullptr);
  EXPECT_NEAR(inner->outward.x, -1.0, 1e-12);
}

TEST(Openings, PaneBetweenEquallyBrightRoomsIsNone) {
  const Scene scene = build_scene(glazed(two_rooms(true, true)));
  EXPECT_EQ(opening_of(scene, "inner"), nullptr);
  ASSERT_NE(opening_of(scene, "far"), nullptr);
  EXPECT_NEAR(opening_of(scene, "far")->outward.x, 1.0, 1e-12);
}

TEST(Openings, WithoutASkyThereAreNone) {
  Study study = glazed(two_rooms(false, true));
  study.sky.type = Sky::Type::kNone;
  EXPECT_TRUE(build_scene(study).openings.empty());
}

TEST(Openings, RaysAreToldOfThem) {
  const Scene scene = build_scene(glazed(two_rooms(false, true)));
  const auto passes = [&](const mesh::Point& from, const mesh::Point& to) {
    const mesh::Segment segment{from - scene.faces.origin, to - scene.faces.origin};
    float passed = -1.0F;
    scene.rays->transmittance({&segment, 1}, {&passed, 1});
    return passed;
  };
  EXPECT_EQ(passes({1, 2, 1.5}, {-1, 2, 1.5}), 0.0F) << "outwards, the opening's own samples carry the light";
  EXPECT_NEAR(passes({-1, 2, 1.5}, {1, 2, 1.5}), 0.70, 1e-5);
}

TEST(Openings, AirPolygonsBlockNothingAndCarryNoElements) {
  Study study = glazed(two_rooms(false, true));
  Material& air = test::material(study, "window");
  air.glazing.reset();
  air.opening = true;
  const Scene scene = build_scene(study);
  const mesh::FaceId face = support::faces_of(scene.faces, "window").at(0);
  EXPECT_EQ(scene.rays->curve(scene.rays->passage(face).curve).front(), 1.0F);
  EXPECT_NE(opening_of(scene, "window"), nullptr);
  EXPECT_EQ(scene.has_elements[2 * face.index()], 0);
  EXPECT_EQ(scene.has_elements[2 * face.index() + 1], 0);
}

TEST(Openings, ShaftEndIsTheBoundingRectangleThatFacesInwards) {
  const Scene scene = build_scene(glazed(two_rooms(false, true)));
  const mesh::ShaftEnd end = shaft_end(*opening_of(scene, "window"));
  ASSERT_EQ(end.count, 4U);
  EXPECT_NEAR(end.normal.x, 1.0, 1e-12);
  const mesh::Vector area = cross(end.corners[1] - end.corners[0], end.corners[3] - end.corners[0]);
  EXPECT_NEAR(area.x, 6.0, 1e-9) << "counter-clockwise seen from inside";
  mesh::Box box;
  for (const mesh::Point& p : end.corners) box.add(p + scene.faces.origin);
  EXPECT_NEAR(box.low.y, 0.5, 1e-9);
  EXPECT_NEAR(box.high.y, 3.5, 1e-9);
  EXPECT_NEAR(box.low.z, 0.5, 1e-9);
  EXPECT_NEAR(box.high.z, 2.5, 1e-9);
}

}  // namespace
}  // namespace clerestory::lighting
