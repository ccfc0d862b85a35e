// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/summary.h"

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "io/lighting_json.h"
#include "io/report_json.h"
#include "io/stopwatch.h"

namespace clerestory::io {

namespace {

double finite(double value, std::string_view name) {
  if (!std::isfinite(value)) throw std::logic_error("'" + std::string(name) + "' is not finite");
  return value;
}

/// An object of numbers, each finite.
Json numbers(std::initializer_list<std::pair<std::string_view, double>> entries) {
  Json object = Json::object();
  for (const auto& [name, value] : entries) object[std::string(name)] = finite(value, name);
  return object;
}

Json head(const ResultContext& context, std::string_view status) {
  Json json;
  json["program"] = kProgram;
  json["version"] = context.version;
  json["status"] = status;
  json["name"] = context.study_name;
  json["kind"] = context.kind == lighting::Study::Kind::kDaylight ? "daylight" : "illuminance";
  json["command"] = context.command;
  json["date"] = context.date;
  return json;
}

Json grid_summary(const lighting::GridResult& grid) {
  const lighting::GridMetrics& m = grid.metrics;
  Json json;
  json["name"] = grid.name;
  if (!grid.moment.empty()) json["moment"] = grid.moment;
  json["sensors"] = grid.sensors.count();
  json["sensors_left_out"] = grid.sensors.left_out;
  json.update(numbers({{"mean_lux", m.mean_lux},
                       {"median_lux", m.median_lux},
                       {"minimum_lux", m.minimum_lux},
                       {"maximum_lux", m.maximum_lux},
                       {"uniformity", m.uniformity}}));
  json["direction"] = grid.direction;
  if (!grid.cylindrical_lux.empty())
    json.update(numbers({{"mean_cylindrical_lux", m.mean_cylindrical_lux}, {"mean_modelling", m.mean_modelling}}));
  if (m.has_daylight_factor)
    json.update(numbers({{"mean_daylight_factor_percent", m.mean_df_percent},
                         {"median_daylight_factor_percent", m.median_df_percent},
                         {"minimum_daylight_factor_percent", m.minimum_df_percent},
                         {"share_above_2_percent", m.share_above_2_percent},
                         {"share_above_5_percent", m.share_above_5_percent}}));
  json["accuracy_reached"] = finite(m.accuracy_reached, "accuracy_reached");
  json["share_within_twice_the_accuracy"] = finite(m.share_within_twice, "share_within_twice_the_accuracy");
  json["accuracy_met"] = m.accuracy_met;
  return json;
}

Json grid_summaries(const std::vector<lighting::GridResult>& grids) {
  Json list = Json::array();
  for (const auto& grid : grids) list.push_back(grid_summary(grid));
  return list;
}

Json accuracy(const lighting::Results& results) {
  Json json = numbers({{"asked", results.accuracy_target}, {"reached", results.accuracy_reached}});
  json["met"] = results.accuracy_met;
  json["converged"] = results.converged;
  return json;
}

const char* status_of(const lighting::Results& results) {
  if (results.stopped && results.stopped->by == lighting::Stop::By::kUser) return kStatusPartial;
  return results.accuracy_met ? kStatusDone : kStatusAccuracyNotReached;
}

Json stop_json(const std::optional<lighting::Stop>& stop) {
  if (!stop) return nullptr;
  return {{"by", word_of(stop->by)}, {"phase", stop->phase}};
}

Json energy_balance(const lighting::EnergyBalance& e) {
  return numbers({{"emitted_lm", e.emitted_lm},
                  {"received_lm", e.received_lm},
                  {"absorbed_lm", e.absorbed_lm},
                  {"left_lm", e.left_lm},
                  {"residual", e.residual},
                  {"reciprocity", e.reciprocity},
                  {"closure", e.closure}});
}

Json counts(const lighting::Results::Counts& c) {
  return {{"parts", c.parts},           {"polygons", c.polygons}, {"openings", c.openings},
          {"faces", c.faces},           {"elements", c.elements}, {"links", c.links},
          {"link_bytes", c.link_bytes}, {"rays", c.rays},         {"iterations", c.iterations}};
}

Json ray_figures(std::uint64_t rays, double ray_s, double cpu_s) {
  const auto count = static_cast<double>(rays);
  Json json = numbers(
      {{"per_cpu_second", cpu_s > 0.0 ? count / cpu_s : 0.0}, {"share_of_time", cpu_s > 0.0 ? ray_s / cpu_s : 0.0}});
  json["count"] = rays;
  return json;
}

/// Rays by phase, and of the solution: direct light and linking.
Json rays_json(const std::vector<lighting::PhaseTime>& phases) {
  Json json = Json::object();
  lighting::PhaseTime solve;
  for (const lighting::PhaseTime& phase : phases) {
    if (phase.rays > 0) json[phase.name] = ray_figures(phase.rays, phase.ray_s, phase.cpu_s);
    if (phase.name != "direct light" && phase.name != "linking") continue;
    solve.rays += phase.rays;
    solve.ray_s += phase.ray_s;
    solve.cpu_s += phase.cpu_s;
  }
  json["solve"] = ray_figures(solve.rays, solve.ray_s, solve.cpu_s);
  return json;
}

/// CPU and wall seconds, by phase; the CPU total is the whole process's, start-up included.
Json times(const lighting::Results& results, const RunFigures& figures) {
  Json cpu = Json::object();
  Json wall = Json::object();
  double wall_total = 0.0;
  for (const auto* phases : {&figures.before, &results.phases, &figures.after}) {
    for (const lighting::PhaseTime& phase : *phases) {
      cpu[phase.name] = cpu.value(phase.name, 0.0) + finite(phase.cpu_s, phase.name);
      wall[phase.name] = wall.value(phase.name, 0.0) + finite(phase.wall_s, phase.name);
      wall_total += phase.wall_s;
    }
  }
  cpu["total"] = process_cpu_seconds();
  wall["total"] = wall_total;
  return {
      {"cpu_seconds", cpu}, {"wall_seconds", wall}, {"threads", figures.threads}, {"peak_memory_mb", peak_memory_mb()}};
}

Json study(const ResultContext& context) {
  if (context.effective_study.empty()) return nullptr;
  return Json::parse(context.effective_study);
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos;
}

}  // namespace

std::string summary_json(const lighting::Results& results, const ResultContext& context, const RunFigures& figures) {
  Json json = head(context, status_of(results));
  json["sky"] = context.sky;
  json["horizontal_illuminance_lux"] = finite(results.horizontal_illuminance_lux, "horizontal_illuminance_lux");
  json["accuracy"] = accuracy(results);
  json["stopped"] = stop_json(results.stopped);
  json["grids"] = grid_summaries(results.grids);
  json["observers"] = observers_json(results);
  json["tasks"] = tasks_json(results);
  json["luminaires"] = luminaires_json(results);
  json["energy_balance"] = energy_balance(results.energy);
  json["counts"] = counts(results.counts);
  json["rays"] = rays_json(results.phases);
  if (results.shadow_lines) {
    const lighting::ShadowLines& shadows = *results.shadow_lines;
    json["shadow_lines"] = shadow_lines_json(shadows.selection, shadows.lines.source_names.size());
    json["shadow_lines"]["mesh"] = mesh_json(shadows.mesh);
  }
  json.update(times(results, figures));
  json["parts"] = results.surfaces.part_names;
  json["materials"] = materials_json(results.materials);
  json["material_light"] = material_lights_json(results);
  json["rooms"] = rooms_json(results.rooms);
  json["defects"] = defects_json(results.clean);
  json.update(meetings_json(results.clean));
  json["assumptions"] = without_repeats(results.assumptions);
  json["notices"] = without_repeats(results.notices);
  json["study"] = study(context);
  json["files"] = figures.files;
  return json_text(json);
}

const char* word_of(lighting::Stop::By by) {
  switch (by) {
    case lighting::Stop::By::kTime:
      return "time";
    case lighting::Stop::By::kMemory:
      return "memory";
    case lighting::Stop::By::kElements:
      return "elements";
    case lighting::Stop::By::kUser:
      break;
  }
  return "interruption";
}

std::string failure_json(const ResultContext& context, const std::string& why) {
  Json json = head(context, kStatusFailed);
  json["why"] = why;
  json["study"] = study(context);
  json["files"] = {"summary.json"};
  return json_text(json);
}

std::optional<EarlierSummary> read_earlier_summary(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const Json json = Json::parse(in, nullptr, false);
  if (!json.is_object() || json.value("program", Json()) != kProgram) return std::nullopt;
  EarlierSummary summary;
  const Json status = json.value("status", Json());
  if (status.is_string()) summary.status = status.get<std::string>();
  for (const Json& name : json.value("files", Json::array())) {
    // A path that leads out of the folder can only be a forgery: it is never touched.
    if (name.is_string() && is_plain_name(name.get<std::string>())) summary.files.push_back(name.get<std::string>());
  }
  return summary;
}

}  // namespace clerestory::io
