// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>

#include "io/byte_reader.h"
#include "io/model_builder.h"
#include "io/ply_header.h"
#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

namespace fs = std::filesystem;

/// The numbers behind a header, in the order of the file.
class PlyData {
 public:
  virtual ~PlyData() = default;

  /// Moves to the next element.
  virtual void begin(const PlyElement& element, std::uint64_t which) = 0;
  /// The next number of this element.
  virtual double number(PlyScalar type) = 0;
  /// Passes over a number, whatever stands there.
  virtual void skip(PlyScalar type) = 0;
  /// All numbers of this element were taken.
  virtual void end() = 0;
  /// Whether something stands behind the last element.
  virtual bool has_more() = 0;
  /// Where the element stands: 0 in a binary file.
  [[nodiscard]] virtual std::uint64_t line() const = 0;
  /// Throws InputError for this element.
  [[noreturn]] virtual void fail(const std::string& what, const std::string& hint) const = 0;
};

/// An element a line.
class TextData : public PlyData {
 public:
  TextData(const fs::path& path, const PlyHeader& header) : lines_(path, "model") {
    while (lines_.number() < header.lines && lines_.next()) continue;
  }

  void begin(const PlyElement& element, std::uint64_t which) override {
    if (!next_line())
      throw InputError(lines_.file(), lines_.number(),
                       fmt::format("the file ends in {} {} of {}", printable(element.name), which + 1, element.count),
                       "was it cut off?");
  }
  double number(PlyScalar /*type*/) override {
    const std::string_view word = next_word();
    const auto value = parse_number(word);
    if (!value) fail(fmt::format("{} is no finite number", in_quotes(word)), "correct this line");
    return *value;
  }
  void skip(PlyScalar /*type*/) override { next_word(); }
  void end() override {
    if (at_ < words_.size())
      fail(fmt::format("this line has {} numbers, the header asks for {}", words_.size(), at_), "correct this line");
  }
  bool has_more() override { return next_line(); }
  [[nodiscard]] std::uint64_t line() const override { return lines_.number(); }
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const override {
    throw InputError(lines_.file(), lines_.number(), what, hint);
  }

 private:
  bool next_line() {
    at_ = 0;
    do {
      if (!lines_.next()) return false;
      words_ = split_words(lines_.line());
    } while (words_.empty());
    return true;
  }
  std::string_view next_word() {
    if (at_ == words_.size())
      fail(fmt::format("this line has {} numbers, the header asks for more", words_.size()),
           "complete it; was the file cut off?");
    return words_[at_++];
  }

  LineReader lines_;
  std::vector<std::string_view> words_;
  std::size_t at_ = 0;
};

class BinaryData : public PlyData {
 public:
  BinaryData(const fs::path& path, const PlyHeader& header)
      : bytes_(path, "model", header.bytes), big_endian_(header.encoding == PlyEncoding::kBigEndian) {}

  void begin(const PlyElement& element, std::uint64_t which) override {
    element_ = &element;
    which_ = which;
    start_ = bytes_.offset();
  }
  double number(PlyScalar type) override {
    switch (type) {
      case PlyScalar::kInt8:
        return take<std::int8_t>();
      case PlyScalar::kUint8:
        return take<std::uint8_t>();
      case PlyScalar::kInt16:
        return take<std::int16_t>();
      case PlyScalar::kUint16:
        return take<std::uint16_t>();
      case PlyScalar::kInt32:
        return take<std::int32_t>();
      case PlyScalar::kUint32:
        return take<std::uint32_t>();
      case PlyScalar::kFloat32:
        return static_cast<double>(take<float>());
      case PlyScalar::kFloat64:
        return take<double>();
    }
    return 0.0;
  }
  void skip(PlyScalar type) override { number(type); }
  void end() override {}
  bool has_more() override { return bytes_.offset() < bytes_.size(); }
  [[nodiscard]] std::uint64_t line() const override { return 0; }
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const override {
    throw InputError(
        bytes_.file(), 0,
        fmt::format("{} {} of {} at byte {}: {}", printable(element_->name), which_ + 1, element_->count, start_, what),
        hint);
  }

