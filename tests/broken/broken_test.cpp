// SPDX-License-Identifier: GPL-3.0-or-later
// Tiny models with one defect, or a pair that interacts: NAME.obj says in its first line what is wrong, NAME.report what is expected:
//   found N mended N KIND     a line a kind
//   area_m2 A                 of all polygons after the clean-up
//   open_edges N, closed_shells N
//   two_sided N, contacts N   where there are some
//   gap_m G                   an option, where it is given
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "io/model_file.h"
#include "mesh/clean.h"
#include "tests/support/places.h"

namespace clerestory::test {
namespace {

struct Expected {
  mesh::CleanOptions options;
  std::vector<std::string> defects;  ///< "found N mended N KIND"
  double area_m2 = -1.0;
  std::size_t open_edges = 0;
  std::size_t closed_shells = 0;
  std::size_t two_sided = 0;
  std::size_t contacts = 0;
};

std::filesystem::path folder() { return source_dir() / "tests" / "broken"; }

Expected read_expected(const std::string& name) {
  std::ifstream in(folder() / (name + ".report"));
  Expected expected;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string key;
    double value = 0.0;
    words >> key >> value;
    if (key == "found") expected.defects.push_back(line);
    if (key == "area_m2") expected.area_m2 = value;
    if (key == "open_edges") expected.open_edges = static_cast<std::size_t>(value);
    if (key == "closed_shells") expected.closed_shells = static_cast<std::size_t>(value);
    if (key == "two_sided") expected.two_sided = static_cast<std::size_t>(value);
    if (key == "contacts") expected.contacts = static_cast<std::size_t>(value);
    if (key == "gap_m") expected.options.gap_m = value;
  }
  return expected;
}

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    if (entry.path().extension() == ".obj") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

mesh::Model read(const std::string& name) {
  io::ModelFormat metres;
  metres.unit = io::LengthUnit::kMetre;
  return io::read_model(folder() / (name + ".obj"), metres).model;
}

std::vector<std::string> lines_of(const mesh::CleanReport& report) {
  std::vector<std::string> lines;
  for (const mesh::Defect& d : report.defects) {
    lines.push_back("found " + std::to_string(d.found) + " mended " + std::to_string(d.mended) + " " + d.kind);
  }
  return lines;
}

class Broken : public testing::TestWithParam<std::string> {};

TEST_P(Broken, GivesTheExpectedReport) {
  const Expected expected = read_expected(GetParam());
  const mesh::CleanReport report = mesh::clean(read(GetParam()), expected.options).report;
  EXPECT_THAT(lines_of(report), testing::ElementsAreArray(expected.defects));
  EXPECT_NEAR(report.area_after_m2, expected.area_m2, 1e-6 * expected.area_m2);
  EXPECT_EQ(report.open_edges, expected.open_edges);
  EXPECT_EQ(report.closed_shells, expected.closed_shells);
  EXPECT_EQ(report.two_sided, expected.two_sided);
  EXPECT_EQ(report.contacts, expected.contacts);
}

TEST_P(Broken, TellsWhereAndWhyNot) {
  const mesh::Model model = read(GetParam());
  for (const mesh::Defect& defect : mesh::clean(model, read_expected(GetParam()).options).report.defects) {
    EXPECT_EQ(defect.places.size(), defect.found);
    for (const mesh::Defect::Place& place : defect.places) {
      EXPECT_LT(place.polygon, model.polygon_count());
      EXPECT_TRUE(mesh::is_finite(place.at));
      EXPECT_TRUE(place.mended || !place.note.empty()) << defect.kind;
    }
  }
}

TEST_P(Broken, IsCleanOnceCleaned) {
  const mesh::CleanOptions options = read_expected(GetParam()).options;
  const mesh::CleanSurface once = mesh::clean(read(GetParam()), options);
  const mesh::CleanSurface twice = mesh::clean(once.polygons, options);
  for (const mesh::Defect& defect : twice.report.defects) EXPECT_EQ(defect.mended, 0U) << defect.kind;
  EXPECT_EQ(once.polygons.vertices, twice.polygons.vertices);
  EXPECT_EQ(once.polygons.corners, twice.polygons.corners);
}

INSTANTIATE_TEST_SUITE_P(Models, Broken, testing::ValuesIn(names()), [](const auto& test) { return test.param; });

}  // namespace
}  // namespace clerestory::test
