// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

#include "io/text_file.h"

namespace clerestory::io {

/// A number as bytes hold it. Its size is that of the bytes.
template <class Number>
Number number_of_bytes(const unsigned char* bytes, bool big_endian) {
  unsigned char ordered[sizeof(Number)];
  const bool same_order = big_endian == (std::endian::native == std::endian::big);
  for (std::size_t i = 0; i < sizeof(Number); ++i) ordered[i] = bytes[same_order ? i : sizeof(Number) - 1 - i];
  Number number;
  std::memcpy(&number, ordered, sizeof(Number));
  return number;
}

/// A binary file from front to back in constant memory.
class ByteReader {
 public:
  /// Throws InputError where open_file() does.
  ByteReader(const std::filesystem::path& path, std::string_view kind, std::uint64_t offset = 0);

  /// Whether there were so many bytes; where not, the file is at its end. Throws MachineError where reading fails.
  bool read(unsigned char* bytes, std::size_t count);

  [[nodiscard]] std::uint64_t offset() const { return offset_; }   ///< bytes read so far
  [[nodiscard]] std::uint64_t size() const { return size_; }       ///< of the file
  [[nodiscard]] const std::string& file() const { return file_; }  ///< as the user named it

 private:
  std::string file_;
  FileStream stream_;
  std::uint64_t size_ = 0;
  std::uint64_t offset_ = 0;
};

}  // namespace clerestory::io
