// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clerestory::io {

using TextRow = std::vector<std::string>;

/// Rows of text in UTF-8 as columns two blanks apart, for a reader at a terminal.
/// @param sides  of each column, 'l' or 'r', where its text stands; the last letter counts for all that follow
std::string text_table(const std::vector<TextRow>& rows, std::string_view sides = "lr");

/// Three significant digits, without an exponent where people would not write one.
std::string figure(double value);

}  // namespace clerestory::io
