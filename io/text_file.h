// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_encoding.h"

namespace clerestory::io {

/// Throws InputError unless the path names a regular file: missing, a folder, a device or a pipe. `kind` is what the file
/// should be, for the message: "model", "study".
void require_file(const std::filesystem::path& path, std::string_view kind);

/// Throws InputError where require_file() does, and for a file over `limit` bytes.
void require_file_of_at_most(const std::filesystem::path& path, std::string_view kind, std::uint64_t limit);

struct CloseFile {
  void operator()(std::FILE* stream) const { std::fclose(stream); }
};
using FileStream = std::unique_ptr<std::FILE, CloseFile>;

/// A file opened to be read. Throws InputError where require_file() does, and where the file may not be read.
FileStream open_file(const std::filesystem::path& path, std::string_view kind);

/// The first bytes of a file, at most `most`: what they are tells a format. Throws as require_file() does.
std::string read_head(const std::filesystem::path& path, std::size_t most);

/// The whole of a text file in UTF-8, without a byte-order mark; a file that one marks as UTF-16 is decoded.
/// Throws InputError where open_file() does, and for files over `limit` bytes.
std::string read_text_file(const std::filesystem::path& path, std::string_view kind, std::uint64_t limit);

/// A text file line by line in constant memory. Ends of line are LF, CRLF or CR. Lines come in UTF-8: a file that a byte-order mark
/// says to be in UTF-16 is decoded, a line that is no UTF-8 is taken as Windows-1252.
class LineReader {
 public:
  /// Throws InputError where open_file() does. Every member throws InputError for bytes that no text has, and for a line of
  /// over 64 MiB.
  LineReader(const std::filesystem::path& path, std::string_view kind);
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  /// Moves to the next line; false at the end of the file.
  bool next();
  /// As next(), but a line that ends in a backslash is joined with the one after it. number() is that of the first.
  bool next_continued();

  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] std::uint64_t number() const { return number_; }   ///< 1-based
  [[nodiscard]] const std::string& file() const { return file_; }  ///< as the user named it

 private:
  bool fill();
  void append(const char* begin, const char* end);
  bool fill_from_utf16();
  void obey_byte_order_mark();
  bool read_line();

  std::string file_;
  FileStream stream_;
  std::vector<char> raw_;  // as the file has it
  std::optional<Utf16Decoder> utf16_;
  std::string decoded_;      // of raw_, where that is in UTF-16
  std::string_view buffer_;  // what is being cut into lines: raw_ or decoded_
  std::size_t at_ = 0;
  bool after_return_ = false;  // the last line ended in CR: an LF that follows belongs to it
  std::uint64_t lines_read_ = 0;
  std::uint64_t number_ = 0;
  std::string line_;
};

}  // namespace clerestory::io
