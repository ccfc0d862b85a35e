// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <vector>

#include "io/words.h"

namespace clerestory::io {

namespace {

struct UnitEntry {
  LengthUnit unit;
  std::string_view word;
  double metres;
};

constexpr std::array<UnitEntry, 5> kUnits{{{LengthUnit::kMetre, "m", 1.0},
                                           {LengthUnit::kCentimetre, "cm", 0.01},
                                           {LengthUnit::kMillimetre, "mm", 0.001},
                                           {LengthUnit::kInch, "in", 0.0254},
                                           {LengthUnit::kFoot, "ft", 0.3048}}};

const UnitEntry& entry(LengthUnit unit) {
  return *std::find_if(kUnits.begin(), kUnits.end(), [unit](const UnitEntry& e) { return e.unit == unit; });
}

std::vector<std::string> letter_runs(std::string_view text) {
  std::vector<std::string> runs(1);
  for (const char c : lower(text)) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      runs.back() += c;
    } else if (!runs.back().empty()) {
      runs.emplace_back();
    }
  }
  return runs;
}

std::optional<LengthUnit> unit_by_full_name(std::string word) {
  if (word.ends_with('s')) word.pop_back();
  if (word == "metre" || word == "meter") return LengthUnit::kMetre;
  if (word == "centimetre" || word == "centimeter") return LengthUnit::kCentimetre;
  if (word == "millimetre" || word == "millimeter") return LengthUnit::kMillimetre;
  if (word == "inch" || word == "inche") return LengthUnit::kInch;
  if (word == "foot" || word == "feet") return LengthUnit::kFoot;
  return std::nullopt;
}

}  // namespace

std::optional<LengthUnit> length_unit(std::string_view word) {
  for (const UnitEntry& e : kUnits)
    if (e.word == word) return e.unit;
  return std::nullopt;
}

std::string_view unit_word(LengthUnit unit) { return entry(unit).word; }

double metres_per(LengthUnit unit) { return entry(unit).metres; }

std::optional<LengthUnit> unit_in_comment(std::string_view comment) {
  std::set<LengthUnit> named;
  bool after_units = false;  // short forms count only behind the word "units": "in" and "m" mean too much else
  for (const std::string& word : letter_runs(comment)) {
    if (const auto unit = unit_by_full_name(word)) named.insert(*unit);
    if (after_units) {
      if (const auto unit = length_unit(word)) named.insert(*unit);
    }
    after_units = after_units || word == "unit" || word == "units";
  }
  return named.size() == 1 ? std::optional(*named.begin()) : std::nullopt;
}

LengthUnit guess_unit(double vertical_extent) {
  constexpr double kTallestInMetres = 100.0;
  constexpr double kTallestInCentimetres = 1500.0;
  if (vertical_extent < kTallestInMetres) return LengthUnit::kMetre;
  return vertical_extent < kTallestInCentimetres ? LengthUnit::kCentimetre : LengthUnit::kMillimetre;
}

void to_metres_z_up(mesh::Model& model, LengthUnit unit, UpAxis up) {
  const double scale = metres_per(unit);
  for (mesh::Point& p : model.vertices) {
    if (up == UpAxis::kY) p = {p.x, -p.z, p.y};
    if (unit != LengthUnit::kMetre) p = {scale * p.x, scale * p.y, scale * p.z};
  }
}

}  // namespace clerestory::io
