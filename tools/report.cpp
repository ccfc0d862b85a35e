// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/report.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <vector>

#include "io/csv.h"
#include "io/stopwatch.h"
#include "io/summary.h"
#include "io/text_table.h"
#include "tools/task_report.h"

namespace clerestory::tools {

namespace {

using io::figure;

std::string percent(double share) { return figure(100.0 * share) + " %"; }

std::string daylight_table(const std::vector<lighting::GridResult>& grids) {
  std::vector<io::TextRow> rows = {
      {"grid", "sensors", "mean", "median", "minimum", "uniformity", "above 2 %", "above 5 %", "mean lux", "accuracy"}};
  for (const auto& grid : grids) {
    const lighting::GridMetrics& m = grid.metrics;
    rows.push_back({io::full_name(grid), std::to_string(grid.sensors.count()), figure(m.mean_df_percent) + " %",
                    figure(m.median_df_percent) + " %", figure(m.minimum_df_percent) + " %",
                    fmt::format("{:.2f}", m.uniformity), percent(m.share_above_2_percent),
                    percent(m.share_above_5_percent), figure(m.mean_lux), percent(m.accuracy_reached)});
  }
  return io::text_table(rows);
}

std::string illuminance_table(const std::vector<lighting::GridResult>& grids) {
  std::vector<io::TextRow> rows = {
      {"grid", "sensors", "mean", "median", "minimum", "maximum", "uniformity", "accuracy"}};
  for (const auto& grid : grids) {
    const lighting::GridMetrics& m = grid.metrics;
    rows.push_back({io::full_name(grid), std::to_string(grid.sensors.count()), figure(m.mean_lux) + " lx",
                    figure(m.median_lux) + " lx", figure(m.minimum_lux) + " lx", figure(m.maximum_lux) + " lx",
                    fmt::format("{:.2f}", m.uniformity), percent(m.accuracy_reached)});
  }
  return io::text_table(rows);
}

/// Of the grids that have it.
std::string modelling_table(const std::vector<lighting::GridResult>& grids) {
  std::vector<io::TextRow> rows = {{"grid", "mean cylindrical", "mean modelling"}};
  for (const auto& grid : grids) {
    if (grid.cylindrical_lux.empty()) continue;
    rows.push_back({io::full_name(grid), figure(grid.metrics.mean_cylindrical_lux) + " lx",
                    fmt::format("{:.2f}", grid.metrics.mean_modelling)});
  }
  return rows.size() > 1 ? "\n" + io::text_table(rows) : "";
}

std::string heading(const io::ResultContext& context) {
  const bool daylight = context.kind == lighting::Study::Kind::kDaylight;
  return fmt::format("{}: {}, {}\n\n", context.study_name, daylight ? "daylight factor" : "illuminance", context.sky);
}

std::string left_out(const std::vector<lighting::GridResult>& grids) {
  std::string text;
  std::set<std::string_view> told;
  for (const auto& grid : grids)
    if (grid.sensors.left_out > 0 && told.insert(grid.name).second)
      text += fmt::format("{}: {} left out inside solids\n", grid.name,
                          grid.sensors.left_out == 1 ? "1 sensor" : fmt::format("{} sensors", grid.sensors.left_out));
  return text;
}

std::string accuracy_line(const lighting::Results& results) {
  const char* const outcome = results.accuracy_met ? "reached" : results.converged ? "NOT REACHED" : "NOT CONVERGED";
  return fmt::format("accuracy  {} of {} asked: {}\n", percent(results.accuracy_reached),
                     percent(results.accuracy_target), outcome);
}

std::string figures_of_the_run(const lighting::Results& results) {
  const lighting::EnergyBalance& e = results.energy;
  std::string text = accuracy_line(results);
  if (results.stopped)
    text +=
        fmt::format("stopped   by {} in the phase '{}'\n", io::word_of(results.stopped->by), results.stopped->phase);
  text += fmt::format("energy    {} lm emitted and {} lm received = {} lm absorbed and {} lm left, but for {}\n",
                      figure(e.emitted_lm), figure(e.received_lm), figure(e.absorbed_lm), figure(e.left_lm),
                      percent(std::abs(e.residual)));
  text += fmt::format("time      {:.1f} s CPU\n", io::process_cpu_seconds());
  return text;
}

std::string places(const lighting::Results& results, const std::filesystem::path& out) {
  std::string text;
  for (const auto& grid : results.grids)
    text += fmt::format("map       {}\n", (out / (io::full_name(grid) + ".png")).string());
  return text + fmt::format("results   {}\n", (out / "").string());
}

/// Each sentence once, as "label: sentence".
std::string sentences(std::string_view label, const std::vector<std::string>& list) {
  std::string text;
  std::set<std::string_view> said;
  for (const std::string& sentence : list)
    if (said.insert(sentence).second) text += fmt::format("{}: {}\n", label, sentence);
  return text;
}

}  // namespace

std::string report(const lighting::Results& results, const io::ResultContext& context,
                   const std::filesystem::path& out) {
  const bool daylight = context.kind == lighting::Study::Kind::kDaylight;
  return heading(context) + (daylight ? daylight_table(results.grids) : illuminance_table(results.grids)) +
         modelling_table(results.grids) + "\n" + task_report(results) + left_out(results.grids) +
         figures_of_the_run(results) + places(results, out) + sentences("assumed", results.assumptions) +
         sentences("note", results.notices);
}

std::string shortfall(const lighting::Results& results) {
  std::string text;
  if (results.stopped)
    text = fmt::format("stopped by {} in the phase '{}': ", io::word_of(results.stopped->by), results.stopped->phase);
  if (results.accuracy_reached <= results.accuracy_target) {
    const char* const why = results.converged ? "but more than twice that at too many sensors" : "not converged";
    return text +
           fmt::format("{} of {} asked, {}", percent(results.accuracy_reached), percent(results.accuracy_target), why);
  }
  return text + fmt::format("the accuracy of {} was not reached, only {}", percent(results.accuracy_target),
                            percent(results.accuracy_reached));
}

std::string remedy(const lighting::Results& results, bool from_stored) {
  if (results.stopped) {
    switch (results.stopped->by) {
      case lighting::Stop::By::kTime:
        return "give more time by --max-time";
      case lighting::Stop::By::kMemory:
        return "allow more by --max-memory";
      case lighting::Stop::By::kElements:
        return "allow more by mesh.max_elements";
      case lighting::Stop::By::kUser:
        return "run it again, to its end";
    }
  }
  if (from_stored)
    return "the stored solution is too coarse for this: run the study with these grids, light and accuracy";
  return "ask for a finer accuracy by --accuracy, or see which sensors have the largest error_lux";
}

}  // namespace clerestory::tools
