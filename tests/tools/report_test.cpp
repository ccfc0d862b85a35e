// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clerestory::tools {
namespace {

using testing::HasSubstr;
using testing::Not;

lighting::Results one_grid() {
  lighting::Results results;
  auto& grid = results.grids.emplace_back();
  grid.name = "workplane";
  grid.sensors.positions = {{0, 0, 0.8}};
  grid.metrics.mean_lux = 215.34;
  grid.metrics.minimum_lux = 30.0;
  grid.metrics.uniformity = 0.139;
  grid.metrics.mean_df_percent = 2.1534;
  grid.metrics.share_above_2_percent = 0.381;
  results.accuracy_target = 0.02;
  results.accuracy_reached = 0.0178;
  results.accuracy_met = true;
  results.energy.received_lm = 1200.0;
  results.energy.residual = -1e-4;
  return results;
}

std::string report_of(const lighting::Results& results, lighting::Study::Kind kind) {
  io::ResultContext context;
  context.study_name = "office";
  context.sky = "CIE overcast sky of 10000 lx";
  context.kind = kind;
  return report(results, context, "out");
}

TEST(Report, ADaylightReportHasDaylightFactors) {
  const std::string text = report_of(one_grid(), lighting::Study::Kind::kDaylight);
  EXPECT_THAT(text, HasSubstr("office: daylight factor, CIE overcast sky of 10000 lx"));
  EXPECT_THAT(text, testing::ContainsRegex("grid +sensors +mean .* above 2 % +above 5 %"));
  EXPECT_THAT(text, testing::ContainsRegex("workplane +1 +2.15 % .* 0.14 +38.1 %"));
}

TEST(Report, AnIlluminanceReportHasLux) {
  const std::string text = report_of(one_grid(), lighting::Study::Kind::kIlluminance);
  EXPECT_THAT(text, testing::ContainsRegex("workplane +1 +215 lx .* 30.0 lx"));
  EXPECT_THAT(text, Not(HasSubstr("above 2 %")));
}

TEST(Report, TellsAccuracyEnergyAndWhereTheMapIs) {
  const std::string text = report_of(one_grid(), lighting::Study::Kind::kDaylight);
  EXPECT_THAT(text, HasSubstr("1.78 % of 2.00 % asked: reached\n"));
  EXPECT_THAT(text, HasSubstr("1200 lm received"));
  EXPECT_THAT(text, HasSubstr("but for 0.01 %"));
  EXPECT_THAT(text, HasSubstr("out/workplane.png\n"));
}

TEST(Report, AnAccuracyThatWasNotReachedStandsOut) {
  auto results = one_grid();
  results.accuracy_met = false;
  EXPECT_THAT(report_of(results, lighting::Study::Kind::kDaylight), HasSubstr("NOT REACHED"));
}

TEST(Report, ARunThatWasStoppedSaysByWhatAndWhere) {
  auto results = one_grid();
  results.stopped = lighting::Stop{lighting::Stop::By::kTime, "linking"};
  results.converged = results.accuracy_met = false;
  const std::string text = report_of(results, lighting::Study::Kind::kDaylight);
  EXPECT_THAT(text, HasSubstr("of 2.00 % asked: NOT CONVERGED\nstopped   by time in the phase 'linking'\n"));
  EXPECT_EQ(shortfall(results), "stopped by time in the phase 'linking': 1.78 % of 2.00 % asked, not converged");
  results.accuracy_reached = 0.04;
  EXPECT_EQ(shortfall(results),
            "stopped by time in the phase 'linking': the accuracy of 2.00 % was not reached, only 4.00 %");
}

TEST(Report, ARunOutOfElementsHasConverged) {
  auto results = one_grid();
  results.stopped = lighting::Stop{lighting::Stop::By::kElements, "linking"};
  EXPECT_THAT(report_of(results, lighting::Study::Kind::kDaylight),
              HasSubstr("of 2.00 % asked: reached\nstopped   by elements in the phase 'linking'\n"));
  results.accuracy_met = false;
  EXPECT_EQ(shortfall(results),
            "stopped by elements in the phase 'linking': 1.78 % of 2.00 % asked, but more than twice that at too many "
            "sensors");
}

TEST(Report, ForWhatWasNotReachedThereIsARemedy) {
  auto results = one_grid();
  EXPECT_THAT(remedy(results, false), HasSubstr("--accuracy"));
  EXPECT_THAT(remedy(results, true), HasSubstr("run the study"));
  results.stopped = lighting::Stop{lighting::Stop::By::kMemory, "linking"};
  EXPECT_THAT(remedy(results, false), HasSubstr("--max-memory"));
  results.stopped = lighting::Stop{lighting::Stop::By::kTime, "linking"};
  EXPECT_THAT(remedy(results, true), HasSubstr("--max-time"));
  results.stopped = lighting::Stop{lighting::Stop::By::kElements, "linking"};
  EXPECT_THAT(remedy(results, false), HasSubstr("mesh.max_elements"));
}

TEST(Report, SaysEachAssumptionAndNoticeOnce) {
  auto results = one_grid();
  results.assumptions = {"units are metres", "units are metres"};
  results.notices = {"no opening"};
  EXPECT_THAT(report_of(results, lighting::Study::Kind::kDaylight),
              testing::EndsWith("results   out/\nassumed: units are metres\nnote: no opening\n"));
}

}  // namespace
}  // namespace clerestory::tools
