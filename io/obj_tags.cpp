// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/obj_tags.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

/// Nothing is sharper: OpenSubdiv's sharpness for ever.
constexpr double kSharpest = 10.0;

/// The arguments of one line: "t crease 2/1/0 0 1 4.7" has two integers, a number and no text.
struct TagLine {
  std::vector<std::uint32_t> integers;
  std::vector<double> numbers;
  std::vector<std::string> texts;
};

[[noreturn]] void fail(const ObjPlace& place, const std::string& what, const std::string& hint) {
  throw InputError(place.file, place.line, what, hint);
}

std::optional<std::uint32_t> whole_number(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The three counts of "2/1/0".
std::array<std::size_t, 3> counts_of(std::string_view text, const ObjPlace& place) {
  std::array<std::size_t, 3> counts{};
  std::size_t begin = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t end = k < 2 ? text.find('/', begin) : text.size();
    const auto count = end == std::string_view::npos ? std::nullopt : whole_number(text.substr(begin, end - begin));
    if (!count)
      fail(place, fmt::format("{} does not count the arguments of a tag", in_quotes(text)),
           "write for example `t crease 2/1/0 0 1 3.5`");
    counts[k] = *count;
    begin = end + 1;
  }
  return counts;
}

TagLine split_tag(const std::vector<std::string_view>& words, const ObjPlace& place) {
  if (words.size() < 3) fail(place, "a tag has a name and counts its arguments", "write for example `t hole 1/0/0 4`");
  const auto counts = counts_of(words[2], place);
  if (words.size() - 3 != counts[0] + counts[1] + counts[2])
    fail(place, fmt::format("the tag has {} arguments, and says {}", words.size() - 3, words[2]), "correct the line");
  TagLine line;
  for (std::size_t i = 3; i < words.size(); ++i) {
    if (i - 3 < counts[0]) {
      const auto value = whole_number(words[i]);
      if (!value) fail(place, fmt::format("{} is no whole number from 0", in_quotes(words[i])), "correct the tag");
      line.integers.push_back(*value);
    } else if (i - 3 < counts[0] + counts[1]) {
      const auto value = parse_number(words[i]);
      if (!value) fail(place, fmt::format("{} is no finite number", in_quotes(words[i])), "correct the tag");
      line.numbers.push_back(*value);
    } else {
      line.texts.emplace_back(words[i]);
    }
  }
  return line;
}

/// One sharpness for all, or one for each.
float sharpness(const TagLine& line, std::size_t i, std::size_t count, const ObjPlace& place) {
  if (line.numbers.size() != 1 && line.numbers.size() != count)
    fail(place, fmt::format("the tag gives {} values of sharpness for {}", line.numbers.size(), count),
         "give one, or one for each");
  const double value = line.numbers.size() == 1 ? line.numbers[0] : line.numbers[i];
  if (value < 0.0)
    fail(place, fmt::format("a sharpness of {:g} means nothing", value), "give 0 (smooth) to 10 (sharp)");
  return static_cast<float>(std::min(value, kSharpest));
}

void expect_below(std::uint32_t index, std::size_t count, std::string_view what, const ObjPlace& place) {
  if (index >= count)
    fail(place, fmt::format("{} {} does not exist: {} stand before the tag, counted from 0", what, index, count),
         "correct the tag");
}

void read_crease(const TagLine& line, const ObjPlace& place, mesh::SubdivisionTags& tags) {
  if (line.integers.empty() || line.integers.size() % 2 != 0)
    fail(place, "a crease is given by pairs of vertices", "write for example `t crease 2/1/0 0 1 3.5`");
  for (const std::uint32_t v : line.integers) expect_below(v, place.vertices, "vertex", place);
  const std::size_t count = line.integers.size() / 2;
  for (std::size_t i = 0; i < count; ++i)
    tags.creases.push_back({{line.integers[2 * i], line.integers[2 * i + 1]}, sharpness(line, i, count, place)});
}

void read_corner(const TagLine& line, const ObjPlace& place, mesh::SubdivisionTags& tags) {
  for (std::size_t i = 0; i < line.integers.size(); ++i) {
    expect_below(line.integers[i], place.vertices, "vertex", place);
    tags.corners.push_back({line.integers[i], sharpness(line, i, line.integers.size(), place)});
  }
}

void read_hole(const TagLine& line, const ObjPlace& place, mesh::SubdivisionTags& tags) {
  for (const std::uint32_t face : line.integers) {
    expect_below(face, place.polygons, "face", place);
    tags.holes.push_back(face);
  }
}

mesh::SubdivisionRules& rules_of(mesh::SubdivisionTags& tags, mesh::PartId part) {
  for (auto& told : tags.rules) {
    if (told.part == part) return told.rules;
  }
  tags.rules.push_back({part, {}});
  return tags.rules.back().rules;
}

void read_boundary(const TagLine& line, const ObjPlace& place, mesh::SubdivisionRules& rules) {
  using Boundary = mesh::SubdivisionRules::Boundary;
  constexpr std::array kRules{Boundary::kNone, Boundary::kEdgeAndCorner, Boundary::kEdgeOnly};
  if (line.integers.size() != 1 || line.integers[0] >= kRules.size())
    fail(place, "the boundary rule is one number",
         "give 0 (no surface at the boundary), 1 (sharp edges and corners) or 2 (sharp edges)");
  rules.boundary = kRules[line.integers[0]];
}

/// Which of two words the line has.
bool second_word(const TagLine& line, const ObjPlace& place, std::string_view first, std::string_view second) {
  if (line.texts.size() == 1 && line.texts[0] == second) return true;
  if (line.texts.size() != 1 || line.texts[0] != first)
    fail(place, fmt::format("this tag takes the word {} or {}", first, second), "correct the tag");
  return false;
}

}  // namespace

bool read_obj_tag(const std::vector<std::string_view>& words, const ObjPlace& place, mesh::PartId part,
                  mesh::SubdivisionTags& tags) {
  const TagLine line = split_tag(words, place);
  const std::string_view name = words[1];
  if (name == "crease") {
    read_crease(line, place, tags);
  } else if (name == "corner") {
    read_corner(line, place, tags);
  } else if (name == "hole") {
    read_hole(line, place, tags);
  } else if (name == "interpolateboundary") {
    read_boundary(line, place, rules_of(tags, part));
  } else if (name == "creasemethod") {
    rules_of(tags, part).chaikin_creases = second_word(line, place, "normal", "chaikin");
  } else if (name == "smoothtriangles") {
    rules_of(tags, part).smooth_triangles = second_word(line, place, "catmark", "smooth");
  } else {
    return name.starts_with("facevarying");
  }
  return true;
}

}  // namespace clerestory::io
