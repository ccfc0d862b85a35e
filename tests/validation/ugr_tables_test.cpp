// SPDX-License-Identifier: GPL-3.0-or-later
// UGR tables of eleven luminaires against those that two lighting programs print for them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>
#include <vector>

#include "io/eulumdat.h"
#include "lighting/ugr_table.h"
#include "tests/support/places.h"

namespace clerestory {
namespace {

using lighting::kUgrRooms;

/// A table of another program; NaN where it prints a bound alone.
std::vector<std::vector<double>> read_table(const std::string& name) {
  std::ifstream in(test::shared_data_dir() / "photometry-ugr-tables" / name);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::vector<double> row;
    for (std::string word; std::getline(words, word, ',');)
      row.push_back(word.starts_with('<') ? std::numeric_limits<double>::quiet_NaN() : std::stod(word));
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

/// How a table compares where both programs have values.
struct Agreement {
  int together = 0;       ///< cells where the programs agree within 0.5
  int together_near = 0;  ///< of those, within 0.5 of one of them
  int apart = 0;          ///< cells where they do not
  int apart_near = 0;     ///< of those, within 1.0 of one of them
  double worst = 0.0;
};

void compare(const std::string& number, Agreement& sum) {
  const auto photometry =
      io::read_eulumdat(test::shared_data_dir() / "photometry-ugr-tables" / ("sample_" + number + ".ldt"));
  const auto table = lighting::ugr_table(lighting::web_of(photometry), photometry.opening, true);
  const auto dialux = read_table("ugr_table_" + number + "_Dialux.csv");
  const auto relux = read_table("ugr_table_" + number + "_Relux.csv");
  ASSERT_EQ(dialux.size(), kUgrRooms.size());
  double worst = 0.0;
  for (std::size_t r = 0; r < kUgrRooms.size(); ++r) {
    for (std::size_t c = 0; c < table[r].size(); ++c) {
      const double d = dialux[r].at(c);
      const double x = relux[r].at(c);
      if (std::isnan(d) || std::isnan(x)) continue;
      const double off = std::min(std::abs(table[r][c] - d), std::abs(table[r][c] - x));
      worst = std::max(worst, off);
      if (std::abs(d - x) <= 0.5) {
        ++sum.together;
        sum.together_near += off <= 0.5 ? 1 : 0;
      } else {
        ++sum.apart;
        sum.apart_near += off <= 1.0 ? 1 : 0;
      }
    }
  }
  sum.worst = std::max(sum.worst, worst);
  std::cout << fmt::format("[ FIGURES  ] luminaire {}: worst {:.2f}\n", number, worst);
}

TEST(UgrTables, AreThoseOfTheProgramsForTenLuminaires) {
  CLERESTORY_NEEDS_SHARED_DATA("photometry-ugr-tables");
  Agreement sum;
  // On luminaire 06 the programs differ by up to 3.7: it is reported below.
  for (const char* number : {"01", "02", "03", "04", "05", "07", "08", "09", "10", "11"}) compare(number, sum);
  std::cout << fmt::format(
      "[ FIGURES  ] within 0.5: {} of {} where the programs agree; within 1.0: {} of {} elsewhere; worst {:.2f}\n",
      sum.together_near, sum.together, sum.apart_near, sum.apart, sum.worst);
  EXPECT_GE(sum.together_near, 0.95 * sum.together);
  EXPECT_EQ(sum.apart_near, sum.apart);
}

TEST(UgrTables, OfTheLuminaireOnWhichTheProgramsDifferAreReported) {
  CLERESTORY_NEEDS_SHARED_DATA("photometry-ugr-tables");
  Agreement sum;
  compare("06", sum);
  EXPECT_GT(sum.together + sum.apart, 0);
}

}  // namespace
}  // namespace clerestory