 private:
  template <class Number>
  Number take() {
    std::array<unsigned char, sizeof(Number)> raw{};
    if (!bytes_.read(raw.data(), raw.size()))
      fail(fmt::format("the file ends here, with {} bytes", bytes_.size()), "was it cut off?");
    return number_of_bytes<Number>(raw.data(), big_endian_);
  }

  ByteReader bytes_;
  bool big_endian_;
  const PlyElement* element_ = nullptr;
  std::uint64_t which_ = 0;
  std::uint64_t start_ = 0;
};

std::unique_ptr<PlyData> open_data(const fs::path& path, const PlyHeader& header) {
  if (header.encoding == PlyEncoding::kText) return std::make_unique<TextData>(path, header);
  return std::make_unique<BinaryData>(path, header);
}

class PlyReader {
 public:
  explicit PlyReader(const fs::path& path)
      : path_(path), header_(read_ply_header(path)), data_(open_data(path, header_)), builder_(path.string()) {}

  ModelFile read(const ModelFormat& format);

 private:
  void read_elements(const PlyElement& element);
  void read_vertices(const PlyElement& element);
  void read_lists(const PlyElement& element, void (PlyReader::*take)());
  double* id_of(const PlyProperty& property);
  void pass_over(const PlyProperty& property);
  std::uint64_t list_size(const PlyProperty& property);
  void take_face();
  void take_strips();
  void take_strip(std::span<const double> strip);
  std::uint32_t corner(double index) const;
  void add(std::span<const std::uint32_t> corners);

  fs::path path_;
  PlyHeader header_;
  std::unique_ptr<PlyData> data_;
  ModelBuilder builder_;
  std::vector<double> list_;  // of the current element, as the file has it
  std::vector<std::uint32_t> corners_;
  double part_ = -1.0;  // number of the current element; -1 for none
  double material_ = -1.0;
};

/// Nothing for a number that has no name.
std::optional<std::string> name_of(double id, const std::vector<std::string>& names) {
  const bool is_named = id >= 0.0 && id < static_cast<double>(names.size()) && id == std::floor(id);
  return is_named ? std::optional(names[static_cast<std::size_t>(id)]) : std::nullopt;
}

ModelFile PlyReader::read(const ModelFormat& format) {
  for (const PlyElement& element : header_.elements) read_elements(element);
  ModelFile result;
  result.files.push_back(path_);
  if (data_->has_more()) result.notices.emplace_back("The file goes on behind its last element; that was passed over.");
  builder_.finish(result, format, header_.unit);
  return result;
}

void PlyReader::read_elements(const PlyElement& element) {
  if (element.name == "vertex") return read_vertices(element);
  if (element.name == "face") return read_lists(element, &PlyReader::take_face);
  if (element.name == "tristrips") return read_lists(element, &PlyReader::take_strips);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    data_->begin(element, i);
    for (const PlyProperty& property : element.properties) pass_over(property);
    data_->end();
  }
}

void PlyReader::read_vertices(const PlyElement& element) {
  std::array<const PlyProperty*, 3> axes{};
  for (const PlyProperty& property : element.properties)
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
      if (property.name == std::string(1, "xyz"[axis]) && !property.count_type) axes[axis] = &property;
  if (std::find(axes.begin(), axes.end(), nullptr) != axes.end())
    throw InputError(path_.string(), element.line, "a vertex of this file has no x, y and z", "complete the header");

  for (std::uint64_t i = 0; i < element.count; ++i) {
    data_->begin(element, i);
    std::array<double, 3> xyz{};
    for (const PlyProperty& property : element.properties) {
      const auto axis = std::find(axes.begin(), axes.end(), &property);
      if (axis == axes.end()) {
        pass_over(property);
        continue;
      }
      const double value = data_->number(property.type);
      if (!std::isfinite(value)) data_->fail("a coordinate is no finite number", "correct or remove this vertex");
      xyz[static_cast<std::size_t>(axis - axes.begin())] = value;
    }
    data_->end();
    builder_.vertex({xyz[0], xyz[1], xyz[2]}, data_->line());
  }
}

