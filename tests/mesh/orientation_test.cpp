// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/orientation.h"

#include <gtest/gtest.h>

#include "mesh/clean.h"
#include "mesh/faces.h"
#include "mesh/weld.h"
#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

using support::Fronts;

Soup shared_soup(const Model& model) {
  Soup soup = to_soup(model);
  share_vertices(soup);
  return soup;
}

double volume(const Soup& soup) {
  double sum = 0.0;
  for (const SoupPolygon& p : soup.polygons) {
    sum += dot(soup.points[p.loops[0][0]] - Point{}, newell(soup.points, p.loops[0])) / 6.0;
  }
  return sum;
}

TEST(Orientation, AClosedShellLooksOutwardHoweverItWasTurned) {
  for (unsigned turned = 0; turned < 64; ++turned) {
    Model box;
    support::add_box(box, {1, 2, 3}, {2, 4, 6});
    Soup soup = shared_soup(box);
    for (std::size_t p = 0; p < 6; ++p) {
      if ((turned >> p & 1U) != 0) flip(soup.polygons[p]);
    }
    for (SoupPolygon& polygon : soup.polygons) polygon.flipped = false;
    DefectList defects;
    EXPECT_EQ(orient_shells(soup, defects), 1U);
    EXPECT_NEAR(volume(soup), 6.0, 1e-12);
    for (std::size_t p = 0; p < 6; ++p) EXPECT_EQ(soup.polygons[p].flipped, (turned >> p & 1U) != 0);
  }
}

TEST(Orientation, InAnOpenShellTheLargerAreaStays) {
  Model strip;
  support::add_quad(strip, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  support::add_quad(strip, {1, 0, 0}, {1, 1, 0}, {4, 1, 0}, {4, 0, 0});  // the other way round
  Soup soup = shared_soup(strip);
  DefectList defects;
  EXPECT_EQ(orient_shells(soup, defects), 0U);
  EXPECT_TRUE(soup.polygons[0].flipped);
  EXPECT_FALSE(soup.polygons[1].flipped);
  EXPECT_EQ(std::move(defects).take({})[0].kind, "mixed orientation");
}

TEST(Orientation, AThirdPolygonAtAnEdgeDoesNotPartAShellOfOnePart) {
  Model model;
  support::add_box(model, {0, 0, 0}, {1, 1, 1}, {"wall", "box"}, Fronts::kInward);
  support::add_quad(model, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {"floor", "floor"});
  Soup soup = shared_soup(model);
  DefectList defects;
  EXPECT_EQ(orient_shells(soup, defects), 1U);
  const std::vector<Defect> found = std::move(defects).take({});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, "inside-out shells");
}

TEST(Orientation, FacesKeepTheFrontOfTheFile) {
  Model model;
  support::add_box(model, {0, 0, 0}, {1, 1, 1}, {"wall", "room"}, Fronts::kInward);
  const CleanSurface surface = clean(model, {});
  EXPECT_EQ(surface.flipped, std::vector<std::uint8_t>(6, 1));
  const Faces faces = build_faces(surface);
  const Point centre = Point{0.5, 0.5, 0.5} - surface.origin;
  ASSERT_EQ(faces.count(), 6U);
  for (const Face& face : faces.faces) EXPECT_GT(dot(centre - face.origin, face.frame.w), 0.0);
}

}  // namespace
}  // namespace clerestory::mesh
