// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance_xform.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "io/radiance_words.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

using Words = std::vector<std::string>;

constexpr int kDeepestCommand = 16;  // arrays in arrays, and -f files that name -f files
/// Words that a command may become when its arrays are written out [bytes]: some 500 a copy for the most copies.
constexpr std::size_t kMostWords = std::size_t{96} << 20;
/// Programs whose whole output is a sky: the study says which sky there is.
constexpr std::array<std::string_view, 4> kSkyMakers{"gensky", "gendaylit", "genssky", "gencumulativesky"};

class CommandReader {
 public:
  CommandReader(std::string_view command, RadiancePlace place, const ArgumentLines& lines)
      : command_(trim(command)), place_(std::move(place)), argument_lines_(lines) {}

  RadianceInclude read();

 private:
  Words stages() const;
  std::vector<RadianceCopy> read_stage(const std::string& text, bool first);
  void add_xform(Words words, int depth, std::vector<RadianceCopy>& copies);
  void add_by_argument_file(const Words& words, std::size_t at, int depth, std::vector<RadianceCopy>& copies);
  void add_array(const Words& words, std::size_t at, int depth, std::vector<RadianceCopy>& copies);
  RadianceCopy one_copy(const Words& words);
  std::size_t read_transforms(const Words& words, std::size_t at, RadianceTransform& transform);
  RadianceTransform step(const Words& words, std::size_t& at);
  RadianceTransform rotation(const Words& words, std::size_t& at);
  double number(const Words& words, std::size_t at) const;
  std::size_t count(const Words& words, std::size_t at) const;
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
    throw InputError(place_.file, place_.line, what, hint);
  }
  void check_words(const Words& words) {
    for (const std::string& word : words) words_ += word.size() + sizeof(word);
    if (words_ > kMostWords)
      fail("this command is too long for the copies that it makes", "make the arrays or the list of files smaller");
  }
  void check_copies(std::size_t copies) const {
    if (copies > kMostRadianceCopies)
      fail(fmt::format("this command makes more than {} copies", kMostRadianceCopies), "make the arrays smaller");
  }

  std::string command_;
  RadiancePlace place_;
  const ArgumentLines& argument_lines_;
  std::size_t words_ = 0;  ///< that were written out [bytes]
};

std::string program_of(const std::string& stage) {
  const Words words = split_quoted(stage);
  if (words.empty()) return {};
  std::string name = words[0].substr(words[0].find_last_of("/\\") + 1);
  if (lower(name).ends_with(".exe")) name.resize(name.size() - 4);
  return name;
}

/// The name with which xform would mark a copy: those of the outer one first.
std::string joined(const std::string& outer, const std::string& inner) {
  if (outer.empty() || inner.empty()) return outer + inner;
  return outer + "." + inner;
}

RadianceCopy after(const RadianceCopy& inner, const RadianceCopy& outer) {
  RadianceCopy both = inner;
  both.transform = inner.transform.then(outer.transform);
  both.name = joined(outer.name, inner.name);
  both.numbers = outer.numbers + inner.numbers;
  if (outer.modifier) both.modifier = outer.modifier;
  both.inverted = inner.inverted != outer.inverted;
  return both;
}

Words CommandReader::stages() const {
  Words result(1);
  char quote = 0;
  for (const char c : command_) {
    if (quote == 0 && std::string_view(";&<>`$").find(c) != std::string_view::npos)
      fail(fmt::format("the command {} asks a shell for more than to include files", in_quotes("!" + command_)),
           "only !xform and !cat are followed; run it yourself, write its output to a file and include that by !cat");
    if (quote == 0 && (c == '"' || c == '\'')) {
      quote = c;
    } else if (c == quote) {
      quote = 0;
    }
    if (c == '|' && quote == 0) {
      result.emplace_back();
    } else {
      result.back() += c;
    }
  }
  return result;
}

RadianceInclude CommandReader::read() {
  RadianceInclude include;
  const std::string maker = program_of(command_);
  include.makes_sky = std::find(kSkyMakers.begin(), kSkyMakers.end(), maker) != kSkyMakers.end();
  if (include.makes_sky) return include;
  const Words parts = stages();
  include.copies = read_stage(parts[0], true);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::vector<RadianceCopy> outer = read_stage(parts[i], false);
    check_copies(outer.size() * include.copies.size());
    std::vector<RadianceCopy> both;
    for (const RadianceCopy& copy : outer)
      for (const RadianceCopy& inner : include.copies) {
        check_words(inner.files);
        both.push_back(after(inner, copy));
      }
    include.copies = std::move(both);
  }
  return include;
}

