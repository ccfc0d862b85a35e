// SPDX-License-Identifier: GPL-3.0-or-later
// The sample gives the numbers that its README states. They come from the path tracer of tests/support, not from the program.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <regex>

#include "io/study_file.h"
#include "tests/support/places.h"
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

}  // namespace
}  // namespace clerestory::test
