// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/off.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>

#include "io/model_builder.h"
#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

/// What of the first word is the header, as in "OFF", "STCNOFF" and "OFF8" with a count glued to it; empty for none.
std::string_view keyword(std::string_view word) {
  std::string_view rest = word;
  for (const std::string_view prefix : {"ST", "C", "N", "4", "n"})
    if (rest.starts_with(prefix)) rest.remove_prefix(prefix.size());
  return rest.starts_with("OFF") ? word.substr(0, word.size() - rest.size() + 3) : std::string_view{};
}

class OffReader {
 public:
  explicit OffReader(const std::filesystem::path& path) : path_(path), lines_(path, "model"), builder_(lines_.file()) {}

  ModelFile read(const ModelFormat& format);

 private:
  bool next_line();
  void read_header();
  void read_counts();
  void read_vertex(std::uint64_t which);
  void read_face(std::uint64_t which);
  std::uint64_t whole(std::string_view word, std::string_view what) const;
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
    throw InputError(lines_.file(), lines_.number(), what, hint);
  }

  std::filesystem::path path_;
  LineReader lines_;
  ModelBuilder builder_;
  std::vector<std::string_view> words_;  // of the line, without its comment
  std::optional<ToldUnit> unit_;
  std::uint64_t vertices_ = 0;  // as promised
  std::uint64_t faces_ = 0;     // as promised
  std::uint64_t points_and_lines_ = 0;
  std::vector<std::uint32_t> corners_;
};

/// The next line that is not empty.
bool OffReader::next_line() {
  do {
    if (!lines_.next()) return false;
    const std::string_view line = lines_.line();
    const std::size_t comment = std::min(line.find('#'), line.size());
    if (!unit_ && builder_.vertex_count() == 0)
      if (const auto unit = unit_in_comment(line.substr(comment).substr(0, 200)))
        unit_ = ToldUnit{*unit, fmt::format("as line {} of the model says", lines_.number())};
    words_ = split_words(line.substr(0, comment));
  } while (words_.empty());
  return true;
}

ModelFile OffReader::read(const ModelFormat& format) {
  read_header();
  read_counts();
  for (std::uint64_t i = 0; i < vertices_; ++i) read_vertex(i);
  for (std::uint64_t i = 0; i < faces_; ++i) read_face(i);
  ModelFile result;
  result.files.push_back(path_);
  if (points_and_lines_ > 0)
    result.notices.push_back(fmt::format("{} points and lines of the model were left out.", points_and_lines_));
  if (next_line())
    result.notices.push_back(
        fmt::format("The file goes on behind its last face, from line {}; that was passed over.", lines_.number()));
  builder_.finish(result, format, unit_);
  return result;
}

void OffReader::read_header() {
  if (!next_line()) fail("there is nothing in this file", "export the model again");
  const std::string_view word = keyword(words_[0]);
  if (word.find('4') != std::string_view::npos || word.find('n') != std::string_view::npos)
    fail(fmt::format("{} has other than three dimensions", word), "export it as OFF");
  if (words_.size() > 1 && words_[1] == "BINARY") fail("this OFF is binary", "export it as text, or as PLY");
  if (word.size() == words_[0].size()) {
    words_.erase(words_.begin());
  } else {
    words_[0].remove_prefix(word.size());
  }
}

void OffReader::read_counts() {
  if (words_.empty() && !next_line()) fail("the file ends before its counts", "was it cut off?");
  if (words_.size() < 2) fail("the counts of vertices and faces should stand here", "complete this line");
  vertices_ = whole(words_[0], "count");
  faces_ = whole(words_[1], "count");
}

std::uint64_t OffReader::whole(std::string_view word, std::string_view what) const {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size())
    fail(fmt::format("{} is no {}", in_quotes(word), what), "correct this line");
  return value;
}

void OffReader::read_vertex(std::uint64_t which) {
  if (!next_line()) fail(fmt::format("the file ends in vertex {} of {}", which + 1, vertices_), "was it cut off?");
  if (words_.size() < 3)
    fail(fmt::format("a vertex has three coordinates, this line has {}", words_.size()), "complete the line");
  std::array<double, 3> xyz{};
  for (std::size_t axis = 0; axis < xyz.size(); ++axis) {
    const auto value = parse_number(words_[axis]);
    if (!value)
      fail(fmt::format("the coordinate {} is no finite number", in_quotes(words_[axis])),
           "correct or remove this vertex");
    xyz[axis] = *value;
  }
  builder_.vertex({xyz[0], xyz[1], xyz[2]}, lines_.number());
}

void OffReader::read_face(std::uint64_t which) {
  if (!next_line()) fail(fmt::format("the file ends in face {} of {}", which + 1, faces_), "was it cut off?");
  const std::uint64_t count = whole(words_[0], "count of corners");
  if (count == 0) fail("a face has at least one corner", "remove this face");
  if (count > words_.size() - 1)
    fail(fmt::format("this face promises {} corners and has {}", count, words_.size() - 1), "complete the line");
  corners_.clear();
  for (std::size_t i = 1; i <= count; ++i) {
    const std::uint64_t index = whole(words_[i], "vertex");
    if (index >= builder_.vertex_count())
      fail(fmt::format("vertex {} does not exist: the model has {}, counted from 0", index, builder_.vertex_count()),
           "correct or remove this face");
    corners_.push_back(static_cast<std::uint32_t>(index));
  }
  if (count < 3) {
    ++points_and_lines_;
    return;
  }
  builder_.polygon(corners_, builder_.material(kUnnamed), builder_.part(path_.stem().string()), lines_.number());
}

}  // namespace

bool is_off(std::string_view head) {
  const std::vector<std::string_view> words = split_words(head.substr(0, head.find_first_of("\r\n")));
  return !words.empty() && !keyword(words[0]).empty();
}

ModelFile read_off(const std::filesystem::path& path, const ModelFormat& format) {
  return OffReader(path).read(format);
}

}  // namespace clerestory::io
