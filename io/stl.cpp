// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "io/byte_reader.h"
#include "io/model_builder.h"
#include "io/shared_vertices.h"
#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kCountBytes = 4;
constexpr std::size_t kTriangleBytes = 50;  // normal, three corners, 12 floats in all, and two bytes of attributes
constexpr std::size_t kNormalBytes = 12;
constexpr std::size_t kPrologueBytes = kHeaderBytes + kCountBytes;
constexpr std::size_t kHeadBytes = 1024;  // in which a text STL with a long name has its first facet

std::uint64_t binary_size(std::uint64_t triangles) { return kPrologueBytes + kTriangleBytes * triangles; }

std::uint32_t triangle_count(std::string_view head) {
  std::array<unsigned char, kCountBytes> bytes{};
  std::copy_n(head.begin() + kHeaderBytes, kCountBytes, bytes.begin());
  return number_of_bytes<std::uint32_t>(bytes.data(), false);
}

bool is_binary(const fs::path& path) {
  const std::string head = read_head(path, kHeadBytes);
  if (head.size() >= kPrologueBytes && fs::file_size(path) == binary_size(triangle_count(head))) return true;
  return !is_text_stl(head) && !is_utf16(head) && head.find('\0') != std::string::npos;
}

class BinaryStl {
 public:
  explicit BinaryStl(const fs::path& path)
      : bytes_(path, "model"), builder_(bytes_.file()), part_(path.stem().string()) {}

  ModelFile read(const ModelFormat& format);

 private:
  std::uint64_t read_prologue();
  void read_triangle(std::uint64_t which, std::uint64_t count);

  ByteReader bytes_;
  ModelBuilder builder_;
  SharedVertices vertices_;
  std::string part_;
};

ModelFile BinaryStl::read(const ModelFormat& format) {
  const std::uint64_t count = read_prologue();
  for (std::uint64_t i = 0; i < count; ++i) read_triangle(i, count);
  ModelFile result;
  result.files.emplace_back(bytes_.file());
  if (bytes_.size() > bytes_.offset())
    result.notices.push_back(
        fmt::format("{} bytes behind the last triangle were passed over.", bytes_.size() - bytes_.offset()));
  builder_.finish(result, format, std::nullopt);
  return result;
}

std::uint64_t BinaryStl::read_prologue() {
  std::array<unsigned char, kPrologueBytes> prologue{};
  if (!bytes_.read(prologue.data(), prologue.size()))
    throw InputError(bytes_.file(), 0,
                     fmt::format("a binary STL begins with {} bytes, this file has {}", kPrologueBytes, bytes_.size()),
                     "export it again");
  return number_of_bytes<std::uint32_t>(prologue.data() + kHeaderBytes, false);
}

void BinaryStl::read_triangle(std::uint64_t which, std::uint64_t count) {
  const std::uint64_t start = bytes_.offset();
  std::array<unsigned char, kTriangleBytes> bytes{};
  if (!bytes_.read(bytes.data(), bytes.size()))
    throw InputError(bytes_.file(), 0,
                     fmt::format("the file ends at byte {}, in triangle {} of {}", bytes_.size(), which + 1, count),
                     "export it again; was it cut off, or is it no STL?");
  std::array<std::uint32_t, 3> corners{};
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    std::array<double, 3> xyz{};
    for (std::size_t axis = 0; axis < xyz.size(); ++axis)
      xyz[axis] = number_of_bytes<float>(bytes.data() + kNormalBytes + 4 * (3 * corner + axis), false);
    const mesh::Point p{xyz[0], xyz[1], xyz[2]};
    try {
      corners[corner] = vertices_.index(p, [&] { return builder_.vertex(p); });
    } catch (const InputError& error) {
      throw InputError(error.file(), 0, fmt::format("triangle {} at byte {}: {}", which + 1, start, error.problem()),
                       error.hint());
    }
  }
  builder_.polygon(corners, builder_.material(kUnnamed), builder_.part(part_));
}

/// The words of a text STL; where lines end does not matter but for the names of solids.
class TextStl {
 public:
  explicit TextStl(const fs::path& path)
      : stem_(path.stem().string()), lines_(path, "model"), builder_(lines_.file()) {}

  ModelFile read(const ModelFormat& format);

