// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "io/text_file.h"

namespace clerestory::io {

/// A word of a Radiance scene, or a whole command line.
struct RadianceWord {
  std::string text;         ///< without its quotation marks; of a command what follows the "!"
  std::uint64_t line = 0;   ///< 1-based
  bool is_command = false;  ///< the line began with "!"
};

/// The words of a Radiance scene with any number of words of look-ahead. Comments run from a word that begins with # to the end of
/// the line; a word in quotation marks, single or double, may hold blanks. Throws InputError where LineReader does.
class RadianceWords {
 public:
  explicit RadianceWords(const std::filesystem::path& path) : lines_(path, "Radiance scene") {}

  /// The word `ahead` places on; null behind the end of the file.
  const RadianceWord* peek(std::size_t ahead = 0);
  /// The next word, which must be there.
  RadianceWord take();

  [[nodiscard]] const std::string& file() const { return lines_.file(); }
  [[nodiscard]] std::uint64_t line() const { return lines_.number(); }  ///< the last one read

 private:
  bool read_line();

  LineReader lines_;
  std::deque<RadianceWord> ahead_;
};

/// The words of a text as Radiance and a shell see them: blanks between them, quotation marks around those that hold blanks.
std::vector<std::string> split_quoted(std::string_view text);

}  // namespace clerestory::io
