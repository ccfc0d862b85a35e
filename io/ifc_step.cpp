// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ifc_step.h"

#include <charconv>

namespace clerestory::io {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Walks statement by statement; a statement ends at a semicolon outside of strings.
class StepScanner {
 public:
  explicit StepScanner(std::string_view text) : text_(text) {}

  StepOutline scan() {
    StepOutline outline;
    while (next_statement()) {
      if (statement_.front() == '#') {
        add_entity(outline);
      } else if (statement_.starts_with("FILE_SCHEMA")) {
        outline.schema = quoted(statement_);
      } else if (statement_.starts_with("END-ISO-10303-21")) {
        outline.complete = true;
      }
    }
    return outline;
  }

 private:
  bool next_statement() {
    skip_blanks_and_comments();
    if (at_ >= text_.size()) return false;
    line_of_statement_ = line_;
    const std::size_t begin = at_;
    bool in_string = false;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') ++line_;
      if (text_[at_] == '\'') in_string = !in_string;
      if (text_[at_] == ';' && !in_string) break;
    }
    statement_ = text_.substr(begin, at_ - begin);
    ended_ = at_ < text_.size();
    if (ended_) ++at_;
    if (statement_.empty()) statement_ = " ";
    return true;
  }

  void skip_blanks_and_comments() {
    while (at_ < text_.size()) {
      if (text_.substr(at_).starts_with("/*")) {
        const std::size_t end = text_.find("*/", at_ + 2);
        const std::size_t stop = end == std::string_view::npos ? text_.size() : end + 2;
        for (; at_ < stop; ++at_) line_ += text_[at_] == '\n' ? 1 : 0;
      } else if (is_blank(text_[at_])) {
        line_ += text_[at_++] == '\n' ? 1 : 0;
      } else {
        return;
      }
    }
  }

  void add_entity(StepOutline& outline) const {
    int id = 0;
    const auto [end, error] = std::from_chars(statement_.data() + 1, statement_.data() + statement_.size(), id);
    if (error != std::errc{} || !is_digit(statement_[1])) return;
    std::string_view rest(end, static_cast<std::size_t>(statement_.data() + statement_.size() - end));
    while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
    if (rest.starts_with('=') && ended_) outline.lines.emplace(id, line_of_statement_);
  }

  static std::string quoted(std::string_view statement) {
    const std::size_t begin = statement.find('\'');
    if (begin == std::string_view::npos) return {};
    std::string word(statement.substr(begin + 1, statement.find('\'', begin + 1) - begin - 1));
    for (char& c : word)
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return word;
  }

  std::string_view text_;
  std::string_view statement_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 1;
  std::uint64_t line_of_statement_ = 1;
  bool ended_ = false;
};

}  // namespace

StepOutline outline_step(std::string_view text) { return StepScanner(text).scan(); }

}  // namespace clerestory::io