 private:
  bool next_word();
  void need_word(const char* wanted);
  void read_solid();
  void read_facet();
  void read_vertex();
  void skip_line() { at_ = words_.size(); }
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
    throw InputError(lines_.file(), lines_.number(), what, hint);
  }

  std::string stem_;
  LineReader lines_;
  ModelBuilder builder_;
  SharedVertices vertices_;
  std::vector<std::string_view> words_;  // of the line
  std::size_t at_ = 0;                   // behind the current word
  std::string word_;                     // the current one in lower case
  std::string part_;
  std::vector<std::uint32_t> corners_;
};

bool TextStl::next_word() {
  while (at_ == words_.size()) {
    if (!lines_.next()) return false;
    words_ = split_words(lines_.line());
    at_ = 0;
  }
  word_ = lower(words_[at_++]);
  return true;
}

void TextStl::need_word(const char* wanted) {
  if (!next_word()) fail(fmt::format("the file ends where {} should follow", wanted), "was it cut off?");
  if (word_ != wanted)
    fail(fmt::format("{} stands where {} should", in_quotes(words_[at_ - 1]), wanted), "correct this line");
}

ModelFile TextStl::read(const ModelFormat& format) {
  need_word("solid");
  do {
    if (word_ != "solid")
      fail(fmt::format("{} stands where a solid should begin", in_quotes(words_[at_ - 1])), "correct this line");
    read_solid();
  } while (next_word());
  ModelFile result;
  result.files.emplace_back(lines_.file());
  builder_.finish(result, format, std::nullopt);
  return result;
}

void TextStl::read_solid() {
  const std::string_view line = lines_.line();
  const std::string name(
      trim(line.substr(static_cast<std::size_t>(word_.size() + words_[at_ - 1].data() - line.data()))));
  part_ = name.empty() ? stem_ : name;
  skip_line();
  while (next_word()) {
    if (word_ == "facet") {
      read_facet();
    } else if (word_ == "endsolid") {
      return skip_line();
    } else if (word_ == "color") {
      skip_line();
    } else {
      fail(fmt::format("{} stands where a facet should begin", in_quotes(words_[at_ - 1])), "correct this line");
    }
  }
  fail("the file ends inside a solid", "was it cut off?");
}

void TextStl::read_facet() {
  // The normal follows from the corners; exporters write NaN here.
  while (next_word() && word_ != "outer") {
    if (word_ == "vertex" || word_ == "endfacet" || word_ == "facet")
      fail(fmt::format("{} stands where outer loop should", in_quotes(words_[at_ - 1])), "correct this line");
  }
  need_word("loop");
  const std::uint64_t line = lines_.number();
  corners_.clear();
  need_word("vertex");
  while (word_ == "vertex") {
    read_vertex();
    if (!next_word()) fail("the file ends inside a facet", "was it cut off?");
  }
  if (word_ != "endloop")
    fail(fmt::format("{} stands where vertex or endloop should", in_quotes(words_[at_ - 1])), "correct this line");
  need_word("endfacet");
  if (corners_.size() < 3)
    fail(fmt::format("a facet has at least 3 corners, this one has {}", corners_.size()), "complete or remove it");
  builder_.polygon(corners_, builder_.material(kUnnamed), builder_.part(part_), line);
}

void TextStl::read_vertex() {
  std::array<double, 3> xyz{};
  for (double& value : xyz) {
    if (!next_word()) fail("the file ends inside a vertex", "was it cut off?");
    const auto number = parse_number(word_);
    if (!number)
      fail(fmt::format("the coordinate {} is no finite number", in_quotes(word_)), "correct or remove this facet");
    value = *number;
  }
  const mesh::Point p{xyz[0], xyz[1], xyz[2]};
  corners_.push_back(vertices_.index(p, [&] { return builder_.vertex(p, lines_.number()); }));
}

}  // namespace

bool is_text_stl(std::string_view head) {
  if (head.starts_with("\xef\xbb\xbf")) head.remove_prefix(3);
  if (head.find('\0') != std::string_view::npos) return false;
  const std::vector<std::string_view> words = split_words(head);
  if (words.empty() || lower(words[0]) != "solid") return false;
  const auto is_grammar = [](std::string_view word) { return lower(word) == "facet" || lower(word) == "endsolid"; };
  return std::any_of(words.begin(), words.end(), is_grammar);
}

ModelFile read_stl(const fs::path& path, const ModelFormat& format) {
  require_file(path, "model");
  return is_binary(path) ? BinaryStl(path).read(format) : TextStl(path).read(format);
}

}  // namespace clerestory::io
