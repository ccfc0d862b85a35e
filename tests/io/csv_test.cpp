// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

#include "mesh/error.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

lighting::GridResult two_sensors() {
  lighting::GridResult grid;
  grid.name = "desk";
  grid.sensors.positions = {{1.5, 2.0, 0.8}, {612345.123456, -0.0000001, 0.1 + 0.2}};
  grid.sensors.normals = {{0.0, 0.0, 1.0}, {-0.0, 0.6, 0.8}};
  grid.illuminance_lux = {123.456F, 100000.0F};
  grid.error_lux = {1.5F, 1e-7F};
  return grid;
}

std::string csv_of(const lighting::GridResult& grid) { return grid_csv(std::span(&grid, 1)); }

TEST(Csv, HasASensorALineInTheOrderOfTheSensors) {
  EXPECT_EQ(csv_of(two_sensors()),
            "id,x,y,z,nx,ny,nz,illuminance_lux,error_lux\n"
            "0,1.5,2,0.8,0,0,1,123.456,1.5\n"
            "1,612345.123456,0,0.3,0,0.6,0.8,100000,0.0000001\n");
}

TEST(Csv, HasTheDaylightFactorWhereTheGridHasIt) {
  auto grid = two_sensors();
  grid.daylight_factor_percent = {1.25F, 0.0F};
  const std::string csv = csv_of(grid);
  EXPECT_NE(csv.find(",error_lux,daylight_factor_percent\n"), std::string::npos);
  EXPECT_NE(csv.find(",123.456,1.5,1.25\n"), std::string::npos);
}

TEST(Csv, HasCylindricalIlluminanceAndModellingWhereTheGridHasThem) {
  auto grid = two_sensors();
  grid.illuminance_lux = {200.0F, 0.0F};
  grid.cylindrical_lux = {100.0F, 0.0F};
  grid.cylindrical_error_lux = {0.5F, 0.25F};
  const std::string csv = csv_of(grid);
  EXPECT_NE(csv.find(",error_lux,cylindrical_lux,cylindrical_error_lux,modelling\n"), std::string::npos);
  EXPECT_NE(csv.find(",200,1.5,100,0.5,0.5\n"), std::string::npos);
  EXPECT_NE(csv.find(",0,0.0000001,0,0.25,0\n"), std::string::npos);
}

TEST(Csv, AnObserverALineWithAnEmptyUgrWhereNothingGlares) {
  std::vector<lighting::ObserverResult> observers(2);
  observers[0].observer = {"the \"boss\"", {1, 2, 1.2}, {0, 1, 0}};
  observers[0].ugr = 18.5;
  observers[0].ugr_error = 0.25;
  observers[0].background_cd_m2 = 40;
  observers[0].indirect_lux = 125;
  observers[1].ugr = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(observers_csv(observers),
            "name,x,y,z,look_x,look_y,look_z,ugr,ugr_error,background_cd_m2,indirect_vertical_lux\n"
            "\"the \"\"boss\"\"\",1,2,1.2,0,1,0,18.5,0.25,40,125\n"
            "\"\",0,0,0,0,0,0,,0,0,0\n");
}

TEST(Csv, ObserversHaveColumnsOfEachMoment) {
  std::vector<lighting::ObserverResult> observers(4);
  for (std::size_t i = 0; i < observers.size(); ++i) {
    observers[i].observer.name = i < 2 ? "front" : "back";
    observers[i].moment = i % 2 == 0 ? "2026-03-21T0900" : "2026-03-21T1200";
    observers[i].ugr = 10.0 + static_cast<double>(i);
  }
  EXPECT_EQ(full_name(observers[1]), "front_2026-03-21T1200");
  EXPECT_EQ(observers_csv(observers),
            "name,x,y,z,look_x,look_y,look_z,ugr_2026-03-21T0900,ugr_error_2026-03-21T0900,"
            "background_cd_m2_2026-03-21T0900,indirect_vertical_lux_2026-03-21T0900,ugr_2026-03-21T1200,"
            "ugr_error_2026-03-21T1200,background_cd_m2_2026-03-21T1200,indirect_vertical_lux_2026-03-21T1200\n"
            "\"front\",0,0,0,0,0,0,10,0,0,0,11,0,0,0\n"
            "\"back\",0,0,0,0,0,0,12,0,0,0,13,0,0,0\n");
}

