// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/text_file.h"
#include "mesh/geometry.h"

namespace clerestory::io {

/// A value of a DXF file and the code that says what it means.
struct DxfGroup {
  int code = 0;
  std::string text;
  std::uint64_t line = 0;  ///< of the value
};

/// What stands between two groups of code 0: an entity, an entry of a table, the begin or end of a section. Of groups with one code the
/// first one counts.
struct DxfRecord {
  std::string file;
  std::string type;  ///< in upper case
  std::uint64_t line = 0;
  std::vector<DxfGroup> groups;

  [[nodiscard]] const DxfGroup* find(int code) const;
  /// The text of a group, with \U+XXXX resolved; empty where there is none.
  [[nodiscard]] std::string text(int code) const;
  /// Throw InputError with the line where the value is no finite number, or no whole one of 64 bits.
  [[nodiscard]] double number(int code, double otherwise) const;
  [[nodiscard]] std::int64_t whole(int code, std::int64_t otherwise) const;
  /// The point whose x has this code, y and z that code plus 10 and 20. Throws InputError where there is no x or no y.
  [[nodiscard]] mesh::Point point(int code) const;

  [[nodiscard]] double number(const DxfGroup& group) const;
  [[nodiscard]] std::int64_t whole(const DxfGroup& group) const;
  [[noreturn]] void fail(std::uint64_t at_line, const std::string& what, const std::string& hint) const;
};

/// The records of a text DXF, one at a time.
class DxfRecords {
 public:
  /// Throws InputError where LineReader does.
  explicit DxfRecords(const std::filesystem::path& path);

  /// Moves to the next record; false behind the last. Throws InputError for a code that is no whole number, and for one without a value.
  /// Groups that do not matter are not kept.
  bool next(bool keep_groups = true);

  [[nodiscard]] const DxfRecord& record() const { return record_; }
  [[nodiscard]] std::uint64_t line() const { return lines_.number(); }

 private:
  std::optional<DxfGroup> read_group();

  LineReader lines_;
  DxfRecord record_;
  std::optional<DxfGroup> next_;  // that begins the next record
};

}  // namespace clerestory::io
