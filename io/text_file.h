// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace clerestory::io {

/// Throws InputError unless the path names a regular file: missing, a folder, a device or a pipe. `kind` is what the file
/// should be, for the message: "model", "study".
void require_file(const std::filesystem::path& path, std::string_view kind);

/// The first bytes of a file, at most `most`: what they are tells a format. Throws as require_file() does.
std::string read_head(const std::filesystem::path& path, std::size_t most);

/// The whole of a text file, without a byte-order mark.
/// Throws InputError where require_file does, for files over `limit` bytes and for text in UTF-16.
std::string read_text_file(const std::filesystem::path& path, std::string_view kind, std::uint64_t limit);

/// A text file line by line in constant memory. Ends of line are LF, CRLF or CR; a byte-order mark of UTF-8 is skipped.
class LineReader {
 public:
  /// Throws InputError where require_file does. Every member throws InputError for UTF-16, for bytes that no text has,
  /// and for a line of over 64 MiB.
  LineReader(const std::filesystem::path& path, std::string_view kind);

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
  void skip_byte_order_mark();
  bool read_line();

  struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };

  std::string file_;
  std::unique_ptr<std::FILE, Close> stream_;
  std::vector<char> buffer_;
  std::size_t at_ = 0;
  std::size_t filled_ = 0;
  bool after_return_ = false;  // the last line ended in CR: an LF that follows belongs to it
  std::uint64_t lines_read_ = 0;
  std::uint64_t number_ = 0;
  std::string line_;
};

}  // namespace clerestory::io
