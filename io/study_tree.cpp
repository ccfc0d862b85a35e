// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/words.h"

namespace clerestory::io {

namespace {

constexpr double kFarthest = 1e7;  // metres: no building lies farther out

}  // namespace

const StudyValue* StudyValue::find(std::string_view name) const {
  if (kind != Kind::kTable) return nullptr;
  const auto at =
      std::find_if(children.begin(), children.end(), [name](const StudyValue& child) { return child.key == name; });
  return at == children.end() ? nullptr : &*at;
}

StudyValue* StudyValue::find(std::string_view name) { return const_cast<StudyValue*>(std::as_const(*this).find(name)); }

const StudyValue* find_table(const StudyValue& table, std::string_view name) {
  const StudyValue* value = table.find(name);
  return value != nullptr && value->kind == StudyValue::Kind::kTable ? value : nullptr;
}

double number_or(const StudyValue& table, std::string_view name, double fallback) {
  const StudyValue* value = table.find(name);
  return value != nullptr && value->is_number() ? value->number : fallback;
}

std::string text_or(const StudyValue& table, std::string_view name, std::string_view fallback) {
  const StudyValue* value = table.find(name);
  return value != nullptr && value->kind == StudyValue::Kind::kText ? value->text : std::string(fallback);
}

bool flag_or(const StudyValue& table, std::string_view name, bool fallback) {
  const StudyValue* value = table.find(name);
  return value != nullptr && value->kind == StudyValue::Kind::kBoolean ? value->boolean : fallback;
}

std::vector<double> numbers_of(const StudyValue& list, std::size_t count, std::string_view form) {
  std::vector<double> numbers;
  for (const StudyValue& item : list.children) {
    if (item.is_number() && std::abs(item.number) <= kFarthest) numbers.push_back(item.number);
  }
  if (numbers.size() != count || list.children.size() != count)
    throw list.error(
        fmt::format("{} is {}, expected {} numbers", list.key.empty() ? "a place" : list.key, describe(list), count),
        fmt::format("write {}", form));
  return numbers;
}

std::string describe(const StudyValue& value) {
  switch (value.kind) {
    case StudyValue::Kind::kTable:
      return "a table";
    case StudyValue::Kind::kArray:
      return fmt::format("a list of {}", value.children.size());
    case StudyValue::Kind::kText:
      return in_quotes(value.text);
    case StudyValue::Kind::kInteger:
    case StudyValue::Kind::kNumber:
      return fmt::format("{}", value.number);
    case StudyValue::Kind::kBoolean:
      return value.boolean ? "true" : "false";
    case StudyValue::Kind::kDate:
      return value.text;
  }
  return {};
}

}  // namespace clerestory::io