std::vector<RadianceCopy> CommandReader::read_stage(const std::string& text, bool first) {
  const std::string program = program_of(text);
  Words words = split_quoted(text);
  if (!words.empty()) words.erase(words.begin());
  std::vector<RadianceCopy> copies;
  if (program == "cat" && first) {
    copies.emplace_back().files = words;
  } else if (program == "xform") {
    add_xform(words, 0, copies);
  } else {
    fail(fmt::format("the command {} is not run: no program is ever run from a scene", in_quotes("!" + command_)),
         "only !xform and !cat are followed; run it yourself, write its output to a file and include that by !cat");
  }
  for (RadianceCopy& copy : copies) {
    if (!copy.name.empty()) copy.name += std::exchange(copy.numbers, {});
    if (copy.files.empty() == first)
      fail(first ? fmt::format("{} names no file", in_quotes("!" + command_))
                 : fmt::format("the xform behind the bar of {} names a file", in_quotes("!" + command_)),
           first ? "name the scene to include" : "name files in front of the bar");
  }
  return copies;
}

/// Arrays and files of arguments become a command for each of their copies, as xform itself does it.
void CommandReader::add_xform(Words words, int depth, std::vector<RadianceCopy>& copies) {
  check_words(words);
  if (depth > kDeepestCommand)
    fail(fmt::format("over {} arrays and files of arguments for xform stand in each other", kDeepestCommand),
         "write fewer -a, and let no -f file name itself");
  const auto by_file = std::find(words.begin(), words.end(), "-f");
  if (by_file != words.end())
    return add_by_argument_file(words, static_cast<std::size_t>(by_file - words.begin()), depth, copies);
  const auto array = std::find(words.begin(), words.end(), "-a");
  if (array != words.end()) return add_array(words, static_cast<std::size_t>(array - words.begin()), depth, copies);
  copies.push_back(one_copy(words));
  check_copies(copies.size());
}

/// Outer arrays come first in the numbers of a copy.
void put_number_before(std::vector<RadianceCopy>& copies, std::size_t from, std::size_t number) {
  for (std::size_t i = from; i < copies.size(); ++i) copies[i].numbers = fmt::format(".{}", number) + copies[i].numbers;
}

RadianceTransform power(RadianceTransform steps, std::size_t times) {
  RadianceTransform result;
  for (; times > 0; times /= 2) {
    if (times % 2 == 1) result = result.then(steps);
    steps = steps.then(steps);
  }
  return result;
}

void CommandReader::add_by_argument_file(const Words& words, std::size_t at, int depth,
                                         std::vector<RadianceCopy>& copies) {
  if (at + 1 >= words.size()) fail("-f of xform names no file", "name the file that holds the arguments");
  std::size_t row = 0;
  for (const std::string& line : argument_lines_(words[at + 1])) {
    std::string_view text = trim(line);
    if (text.empty() || text.front() == '#') continue;
    if (text.starts_with('!')) text.remove_prefix(1);
    if (text.starts_with("xform ")) text.remove_prefix(6);
    Words all(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(at));
    for (std::string& word : split_quoted(text)) all.push_back(std::move(word));
    all.insert(all.end(), words.begin() + static_cast<std::ptrdiff_t>(at) + 2, words.end());
    const std::size_t from = copies.size();
    add_xform(std::move(all), depth + 1, copies);
    put_number_before(copies, from, row++);
  }
}

void CommandReader::add_array(const Words& words, std::size_t at, int depth, std::vector<RadianceCopy>& copies) {
  const std::size_t number_of_copies = count(words, at + 1);
  Words one = words;
  one[at] = "-i";
  for (std::size_t i = 0; i < number_of_copies; ++i) {
    one[at + 1] = std::to_string(i);
    const std::size_t from = copies.size();
    add_xform(one, depth + 1, copies);
    put_number_before(copies, from, i);
  }
}

