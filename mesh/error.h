// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace clerestory {

/// The user's input is at fault: where, what, and what to do. what() gives it as one line.
class InputError : public std::runtime_error {
 public:
  /// @param file  the file as the user named it; empty where the fault lies in no file
  /// @param line  1-based; 0 where a line means nothing
  InputError(std::string file, std::uint64_t line, std::string what, std::string hint = {})
      : std::runtime_error(compose(file, line, what, hint)),
        file_(std::move(file)),
        line_(line),
        problem_(std::move(what)),
        hint_(std::move(hint)) {}

  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] std::uint64_t line() const { return line_; }
  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] const std::string& hint() const { return hint_; }

 private:
  static std::string compose(const std::string& file, std::uint64_t line, const std::string& what,
                             const std::string& hint) {
    std::string text = file;
    if (line != 0) text += ":" + std::to_string(line);
    if (!text.empty()) text += ": ";
    text += what;
    if (!hint.empty()) text += "; " + hint;
    return text;
  }

  std::string file_;
  std::uint64_t line_;
  std::string problem_;
  std::string hint_;
};

/// The machine failed us: disk full, no permission to write, memory. Exit status 3.
class MachineError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A limit that the user has set was met before there was anything to show. Exit status 4.
class LimitReached : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The user interrupted the run. Exit status 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace clerestory
