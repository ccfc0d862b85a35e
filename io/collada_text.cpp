// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/collada_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";

/// From the beginning of one tag to its end; npos for none.
struct Span {
  std::size_t begin = std::string::npos;
  std::size_t end = std::string::npos;
};

bool is_at(std::string_view text, std::size_t at, std::string_view word) { return text.substr(at).starts_with(word); }

/// The end of what begins with < here: a comment, a CDATA section, a declaration, or a tag whose attributes may hold a >.
std::size_t end_of_markup(std::string_view text, std::size_t begin) {
  const auto after = [&](std::string_view closing) {
    const std::size_t at = text.find(closing, begin);
    return at == std::string_view::npos ? text.size() : at + closing.size();
  };
  if (is_at(text, begin, "<!--")) return after("-->");
  if (is_at(text, begin, "<![CDATA[")) return after("]]>");
  if (is_at(text, begin, "<?")) return after("?>");
  for (std::size_t at = begin; at < text.size(); ++at) {
    if (text[at] == '>') return at + 1;
    if (text[at] != '"' && text[at] != '\'') continue;
    at = text.find(text[at], at + 1);
    if (at == std::string_view::npos) break;
  }
  return text.size();
}

/// The next tag of that name, "unit" or "/unit", that begins in [from, to).
Span find_tag(std::string_view text, std::string_view name, std::size_t from, std::size_t to) {
  for (std::size_t at = text.find('<', from); at < to; at = text.find('<', at)) {
    const std::size_t end = end_of_markup(text, at);
    const std::size_t after_name = at + 1 + name.size();
    if (is_at(text, at + 1, name) && after_name < end &&
        (kBlanks.find(text[after_name]) != std::string_view::npos || text[after_name] == '>' ||
         text[after_name] == '/'))
      return {at, end};
    at = end;
  }
  return {};
}

/// The value of an attribute in a tag.
std::optional<std::string_view> attribute(std::string_view tag, std::string_view name) {
  for (std::size_t at = tag.find(name); at != std::string_view::npos; at = tag.find(name, at + 1)) {
    if (at == 0 || kBlanks.find(tag[at - 1]) == std::string_view::npos) continue;
    const std::size_t equals = tag.find_first_not_of(kBlanks, at + name.size());
    if (equals == std::string_view::npos || tag[equals] != '=') continue;
    const std::size_t quote = tag.find_first_not_of(kBlanks, equals + 1);
    if (quote == std::string_view::npos || (tag[quote] != '"' && tag[quote] != '\'')) continue;
    const std::size_t end = tag.find(tag[quote], quote + 1);
    if (end != std::string_view::npos) return trim(tag.substr(quote + 1, end - quote - 1));
  }
  return std::nullopt;
}

std::uint64_t line_of(std::string_view text, std::size_t at) {
  return 1 + static_cast<std::uint64_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

void blank(std::string& text, std::size_t begin, std::size_t end) {
  for (std::size_t at = begin; at < end; ++at)
    if (text[at] != '\n') text[at] = ' ';
}

void take_unit(std::string& document, const Span& tag, const std::string& file, ColladaAsset& asset) {
  const std::string_view text = std::string_view(document).substr(tag.begin, tag.end - tag.begin);
  asset.unit_line = line_of(document, tag.begin);
  if (const auto value = attribute(text, "meter")) {
    asset.metres_per_unit = parse_number(*value);
    if (!asset.metres_per_unit || *asset.metres_per_unit <= 0.0)
      throw InputError(file, asset.unit_line, fmt::format("the unit of {} metres is no length", in_quotes(*value)),
                       "correct it, or remove it and set model.units");
  }
  const bool is_whole = text.ends_with("/>");
  const Span closing = is_whole ? tag : find_tag(document, "/unit", tag.end, document.size());
  blank(document, tag.begin, closing.end == std::string::npos ? tag.end : closing.end);
}

}  // namespace

ColladaAsset take_asset(std::string& document, const std::string& file) {
  ColladaAsset asset;
  const Span begin = find_tag(document, "asset", 0, document.size());
  if (begin.begin == std::string::npos) return asset;
  const Span end = find_tag(document, "/asset", begin.end, document.size());
  if (end.begin == std::string::npos) return asset;
  const Span unit = find_tag(document, "unit", begin.end, end.begin);
  if (unit.begin != std::string::npos) take_unit(document, unit, file, asset);
  const Span up = find_tag(document, "up_axis", begin.end, end.begin);
  const Span up_end = find_tag(document, "/up_axis", begin.end, end.begin);
  if (up.begin == std::string::npos || up_end.begin == std::string::npos || up_end.begin < up.end) return asset;
  const std::string_view axis = trim(std::string_view(document).substr(up.end, up_end.begin - up.end));
  if (axis == "X_UP" || axis == "Y_UP" || axis == "Z_UP") asset.up = axis.front();
  blank(document, up.begin, up_end.end);
  return asset;
}

void move_blanks_back(std::string& document) {
  for (std::size_t at = document.find('<'); at < document.size();) {
    const std::size_t begin = end_of_markup(document, at);
    const std::size_t end = std::min(document.find('<', begin), document.size());
    const std::size_t text = std::min(document.find_first_not_of(kBlanks, begin), end);
    const auto place = [&](std::size_t byte) { return document.begin() + static_cast<std::ptrdiff_t>(byte); };
    if (text < end) std::rotate(place(begin), place(text), place(end));
    at = end;
  }
}

void add_stand_in_material(std::string& document) {
  const Span asset_end = find_tag(document, "/asset", 0, document.size());
  if (asset_end.begin == std::string::npos) return;
  // The importer sorts materials by their ids, and nothing sorts before a single !.
  document.insert(asset_end.end,
                  fmt::format("<library_effects><effect id=\"!\"><profile_COMMON/></effect></library_effects>"
                              "<library_materials><material id=\"!\" name=\"{}\">"
                              "<instance_effect url=\"#!\"/></material></library_materials>",
                              kStandInMaterial));
}

std::optional<std::uint64_t> line_of_element(const std::string& document, const std::string& name) {
  const Span tag = find_tag(document, name, 0, document.size());
  return tag.begin == std::string::npos ? std::nullopt : std::optional(line_of(document, tag.begin));
}

}  // namespace clerestory::io
