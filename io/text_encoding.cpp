// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text_encoding.h"

#include <algorithm>
#include <array>

namespace clerestory::io {

namespace {

constexpr std::uint32_t kReplacement = 0xFFFD;

/// What Windows-1252 has in place of the control characters 0x80 to 0x9F.
constexpr std::array<std::uint16_t, 32> kWindows1252{0x20AC, 0xFFFD, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                                     0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0xFFFD, 0x017D, 0xFFFD,
                                                     0xFFFD, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                                     0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0xFFFD, 0x017E, 0x0178};

bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }
bool is_surrogate(std::uint32_t unit) { return unit >= 0xD800 && unit < 0xE000; }
bool is_high_surrogate(std::uint32_t unit) { return unit >= 0xD800 && unit < 0xDC00; }

char byte(std::uint32_t bits) { return static_cast<char>(static_cast<unsigned char>(bits)); }

/// The bytes of the character that begins the text; 0 where it is no UTF-8.
std::size_t character_bytes(std::string_view text) {
  const auto at = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = at(0);
  if (first < 0x80) return 1;
  const std::size_t count = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < count) return 0;
  for (std::size_t i = 1; i < count; ++i)
    if ((at(i) & 0xC0U) != 0x80) return 0;
  const bool too_long = (first == 0xE0 && at(1) < 0xA0) || (first == 0xF0 && at(1) < 0x90);
  const bool no_character = (first == 0xED && at(1) >= 0xA0) || (first == 0xF4 && at(1) >= 0x90);
  return too_long || no_character ? 0 : count;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t count = character_bytes(text);
    if (count == 0) return false;
    text.remove_prefix(count);
  }
  return true;
}

}  // namespace

bool is_utf16(std::string_view text) { return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"); }

void append_utf8(std::uint32_t character, std::string& text) {
  if (character > 0x10FFFF || is_surrogate(character)) character = kReplacement;
  if (character < 0x80) {
    text += byte(character);
  } else if (character < 0x800) {
    text += byte(0xC0U | (character >> 6U));
    text += byte(0x80U | (character & 0x3FU));
  } else if (character < 0x10000) {
    text += byte(0xE0U | (character >> 12U));
    text += byte(0x80U | ((character >> 6U) & 0x3FU));
    text += byte(0x80U | (character & 0x3FU));
  } else {
    text += byte(0xF0U | (character >> 18U));
    text += byte(0x80U | ((character >> 12U) & 0x3FU));
    text += byte(0x80U | ((character >> 6U) & 0x3FU));
    text += byte(0x80U | (character & 0x3FU));
  }
}

void Utf16Decoder::append(std::string_view bytes, std::string& text) {
  for (const char c : bytes) {
    const auto value = static_cast<unsigned char>(c);
    if (!has_odd_byte_) {
      odd_byte_ = value;
      has_odd_byte_ = true;
      continue;
    }
    has_odd_byte_ = false;
    const std::uint32_t first = odd_byte_;
    append_unit(big_endian_ ? (first << 8U) | value : (std::uint32_t{value} << 8U) | first, text);
  }
}

void Utf16Decoder::append_unit(std::uint32_t unit, std::string& text) {
  const bool is_low = is_surrogate(unit) && !is_high_surrogate(unit);
  if (high_surrogate_ != 0 && is_low) {
    append_utf8(0x10000 + ((high_surrogate_ - 0xD800) << 10U) + (unit - 0xDC00), text);
    high_surrogate_ = 0;
    return;
  }
  if (high_surrogate_ != 0) append_utf8(kReplacement, text);
  high_surrogate_ = is_high_surrogate(unit) ? unit : 0;
  if (high_surrogate_ == 0) append_utf8(unit, text);
}

void Utf16Decoder::finish(std::string& text) {
  if (has_odd_byte_ || high_surrogate_ != 0) append_utf8(kReplacement, text);
  has_odd_byte_ = false;
  high_surrogate_ = 0;
}

void make_utf8(std::string& text) {
  if (std::all_of(text.begin(), text.end(), is_ascii) || is_utf8(text)) return;
  std::string result;
  for (const char c : text) {
    const std::uint32_t value = static_cast<unsigned char>(c);
    append_utf8(value >= 0x80 && value < 0xA0 ? kWindows1252[value - 0x80] : value, result);
  }
  text = std::move(result);
}

}  // namespace clerestory::io
