// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include "io/radiance_words.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

struct Type {
  std::string_view word;
  RadianceKind kind;
};

using enum RadianceKind;

constexpr std::array kTypes{Type{"polygon", kSurface},     Type{"cone", kSurface},       Type{"cup", kSurface},
                            Type{"cylinder", kSurface},    Type{"tube", kSurface},       Type{"ring", kSurface},
                            Type{"sphere", kSurface},      Type{"bubble", kSurface},     Type{"source", kSource},
                            Type{"instance", kInstance},   Type{"mesh", kInstance},      Type{"alias", kAlias},
                            Type{"plastic", kMaterial},    Type{"metal", kMaterial},     Type{"trans", kMaterial},
                            Type{"plastic2", kMaterial},   Type{"metal2", kMaterial},    Type{"trans2", kMaterial},
                            Type{"ashik2", kMaterial},     Type{"glass", kMaterial},     Type{"dielectric", kMaterial},
                            Type{"interface", kMaterial},  Type{"light", kMaterial},     Type{"glow", kMaterial},
                            Type{"spotlight", kMaterial},  Type{"illum", kMaterial},     Type{"mirror", kMaterial},
                            Type{"prism1", kMaterial},     Type{"prism2", kMaterial},    Type{"mist", kMaterial},
                            Type{"antimatter", kMaterial}, Type{"plasfunc", kMaterial},  Type{"metfunc", kMaterial},
                            Type{"transfunc", kMaterial},  Type{"plasdata", kMaterial},  Type{"metdata", kMaterial},
                            Type{"transdata", kMaterial},  Type{"BRTDfunc", kMaterial},  Type{"BSDF", kMaterial},
                            Type{"aBSDF", kMaterial},      Type{"WGMDfunc", kMaterial},  Type{"brightfunc", kPattern},
                            Type{"brightdata", kPattern},  Type{"brighttext", kPattern}, Type{"colorfunc", kPattern},
                            Type{"colordata", kPattern},   Type{"colortext", kPattern},  Type{"colorpict", kPattern},
                            Type{"spectrum", kPattern},    Type{"specfile", kPattern},   Type{"specfunc", kPattern},
                            Type{"specdata", kPattern},    Type{"specpict", kPattern},   Type{"texfunc", kTexture},
                            Type{"texdata", kTexture},     Type{"mixfunc", kMixture},    Type{"mixdata", kMixture},
                            Type{"mixtext", kMixture},     Type{"mixpict", kMixture}};

const Type* type_of(std::string_view word) {
  // Numbers are by far the most words that are asked about.
  if (word.empty() || std::isalpha(static_cast<unsigned char>(word[0])) == 0) return nullptr;
  const auto* at = std::find_if(kTypes.begin(), kTypes.end(), [&](const Type& type) { return type.word == word; });
  return at == kTypes.end() ? nullptr : &*at;
}

std::optional<std::size_t> parse_count(std::string_view word) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return count;
}

class FileReader {
 public:
  FileReader(const std::filesystem::path& path, RadianceNotices& notices) : words_(path), notices_(notices) {}

  std::vector<RadianceStatement> read();
  [[nodiscard]] const std::string& name() const { return words_.file(); }

 private:
  RadiancePrimitive read_primitive();
  RadianceWord next(const RadiancePrimitive& of);
  std::size_t read_count(const RadiancePrimitive& of, std::string_view what);
  void read_reals(RadiancePrimitive& primitive);
  std::vector<double> numbers_that_stand_there();
  bool primitive_begins();
  void check_end_of_numbers(const RadiancePrimitive& primitive, const std::optional<std::size_t>& said);
  [[noreturn]] void fail(std::uint64_t line, const std::string& what, const std::string& hint) const {
    throw InputError(words_.file(), line, what, hint);
  }

  RadianceWords words_;
  RadianceNotices& notices_;
};

std::vector<RadianceStatement> FileReader::read() {
  std::vector<RadianceStatement> statements;
  while (const RadianceWord* word = words_.peek()) {
    RadianceStatement statement;
    statement.line = word->line;
    if (word->is_command) {
      statement.command = words_.take().text;
    } else {
      statement.primitive = read_primitive();
    }
    statements.push_back(std::move(statement));
  }
  return statements;
}

RadianceWord FileReader::next(const RadiancePrimitive& of) {
  const RadianceWord* word = words_.peek();
  if (word != nullptr && !word->is_command) return words_.take();
  const std::string where = of.identifier.empty() ? "a primitive" : in_quotes(of.identifier);
  if (word == nullptr)
    fail(words_.line(), fmt::format("the file ends inside {}, which begins in line {}", where, of.line),
         "complete or remove it; was the file cut off?");
  fail(word->line, fmt::format("a command stands inside {}, which begins in line {}", where, of.line),
       "complete or remove that primitive");
}

