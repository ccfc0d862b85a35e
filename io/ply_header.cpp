// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ply_header.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <string_view>

#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

constexpr std::size_t kLongestHeader = std::size_t{1} << 20;

struct TypeWord {
  std::string_view word;
  PlyScalar type;
};
constexpr std::array<TypeWord, 16> kTypes{{{"char", PlyScalar::kInt8},
                                           {"int8", PlyScalar::kInt8},
                                           {"uchar", PlyScalar::kUint8},
                                           {"uint8", PlyScalar::kUint8},
                                           {"short", PlyScalar::kInt16},
                                           {"int16", PlyScalar::kInt16},
                                           {"ushort", PlyScalar::kUint16},
                                           {"uint16", PlyScalar::kUint16},
                                           {"int", PlyScalar::kInt32},
                                           {"int32", PlyScalar::kInt32},
                                           {"uint", PlyScalar::kUint32},
                                           {"uint32", PlyScalar::kUint32},
                                           {"float", PlyScalar::kFloat32},
                                           {"float32", PlyScalar::kFloat32},
                                           {"double", PlyScalar::kFloat64},
                                           {"float64", PlyScalar::kFloat64}}};

/// The lines of a header. Binary data follow the last end of line at once and may begin with any byte, so that CR ends lines only where
/// it ends the first one.
class HeaderLines {
 public:
  explicit HeaderLines(std::string_view text) : text_(text) {
    const std::size_t end = text.find_first_of("\r\n");
    if (end != std::string_view::npos && !text.substr(end).starts_with("\r\n")) end_of_line_ = text[end];
  }

  bool next() {
    const std::size_t end = text_.find(end_of_line_, at_);
    if (end == std::string_view::npos) return false;
    line_ = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++number_;
    return true;
  }

  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] std::uint64_t number() const { return number_; }
  [[nodiscard]] std::uint64_t offset() const { return at_; }

 private:
  std::string_view text_;
  char end_of_line_ = '\n';
  std::string_view line_;
  std::size_t at_ = 0;
  std::uint64_t number_ = 0;
};

class HeaderReader {
 public:
  explicit HeaderReader(const std::filesystem::path& path)
      : file_(path.string()), text_(read_head(path, kLongestHeader)), lines_(text_) {}

  PlyHeader read();

 private:
  using Words = std::vector<std::string_view>;

  void read_format(const Words& words);
  void read_element(const Words& words);
  void read_property(const Words& words);
  bool read_name(std::string_view line);
  void read_comment(std::string_view line);
  PlyScalar type(std::string_view word) const;
  void check() const;
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
    throw InputError(file_, lines_.number(), what, hint);
  }

  std::string file_;
  std::string text_;
  HeaderLines lines_;
  PlyHeader header_;
  bool has_format_ = false;
};

PlyHeader HeaderReader::read() {
  if (!lines_.next() || trim(lines_.line()) != "ply")
    throw InputError(file_, 1, "a PLY file begins with the line ply, this one does not", "export it again");
  while (lines_.next()) {
    const Words words = split_words(lines_.line());
    if (words.empty()) continue;
    if (words[0] == "end_header") {
      check();
      header_.lines = lines_.number();
      header_.bytes = lines_.offset();
      return std::move(header_);
    }
    if (words[0] == "format") {
      read_format(words);
    } else if (words[0] == "element") {
      read_element(words);
    } else if (words[0] == "property") {
      read_property(words);
    } else if (words[0] == "comment" || words[0] == "obj_info") {
      read_comment(lines_.line());
    } else {
      fail(fmt::format("{} is no word of a PLY header", in_quotes(words[0])), "correct this line");
    }
  }
  fail("the header does not end: there is no line end_header", "was the file cut off?");
}

void HeaderReader::read_format(const Words& words) {
  const std::string_view word = words.size() < 2 ? std::string_view{} : words[1];
  has_format_ = true;
  if (word == "ascii") {
    header_.encoding = PlyEncoding::kText;
  } else if (word == "binary_little_endian") {
    header_.encoding = PlyEncoding::kLittleEndian;
  } else if (word == "binary_big_endian") {
    header_.encoding = PlyEncoding::kBigEndian;
  } else {
    fail(fmt::format("{} is no encoding of PLY", in_quotes(word)),
         "ascii, binary_little_endian and binary_big_endian are");
  }
}

void HeaderReader::read_element(const Words& words) {
  if (words.size() < 3) fail("an element has a name and a count", "complete this line");
  std::uint64_t count = 0;
  const std::string_view text = words[2];
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc{} || end != text.data() + text.size())
    fail(fmt::format("{} is no count", in_quotes(text)), "correct this line");
  header_.elements.push_back({std::string(words[1]), count, {}, lines_.number()});
}

void HeaderReader::read_property(const Words& words) {
  if (header_.elements.empty()) fail("this property belongs to no element", "put an element before it");
  std::vector<PlyProperty>& properties = header_.elements.back().properties;
  if (words.size() >= 5 && words[1] == "list") {
    const PlyScalar count_type = type(words[2]);
    if (count_type == PlyScalar::kFloat32 || count_type == PlyScalar::kFloat64)
      fail("the count of a list is a whole number", "correct this line");
    properties.push_back({std::string(words[4]), type(words[3]), count_type});
  } else if (words.size() >= 3 && words[1] != "list") {
    properties.push_back({std::string(words[2]), type(words[1]), std::nullopt});
  } else {
    fail("a property has a type and a name", "complete this line");
  }
}

/// "part 0 desk": whether the comment names the next number of its kind.
bool HeaderReader::read_name(std::string_view line) {
  const std::vector<std::string_view> words = split_words(line);
  if (words.size() < 3 || (words[1] != "part" && words[1] != "material")) return false;
  std::vector<std::string>& names = words[1] == "part" ? header_.part_names : header_.material_names;
  if (words[2] != std::to_string(names.size())) return false;
  names.emplace_back(trim(line.substr(static_cast<std::size_t>(words[2].data() + words[2].size() - line.data()))));
  return true;
}

void HeaderReader::read_comment(std::string_view line) {
  if (read_name(line)) return;
  if (header_.unit) return;
  if (const auto unit = unit_in_comment(line.substr(0, 200)))
    header_.unit = ToldUnit{*unit, fmt::format("as line {} of the model says", lines_.number())};
}

PlyScalar HeaderReader::type(std::string_view word) const {
  for (const TypeWord& known : kTypes)
    if (known.word == word) return known.type;
  fail(fmt::format("{} is no type of PLY", in_quotes(word)), "char to double, or int8 to float64");
}

void HeaderReader::check() const {
  if (!has_format_) fail("the header names no format", "add a line as format ascii 1.0");
  for (const PlyElement& element : header_.elements)
    if (element.properties.empty() && element.count > 0)
      throw InputError(file_, element.line, fmt::format("the element {} has no properties", in_quotes(element.name)),
                       "complete the header");
}

}  // namespace

PlyHeader read_ply_header(const std::filesystem::path& path) { return HeaderReader(path).read(); }

}  // namespace clerestory::io
