// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clerestory::io {

/// The text without blanks at either end.
std::string_view trim(std::string_view text);

/// The words of a line, between blanks and tabs.
std::vector<std::string_view> split_words(std::string_view text);

/// The words of a name in lower case: they end at blanks, punctuation, digits and at a capital behind a small letter.
std::vector<std::string> name_words(std::string_view name);

/// ASCII letters in lower case; everything else stays.
std::string lower(std::string_view text);

/// A decimal number that takes up the whole text, rounded to the nearest double; a leading + is allowed. Nothing for any other
/// text, for infinities, NaN and what lies beyond the range of double.
std::optional<double> parse_number(std::string_view text);

/// A share as text, "2%" or "0.02"; nothing for any other text.
std::optional<double> parse_share(std::string_view text);

/// The text fit for a message of one line: control characters replaced, long text cut.
std::string printable(std::string_view text);

/// The same between quotation marks.
std::string in_quotes(std::string_view text);

/// Insertions, deletions, replacements and swaps of neighbours that make b out of a.
/// Source: Damerau 1964, in the restricted form (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate that was probably meant: the smallest edit distance, case aside, where that is at most a third of the name
/// (at least 2), or a candidate that begins with the name. Nothing if none is near.
std::optional<std::string> nearest(std::string_view name, std::span<const std::string> candidates);

/// Whether the text holds one of * ? [ that make it a pattern.
bool is_glob(std::string_view text);

/// Whether the name fits the pattern as a shell would match it; case counts.
bool matches_glob(const std::string& pattern, const std::string& name);

/// "a, b, c and 4 more".
std::string list_names(std::span<const std::string> names, std::size_t limit = 12);

}  // namespace clerestory::io