std::size_t FileReader::read_count(const RadiancePrimitive& of, std::string_view what) {
  const RadianceWord word = next(of);
  const auto count = parse_count(word.text);
  if (!count)
    fail(word.line, fmt::format("{} is no count of the {} of {}", in_quotes(word.text), what, in_quotes(of.identifier)),
         "write the counts of words, integers and numbers behind the identifier");
  return *count;
}

RadiancePrimitive FileReader::read_primitive() {
  RadiancePrimitive primitive;
  primitive.line = words_.peek()->line;
  primitive.modifier = words_.take().text;
  const RadianceWord word = next(primitive);
  const Type* type = type_of(word.text);
  if (type == nullptr)
    fail(word.line, fmt::format("{} is no type of a Radiance primitive", in_quotes(word.text)),
         fmt::format("a primitive begins with modifier, type, identifier; here the modifier was {}",
                     in_quotes(primitive.modifier)));
  primitive.type = type->word;
  primitive.kind = type->kind;
  primitive.identifier = next(primitive).text;
  if (primitive.kind == kAlias) {
    primitive.strings.push_back(next(primitive).text);
    return primitive;
  }
  for (std::size_t left = read_count(primitive, "words"); left > 0; --left)
    primitive.strings.push_back(next(primitive).text);
  for (std::size_t left = read_count(primitive, "integers"); left > 0; --left) next(primitive);
  read_reals(primitive);
  return primitive;
}

bool FileReader::primitive_begins() {
  const RadianceWord* second = words_.peek(1);
  return second != nullptr && !second->is_command && type_of(second->text) != nullptr;
}

std::vector<double> FileReader::numbers_that_stand_there() {
  std::vector<double> numbers;
  while (const RadianceWord* word = words_.peek()) {
    if (word->is_command) break;
    const auto value = parse_number(word->text);
    // A modifier may be named "1".
    if (!value || primitive_begins()) break;
    numbers.push_back(*value);
    words_.take();
  }
  return numbers;
}

void FileReader::read_reals(RadiancePrimitive& primitive) {
  const RadianceWord count = next(primitive);
  if (!parse_number(count.text))
    fail(count.line,
         fmt::format("{} is no count of the numbers of {}", in_quotes(count.text), in_quotes(primitive.identifier)),
         "write how many numbers follow");
  const auto said = parse_count(count.text);
  primitive.reals = numbers_that_stand_there();
  if (said == primitive.reals.size()) return;
  check_end_of_numbers(primitive, said);
  notices_.add("Primitives with a wrong count of numbers, taken with those that stand there", primitive.identifier,
               words_.file(), count.line);
}

/// A wrong count is survived only where it is certain that the primitive is over.
void FileReader::check_end_of_numbers(const RadiancePrimitive& primitive, const std::optional<std::size_t>& said) {
  const bool too_few = !said || primitive.reals.size() < *said;
  const RadianceWord* word = words_.peek();
  if (word == nullptr) {
    if (too_few && said) next(primitive);
    return;
  }
  if (too_few && !word->is_command && !primitive_begins())
    fail(word->line, fmt::format("{} is no finite number", in_quotes(word->text)),
         fmt::format("correct or remove {}", in_quotes(primitive.identifier)));
}

}  // namespace

void RadianceNotices::add(const std::string& what, const std::string& identifier, const std::string& file,
                          std::uint64_t line) {
  Entry& entry = entries_[what];
  if (entry.count++ == 0) entry.first = fmt::format("{} in {}:{}", in_quotes(identifier), file, line);
}

std::vector<std::string> RadianceNotices::sentences() const {
  std::vector<std::string> result;
  for (const auto& [what, entry] : entries_)
    result.push_back(fmt::format("{}: {}, the first is {}.", what, entry.count, entry.first));
  return result;
}

RadianceFile read_radiance_file(const std::filesystem::path& path, RadianceNotices& notices) {
  FileReader reader(path, notices);
  RadianceFile file;
  file.path = path;
  file.name = reader.name();
  file.statements = reader.read();
  return file;
}

bool looks_like_radiance(std::string_view head) {
  while (!head.empty()) {
    const std::size_t end = std::min(head.find('\n'), head.size());
    const std::string_view line = trim(head.substr(0, end));
    if (line.starts_with("!xform ") || line.starts_with("!cat ")) return true;
    if (line.empty() || line.front() == '#') {
      head.remove_prefix(std::min(end + 1, head.size()));
      continue;
    }
    // "solid cone" begins an STL file: only the counts behind the identifier make it certain.
    const auto words = split_words(head.substr(0, 1024));
    if (words.size() < 4) return false;
    const Type* type = type_of(words[1]);
    return type != nullptr && (type->kind == kAlias || parse_count(words[3]).has_value());
  }
  return false;
}

}  // namespace clerestory::io
