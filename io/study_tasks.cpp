// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "io/study_tables.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

using lighting::TaskRequirements;

lighting::Observer observer_of(const StudyValue& table, std::size_t number) {
  lighting::Observer observer;
  observer.name = printable(text_or(table, "name", fmt::format("observer {}", number)));
  const StudyValue* at = table.find("at");
  if (at == nullptr) throw table.error("this observer has no place", "write for example at = [2.0, 1.5, 1.2]");
  const auto eye = numbers_of(*at, 3, "at = [2.0, 1.5, 1.2]");
  const auto look = numbers_of(*table.find("look"), 3, "look = [0, 1, 0]");
  observer.eye = {eye[0], eye[1], eye[2]};
  observer.look = {look[0], look[1], look[2]};
  if (!(norm(observer.look) > 1e-12))
    throw table.find("look")->error("the direction of this observer's sight is zero", "write look = [0, 1, 0]");
  observer.look = normalized(observer.look);
  return observer;
}

/// Those of the built-in list, and what the study says in their place.
TaskRequirements requirements_of_task(const StudyValue& table) {
  TaskRequirements required;
  if (const StudyValue* word = table.find("task")) {
    required = lighting::requirements_of(*lighting::find_task(word->text));
  } else {
    required.task = "as the study says";
  }
  required.illuminance_lux = number_or(table, "illuminance", required.illuminance_lux);
  required.uniformity = number_or(table, "uniformity", required.uniformity);
  required.ugr = number_or(table, "ugr", required.ugr);
  required.cylindrical_lux = number_or(table, "cylindrical", required.cylindrical_lux);
  required.walls_lux = number_or(table, "walls", required.walls_lux);
  required.ceiling_lux = number_or(table, "ceiling", required.ceiling_lux);
  if (required.illuminance_lux <= 0.0)
    throw table.error("this task asks for no illuminance", "write for example task = \"office-writing\"");
  return required;
}

mesh::Box rectangle_of(const StudyValue& value) {
  const std::string_view form = "rectangle = [[1.0, 1.0], [2.6, 1.8]]";
  if (value.children.size() != 2)
    throw value.error(fmt::format("the rectangle is {}, expected two corners", describe(value)),
                      fmt::format("write {}", form));
  mesh::Box box;
  for (const StudyValue& corner : value.children) {
    const auto p = numbers_of(corner, 2, form);
    box.add(mesh::Point{p[0], p[1], 0.0});
  }
  if (!(box.size().x > 0.0 && box.size().y > 0.0))
    throw value.error("the rectangle has no area", fmt::format("write two opposite corners, {}", form));
  return box;
}

}  // namespace

void read_observers_table(const StudyValue& root, lighting::Study& study) {
  const StudyValue* tables = root.find("observers");
  if (tables == nullptr || study.kind == lighting::Study::Kind::kDaylight) return;
  for (const StudyValue& table : tables->children)
    study.observers.push_back(observer_of(table, study.observers.size() + 1));
}

void read_tasks_table(const StudyValue& root, lighting::Study& study) {
  const StudyValue* tables = root.find("tasks");
  if (tables == nullptr || study.kind == lighting::Study::Kind::kDaylight) return;
  std::set<std::string> taken;
  for (const lighting::GridRequest& grid : study.grids) taken.insert(lower(grid.name));
  for (const StudyValue& table : tables->children) {
    lighting::TaskRequest task;
    task.name = text_or(table, "name", "task");
    check_result_name(table, "task", task.name, taken);
    task.required = requirements_of_task(table);
    task.rooms = text_or(table, "rooms", "*");
    if (const StudyValue* rectangle = table.find("rectangle")) task.rectangle = rectangle_of(*rectangle);
    task.height_m = number_or(table, "height", 0.75);
    task.eye_height_m = number_or(table, "eye_height", 1.2);
    study.tasks.push_back(std::move(task));
  }
}

}  // namespace clerestory::io
