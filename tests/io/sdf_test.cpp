// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/sdf.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/io/refusal.h"
#include "tests/support/places.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

/// A folder with worlds/a.world, and the model "lamp": a triangle with a corner at (1, 0, 0) and one at (0, 0, 2).
class Sdf : public testing::Test {
 protected:
  Sdf() {
    fs::create_directories(folder_.path() / "worlds");
    fs::create_directories(model_folder());
    test::write_text(model_folder() / "lamp.obj", "v 1 0 0\nv 0 1 0\nv 0 0 2\nusemtl brass\nf 1 2 3\n");
    write_model(
        "<link name='l'><visual name='v'><geometry><mesh><uri>model://shop_lamp/lamp.obj</uri></mesh>"
        "</geometry></visual></link>");
  }

  [[nodiscard]] fs::path model_folder() const { return folder_.path() / "models" / "lamp"; }
  void write_model(const std::string& content, const std::string& pose = "") const {
    test::write_text(model_folder() / "model.sdf",
                     "<sdf version='1.6'><model name='lamp'>" + pose + content + "</model></sdf>");
  }
  [[nodiscard]] ModelFile read(const std::string& world) const {
    const fs::path file = folder_.path() / "worlds" / "a.world";
    test::write_text(file, "<sdf version='1.6'>\n<world name='w'>\n" + world + "</world></sdf>");
    return read_model(file);
  }
  [[nodiscard]] std::string refusal(const std::string& world) const {
    return test::refusal_of([&] { static_cast<void>(read(world)); });
  }

  test::ScratchFolder folder_;
};

const std::string kInclude = "<include><uri>model://shop_lamp</uri></include>";

std::string at(const std::string& pose) {
  return "<model name='one'>" + kInclude + "<pose frame=''>" + pose + "</pose></model>\n";
}

void expect_at(const mesh::Point& p, double x, double y, double z) {
  EXPECT_NEAR(p.x, x, 1e-12);
  EXPECT_NEAR(p.y, y, 1e-12);
  EXPECT_NEAR(p.z, z, 1e-12);
}

TEST_F(Sdf, AModelStandsAtItsPoseAndIsAPart) {
  const ModelFile file = read(at("10 20 0 0 0 0"));
  EXPECT_EQ(file.format, "SDF");
  EXPECT_THAT(file.model.part_names, ElementsAre("one"));
  EXPECT_THAT(file.model.material_names, ElementsAre("brass"));
  expect_at(file.model.vertices[0], 11, 20, 0);
  expect_at(file.model.vertices[2], 10, 20, 2);
  EXPECT_EQ(file.files.size(), 3U);
}

TEST_F(Sdf, RollPitchAndYawTurnAboutTheFixedAxesInThisOrder) {
  constexpr double kQuarter = std::numbers::pi / 2.0;
  expect_at(read(at(fmt::format("0 0 0 0 0 {}", kQuarter))).model.vertices[0], 0, 1, 0);
  expect_at(read(at(fmt::format("0 0 0 {} 0 0", kQuarter))).model.vertices[1], 0, 0, 1);
  expect_at(read(at(fmt::format("0 0 0 0 {} 0", kQuarter))).model.vertices[0], 0, 0, -1);
  expect_at(read(at(fmt::format("0 0 0 {0} 0 {0}", kQuarter))).model.vertices[2], 2, 0, 0);
}

TEST_F(Sdf, PosesOfModelLinkAndVisualMultiply) {
  write_model(
      "<link name='l'><pose>0 0 1 0 0 1.5707963267948966</pose><visual name='v'><pose>2 0 0 0 0 0</pose><geometry>"
      "<mesh><uri>model://shop_lamp/lamp.obj</uri><scale>3 1 1</scale></mesh></geometry></visual></link>",
      "<pose>100 0 0 0 0 0</pose>");
  expect_at(read(at("10 0 0 0 0 0")).model.vertices[0], 110, 5, 1);
}

TEST_F(Sdf, ThePoseOfAnIncludeStandsInPlaceOfTheModels) {
  write_model("<link name='l'><visual name='v'><geometry><mesh><uri>lamp.obj</uri></mesh></geometry></visual></link>",
              "<pose>100 0 0 0 0 0</pose>");
  const ModelFile file =
      read("<include><uri>model://shop_lamp</uri><name>mine</name><pose>5 0 0 0 0 0</pose></include>");
  expect_at(file.model.vertices[0], 6, 0, 0);
  EXPECT_THAT(file.model.part_names, ElementsAre("mine"));
}

