// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/lighting_json.h"

#include <cmath>

#include "io/summary.h"

namespace clerestory::io {

namespace {

Json vector_json(double x, double y, double z) { return Json::array({x, y, z}); }

Json observer_json(const lighting::ObserverResult& o, const lighting::Results& results) {
  Json json;
  json["name"] = o.observer.name;
  if (!o.moment.empty()) json["moment"] = o.moment;
  json["at"] = vector_json(o.observer.eye.x, o.observer.eye.y, o.observer.eye.z);
  json["look"] = vector_json(o.observer.look.x, o.observer.look.y, o.observer.look.z);
  json["room"] = o.room ? Json(results.rooms.at(*o.room).name) : Json(nullptr);
  json["ugr"] = std::isfinite(o.ugr) ? Json(o.ugr) : Json(nullptr);
  json["ugr_error"] = o.ugr_error;
  json["background_cd_m2"] = o.background_cd_m2;
  json["indirect_vertical_lux"] = o.indirect_lux;
  json["glaring"] = o.glaring;
  json["under_0.0003_sr"] = o.small;
  json["over_0.1_sr"] = o.large;
  json["without_luminous_area"] = o.without_area;
  return json;
}

Json criterion_json(const lighting::Criterion& c) {
  return {{"what", c.what},   {"unit", c.unit},   {c.at_most ? "at_most" : "at_least", c.required},
          {"found", c.found}, {"error", c.error}, {"verdict", word_of(c.verdict)}};
}

Json task_json(const lighting::TaskResult& task) {
  Json json;
  json["name"] = task.name;
  if (!task.moment.empty()) json["moment"] = task.moment;
  json["standard"] = "EN 12464-1:2021";
  json["task"] = task.task;
  json["room"] = task.room;
  json["verdict"] = word_of(task.verdict);
  json["criteria"] = Json::array();
  for (const lighting::Criterion& c : task.criteria) json["criteria"].push_back(criterion_json(c));
  json["power_w_m2_per_100_lux"] = task.power_w_m2_per_100_lux;
  json["remarks"] = task.remarks;
  json["grids"] = task.grids;
  json["observers"] = task.observers;
  return json;
}

}  // namespace

const char* word_of(lighting::Criterion::Verdict verdict) {
  switch (verdict) {
    case lighting::Criterion::Verdict::kPass:
      return "pass";
    case lighting::Criterion::Verdict::kFail:
      return "fail";
    case lighting::Criterion::Verdict::kUndecided:
      break;
  }
  return "not decided";
}

Json observers_json(const lighting::Results& results) {
  Json list = Json::array();
  for (const lighting::ObserverResult& observer : results.observers) list.push_back(observer_json(observer, results));
  return list;
}

Json tasks_json(const lighting::Results& results) {
  Json list = Json::array();
  for (const lighting::TaskResult& task : results.tasks) list.push_back(task_json(task));
  return list;
}

Json luminaires_json(const lighting::Results& results) {
  Json kinds = Json::array();
  std::size_t count = 0;
  double flux_lm = 0.0;
  double power_w = 0.0;
  for (const lighting::LuminaireUse& use : results.luminaires) {
    kinds.push_back({{"name", use.name},
                     {"group", use.group},
                     {"count", use.count},
                     {"flux_lm", use.flux_lm},
                     {"power_w", use.power_w}});
    count += use.count;
    flux_lm += use.flux_lm;
    power_w += use.power_w;
  }
  Json rooms = Json::array();
  for (const lighting::RoomPower& room : results.room_power)
    rooms.push_back({{"room", room.room},
                     {"luminaires", room.luminaires},
                     {"power_w", room.power_w},
                     {"power_w_m2", room.per_area_w_m2}});
  return {{"kinds", kinds}, {"rooms", rooms}, {"count", count}, {"flux_lm", flux_lm}, {"power_w", power_w}};
}

Json material_lights_json(const lighting::Results& results) {
  Json list = Json::array();
  for (const lighting::MaterialLight& light : results.material_light)
    list.push_back({{"name", light.name},
                    {"area_m2", light.area_m2},
                    {"mean_illuminance_lux", light.illuminance_lux},
                    {"mean_luminance_cd_m2", light.luminance_cd_m2}});
  return list;
}

}  // namespace clerestory::io
