// SPDX-License-Identifier: GPL-3.0-or-later
// The parser is our own: tinyobjloader turns a coordinate that is no number into 0, drops faces without a word,
// and knows no line numbers.
#include "io/obj.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "io/model_builder.h"
#include "io/mtl_library.h"
#include "io/obj_tags.h"
#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

constexpr std::size_t kHeaderComments = 100;

/// Keywords that say nothing of polygons, parts or materials.
constexpr std::array<std::string_view, 33> kPassedOver{
    "vt",    "vn",     "vp",     "s",        "l",        "p",          "cstype",    "deg",   "bmat",  "step", "curv",
    "curv2", "surf",   "parm",   "trim",     "hole",     "scrv",       "sp",        "end",   "con",   "mg",   "bevel",
    "lod",   "maplib", "usemap", "c_interp", "d_interp", "shadow_obj", "trace_obj", "ctech", "stech", "call", "csh"};

class ObjReader {
 public:
  explicit ObjReader(const std::filesystem::path& path) : path_(path), lines_(path, "model"), builder_(lines_.file()) {}

  ModelFile read(const ModelFormat& format);

 private:
  void read_statement();
  void read_vertex(const std::vector<std::string_view>& words);
  void read_face(const std::vector<std::string_view>& words);
  std::uint32_t corner(std::string_view word) const;
  void read_comment(std::string_view line);
  void read_tag(const std::vector<std::string_view>& words);
  void pass_over(std::string_view keyword);
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
    throw InputError(lines_.file(), lines_.number(), what, hint);
  }

  std::filesystem::path path_;
  LineReader lines_;
  ModelBuilder builder_;
  std::string material_ = kUnnamed;
  std::string object_ = kUnnamed;
  std::string part_ = kUnnamed;
  std::vector<MtlReference> mtllibs_;
  std::vector<std::uint32_t> face_corners_;
  std::size_t header_comments_ = 0;
  std::optional<ToldUnit> told_unit_;
  std::size_t unknown_lines_ = 0;
  std::string first_unknown_;
  std::size_t curved_surfaces_ = 0;
  std::size_t unknown_tags_ = 0;
  std::uint64_t first_unknown_tag_ = 0;
};

ModelFile ObjReader::read(const ModelFormat& format) {
  while (lines_.next_continued()) read_statement();

  MtlLibrary library = read_mtl_library(path_, mtllibs_);
  ModelFile result;
  result.files.push_back(path_);
  result.files.insert(result.files.end(), library.files.begin(), library.files.end());
  result.notices = std::move(library.notices);
  builder_.finish(result, format, told_unit_);
  attach_materials(std::move(library.materials), result);
  if (curved_surfaces_ > 0)
    result.notices.push_back(
        fmt::format("{} free-form surfaces of the model were left out: only polygons are read.", curved_surfaces_));
  if (unknown_tags_ > 0)
    result.notices.push_back(
        fmt::format("{} subdivision tags of the model are not known and were passed over, the first in line {}.",
                    unknown_tags_, first_unknown_tag_));
  if (unknown_lines_ > 0)
    result.notices.push_back(fmt::format("{} lines of the model were not understood and passed over, the first is {}.",
                                         unknown_lines_, first_unknown_));
  return result;
}

void ObjReader::read_statement() {
  const std::string_view line = trim(lines_.line());
  if (line.empty()) return;
  if (line.front() == '#') return read_comment(line);
  const std::vector<std::string_view> words = split_words(line);
  const std::string_view keyword = words[0];
  const std::string rest(trim(line.substr(keyword.size())));
  if (keyword == "v") {
    read_vertex(words);
  } else if (keyword == "f" || keyword == "fo") {
    read_face(words);
  } else if (keyword == "usemtl") {
    material_ = rest.empty() ? kUnnamed : rest;
  } else if (keyword == "o") {
    object_ = rest.empty() ? kUnnamed : rest;
    part_ = object_;
  } else if (keyword == "g") {
    part_ = rest.empty() ? object_ : rest;
  } else if (keyword == "mtllib") {
    mtllibs_.push_back({rest, lines_.number()});
  } else if (keyword == "t") {
    read_tag(words);
  } else {
    pass_over(keyword);
  }
}

void ObjReader::read_comment(std::string_view line) {
  if (builder_.vertex_count() > 0 || told_unit_ || header_comments_++ >= kHeaderComments) return;
  if (const auto unit = unit_in_comment(line.substr(0, 200)))
    told_unit_ = ToldUnit{*unit, fmt::format("as line {} of the model says", lines_.number())};
}

void ObjReader::read_tag(const std::vector<std::string_view>& words) {
  const ObjPlace place{lines_.file(), lines_.number(), builder_.vertex_count(), builder_.polygon_count()};
  if (read_obj_tag(words, place, builder_.part(part_), builder_.tags())) return;
  if (unknown_tags_++ == 0) first_unknown_tag_ = lines_.number();
}

void ObjReader::pass_over(std::string_view keyword) {
  if (keyword == "surf") ++curved_surfaces_;
  for (const std::string_view known : kPassedOver)
    if (keyword == known) return;
  if (unknown_lines_++ == 0)
    first_unknown_ = fmt::format("{} in line {}", in_quotes(keyword.substr(0, 20)), lines_.number());
}

void ObjReader::read_vertex(const std::vector<std::string_view>& words) {
  if (words.size() < 4)
    fail(fmt::format("a vertex has three coordinates, this line has {}", words.size() - 1),
         "complete the line; was the file cut off?");
  std::array<double, 3> xyz{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto value = parse_number(words[axis + 1]);
    if (!value)
      fail(fmt::format("the coordinate {} is no finite number", in_quotes(words[axis + 1])),
           "correct or remove this vertex");
    xyz[axis] = *value;
  }
  builder_.vertex({xyz[0], xyz[1], xyz[2]}, lines_.number());
}

std::uint32_t ObjReader::corner(std::string_view word) const {
  const std::string_view index_text = word.substr(0, word.find('/'));
  const std::string_view others = word.substr(index_text.size());
  std::int64_t index = 0;
  const auto [end, error] = std::from_chars(index_text.data(), index_text.data() + index_text.size(), index);
  const bool whole = error == std::errc{} && end == index_text.data() + index_text.size();
  if (!whole || others.find_first_not_of("0123456789-/") != std::string_view::npos)
    fail(fmt::format("{} is no corner of a face", in_quotes(word)), "write the number of a vertex, or v/vt/vn");
  if (index == 0) fail("the vertex number 0 means nothing: vertices count from 1", "correct or remove this face");
  const auto count = static_cast<std::int64_t>(builder_.vertex_count());
  if (index < -count)
    fail(fmt::format("vertex {} does not exist: {} are given so far", index, count), "correct or remove this face");
  if (index > std::numeric_limits<std::uint32_t>::max() - 1)
    fail(fmt::format("vertex {} does not exist", index), "correct or remove this face");
  return static_cast<std::uint32_t>(index < 0 ? count + index : index - 1);
}

void ObjReader::read_face(const std::vector<std::string_view>& words) {
  if (words.size() < 4)
    fail(fmt::format("a face has at least 3 corners, this one has {}", words.size() - 1),
         "complete or remove this face; was the file cut off?");
  face_corners_.clear();
  for (std::size_t i = 1; i < words.size(); ++i) face_corners_.push_back(corner(words[i]));
  builder_.polygon(face_corners_, builder_.material(material_), builder_.part(part_), lines_.number());
}

}  // namespace

ModelFile read_obj(const std::filesystem::path& path, const ModelFormat& format) {
  return ObjReader(path).read(format);
}

}  // namespace clerestory::io