TEST_F(Sdf, AMirroredMeshKeepsItsFronts) {
  write_model(
      "<link name='l'><visual name='v'><geometry><mesh><uri>lamp.obj</uri><scale>-1 1 1</scale></mesh></geometry>"
      "</visual></link>");
  const mesh::Model model = read(at("0 0 0 0 0 0")).model;
  EXPECT_THAT(model.loop(0), ElementsAre(2, 1, 0));
}

TEST_F(Sdf, WhatIsNotThereIsTold) {
  const ModelFile file = read(at("0 0 0 0 0 0") + "<include><uri>model://shop_sofa</uri></include><light name='sun'/>");
  EXPECT_THAT(file.notices, Contains(HasSubstr("left out, in 1 places: model://shop_sofa.")));
  EXPECT_THAT(file.notices, Contains(HasSubstr("named like the end of a model's name were taken for it: lamp.")));
  EXPECT_THAT(file.notices, Contains(HasSubstr("no photometry and were left out: 1.")));
}

TEST_F(Sdf, WhatCannotBeReadIsRefusedInOneLine) {
  EXPECT_THAT(refusal(at("1 2 3")), HasSubstr("a.world:3: <pose> is '1 2 3', expected 6 numbers"));
  EXPECT_THAT(refusal(at("0 0 0 0 0 nan")), HasSubstr("expected 6 numbers"));
  EXPECT_THAT(refusal("<model name='m'><pose relative_to='x'>0 0 0 0 0 0</pose></model>"),
              HasSubstr("this pose is relative to 'x'"));
  EXPECT_THAT(refusal("<include><uri>model://sofa</uri></include>"), HasSubstr("none of its 1 models is there"));
  EXPECT_THAT(refusal("<include><uri>model://../../etc</uri></include>"), HasSubstr("is no place of a model"));
  EXPECT_THAT(refusal("<include/>"), HasSubstr("a.world:3: this <include> has no <uri>"));
  EXPECT_THAT(refusal(""), HasSubstr("there is no mesh in this world"));
  EXPECT_THAT(refusal("<include>"), HasSubstr("no sound XML"));
  fs::remove(model_folder() / "lamp.obj");
  EXPECT_THAT(refusal(at("0 0 0 0 0 0")), HasSubstr("there is no mesh 'model://shop_lamp/lamp.obj'"));
}

TEST_F(Sdf, ModelsThatIncludeThemselvesAreRefused) {
  write_model(kInclude);
  EXPECT_THAT(refusal(kInclude), HasSubstr("over 16 models include each other"));
}

TEST(SdfCollection, TheSmallHouseIsAssembledByItsPoses) {
  CLERESTORY_NEEDS_SHARED_DATA("collada-small-house");
  const ModelFile file = read_model(test::shared_data_dir() / "collada-small-house" / "worlds" / "small_house.world");
  const auto box = [&](const std::string& part) {
    mesh::Box result;
    for (std::size_t p = 0; p < file.model.polygon_count(); ++p) {
      if (file.model.part_names[file.model.polygon_part[p].index()] != part) continue;
      for (const std::uint32_t corner : file.model.loop(p)) result.add(file.model.vertices[corner]);
    }
    return result;
  };
  EXPECT_NEAR(box("HouseWallB_01_001").size().x, 19.0, 1e-3);
  EXPECT_NEAR(box("HouseWallB_01_001").size().z, 3.0, 1e-3);
  // The first chair stands at (-1.38, 4.10), which is within the walls.
  const mesh::Point chair = box("ChairD_01_001").centre();
  EXPECT_NEAR(chair.x, -1.38, 0.5);
  EXPECT_NEAR(chair.y, 4.10, 0.5);
  std::size_t windows = 0;
  for (const std::string& name : file.model.part_names) windows += name.starts_with("RoomWindow_01") ? 1 : 0;
  EXPECT_EQ(windows, 9U);
}

}  // namespace
}  // namespace clerestory::io