TEST(Csv, SensorsKeepTheirNumbersWhereOthersAreLeftOut) {
  auto grid = two_sensors();
  grid.sensors.ids = {3, 7};
  EXPECT_NE(csv_of(grid).find("\n3,1.5,"), std::string::npos);
  EXPECT_NE(csv_of(grid).find("\n7,612345"), std::string::npos);
}

TEST(Csv, LightReadsBackAsTheSameFloat) {
  auto grid = two_sensors();
  for (const float value : {0.1F, 1.0F / 3.0F, 16777217.0F, std::numeric_limits<float>::min(), 3.4e38F}) {
    grid.illuminance_lux[0] = value;
    std::istringstream line(csv_of(grid));
    std::string field;
    std::getline(line, field);
    for (int i = 0; i < 8; ++i) std::getline(line, field, ',');
    EXPECT_EQ(std::strtof(field.c_str(), nullptr), value) << field;
  }
}

/// Writes 1.5 as 1;5 and 1000 as 1'000.
struct OddNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ';'; }
  char do_thousands_sep() const override { return '\''; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(Csv, DoesNotDependOnTheLocale) {
  const std::string plain = csv_of(two_sensors());
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new OddNumbers));
  const std::string odd = csv_of(two_sensors());
  std::locale::global(before);
  EXPECT_EQ(odd, plain);
}

TEST(Csv, NeverHoldsAValueThatIsNotFinite) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    auto grid = two_sensors();
    grid.error_lux[1] = bad;
    EXPECT_THROW(csv_of(grid), std::logic_error);
  }
}

TEST(Csv, RefusesArraysOfDifferentLengths) {
  auto grid = two_sensors();
  grid.error_lux.pop_back();
  EXPECT_THROW(csv_of(grid), std::logic_error);
}

TEST(Csv, GroupsAreColumnsBehindAllOthers) {
  auto grid = two_sensors();
  grid.groups = {{"row a", {1.5F, 2.5F}, {0.5F, 0.25F}}};
  const std::string text = csv_of(grid);
  const std::string head = text.substr(0, text.find('\n'));
  EXPECT_TRUE(head.ends_with(",illuminance_lux_row-a,error_lux_row-a")) << head;
  EXPECT_TRUE(text.ends_with(",2.5,0.25\n")) << text;
  grid.groups[0].error_lux.pop_back();
  EXPECT_THROW(csv_of(grid), std::logic_error);
}

TEST(Csv, AFileThatCannotBeWrittenIsTheMachinesFault) {
  const test::ScratchFolder scratch;
  EXPECT_THROW(write_grid_csv(scratch.path() / "missing" / "desk.csv", std::vector{two_sensors()}), MachineError);
  EXPECT_THROW(write_grid_csv("/dev/full", std::vector{two_sensors()}), MachineError);
}

TEST(Csv, SeveralMomentsHaveColumnsOfTheirOwn) {
  std::vector<lighting::GridResult> moments(2, two_sensors());
  moments[0].moment = "2026-03-21T0900";
  moments[1].moment = "2026-03-21T1200";
  moments[1].illuminance_lux = {7.0F, 8.0F};
  moments[1].groups = {{"row a", {1.0F, 2.0F}, {0.5F, 0.25F}}};
  const std::string csv = grid_csv(moments);
  EXPECT_TRUE(csv.starts_with(
      "id,x,y,z,nx,ny,nz,illuminance_lux_2026-03-21T0900,error_lux_2026-03-21T0900,illuminance_lux_2026-03-21T1200,"
      "error_lux_2026-03-21T1200,illuminance_lux_row-a_2026-03-21T1200,error_lux_row-a_2026-03-21T1200\n"));
  EXPECT_NE(csv.find(",123.456,1.5,7,1.5,1,0.5\n"), std::string::npos) << csv;
  EXPECT_EQ(full_name(moments[1]), "desk_2026-03-21T1200");
  EXPECT_EQ(full_name(two_sensors()), "desk");
}

}  // namespace
}  // namespace clerestory::io
