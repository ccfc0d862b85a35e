// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mtl.h"

#include <algorithm>

#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

using Words = std::vector<std::string_view>;

double number(const LineReader& reader, std::string_view word) {
  const auto value = parse_number(word);
  if (!value) throw InputError(reader.file(), reader.number(), in_quotes(word) + " is no number", "correct this line");
  return *value;
}

/// The colour behind a keyword: three numbers, or one that stands for all three. Nothing for spectral curves and CIE XYZ.
std::optional<std::array<double, 3>> colour(const LineReader& reader, const Words& words) {
  if (words.size() > 1 && (words[1] == "spectral" || words[1] == "xyz")) return std::nullopt;
  if (words.size() != 2 && words.size() < 4)
    throw InputError(reader.file(), reader.number(),
                     "a colour has three numbers, this line has " + std::to_string(words.size() - 1),
                     "write for example Kd 0.5 0.5 0.5");
  std::array<double, 3> result{};
  for (std::size_t band = 0; band < 3; ++band) {
    result[band] = number(reader, words[words.size() == 2 ? 1 : band + 1]);
    if (result[band] < 0.0)
      throw InputError(reader.file(), reader.number(),
                       "the colour value " + std::string(words[band + 1]) + " is below zero",
                       "give values from 0 to 1");
  }
  return result;
}

/// d and Tr may have an option before the number ("d -halo 0.5").
double factor(const LineReader& reader, const Words& words) {
  if (words.size() < 2)
    throw InputError(reader.file(), reader.number(), "the number is missing", "complete this line, or remove it");
  return std::clamp(number(reader, words.back()), 0.0, 1.0);
}

struct Opacity {
  std::optional<double> dissolve;      // d
  std::optional<double> transparency;  // Tr
};

std::optional<double> opacity(const Opacity& given) {
  if (given.dissolve) return given.dissolve;
  if (!given.transparency) return std::nullopt;
  // Some exporters write Tr with the meaning of d. A surface that is not there at all would not have been exported.
  return *given.transparency == 1.0 ? 1.0 : 1.0 - *given.transparency;
}

void read_statement(const LineReader& reader, const Words& words, SourceMaterial& material, Opacity& given) {
  const std::string keyword = lower(words[0]);
  if (keyword == "kd") material.diffuse = colour(reader, words);
  if (keyword == "d") given.dissolve = factor(reader, words);
  if (keyword == "tr") given.transparency = factor(reader, words);
  if (keyword == "map_kd") material.textured = true;
  if (keyword == "ke") {
    const auto emitted = colour(reader, words);
    material.shines = emitted && *std::max_element(emitted->begin(), emitted->end()) > 0.0;
  }
  material.opacity = opacity(given);
}

}  // namespace

std::vector<SourceMaterial> read_mtl(const std::filesystem::path& path) {
  LineReader reader(path, "MTL file");
  std::vector<SourceMaterial> materials;
  Opacity given;
  while (reader.next_continued()) {
    const std::string_view line = trim(reader.line());
    const Words words = split_words(line);
    if (words.empty() || words[0].starts_with('#')) continue;
    if (words[0] == "newmtl") {
      materials.push_back({.name = std::string(trim(line.substr(words[0].size()))),
                           .file = reader.file(),
                           .line = reader.number(),
                           .diffuse = {},
                           .opacity = {}});
      given = {};
    } else if (!materials.empty()) {
      read_statement(reader, words, materials.back(), given);
    }
  }
  return materials;
}

}  // namespace clerestory::io
