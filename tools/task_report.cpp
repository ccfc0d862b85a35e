// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/task_report.h"

#include <fmt/format.h>

#include <cmath>

#include "io/csv.h"
#include "io/summary.h"
#include "io/text_table.h"

namespace clerestory::tools {

namespace {

using io::figure;

std::string power(double watts) { return watts > 0.0 ? figure(watts) + " W" : "not stated"; }

std::string luminaires_table(const lighting::Results& results) {
  if (results.luminaires.empty()) return {};
  std::vector<io::TextRow> rows = {{"luminaires", "group", "count", "flux", "power"}};
  for (const lighting::LuminaireUse& use : results.luminaires)
    rows.push_back({use.name, use.group, std::to_string(use.count), figure(use.flux_lm) + " lm", power(use.power_w)});
  std::string text = io::text_table(rows, "llr");
  for (const lighting::RoomPower& room : results.room_power)
    if (room.power_w > 0.0)
      text += fmt::format("{}: {} W installed, {} W/m²\n", room.room, figure(room.power_w), figure(room.per_area_w_m2));
  return text + "\n";
}

std::string observers_table(const lighting::Results& results) {
  if (results.observers.empty()) return {};
  std::vector<io::TextRow> rows = {{"observer", "UGR", "error", "background", "luminaires seen"}};
  for (const lighting::ObserverResult& o : results.observers)
    rows.push_back({io::full_name(o), std::isfinite(o.ugr) ? fmt::format("{:.1f}", o.ugr) : "none",
                    fmt::format("{:.2f}", o.ugr_error), figure(o.background_cd_m2) + " cd/m²",
                    std::to_string(o.glaring)});
  return io::text_table(rows) + "\n";
}

std::string task_table(const lighting::TaskResult& task) {
  const std::string when = task.moment.empty() ? "" : " at " + task.moment;
  std::string text = fmt::format("{}{}, EN 12464-1:2021, {}, in {}: {}\n", task.name, when, task.task, task.room,
                                 io::word_of(task.verdict));
  std::vector<io::TextRow> rows = {{"  criterion", "asked", "found", "error", "verdict"}};
  const auto amount = [](double value, const std::string& unit) {
    return unit.empty() ? fmt::format("{:.2f}", value) : figure(value) + " " + unit;
  };
  for (const lighting::Criterion& c : task.criteria)
    rows.push_back({"  " + c.what, (c.at_most ? "≤ " : "≥ ") + amount(c.required, c.unit), amount(c.found, c.unit),
                    amount(c.error, c.unit), io::word_of(c.verdict)});
  text += io::text_table(rows);
  if (task.power_w_m2_per_100_lux > 0.0)
    text += fmt::format("  {} W/m² per 100 lx on the task area\n", figure(task.power_w_m2_per_100_lux));
  for (const std::string& remark : task.remarks) text += "  " + remark + "\n";
  return text + "\n";
}

}  // namespace

std::string task_report(const lighting::Results& results) {
  std::string text = luminaires_table(results) + observers_table(results);
  for (const lighting::TaskResult& task : results.tasks) text += task_table(task);
  return text;
}

}  // namespace clerestory::tools