RadianceCopy CommandReader::one_copy(const Words& words) {
  RadianceCopy copy;
  std::size_t at = 0;
  for (; at < words.size(); ++at) {
    const std::string& word = words[at];
    if (word == "-I") {
      copy.inverted = !copy.inverted;
    } else if ((word == "-n" || word == "-m") && at + 1 < words.size()) {
      ++at;
      if (word == "-n") copy.name = joined(copy.name, words[at]);
      if (word == "-m" && !copy.modifier) copy.modifier = words[at];
    } else if (word != "-c" && word != "-e") {
      break;
    }
  }
  at = read_transforms(words, at, copy.transform);
  copy.files.assign(words.begin() + static_cast<std::ptrdiff_t>(at), words.end());
  return copy;
}

/// -i n repeats the steps behind it, up to the next -i, n times.
std::size_t CommandReader::read_transforms(const Words& words, std::size_t at, RadianceTransform& transform) {
  RadianceTransform steps;
  std::size_t repeats = 1;
  const auto apply_steps = [&] { transform = transform.then(power(steps, repeats)); };
  while (at < words.size() && words[at].starts_with('-')) {
    if (words[at] == "-i") {
      apply_steps();
      repeats = count(words, at + 1);
      steps = {};
      at += 2;
    } else {
      steps = steps.then(step(words, at));
    }
  }
  apply_steps();
  return at;
}

RadianceTransform CommandReader::step(const Words& words, std::size_t& at) {
  const std::string& word = words[at];
  RadianceTransform result;
  if (word == "-t") {
    result.shift = {number(words, at + 1), number(words, at + 2), number(words, at + 3)};
    at += 4;
  } else if (word == "-s") {
    result.scale = number(words, at + 1);
    if (result.scale == 0.0) fail("xform -s 0 leaves nothing", "give a factor other than 0");
    for (mesh::Vector& axis : result.axes) axis = result.scale * axis;
    at += 2;
  } else if (word == "-mx" || word == "-my" || word == "-mz") {
    mesh::Vector& axis = result.axes[static_cast<std::size_t>(word[2] - 'x')];
    axis = -axis;
    result.scale = -1.0;
    at += 1;
  } else if (word == "-rx" || word == "-ry" || word == "-rz") {
    return rotation(words, at);
  } else {
    fail(fmt::format("xform has no option {}", in_quotes(word)),
         "it has -n -m -I -c -t -rx -ry -rz -s -mx -my -mz -i -a -f");
  }
  return result;
}

RadianceTransform CommandReader::rotation(const Words& words, std::size_t& at) {
  const double angle = number(words, at + 1) * std::numbers::pi / 180.0;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  RadianceTransform result;
  if (words[at] == "-rx") {
    result.axes[1] = {0.0, c, s};
    result.axes[2] = {0.0, -s, c};
  } else if (words[at] == "-ry") {
    result.axes[0] = {c, 0.0, -s};
    result.axes[2] = {s, 0.0, c};
  } else {
    result.axes[0] = {c, s, 0.0};
    result.axes[1] = {-s, c, 0.0};
  }
  at += 2;
  return result;
}

double CommandReader::number(const Words& words, std::size_t at) const {
  const auto value = at < words.size() ? parse_number(words[at]) : std::nullopt;
  if (!value)
    fail(at < words.size() ? fmt::format("{} is no finite number for xform", in_quotes(words[at]))
                           : "a number is missing at the end of the xform command",
         "-t takes x y z, -rx -ry -rz take degrees, -s takes a factor");
  return *value;
}

std::size_t CommandReader::count(const Words& words, std::size_t at) const {
  const std::string text = at < words.size() ? words[at] : "";
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    fail(fmt::format("{} is no count for -a or -i of xform", in_quotes(text)), "give a whole number");
  check_copies(value);
  return value;
}

}  // namespace

mesh::Point RadianceTransform::operator()(const mesh::Point& p) const {
  const mesh::Vector v = p.x * axes[0] + p.y * axes[1] + p.z * axes[2] + shift;
  return {v.x, v.y, v.z};
}

RadianceTransform RadianceTransform::then(const RadianceTransform& next) const {
  const auto turned = [&](const mesh::Vector& v) {
    return v.x * next.axes[0] + v.y * next.axes[1] + v.z * next.axes[2];
  };
  RadianceTransform both;
  for (std::size_t i = 0; i < axes.size(); ++i) both.axes[i] = turned(axes[i]);
  both.shift = turned(shift) + next.shift;
  both.scale = scale * next.scale;
  return both;
}

RadianceInclude parse_radiance_command(std::string_view command, const RadiancePlace& place,
                                       const ArgumentLines& argument_lines) {
  return CommandReader(command, place, argument_lines).read();
}

}  // namespace clerestory::io
