// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/study_schema.h"
#include "io/study_tree.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

using Kind = StudyValue::Kind;

/// "materials.*.reflectance" without the last step: "materials.*".
std::string_view parent_of(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
}

/// The last step of a path, without the mark of a list.
std::string_view name_of(std::string_view path) {
  std::string_view name = path.substr(path.rfind('.') + 1);
  if (name.ends_with("[]")) name.remove_suffix(2);
  return name;
}

/// How the header of a table is written: [sky], [[grids]].
std::string table_header(std::string_view path) {
  return path.ends_with("[]") ? fmt::format("[[{}]]", path.substr(0, path.size() - 2)) : fmt::format("[{}]", path);
}

bool contains_word(std::string_view words, std::string_view word) {
  const auto list = split_words(words);
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::string joined(std::string_view words) {
  std::string text;
  for (const std::string_view word : split_words(words)) text += (text.empty() ? "" : ", ") + std::string(word);
  return text;
}

bool fits_range(const StudyKey& key, double number) {
  return std::isfinite(number) && number <= key.high && (key.low_excluded ? number > key.low : number >= key.low);
}

std::string range_text(const StudyKey& key) {
  std::string text;
  if (key.low > -1e9) text += fmt::format(" {} {:g}", key.low_excluded ? "over" : "from", key.low);
  if (key.high < 1e9) text += fmt::format(" up to {:g}", key.high);
  if (!key.unit.empty()) text += fmt::format(" [{}]", key.unit);
  return text;
}

std::string expected(const StudyKey& key) {
  switch (key.type) {
    case ValueType::kTable:
      return "a table";
    case ValueType::kTables:
      return fmt::format("tables, [[{}]]", name_of(key.path));
    case ValueType::kText:
      return "a text in quotation marks";
    case ValueType::kTexts:
      return "a text in quotation marks, or a list of them";
    case ValueType::kWord:
      return "one of " + joined(key.words);
    case ValueType::kNumber:
      return "a number" + range_text(key);
    case ValueType::kNumberOrWord:
      return fmt::format("a number{} or \"{}\"", range_text(key), joined(key.words));
    case ValueType::kInteger:
      return "a whole number" + range_text(key);
    case ValueType::kBoolean:
      return "true or false";
    case ValueType::kReflectance:
      return fmt::format("a number{}, or one of them a band: [r, g, b]", range_text(key));
    case ValueType::kShare:
      return fmt::format("a number{}, or a share such as \"2%\"", range_text(key));
    case ValueType::kDates:
      return "a date and time, or a list of them";
    case ValueType::kNumbers:
      return "a list of numbers";
    case ValueType::kNumbersOrWord:
      return "a list of numbers, or one of " + joined(key.words);
  }
  return {};
}

bool all_of_items(const StudyValue& value, bool (*fits)(const StudyValue&)) {
  return value.kind == Kind::kArray && !value.children.empty() &&
         std::all_of(value.children.begin(), value.children.end(), fits);
}

bool fits_reflectance(const StudyKey& key, const StudyValue& value) {
  if (value.is_number()) return fits_range(key, value.number);
  return value.kind == Kind::kArray && !value.children.empty() &&
         std::all_of(value.children.begin(), value.children.end(),
                     [&](const StudyValue& band) { return band.is_number() && fits_range(key, band.number); });
}

bool fits_share(const StudyKey& key, const StudyValue& value) {
  if (value.is_number()) return fits_range(key, value.number);
  const auto share = value.kind == Kind::kText ? parse_share(value.text) : std::nullopt;
  return share && fits_range(key, *share);
}

bool is_text(const StudyValue& value) { return value.kind == Kind::kText; }
bool is_date(const StudyValue& value) { return value.kind == Kind::kDate; }
bool is_number_or_list(const StudyValue& value) { return value.is_number() || value.kind == Kind::kArray; }
bool is_table(const StudyValue& value) { return value.kind == Kind::kTable; }

bool fits(const StudyKey& key, const StudyValue& value) {
  switch (key.type) {
    case ValueType::kTable:
      return value.kind == Kind::kTable;
    case ValueType::kTables:
      return all_of_items(value, is_table) || (value.kind == Kind::kArray && value.children.empty());
    case ValueType::kText:
      return is_text(value);
    case ValueType::kTexts:
      return is_text(value) || all_of_items(value, is_text);
    case ValueType::kWord:
      return is_text(value) && (contains_word(key.words, value.text) || contains_word(key.later, value.text));
    case ValueType::kNumber:
      return value.is_number() && fits_range(key, value.number);
    case ValueType::kNumberOrWord:
      return (value.is_number() && fits_range(key, value.number)) ||
             (is_text(value) && contains_word(key.words, value.text));
    case ValueType::kInteger:
      return value.kind == Kind::kInteger && fits_range(key, value.number);
    case ValueType::kBoolean:
      return value.kind == Kind::kBoolean;
    case ValueType::kReflectance:
      return fits_reflectance(key, value);
    case ValueType::kShare:
      return fits_share(key, value);
    case ValueType::kDates:
      return is_date(value) || all_of_items(value, is_date);
    case ValueType::kNumbers:
      return all_of_items(value, is_number_or_list);
    case ValueType::kNumbersOrWord:
      return all_of_items(value, is_number_or_list) || (is_text(value) && contains_word(key.words, value.text));
  }
  return false;
}

std::string remedy(const StudyKey& key, const StudyValue& value) {
  if (key.type == ValueType::kTables) return fmt::format("write [[{}]] in double brackets", name_of(key.path));
  if (key.type == ValueType::kWord && is_text(value)) {
    std::vector<std::string> words;
    for (const std::string_view list : {key.words, key.later})
      for (const std::string_view word : split_words(list)) words.emplace_back(word);
    if (const auto meant = nearest(value.text, words)) return fmt::format("did you mean \"{}\"?", *meant);
  }
  const std::string_view example = key.fallback.empty() ? key.example : key.fallback;
  if (example.empty()) return "see docs/study-file.md";
  return fmt::format("write for example {} = {}", name_of(key.path), example);
}

class Checker {
 public:
  explicit Checker(lighting::Study::Kind kind) : kind_(kind) {}

  void check_members(const StudyValue& table, const std::string& pattern, const std::string& shown) const {
    for (const StudyValue& member : table.children) check_member(member, pattern, shown);
  }

 private:
  void check_member(const StudyValue& member, const std::string& pattern, const std::string& shown) const {
    const std::string prefix = pattern.empty() ? "" : pattern + ".";
    const std::string name = shown.empty() ? member.key : shown + "." + member.key;
    for (const std::string& path : {prefix + member.key, prefix + member.key + "[]", prefix + "*"}) {
      if (const StudyKey* key = find_key(path)) return check_value(*key, member, name);
    }
    refuse_unknown(member, pattern, shown);
  }

  void check_value(const StudyKey& key, const StudyValue& value, const std::string& name) const {
    check_support(key, value, name);
    if (!fits(key, value))
      throw value.error(fmt::format("{} is {}, expected {}", name, describe(value), expected(key)), remedy(key, value));
    if (key.type == ValueType::kTable) check_members(value, std::string(key.path), name);
    if (key.type != ValueType::kTables) return;
    for (std::size_t i = 0; i < value.children.size(); ++i)
      check_members(value.children[i], std::string(key.path), fmt::format("{}.{}", name, i));
  }

  void check_support(const StudyKey& key, const StudyValue& value, const std::string& name) const {
    if (kind_ == lighting::Study::Kind::kDaylight && key.path.starts_with("sky.")) return;
    if (!key.supported && !is_default(key, value))
      throw value.error(fmt::format("{} is not supported by this version", name), "remove it");
    if (value.kind == Kind::kText && contains_word(key.later, value.text))
      throw value.error(fmt::format("{} = \"{}\" is not supported by this version", name, value.text),
                        "choose one of " + joined(key.words));
  }

  [[noreturn]] static void refuse_unknown(const StudyValue& member, const std::string& pattern,
                                          const std::string& shown) {
    std::vector<std::string> siblings;
    std::vector<std::string> elsewhere;
    for (const StudyKey& key : study_keys()) {
      if (parent_of(key.path) == pattern) siblings.emplace_back(name_of(key.path));
      if (name_of(key.path) == member.key) elsewhere.emplace_back(parent_of(key.path));
    }
    // Of several tables that know the key the least nested is meant.
    std::stable_sort(elsewhere.begin(), elsewhere.end(), [](const std::string& a, const std::string& b) {
      return std::count(a.begin(), a.end(), '.') < std::count(b.begin(), b.end(), '.');
    });
    std::string hint = "docs/study-file.md lists all keys";
    if (const auto meant = nearest(member.key, siblings)) {
      hint = fmt::format("did you mean '{}'?", *meant);
    } else if (!elsewhere.empty() && elsewhere.front().empty()) {
      hint = fmt::format("[{}] is a table of its own", member.key);
    } else if (!elsewhere.empty()) {
      hint = fmt::format("it belongs into {}", table_header(elsewhere.front()));
    } else if (!siblings.empty()) {
      hint = "known are " + list_names(siblings, 12);
    }
    throw member.error(fmt::format("unknown key {} {}", in_quotes(member.key),
                                   shown.empty() ? "at the top of the study" : "in [" + shown + "]"),
                       hint);
  }

  lighting::Study::Kind kind_;
};

}  // namespace

bool is_default(const StudyKey& key, const StudyValue& value) {
  if (key.fallback.empty()) return false;
  const StudyValue fallback = parse_value(key.fallback, {});
  return value.is_number()
             ? value.number == fallback.number
             : value.kind == fallback.kind && value.boolean == fallback.boolean && value.text == fallback.text;
}

void check_study(const StudyValue& study, lighting::Study::Kind kind) { Checker(kind).check_members(study, "", ""); }

}  // namespace clerestory::io
