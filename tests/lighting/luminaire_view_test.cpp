// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/luminaire_view.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <utility>
#include <vector>

#include "lighting/form_factor.h"
#include "lighting/luminaire_light.h"
#include "lighting/luminaire_mounting.h"
#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;

const Vector kUp{0, 0, 1};

/// A Lambertian panel of 0.6 m x 0.3 m at (2, 2, 2.5) that shines down.
Luminaire panel() {
  Luminaire lamp = clerestory::test::lambertian_lamp({2, 2, 2.5}, {0, 0, -1}, 1000.0);
  lamp.opening = {.shape = LuminousOpening::Shape::kRectangle, .x_m = 0.6, .y_m = 0.3};
  return lamp;
}

/// A black room with the panel, and a board half-way up from x = 2 on.
struct Room {
  explicit Room(const Luminaire& lamp = panel()) : stage(study_of(lamp)) {}

  static Study study_of(const Luminaire& lamp) {
    mesh::Model model = support::box_room(4, 4, 3);
    support::add_quad(model, {2, 0, 1.25}, {4, 0, 1.25}, {4, 4, 1.25}, {2, 4, 1.25}, {"board", "board"});
    Study study = test::study_of(std::move(model), 0.0, {1, 1, 1});
    study.luminaires.push_back(lamp);
    return study;
  }

  [[nodiscard]] auto seen(const Point& model_point) const {
    const Scene& scene = stage.scene;
    return seen_opening(scene, scene.luminaires[0], scene.flush_faces[0], stage.local(model_point));
  }

  test::Stage stage;
};

double area_of(const std::vector<mesh::ConvexPiece>& parts) {
  double area = 0.0;
  for (const mesh::ConvexPiece& part : parts) {
    for (std::size_t i = 1; i + 1 < part.count; ++i) {
      area += 0.5 * norm(cross(part.corners[i] - part.corners[0], part.corners[i + 1] - part.corners[0]));
    }
  }
  return area;
}

TEST(SeenOpening, IsWhatABoardLeavesOfIt) {
  const Room room;
  // Seen from the floor, the board's edge x = 2 half-way up hides what is beyond x = 4 - x of the point.
  EXPECT_NEAR(area_of(room.seen({1.0, 2, 0}).value()), 0.18, 1e-9);
  EXPECT_NEAR(area_of(room.seen({1.9, 2, 0}).value()), 0.3 * 0.4, 1e-9);
  EXPECT_NEAR(area_of(room.seen({2.1, 2, 0}).value()), 0.3 * 0.2, 1e-9);
  EXPECT_NEAR(area_of(room.seen({3.0, 2, 0}).value()), 0.0, 1e-12);
}

TEST(SeenOpening, IsNotToldBesideTheLampOrOfOtherShapes) {
  EXPECT_FALSE(Room().seen({1.0, 2, 2.6}));
  Luminaire round = panel();
  round.opening.shape = LuminousOpening::Shape::kEllipse;
  EXPECT_FALSE(Room(round).seen({1.0, 2, 0}));
}

TEST(MeanOverParts, OfAHalfHiddenPanelIsExactToItsTolerance) {
  const Room room;
  const double exitance = std::numbers::pi * 1000.0 / 0.18;
  const std::array<Point, 4> corners{Point{1.7, 1.85, 2.5}, Point{1.7, 2.15, 2.5}, Point{2.1, 2.15, 2.5},
                                     Point{2.1, 1.85, 2.5}};
  std::vector<mesh::OutlineEdge> edges;
  for (std::size_t k = 0; k < 4; ++k) edges.push_back({corners[k], corners[(k + 1) % 4]});
  const Point at{1.9, 2, 0};
  const double expected = exitance * point_form_factor(at, kUp, edges, {0, 0, -1});
  const Scene& scene = room.stage.scene;
  const AreaMean fine = luminaire_illuminance(scene, any_luminaires(scene), room.stage.local(at), kUp, kFineMean);
  EXPECT_NEAR(fine.value, expected, 1e-4 * expected);
  const AreaMean rough = luminaire_illuminance(scene, any_luminaires(scene), room.stage.local(at), kUp, kRoughMean);
  EXPECT_NEAR(rough.value, expected, 1e-2 * expected);
}

}  // namespace
}  // namespace clerestory::lighting
