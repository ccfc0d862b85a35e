// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace clerestory::io {

/// Whether the text begins with a byte-order mark of UTF-16.
bool is_utf16(std::string_view text);

/// Appends a character; U+FFFD for what is none, as half a surrogate pair.
void append_utf8(std::uint32_t character, std::string& text);

/// Brings UTF-16 to UTF-8, piece by piece: what a piece ends in the midst of is kept for the next one.
class Utf16Decoder {
 public:
  explicit Utf16Decoder(bool big_endian) : big_endian_(big_endian) {}

  void append(std::string_view bytes, std::string& text);
  /// The end of the text: U+FFFD for what is left over.
  void finish(std::string& text);

 private:
  void append_unit(std::uint32_t unit, std::string& text);

  bool big_endian_;
  bool has_odd_byte_ = false;
  unsigned char odd_byte_ = 0;
  std::uint32_t high_surrogate_ = 0;  ///< 0 for none
};

/// Text that is no UTF-8 is taken as Windows-1252, as older CAD programs write it, and brought to UTF-8.
/// Source: Unicode Consortium, cp1252 to Unicode table, version 2.01.
void make_utf8(std::string& text);

}  // namespace clerestory::io
