// SPDX-License-Identifier: GPL-3.0-or-later
// The sample gives the numbers that its README states. They come from the path tracer of tests/support, not from the program.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <regex>

#include "io/study_file.h"
#include "tests/support/places.h"
#include "tests/support/validation_scenes.h"
#include "tests/validation/statistics.h"
#include "tests/validation/studies.h"

namespace clerestory::test {
namespace {

/// A row of the README's table: a figure and by how much the program may differ from it.
struct Figure {
  double value = 0.0;
  double tolerance = 0.0;
};

/// Rows "| name | value | ± tolerance |" of the README; units and per cent signs are words to skip.
std::map<std::string, Figure> readme_figures() {
  std::ifstream in(samples_dir() / "office" / "README.md");
  const std::regex row(R"(\|\s*([^|]*[^|\s])\s*\|\s*([0-9.]+)[^|]*\|\s*±\s*([0-9.]+)[^|]*\|\s*)");
  std::map<std::string, Figure> figures;
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_match(line, match, row)) figures[match[1]] = {std::stod(match[2]), std::stod(match[3])};
  }
  return figures;
}

TEST(SampleOffice, GivesTheNumbersOfItsReadme) {
  const auto input =
      io::read_study(samples_dir() / "office" / "office.toml", {.kind = lighting::Study::Kind::kDaylight, .set = {}});
  const lighting::Results results = answer(input.study);
  const lighting::GridMetrics& m = results.grids.at(0).metrics;
  const std::map<std::string, double> found{
      {"sensors", static_cast<double>(results.grids[0].sensors.count())},
      {"mean daylight factor", m.mean_df_percent},
      {"median daylight factor", m.median_df_percent},
      {"minimum daylight factor", m.minimum_df_percent},
      {"uniformity", m.uniformity},
      {"area with a daylight factor of at least 2 %", 100.0 * m.share_above_2_percent},
      {"area with a daylight factor of at least 5 %", 100.0 * m.share_above_5_percent},
  };
  const auto stated = readme_figures();
  ASSERT_EQ(stated.size(), found.size());
  for (const auto& [name, figure] : stated) {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_NEAR(found.at(name), figure.value, figure.tolerance) << name;
  }
  EXPECT_TRUE(results.accuracy_met);
}

/// A result as what others are compared with.
Reference reference_of(const lighting::GridResult& grid) {
  return {{grid.illuminance_lux.begin(), grid.illuminance_lux.end()}, {grid.error_lux.begin(), grid.error_lux.end()}};
}

lighting::Results answer_office(double accuracy, std::size_t max_elements) {
  lighting::Study study =
      io::read_study(samples_dir() / "office" / "office.toml", {.kind = lighting::Study::Kind::kDaylight, .set = {}})
          .study;
  study.accuracy.target = accuracy;
  study.mesh.discontinuities = false;
  study.mesh.max_elements = max_elements;
  return answer(study);
}

TEST(SampleOffice, WithFewElementsErrorsGrowAndStayHonest) {
  constexpr std::size_t kMany = 1'000'000;
  const Reference fine = reference_of(answer_office(0.007, kMany).grids.at(0));
  const lighting::Results whole = answer_office(0.02, kMany);
  double last = whole.accuracy_reached;
  for (const std::size_t budget : {1500U, 1000U}) {
    ASSERT_LT(budget, whole.counts.elements / 2);
    const lighting::Results results = answer_office(0.02, budget);
    const Comparison c = compare(results.grids.at(0), fine);
    print("office of " + std::to_string(budget) + " elements", c);
    EXPECT_EQ(results.stopped.value().by, lighting::Stop::By::kElements);
    EXPECT_LE(results.counts.elements, budget);
    EXPECT_GT(results.accuracy_reached, last);
    EXPECT_GE(c.covered, 0.95);
    EXPECT_LE(c.rms_z, 1.2);
    last = results.accuracy_reached;
  }
  EXPECT_GT(last, 0.02);  // so that status 4 is due
}

TEST(SampleOffice, NoSkyLineIsWhereHeadAndRoofOppositeAreInLine) {
  const auto input = io::read_study(samples_dir() / "office" / "office.toml",
                                    {.kind = lighting::Study::Kind::kDaylight, .set = {"accuracy.target=0.2"}});
  const lighting::GridResult grid = answer(input.study).grids.at(0);
  // The head of the wall's outer edge (y = -0.3, z = 2.4), the roof opposite (y = -18, z = 8.7), sensors at z = 0.8.
  const double y = -0.3 + (2.4 - 0.8) * (18.0 - 0.3) / (8.7 - 2.4);
  double low = 6.0;
  double high = 0.0;
  ASSERT_FALSE(grid.no_sky.empty());
  for (const auto& line : grid.no_sky) {
    for (const mesh::Point& p : line) {
      EXPECT_NEAR(p.y, y, 0.01);
      EXPECT_NEAR(p.z, 0.8, 1e-6);
      low = std::min(low, p.x);
      high = std::max(high, p.x);
    }
  }
  // From wall to wall but for what the partition hides.
  EXPECT_NEAR(low, 0.0, 0.01);
  EXPECT_NEAR(high, 6.0, 0.01);
}

}  // namespace
}  // namespace clerestory::test
