// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study_schema.h"
#include "io/study_tree.h"

namespace clerestory::io {

namespace {

StudyValue& add_child(StudyValue& parent, std::string_view key, StudyValue value) {
  value.key = key;
  parent.children.push_back(std::move(value));
  return parent.children.back();
}

/// Fills the default of one key into all places below `at` that the rest of its path names. A table that is not there is
/// made at the top only: nobody who gives a reflectance wants a glazing with its defaults beside it.
void fill(StudyValue& at, std::string_view path, const StudyKey& key, bool at_top) {
  const std::size_t dot = path.find('.');
  std::string_view step = path.substr(0, dot);
  if (dot == std::string_view::npos) {
    if (at.find(step) == nullptr) add_child(at, step, parse_value(key.fallback, {}));
    return;
  }
  const std::string_view rest = path.substr(dot + 1);
  if (step == "*") {
    for (StudyValue& child : at.children) fill(child, rest, key, false);
    return;
  }
  const bool list = step.ends_with("[]");
  if (list) step.remove_suffix(2);
  StudyValue* child = at.find(step);
  if (child == nullptr && at_top && !list) child = &add_child(at, step, {});
  if (child == nullptr) return;
  if (!list) return fill(*child, rest, key, false);
  for (StudyValue& item : child->children) fill(item, rest, key, false);
}

void add_default_grid(StudyValue& study) {
  StudyValue* grids = study.find("grids");
  if (grids == nullptr) {
    StudyValue empty;
    empty.kind = StudyValue::Kind::kArray;
    grids = &add_child(study, "grids", std::move(empty));
  }
  if (grids->children.empty()) grids->children.emplace_back();
}

/// Where sensors are given one by one, nothing is laid out over a surface. What the user gave stays, to be refused.
void drop_layout_of_given_points(StudyValue& study) {
  for (StudyValue& grid : study.find("grids")->children) {
    if (grid.find("points") == nullptr) continue;
    std::erase_if(grid.children, [](const StudyValue& member) { return !member.is_given() && member.key != "name"; });
  }
}

}  // namespace

void fill_defaults(StudyValue& study) {
  add_default_grid(study);
  for (const StudyKey& key : study_keys())
    if (!key.fallback.empty()) fill(study, key.path, key, true);
  drop_layout_of_given_points(study);
}

}  // namespace clerestory::io
