// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ifc_cut.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/ifc_samples.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

/// Whether a long ray through a point meets a body.
bool meets(const mesh::Solid& body, const mesh::Point& through, const mesh::Vector& way) {
  const mesh::Frame frame = mesh::frame_around(mesh::normalized(way));
  const auto side = [&](std::uint32_t a, std::uint32_t b) {
    const mesh::Vector p = body.points[a] - through;
    const mesh::Vector q = body.points[b] - through;
    return mesh::dot(p, frame.u) * mesh::dot(q, frame.v) - mesh::dot(p, frame.v) * mesh::dot(q, frame.u);
  };
  for (const auto& [a, b, c] : body.triangles) {
    const std::array sides{side(a, b), side(b, c), side(c, a)};
    const auto [low, high] = std::minmax_element(sides.begin(), sides.end());
    if (*low >= 0.0 || *high <= 0.0) return true;
  }
  return false;
}

/// A point of the opening off all its edges' middles.
mesh::Point inside(const mesh::Solid& tool) {
  const mesh::Box box = mesh::box_of(tool);
  const mesh::Vector size = box.size();
  return box.low + mesh::Vector{0.513 * size.x, 0.487 * size.y, 0.521 * size.z};
}

struct CutHouse {
  IfcBuilding building;
  std::vector<IfcCut> cuts;
  std::size_t crossing = 0;
  std::vector<std::string> blocked;
};

CutHouse cut_house(const std::filesystem::path& path) {
  CutHouse house{read_ifc_building(path), {}, 0, {}};
  house.cuts = cut_openings(house.building);
  for (const IfcCut& cut : house.cuts) {
    EXPECT_FALSE(cut.failed);
    if (!cut.way) continue;
    ++house.crossing;
    const IfcElement& element = house.building.elements[cut.element];
    for (const IfcItem& item : element.items)
      if (meets(item.body, inside(cut.tool), *cut.way)) house.blocked.push_back(element.name);
  }
  return house;
}

/// Walls, slabs and roofs whose volume is within 1 % of the stated one, and all of them.
std::pair<std::size_t, std::size_t> right_volumes(const IfcBuilding& building) {
  std::pair<std::size_t, std::size_t> counts{0, 0};
  for (const IfcElement& element : building.elements) {
    if (element.class_name != "Wall" && element.class_name != "Slab" && element.class_name != "Roof") continue;
    ++counts.second;
    double volume = 0.0;
    for (const IfcItem& item : element.items) volume += mesh::volume(item.body);
    const double stated = element.stated_volume_m3.value_or(0.0);
    if (stated > 0.0 && std::abs(volume / stated - 1.0) <= 0.01) ++counts.first;
  }
  return counts;
}

class IfcCuts : public testing::Test {
 protected:
  CutHouse cut(const std::string& entities) {
    test::write_text(scratch_.path() / "house.ifc", test::ifc_text(entities));
    return cut_house(scratch_.path() / "house.ifc");
  }

 private:
  test::ScratchFolder scratch_;
};

TEST_F(IfcCuts, OpeningThatEndsAFilmShortOfTheFacesIsOpen) {
  const auto house = cut(test::kIfcFrame + test::kIfcWall);
  EXPECT_EQ(house.crossing, 1U);
  EXPECT_TRUE(house.blocked.empty());
  const mesh::Solid& wall = house.building.elements[1].items.at(0).body;
  EXPECT_NEAR(mesh::volume(wall), 3.6 - 0.36, 1e-6);
  EXPECT_NEAR(mesh::surface_area(wall), 2 * (12.0 + 1.2 + 0.9) - 2 * 1.2 + 4.4 * 0.3, 1e-5);
}

TEST_F(IfcCuts, NicheIsCutAndDoesNotCross) {
  std::string entities = test::kIfcFrame + test::kIfcWall;
  entities.replace(entities.find("1000.,299.999"), 13, "1000.,200.000");
  const auto house = cut(entities);
  EXPECT_EQ(house.crossing, 0U);
  ASSERT_EQ(house.cuts.size(), 1U);
  EXPECT_NEAR(mesh::volume(house.building.elements[1].items.at(0).body), 3.6 - 0.24, 1e-6);
}

TEST_F(IfcCuts, OpeningBesideTheWallChangesNothing) {
  std::string entities = test::kIfcFrame + test::kIfcWall;
  entities.replace(entities.find("((0.,0.,1000.))"), 15, "((9000.,0.,0.))");
  const auto house = cut(entities);
  EXPECT_TRUE(house.cuts.empty());
  EXPECT_NEAR(mesh::volume(house.building.elements[1].items.at(0).body), 3.6, 1e-9);
}

TEST(IfcHouseCuts, FzkIsOpenWhereItShouldBeAndHasTheStatedVolumes) {
  CLERESTORY_NEEDS_SHARED_DATA("ifc");
  const auto house = cut_house(test::ifc_file("AC20-FZK-Haus.ifc"));
  EXPECT_EQ(house.crossing, 17U);
  EXPECT_THAT(house.blocked, testing::IsEmpty());
  EXPECT_EQ(right_volumes(house.building), std::pair(std::size_t{17}, std::size_t{17}));
}

TEST(IfcHouseCuts, DuplexIsOpenWhereItShouldBeAndHasTheStatedVolumesButForFour) {
  CLERESTORY_NEEDS_SHARED_DATA("ifc");
  const auto house = cut_house(test::ifc_file("duplex.ifc"));
  EXPECT_EQ(house.crossing, 40U);
  EXPECT_THAT(house.blocked, testing::IsEmpty());
  EXPECT_EQ(right_volumes(house.building), std::pair(std::size_t{75}, std::size_t{79}));
}

TEST(IfcHouseCuts, OtherHousesAreOpen) {
  CLERESTORY_NEEDS_SHARED_DATA("ifc");
  for (const auto& [name, crossing] : {std::pair<const char*, std::size_t>{"IfcOpenHouse_IFC4.ifc", 4},
                                       {"tested_sample_project.ifc", 10},
                                       {"ISSUE_171_IfcSurfaceCurveSweptAreaSolid.ifc", 16}}) {
    const auto house = cut_house(test::ifc_file(name));
    EXPECT_EQ(house.crossing, crossing) << name;
    EXPECT_THAT(house.blocked, testing::IsEmpty()) << name;
  }
}

}  // namespace
}  // namespace clerestory::io
