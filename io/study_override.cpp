// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/study_schema.h"
#include "io/study_tree.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

constexpr const char* kForm = "write --set table.key=value, for example --set accuracy.target=0.05";

/// The steps of a dotted path; a step in quotation marks may hold dots and equals signs.
struct Path {
  std::vector<std::string> steps;
  std::size_t end = 0;  // of the path in the text: where the equals sign stands
};

Path parse_path(const std::string& text, const std::string& place) {
  Path path;
  path.steps.emplace_back();
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      const std::size_t close = text.find(c, i + 1);
      if (close == std::string::npos) throw InputError(place, 0, "a quotation mark is not closed", kForm);
      path.steps.back() += text.substr(i + 1, close - i - 1);
      i = close;
    } else if (c == '=') {
      path.end = i;
      break;
    } else if (c == '.') {
      path.steps.emplace_back();
    } else if (c != ' ' && c != '\t') {
      path.steps.back() += c;
    }
  }
  const bool hollow =
      std::any_of(path.steps.begin(), path.steps.end(), [](const std::string& step) { return step.empty(); });
  if (path.end == 0 || hollow) throw InputError(place, 0, "this is no setting", kForm);
  return path;
}

/// What TOML makes of the text; a text that is no value of TOML stands for itself.
StudyValue setting_value(const std::string& text, const std::string& place) {
  const std::string_view trimmed = trim(text);
  if (trimmed.empty()) throw InputError(place, 0, "the value is missing", kForm);
  const bool structured = std::string_view("\"'[{").find(trimmed.front()) != std::string_view::npos;
  try {
    return parse_value(trimmed, place);
  } catch (const InputError&) {
    if (structured) throw;
  }
  StudyValue value;
  value.kind = StudyValue::Kind::kText;
  value.text = std::string(trimmed);
  value.file = place;
  return value;
}

StudyValue& child_of_array(StudyValue& array, const std::string& step, const std::string& place) {
  const auto index = parse_number(step);
  const auto count = static_cast<double>(array.children.size());
  if (!index || *index < 0.0 || *index > count || *index != static_cast<double>(static_cast<std::size_t>(*index)))
    throw InputError(
        place, 0,
        fmt::format("{} is a list of {}, and {} is no item of it", in_quotes(array.key), count, in_quotes(step)),
        "count its items from 0");
  if (*index == count) {
    array.children.emplace_back();
    array.children.back().file = place;
  }
  return array.children[static_cast<std::size_t>(*index)];
}

StudyValue& child_of_table(StudyValue& table, const std::string& step, const std::string& place) {
  if (StudyValue* child = table.find(step)) return *child;
  table.children.emplace_back();
  StudyValue& child = table.children.back();
  child.key = step;
  child.file = place;
  if (find_key(step + "[]") != nullptr) child.kind = StudyValue::Kind::kArray;
  return child;
}

/// Lines mean nothing on the command line.
void forget_lines(StudyValue& value) {
  value.line = 0;
  for (StudyValue& child : value.children) forget_lines(child);
}

}  // namespace

void apply_override(StudyValue& study, const std::string& setting) {
  const std::string place = "--set " + printable(setting);
  const Path path = parse_path(setting, place);
  StudyValue value = setting_value(setting.substr(path.end + 1), place);
  StudyValue* at = &study;
  for (std::size_t i = 0; i < path.steps.size(); ++i) {
    if (at->kind == StudyValue::Kind::kArray) {
      at = &child_of_array(*at, path.steps[i], place);
    } else if (at->kind == StudyValue::Kind::kTable) {
      at = &child_of_table(*at, path.steps[i], place);
    } else {
      throw InputError(place, 0, fmt::format("{} is no table", in_quotes(path.steps[i - 1])), "the path ends there");
    }
  }
  value.key = at->key;
  value.line = 0;
  *at = std::move(value);
}

void replace_grids(StudyValue& study, const std::vector<std::string>& grids) {
  StudyValue list;
  list.kind = StudyValue::Kind::kArray;
  list.key = "grids";
  list.file = "--grid";
  for (const std::string& keys : grids) {
    const std::string place = "--grid " + printable(keys);
    try {
      list.children.push_back(parse_value("{" + keys + "}", place));
    } catch (const InputError& fault) {
      throw InputError(place, 0, fault.problem(),
                       "write keys of [[grids]], as in --grid 'name = \"desks\", surface = \"desk*\"'");
    }
    list.children.back().key.clear();
    forget_lines(list.children.back());
  }
  if (StudyValue* own = study.find(list.key))
    *own = std::move(list);
  else
    study.children.push_back(std::move(list));
}

}  // namespace clerestory::io
