// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lighting/study.h"

namespace clerestory::io {

struct StudyValue;

/// Bounds of accuracy.target. The finest was reached for sensors in a room without occluders; nothing finer can be seen in single precision
/// and with the rays that a sensor may have.
inline constexpr double kFinestAccuracy = 1e-4;
inline constexpr double kCoarsestAccuracy = 0.5;

/// What may stand as the value of a key.
enum class ValueType {
  kTable,
  kTables,  ///< [[name]]: any number of tables
  kText,
  kTexts,  ///< a text or a list of texts
  kWord,   ///< one of the key's words
  kNumber,
  kNumberOrWord,  ///< a number, or one of the key's words
  kInteger,
  kBoolean,
  kReflectance,    ///< a number, or three for red, green and blue
  kShare,          ///< a number, or a text in per cent: "2%"
  kDates,          ///< a date and time, or a list of them
  kNumbers,        ///< a list of numbers, or of such lists
  kNumbersOrWord,  ///< a list of numbers, or one of the key's words
};

/// One key of the study file. This table is what the reader checks against, takes defaults from, and what docs/study-file.md
/// is written from.
struct StudyKey {
  std::string_view path;  ///< "materials.*.reflectance": * any name; "grids[].name": [] each table of the list
  ValueType type = ValueType::kTable;
  std::string_view unit = {};
  std::string_view fallback = {};  ///< the default in TOML; empty where there is none
  std::string_view meaning = {};
  std::string_view example = {};  ///< where there is no default to serve as one
  double low = -1e9;
  double high = 1e9;
  bool low_excluded = false;
  std::string_view words = {};  ///< that kWord and kNumberOrWord know, between blanks
  std::string_view later = {};  ///< words that belong to the format and that this version refuses
  bool supported = true;        ///< false: belongs to the format; this version refuses any value but the default
};

/// All keys; a table stands before its members.
std::span<const StudyKey> study_keys();

/// The key with that path, nullptr if there is none.
const StudyKey* find_key(std::string_view path);

/// Whether the value is the default of its key.
bool is_default(const StudyKey& key, const StudyValue& value);

/// Checks all keys, types, ranges and words of a study against the table. For the daylight factor the sky's own keys need not be
/// supported, since another sky takes its place.
/// Throws InputError for the first fault, with file, line and the nearest known key.
void check_study(const StudyValue& study, lighting::Study::Kind kind);

/// Writes the default into every key that has one and is not given; a study without [[grids]] gets one grid.
/// The study has been checked.
void fill_defaults(StudyValue& study);

/// The page docs/study-file.md.
std::string study_page();

}  // namespace clerestory::io
