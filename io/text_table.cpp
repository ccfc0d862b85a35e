// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clerestory::io {

namespace {

std::size_t width_of(const std::string& text) {  // in characters, of UTF-8
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<std::size_t> column_widths(const std::vector<TextRow>& rows) {
  std::vector<std::size_t> widths;
  for (const TextRow& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width_of(row[c]));
  }
  return widths;
}

}  // namespace

std::string text_table(const std::vector<TextRow>& rows, std::string_view sides) {
  const auto widths = column_widths(rows);
  std::string text;
  for (const TextRow& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string blanks(widths[c] - width_of(row[c]), ' ');
      const bool left = sides[std::min(c, sides.size() - 1)] == 'l';
      text += c == 0 ? "" : "  ";
      text += left ? row[c] + blanks : blanks + row[c];
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

std::string figure(double value) {
  const double size = std::abs(value);
  if (size == 0.0) return "0";
  if (size >= 99.95) return fmt::format("{:.0f}", value);
  if (size >= 9.995) return fmt::format("{:.1f}", value);
  if (size >= 0.01) return fmt::format("{:.2f}", value);
  return fmt::format("{:.2g}", value);
}

}  // namespace clerestory::io
