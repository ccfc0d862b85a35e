// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance_words.h"

#include <algorithm>

#include "io/words.h"

namespace clerestory::io {

namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

/// The word that begins at `at`, which is no blank; moves `at` behind it.
std::string take_word(std::string_view text, std::size_t& at) {
  const char quote = text[at];
  const bool quoted = quote == '"' || quote == '\'';
  if (quoted) ++at;
  const std::size_t end = std::min(quoted ? text.find(quote, at) : text.find_first_of(kBlanks, at), text.size());
  std::string word(text.substr(at, end - at));
  at = quoted ? std::min(end + 1, text.size()) : end;
  return word;
}

}  // namespace

std::vector<std::string> split_quoted(std::string_view text) {
  std::vector<std::string> words;
  std::size_t at = text.find_first_not_of(kBlanks);
  while (at != std::string_view::npos) {
    words.push_back(take_word(text, at));
    at = text.find_first_not_of(kBlanks, at);
  }
  return words;
}

const RadianceWord* RadianceWords::peek(std::size_t ahead) {
  while (ahead_.size() <= ahead)
    if (!read_line()) return nullptr;
  return &ahead_[ahead];
}

RadianceWord RadianceWords::take() {
  peek();
  RadianceWord word = std::move(ahead_.front());
  ahead_.pop_front();
  return word;
}

bool RadianceWords::read_line() {
  if (!lines_.next()) return false;
  const std::uint64_t number = lines_.number();
  std::string_view text = trim(lines_.line());
  if (text.starts_with('!')) {
    std::string command(text.substr(1));
    while (command.ends_with('\\')) {
      command.back() = ' ';
      if (!lines_.next()) break;
      command += trim(lines_.line());
    }
    ahead_.push_back({std::move(command), number, true});
    return true;
  }
  std::size_t at = text.find_first_not_of(kBlanks);
  while (at != std::string_view::npos && text[at] != '#') {
    ahead_.push_back({take_word(text, at), number});
    at = text.find_first_not_of(kBlanks, at);
  }
  return true;
}

}  // namespace clerestory::io
