// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/error.h"

namespace clerestory::io {

/// A value of a study file with the place where it stands: a tree, free of the library that parses it.
struct StudyValue {
  enum class Kind { kTable, kArray, kText, kInteger, kNumber, kBoolean, kDate };

  Kind kind = Kind::kTable;
  std::string key;                   ///< within its table; empty for the root and for the items of an array
  std::vector<StudyValue> children;  ///< of tables and arrays, in the order of the file
  std::string text;                  ///< of text, and of dates as written
  double number = 0.0;               ///< of integers and numbers
  bool boolean = false;
  std::string file;        ///< as the user named it, "--set ..." for overrides, empty for defaults
  std::uint64_t line = 0;  ///< 1-based, 0 where a line means nothing

  [[nodiscard]] const StudyValue* find(std::string_view name) const;
  [[nodiscard]] StudyValue* find(std::string_view name);
  [[nodiscard]] bool is_given() const { return !file.empty(); }  ///< by the user, in the study or beside it
  [[nodiscard]] bool is_number() const { return kind == Kind::kNumber || kind == Kind::kInteger; }

  /// The error that this value is at fault.
  [[nodiscard]] InputError error(const std::string& what, const std::string& hint) const {
    return InputError(file, line, what, hint);
  }
};

/// The members that a checked table may have; nothing or the fallback where it has none of that name.
const StudyValue* find_table(const StudyValue& table, std::string_view name);
double number_or(const StudyValue& table, std::string_view name, double fallback);
std::string text_or(const StudyValue& table, std::string_view name, std::string_view fallback);
bool flag_or(const StudyValue& table, std::string_view name, bool fallback);

/// A list of so many numbers, none beyond 10,000 km.
/// @param form  how to write it, for the message
/// Throws InputError for any other.
std::vector<double> numbers_of(const StudyValue& list, std::size_t count, std::string_view form);

/// How a message repeats a value: 1.2, "text", true, "a table", "a list of 3".
std::string describe(const StudyValue& value);

/// Parses the text of a study file. Throws InputError with the line of the first fault.
StudyValue parse_study(std::string_view text, const std::string& file);

/// Parses one value of TOML, as it stands right of an equals sign. Throws InputError without a line.
StudyValue parse_value(std::string_view text, const std::string& file);

/// Applies an override "grids.0.spacing=0.5" (see ReadOptions::set). Numbers in the path count the items of an array from 0; the
/// number after the last one adds an item. Throws InputError where it has no such form, or steps into something that is no table.
void apply_override(StudyValue& study, const std::string& setting);

/// Puts other grids in the place of a study's (see ReadOptions::grids). Throws InputError where the keys of one are no TOML.
void replace_grids(StudyValue& study, const std::vector<std::string>& grids);

/// The tree as a JSON object, two blanks a level.
std::string to_json(const StudyValue& study);

}  // namespace clerestory::io
