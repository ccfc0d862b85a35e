// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dxf_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

constexpr int kTypeCode = 0;
constexpr int kCommentCode = 999;

template <class Whole>
std::optional<Whole> parse_whole(std::string_view text, int base = 10) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Whole value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return result;
}

/// Files of before 2007 write letters that their code page lacks as \U+XXXX.
std::string resolve_escapes(std::string_view text) {
  constexpr std::size_t kEscapeSize = 7;
  std::string result;
  while (!text.empty()) {
    const bool escape = text.starts_with("\\U+") || text.starts_with("\\u+");
    const auto character =
        escape && text.size() >= kEscapeSize ? parse_whole<std::uint32_t>(text.substr(3, 4), 16) : std::nullopt;
    if (character && *character >= 0x20) {
      append_utf8(*character, result);
      text.remove_prefix(kEscapeSize);
    } else {
      result += text.front();
      text.remove_prefix(1);
    }
  }
  return result;
}

}  // namespace

const DxfGroup* DxfRecord::find(int code) const {
  const auto at = std::find_if(groups.begin(), groups.end(), [code](const DxfGroup& g) { return g.code == code; });
  return at == groups.end() ? nullptr : &*at;
}

std::string DxfRecord::text(int code) const {
  const DxfGroup* group = find(code);
  return group == nullptr ? std::string{} : resolve_escapes(group->text);
}

double DxfRecord::number(int code, double otherwise) const {
  const DxfGroup* group = find(code);
  return group == nullptr ? otherwise : number(*group);
}

std::int64_t DxfRecord::whole(int code, std::int64_t otherwise) const {
  const DxfGroup* group = find(code);
  return group == nullptr ? otherwise : whole(*group);
}

mesh::Point DxfRecord::point(int code) const {
  for (const int needed : {code, code + 10})
    if (find(needed) == nullptr)
      fail(line, fmt::format("this {} has no group {}, which is a coordinate", type, needed), "export it again");
  return {number(code, 0.0), number(code + 10, 0.0), number(code + 20, 0.0)};
}

double DxfRecord::number(const DxfGroup& group) const {
  const auto value = parse_number(group.text);
  if (!value) fail(group.line, fmt::format("{} is no finite number", in_quotes(group.text)), "correct this line");
  return *value;
}

std::int64_t DxfRecord::whole(const DxfGroup& group) const {
  const auto value = parse_whole<std::int64_t>(group.text);
  if (!value) fail(group.line, fmt::format("{} is no whole number", in_quotes(group.text)), "correct this line");
  return *value;
}

void DxfRecord::fail(std::uint64_t at_line, const std::string& what, const std::string& hint) const {
  throw InputError(file, at_line, what, hint);
}

DxfRecords::DxfRecords(const std::filesystem::path& path) : lines_(path, "model") {
  record_.file = lines_.file();
  next_ = read_group();
  if (next_ && next_->code != kTypeCode)
    throw InputError(lines_.file(), next_->line - 1, "a DXF file begins with a group of code 0", "export it again");
}

bool DxfRecords::next(bool keep_groups) {
  if (!next_) return false;
  record_.type = upper(next_->text);
  record_.line = next_->line;
  record_.groups.clear();
  while ((next_ = read_group())) {
    if (next_->code == kTypeCode) break;
    if (keep_groups) record_.groups.push_back(std::move(*next_));
  }
  return true;
}

std::optional<DxfGroup> DxfRecords::read_group() {
  DxfGroup group;
  do {
    if (!lines_.next()) return std::nullopt;
    const std::string_view word = trim(lines_.line());
    if (word.empty() && !lines_.next()) return std::nullopt;  // an empty line at the end of the file
    const auto code = parse_whole<int>(trim(lines_.line()));
    if (!code)
      throw InputError(lines_.file(), lines_.number(),
                       fmt::format("{} stands where the code of a group should", in_quotes(trim(lines_.line()))),
                       "export it again, as a text DXF");
    group.code = *code;
    if (!lines_.next())
      throw InputError(lines_.file(), lines_.number(), "the file ends between a code and its value", "was it cut off?");
    group.text = trim(lines_.line());
    group.line = lines_.number();
  } while (group.code == kCommentCode);
  return group;
}

}  // namespace clerestory::io
