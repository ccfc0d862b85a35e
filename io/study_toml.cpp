// SPDX-License-Identifier: GPL-3.0-or-later
// The one file that knows the TOML library.
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "io/study_tree.h"

namespace clerestory::io {

namespace {

template <class Date>
std::string as_written(const Date& date) {
  std::ostringstream text;
  text << date;
  return text.str();
}

class TreeBuilder {
 public:
  explicit TreeBuilder(const std::string& file) : file_(file) {}

  StudyValue build(const toml::node& node) const {
    StudyValue value;
    value.file = file_;
    value.line = node.source().begin.line;
    node.visit([&](const auto& typed) { fill(value, typed); });
    return value;
  }

 private:
  void fill(StudyValue& value, const toml::table& table) const {
    value.kind = StudyValue::Kind::kTable;
    std::vector<std::pair<toml::source_position, StudyValue>> members;
    for (const auto& [key, node] : table) {
      StudyValue member = build(node);
      member.key = std::string(key.str());
      member.line = key.source().begin.line;
      members.emplace_back(key.source().begin, std::move(member));
    }
    // The library sorts by name; the user's order decides between globs.
    std::stable_sort(members.begin(), members.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [position, member] : members) value.children.push_back(std::move(member));
  }

  void fill(StudyValue& value, const toml::array& array) const {
    value.kind = StudyValue::Kind::kArray;
    for (const toml::node& node : array) value.children.push_back(build(node));
  }

  static void fill(StudyValue& value, const toml::value<std::string>& text) {
    value.kind = StudyValue::Kind::kText;
    value.text = text.get();
  }
  static void fill(StudyValue& value, const toml::value<std::int64_t>& integer) {
    value.kind = StudyValue::Kind::kInteger;
    value.number = static_cast<double>(integer.get());
  }
  static void fill(StudyValue& value, const toml::value<double>& number) {
    value.kind = StudyValue::Kind::kNumber;
    value.number = number.get();
  }
  static void fill(StudyValue& value, const toml::value<bool>& boolean) {
    value.kind = StudyValue::Kind::kBoolean;
    value.boolean = boolean.get();
  }
  template <class Date>
  static void fill(StudyValue& value, const toml::value<Date>& date) {
    value.kind = StudyValue::Kind::kDate;
    value.text = as_written(date.get());
  }

  std::string file_;
};

}  // namespace

StudyValue parse_study(std::string_view text, const std::string& file) {
  try {
    const toml::table table = toml::parse(text, std::string_view(file));
    return TreeBuilder(file).build(table);
  } catch (const toml::parse_error& fault) {
    std::string what(fault.description());
    std::replace_if(
        what.begin(), what.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    throw InputError(file, fault.source().begin.line, what,
                     "correct this line; the study file is TOML (https://toml.io)");
  }
}

StudyValue parse_value(std::string_view text, const std::string& file) {
  if (text.find_first_of("\r\n") != std::string_view::npos)
    throw InputError(file, 0, "the value has several lines", "write it in one");
  StudyValue table;
  try {
    table = parse_study("value = " + std::string(text), file);
  } catch (const InputError& fault) {
    throw InputError(file, 0, fault.problem(), "write a number, true, \"text\" or a [list]");
  }
  return table.children.front();
}

}  // namespace clerestory::io
