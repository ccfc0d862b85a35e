// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ifc_panes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/ifc_cut.h"
#include "tests/io/ifc_samples.h"

namespace clerestory::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

mesh::Solid box(const mesh::Point& low, const mesh::Point& high) {
  const std::vector<mesh::Point> loop{low, {high.x, low.y, low.z}, {high.x, high.y, low.z}, {low.x, high.y, low.z}};
  return mesh::snapped(mesh::prism({&loop, 1}, {0.0, 0.0, high.z - low.z}));
}

/// Four bars round 1.2 x 1.5 m.
mesh::Solid frame() {
  const std::vector<std::vector<mesh::Point>> loops{{{0, 0, 0}, {1.2, 0, 0}, {1.2, 0, 1.5}, {0, 0, 1.5}},
                                                    {{0.1, 0, 0.1}, {1.1, 0, 0.1}, {1.1, 0, 1.4}, {0.1, 0, 1.4}}};
  return mesh::snapped(mesh::prism(loops, {0.0, 0.07, 0.0}));
}

mesh::Solid pane() { return box({0.1, 0.03, 0.1}, {1.1, 0.05, 1.4}); }

IfcElement window(std::vector<IfcItem> items) {
  IfcElement element;
  element.class_name = "Window";
  element.name = "W";
  element.items = std::move(items);
  return element;
}

IfcBuilding building(std::vector<IfcElement> elements) {
  IfcBuilding result;
  result.surfaces = {{"Wood", {}, 0.0, 0}, {"Shiny", {}, 0.9, 0}, {"Isolierglas", {}, 0.0, 0}};
  result.elements = std::move(elements);
  return result;
}

std::vector<bool> panes_of(const IfcElement& element) {
  std::vector<bool> panes;
  for (const IfcItem& item : element.items) panes.push_back(item.pane);
  return panes;
}

TEST(IfcPanes, TransparentItemsAndThoseNamedLikeGlassArePanes) {
  auto house =
      building({window({{frame(), 0, false}, {pane(), 1, false}}), window({{frame(), 0, false}, {pane(), 2, false}})});
  find_panes(house);
  EXPECT_THAT(panes_of(house.elements[0]), ElementsAre(false, true));
  EXPECT_THAT(panes_of(house.elements[1]), ElementsAre(false, true));
  EXPECT_THAT(house.notices, IsEmpty());
}

TEST(IfcPanes, PlatesAmongThePartsOfAWindowArePanesAndTransparentMembersAreNot) {
  auto house = building({window({}), window({{pane(), {}, false}}), window({{frame(), 1, false}})});
  house.elements[1].class_name = "Plate";
  house.elements[2].class_name = "Member";
  house.elements[1].whole = house.elements[2].whole = 0;
  find_panes(house);
  EXPECT_THAT(panes_of(house.elements[1]), ElementsAre(true));
  EXPECT_THAT(panes_of(house.elements[2]), ElementsAre(false));
  EXPECT_THAT(house.notices, ElementsAre(HasSubstr("the plates among their parts were taken for panes: W")));
}

TEST(IfcPanes, ThinPlateInABodyOfSeveralPiecesBecomesThePane) {
  mesh::Solid all = frame();
  mesh::append(all, pane());
  auto house = building({window({{all, 0, false}})});
  find_panes(house);
  ASSERT_THAT(panes_of(house.elements[0]), ElementsAre(true, false));
  EXPECT_NEAR(mesh::volume(house.elements[0].items[0].body), 1.0 * 1.3 * 0.02, 1e-9);
  EXPECT_NEAR(mesh::volume(house.elements[0].items[1].body), (1.2 * 1.5 - 1.3) * 0.07, 1e-9);
}

TEST(IfcPanes, FrameAloneGetsARectangleAcrossItsOpening) {
  auto house = building({window({{frame(), 0, false}})});
  house.openings.push_back({7, {}, {box({0, 0, 0}, {1.2, 3, 1.5})}, mesh::Vector{0, 1, 0}});
  house.elements[0].fills = 0;
  find_panes(house);
  ASSERT_THAT(panes_of(house.elements[0]), ElementsAre(false, true));
  EXPECT_NEAR(mesh::surface_area(house.elements[0].items[1].body), 1.8, 1e-9);
  EXPECT_NEAR(mesh::box_of(house.elements[0].items[1].body).low.y, 1.5, 1e-9);
}

TEST(IfcPanes, WindowWithoutABodyGetsAPaneAndARingForTheFrame) {
  auto house = building({window({})});
  house.openings.push_back({7, {}, {box({0, 0, 0}, {1, 0.3, 2})}, {}});
  house.elements[0].fills = 0;
  find_panes(house);
  ASSERT_THAT(panes_of(house.elements[0]), ElementsAre(false, true));
  EXPECT_NEAR(mesh::surface_area(house.elements[0].items[0].body), 2.0 - 1.28, 1e-9);
  EXPECT_NEAR(mesh::surface_area(house.elements[0].items[1].body), 1.28, 1e-9);
}

TEST(IfcPanes, WindowWithoutAnyIsToldAsBlind) {
  auto house = building({window({{frame(), 0, false}})});
  find_panes(house);
  EXPECT_THAT(house.notices, ElementsAre(HasSubstr("no pane was found, so that no light passes: W")));
}

TEST(IfcPanes, GlazingBarsOfGlassAreOfTheFrame) {
  auto house = building(
      {window({{frame(), 0, false}, {pane(), 1, false}, {box({0.1, 0.05, 0.7}, {1.1, 0.0625, 0.725}), 1, false}})});
  find_panes(house);
  EXPECT_THAT(panes_of(house.elements[0]), ElementsAre(false, true, false));
  EXPECT_EQ(house.elements[0].items[2].style, std::optional<std::size_t>(0));
}

TEST(IfcHousePanes, EveryWindowHasAPane) {
  CLERESTORY_NEEDS_SHARED_DATA("ifc");
  for (const auto& [name, count] : {std::pair<const char*, std::size_t>{"AC20-FZK-Haus.ifc", 11},
                                    {"duplex.ifc", 24},
                                    {"tested_sample_project.ifc", 9},
                                    {"IfcOpenHouse_IFC4.ifc", 5},
                                    {"ISSUE_171_IfcSurfaceCurveSweptAreaSolid.ifc", 16}}) {
    IfcBuilding house = read_ifc_building(test::ifc_file(name));
    cut_openings(house);
    find_panes(house);
    std::vector<bool> has_pane(house.elements.size(), false);
    for (std::size_t e = 0; e < house.elements.size(); ++e)
      for (const IfcItem& item : house.elements[e].items)
        if (item.pane) has_pane[house.elements[e].whole.value_or(e)] = has_pane[e] = true;
    std::size_t windows = 0;
    for (std::size_t e = 0; e < house.elements.size(); ++e) {
      if (house.elements[e].class_name != "Window") continue;
      ++windows;
      EXPECT_TRUE(has_pane[e]) << name << " " << house.elements[e].name;
    }
    EXPECT_EQ(windows, count) << name;
  }
}

}  // namespace
}  // namespace clerestory::io