void PlyReader::read_lists(const PlyElement& element, void (PlyReader::*take)()) {
  const auto is_corners = [](const PlyProperty& property) {
    return property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
  };
  const auto corners = std::find_if(element.properties.begin(), element.properties.end(), is_corners);
  if (corners == element.properties.end())
    throw InputError(path_.string(), element.line, fmt::format("a {} of this file has no vertex_indices", element.name),
                     "complete the header");

  for (std::uint64_t i = 0; i < element.count; ++i) {
    data_->begin(element, i);
    list_.clear();
    for (auto property = element.properties.begin(); property != element.properties.end(); ++property) {
      if (property != corners) {
        double* id = id_of(*property);
        if (id != nullptr) *id = data_->number(property->type);
        if (id == nullptr) pass_over(*property);
        continue;
      }
      const std::uint64_t size = list_size(*property);
      for (std::uint64_t k = 0; k < size; ++k) list_.push_back(data_->number(property->type));
    }
    data_->end();
    (this->*take)();
  }
}

/// Where the number of a face's part or material goes, where the header names them.
double* PlyReader::id_of(const PlyProperty& property) {
  if (property.count_type) return nullptr;
  if (property.name == "part" && !header_.part_names.empty()) return &part_;
  if (property.name == "material" && !header_.material_names.empty()) return &material_;
  return nullptr;
}

void PlyReader::pass_over(const PlyProperty& property) {
  const std::uint64_t size = property.count_type ? list_size(property) : 1;
  for (std::uint64_t k = 0; k < size; ++k) data_->skip(property.type);
}

std::uint64_t PlyReader::list_size(const PlyProperty& property) {
  const double size = data_->number(*property.count_type);
  if (size < 0.0 || size > std::numeric_limits<std::uint32_t>::max() || size != std::floor(size))
    data_->fail(fmt::format("{:g} is no length of a list", size), "correct this element");
  return static_cast<std::uint64_t>(size);
}

/// Corners may name vertices that follow later: ModelBuilder checks that they exist.
std::uint32_t PlyReader::corner(double index) const {
  if (!(index >= 0.0) || index >= std::numeric_limits<std::uint32_t>::max() || index != std::floor(index))
    data_->fail(fmt::format("{:g} is no vertex", index), "correct or remove this element");
  return static_cast<std::uint32_t>(index);
}

void PlyReader::add(std::span<const std::uint32_t> corners) {
  const std::string material = name_of(material_, header_.material_names).value_or(kUnnamed);
  const std::string part = name_of(part_, header_.part_names).value_or(path_.stem().string());
  builder_.polygon(corners, builder_.material(material), builder_.part(part), data_->line());
}

void PlyReader::take_face() {
  if (list_.size() < 3)
    data_->fail(fmt::format("a face has at least 3 corners, this one has {}", list_.size()),
                "complete or remove this face");
  corners_.clear();
  for (const double index : list_) corners_.push_back(corner(index));
  add(corners_);
}

/// Strips of one list end at -1.
void PlyReader::take_strips() {
  auto begin = list_.begin();
  while (begin != list_.end()) {
    const auto end = std::find(begin, list_.end(), -1.0);
    take_strip(std::span(begin, end));
    begin = end == list_.end() ? end : end + 1;
  }
}

void PlyReader::take_strip(std::span<const double> strip) {
  for (std::size_t i = 2; i < strip.size(); ++i) {
    const std::size_t odd = i % 2;  // each second triangle of a strip runs the other way
    const std::array<std::uint32_t, 3> triangle{corner(strip[i - 2 + odd]), corner(strip[i - 1 - odd]),
                                                corner(strip[i])};
    const bool joins_strips = triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
    if (!joins_strips) add(triangle);
  }
}

}  // namespace

bool is_ply(std::string_view head) { return head.starts_with("ply\n") || head.starts_with("ply\r"); }

ModelFile read_ply(const fs::path& path, const ModelFormat& format) {
  require_file(path, "model");
  return PlyReader(path).read(format);
}

}  // namespace clerestory::io
