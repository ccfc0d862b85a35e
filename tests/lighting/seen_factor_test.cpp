// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/seen_factor.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/clean.h"
#include "mesh/faces.h"
#include "tests/support/blocked_lamp.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;

const Vector kUp{0, 0, 1};
const std::vector<Point> kLamp{{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}};  // shines down
/// Plates under the lamp, those of the material "pane" passable.
struct Site {
  explicit Site(const mesh::Model& model) : faces(mesh::build_faces(mesh::clean(model, {}))) {
    passable.resize(faces.count(), 0);
    for (std::size_t f = 0; f < faces.count(); ++f)
      passable[f] = faces.material_names[faces.faces[f].material.index()] == "pane" ? 1 : 0;
  }
  [[nodiscard]] SeenFactor seen(const Point& from) const {
    mesh::ShaftEnd lamp{.corners = {}, .count = kLamp.size(), .normal = -kUp};
    for (std::size_t i = 0; i < kLamp.size(); ++i) lamp.corners[i] = kLamp[i] - faces.origin;
    return seen_factor(mesh::Shafts(faces, passable), from - faces.origin, kUp, lamp);
  }
  mesh::Faces faces;
  std::vector<std::uint8_t> passable;
};

void add_plate(mesh::Model& model, const std::vector<Point>& plate, const std::string& name) {
  support::add_polygon(model, plate, {name, name});
}

std::vector<Point> plate_at(double z, double left, double right, double half_depth = 3.0) {
  return {{left, -half_depth, z}, {right, -half_depth, z}, {right, half_depth, z}, {left, half_depth, z}};
}

TEST(SeenFactor, IsExactThroughASlit) {
  const std::vector<std::vector<Point>> plates{plate_at(1, -3, 0.1), plate_at(1, 0.11, 3)};
  mesh::Model model;
  for (const auto& plate : plates) add_plate(model, plate, "plate");
  const Site site(model);
  for (const double x : {-0.3, 0.0, 0.4}) {
    const Point from{x, 0.2, 0};
    const double expected = support::exact_illuminance({.lamp = kLamp, .blockers = plates}, from, kUp);
    ASSERT_GT(expected, 0.0);
    const SeenFactor seen = site.seen(from);
    EXPECT_TRUE(seen.exact);
    EXPECT_NEAR(seen.factor, expected, 1e-9);
  }
}

TEST(SeenFactor, IsABoundBehindAPane) {
  mesh::Model model;
  add_plate(model, plate_at(1, -3, 0), "plate");
  add_plate(model, plate_at(0.5, -3, 3), "pane");
  const Point from{0, 0, 0};
  const SeenFactor seen = Site(model).seen(from);
  EXPECT_FALSE(seen.exact);
  EXPECT_NEAR(seen.factor, support::exact_illuminance({.lamp = kLamp, .blockers = {plate_at(1, -3, 0)}}, from, kUp),
              1e-9);
}

TEST(SeenFactor, IsExactlyNothingBehindPlatesTogetherThoughAPaneIsBeforeThem) {
  mesh::Model model;
  add_plate(model, plate_at(1, -3, 0.1), "plate");
  add_plate(model, plate_at(1.2, 0.1, 3), "other");
  add_plate(model, plate_at(0.5, -3, 3), "pane");
  const SeenFactor seen = Site(model).seen({0, 0, 0});
  EXPECT_TRUE(seen.exact);
  EXPECT_EQ(seen.factor, 0.0);
}

}  // namespace
}  // namespace clerestory::lighting
