// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <deque>
#include <map>

#include "io/ies_opening.h"
#include "io/photometry_checks.h"
#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

namespace fs = std::filesystem;
using lighting::LuminousOpening;
using lighting::Photometry;
using lighting::TiltTable;
using Symmetry = Photometry::Symmetry;

constexpr double kFootM = 0.3048;
constexpr double kLargestOpeningM = 100.0;

std::string upper(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

/// Numbers between blanks and commas, over the ends of lines.
class Numbers {
 public:
  explicit Numbers(LineReader& lines) : lines_(lines) {}

  double next(std::string_view what, double low, double high) {
    while (words_.empty()) {
      if (!lines_.next())
        throw InputError(lines_.file(), lines_.number(), fmt::format("the file ends before {}", what),
                         "it is cut off, or its counts of angles are too large; take the maker's file again");
      take_words();
    }
    const std::string word = words_.front();
    words_.pop_front();
    const auto value = parse_number(word);
    if (!value)
      throw InputError(lines_.file(), lines_.number(), fmt::format("{} is no number, for {}", in_quotes(word), what),
                       "check the counts of angles before it");
    if (*value < low || *value > high)
      throw InputError(lines_.file(), lines_.number(), fmt::format("{} cannot be {}", what, in_quotes(word)),
                       fmt::format("it lies between {:g} and {:g}", low, high));
    return *value;
  }
  std::size_t count(std::string_view what) {
    const double value = next(what, 1.0, kMostAngles);
    if (value != std::floor(value))
      throw InputError(lines_.file(), lines_.number(), fmt::format("{} is no whole number", what), "check the counts");
    return static_cast<std::size_t>(value);
  }
  /// Throws where numbers are left in the file.
  void expect_end() {
    do {
      for (const std::string& word : words_) {
        if (parse_number(word))
          throw InputError(lines_.file(), lines_.number(), "numbers follow after the last intensity",
                           "the counts of angles are too small");
      }
      words_.clear();
      if (!lines_.next()) return;
      take_words();
    } while (true);
  }

 private:
  void take_words() {
    std::string line(lines_.line());
    std::replace(line.begin(), line.end(), ',', ' ');
    for (const std::string_view word : split_words(line)) words_.emplace_back(word);
  }

  LineReader& lines_;
  std::deque<std::string> words_;
};

class IesReader {
 public:
  explicit IesReader(const fs::path& path) : path_(path), lines_(path, "photometric file"), numbers_(lines_) {}

  Photometry read();

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
    throw InputError(lines_.file(), lines_.number(), what, hint);
  }
  void read_format();
  std::string read_labels();
  void read_tilt(const std::string& where);
  void read_quantities();
  void read_opening(double to_metres, double width, double length, double height);
  void read_angles(std::vector<double>& angles, std::size_t count, std::string_view which, double low, double high);
  void read_intensities();
  void find_symmetry();
  void complete_type_b();

  fs::path path_;
  LineReader lines_;
  Numbers numbers_;
  Photometry p_;
  std::map<std::string, std::string> labels_;
  int year_ = 1986;
  bool has_format_line_ = false;
  double factor_ = 1.0;
};

/// The first line names the standard, but in 1986.
void IesReader::read_format() {
  if (!lines_.next()) fail("the file is empty", "take the maker's file again");
  const std::string first = upper(trim(lines_.line()));
  has_format_line_ = first.starts_with("IES");
  if (!has_format_line_) {
    p_.format = "LM-63-1986";
    return;
  }
  p_.format = first;
  for (const int year : {1986, 1991, 1995, 2002, 2019}) {
    const std::string digits = std::to_string(year);
    if (first.ends_with(digits) || first.ends_with("NA" + digits.substr(2))) {
      year_ = year;
      return;
    }
  }
  year_ = 2002;
  p_.notes.push_back(
      fmt::format("Its first line, {}, names no known edition; it is read as of 2002.", in_quotes(first)));
}

/// Keywords up to the line of TILT; gives what that says.
std::string IesReader::read_labels() {
  std::string last;
  bool pending = !has_format_line_;
  while (pending || lines_.next()) {
    pending = false;
    const std::string line(trim(lines_.line()));
    const std::string large = upper(line);
    if (large.starts_with("TILT")) {
      const std::size_t equals = line.find('=');
      if (equals != std::string::npos) return std::string(trim(std::string_view(line).substr(equals + 1)));
    }
    const std::size_t close = line.find(']');
    if (!line.starts_with('[') || close == std::string::npos) {
      if (labels_["label"].empty()) labels_["label"] = line;
      continue;
    }
    const std::string key = large.substr(1, close - 1);
    const std::string value(trim(std::string_view(line).substr(close + 1)));
    if (key == "MORE" && !last.empty()) {
      labels_[last] += (value.empty() ? "" : " ") + value;
    } else {
      labels_[last = key] = value;
    }
  }
  fail("there is no line TILT= in this file", "it is no IES photometric file, or it is cut off");
}

void IesReader::read_tilt(const std::string& where) {
  const std::string word = upper(where);
  if (word == "NONE" || word.empty()) return;
  const auto table = [](Numbers& numbers) {
    TiltTable tilt;
    tilt.lamp_geometry = static_cast<int>(numbers.next("the lamp's geometry", 1, 3));
    const std::size_t count = numbers.count("the count of tilt angles");
    for (std::size_t k = 0; k < count; ++k) tilt.angles_deg.push_back(numbers.next("a tilt angle", -180, 180));
    for (std::size_t k = 0; k < count; ++k) tilt.multipliers.push_back(numbers.next("a tilt multiplier", 0, 10));
    return tilt;
  };
  if (word == "INCLUDE") {
    p_.tilt = table(numbers_);
  } else {
    // The name may have been written on a system with other separators.
    std::string name = where;
    std::replace(name.begin(), name.end(), '\\', '/');
    const fs::path file = path_.parent_path() / name;
    std::error_code error;
    if (!fs::is_regular_file(file, error))
      fail(fmt::format("there is no tilt file {}", in_quotes(file.string())),
           "put it beside the photometric file, or write TILT=NONE");
    require_file_of_at_most(file, "tilt file", kLargestPhotometry);
    LineReader lines(file, "tilt file");
    Numbers numbers(lines);
    p_.tilt = table(numbers);
  }
  if (!std::is_sorted(p_.tilt->angles_deg.begin(), p_.tilt->angles_deg.end(), std::less_equal<>()))
    fail("the tilt angles are out of order", "they must ascend");
}

void IesReader::read_opening(double to_metres, double width, double length, double height) {
  if (const auto opening = ies_opening(to_metres * width, to_metres * length, to_metres * height, year_)) {
    p_.opening = *opening;
    return;
  }
  p_.opening = {.shape = LuminousOpening::Shape::kRectangle,
                .x_m = to_metres * std::abs(length),
                .y_m = to_metres * std::abs(width),
                .z_m = to_metres * std::abs(height)};
  p_.opening.sides_m.fill(p_.opening.z_m);
  p_.notes.push_back(
      fmt::format("Width {:g}, length {:g} and height {:g} mean no shape of luminous opening: it is taken "
                  "as a box.",
                  width, length, height));
}

void IesReader::read_quantities() {
  lighting::LampSet lamp;
  lamp.count = static_cast<int>(numbers_.next("the number of lamps", 0, 1e4));
  const double lumens = numbers_.next("the flux of a lamp", -1e9, kMostCandela);
  const double multiplier = numbers_.next("the multiplier", 0, 1e9);
  const std::size_t verticals = numbers_.count("the count of vertical angles");
  const std::size_t horizontals = numbers_.count("the count of horizontal angles");
  const double type = numbers_.next("the photometric type", 1, 3);
  const double unit = numbers_.next("the unit of length", 1, 2);
  if (type != std::floor(type) || unit != std::floor(unit))
    fail("the photometric type and the unit of length are whole numbers", "check the numbers before them");
  p_.type = type == 1.0 ? Photometry::Type::kC : type == 2.0 ? Photometry::Type::kB : Photometry::Type::kA;
  const double to_metres = unit == 1.0 ? kFootM : 1.0;
  const double most = kLargestOpeningM / to_metres;
  const double width = numbers_.next("the width of the opening", -most, most);
  const double length = numbers_.next("the length of the opening", -most, most);
  const double height = numbers_.next("the height of the opening", -most, most);
  read_opening(to_metres, width, length, height);
  const double ballast = numbers_.next("the ballast factor", 0, 100);
  const double second = numbers_.next("the ballast-lamp factor", 0, 1e6);
  p_.power_w = lamp.power_w = numbers_.next("the input power", 0, kMostCandela);
  factor_ = multiplier * ballast * (year_ < 1995 ? second : 1.0);
  if (year_ >= 1995 && year_ < 2019 && second != 1.0)
    p_.notes.push_back(fmt::format("The field for future use is {:g}; it is passed over.", second));
  p_.absolute = lumens < 0.0;
  lamp.flux_lm = p_.absolute ? 0.0 : lamp.count * lumens * ballast;
  lamp.type = labels_["LAMP"];
  p_.lamps.push_back(lamp);
  const bool c = p_.type == Photometry::Type::kC;
  read_angles(p_.vertical_deg, verticals, "vertical", c ? 0 : -90, c ? 180 : 90);
  read_angles(p_.horizontal_deg, horizontals, "horizontal", c ? 0 : -90, c ? 360 : 90);
}

void IesReader::read_angles(std::vector<double>& angles, std::size_t count, std::string_view which, double low,
                            double high) {
  for (std::size_t k = 0; k < count; ++k) {
    angles.push_back(numbers_.next(fmt::format("{} angle {}", which, k + 1), low, high));
    if (k > 0 && angles[k] <= angles[k - 1])
      fail(fmt::format("the {} angles are out of order: {:g} after {:g}", which, angles[k], angles[k - 1]),
           "they must ascend");
  }
}

void IesReader::read_intensities() {
  const std::size_t count = p_.vertical_deg.size() * p_.horizontal_deg.size();
  p_.candela.reserve(std::min<std::size_t>(count, 1U << 20U));
  for (std::size_t k = 0; k < count; ++k)
    p_.candela.push_back(factor_ * numbers_.next("an intensity", 0, kMostCandela));
  numbers_.expect_end();
}

/// What the ranges of the angles say of the planes that are not there.
void IesReader::find_symmetry() {
  const double first = p_.horizontal_deg.front();
  const double last = p_.horizontal_deg.back();
  if (p_.type != Photometry::Type::kC) {
    if (p_.horizontal_deg.size() < 2)
      fail("one horizontal angle is too few for type A or B", "they have 0 or -90 to 90");
    if (first == 0.0) p_.symmetry = Symmetry::kMirrorC0;
    return;
  }
  if (p_.horizontal_deg.size() == 1) {
    p_.symmetry = Symmetry::kAboutAxis;
  } else if (first == 0.0 && last == 90.0) {
    p_.symmetry = Symmetry::kQuadrants;
  } else if ((first == 0.0 && last == 180.0) || (first == 180.0 && last == 360.0)) {
    p_.symmetry = Symmetry::kMirrorC0;
  } else if (first == 90.0 && last == 270.0) {
    p_.symmetry = Symmetry::kMirrorC90;
  } else {
    const double step = (last - first) / static_cast<double>(p_.horizontal_deg.size() - 1);
    if (first + 360.0 - last > 2.0 * step)
      p_.notes.push_back(
          fmt::format("Its planes run from {:g} to {:g} degrees only; in between it is interpolated.", first, last));
  }
}

/// Type B may state the upper half of each plane alone, where the other is alike.
void IesReader::complete_type_b() {
  if (p_.type != Photometry::Type::kB || p_.vertical_deg.front() != 0.0 || p_.vertical_deg.size() < 2) return;
  const std::size_t count = p_.vertical_deg.size();
  std::vector<double> angles;
  for (std::size_t k = count; k-- > 1;) angles.push_back(-p_.vertical_deg[k]);
  angles.insert(angles.end(), p_.vertical_deg.begin(), p_.vertical_deg.end());
  std::vector<double> candela;
  for (std::size_t plane = 0; plane < p_.horizontal_deg.size(); ++plane) {
    const double* own = &p_.candela[plane * count];
    for (std::size_t k = count; k-- > 1;) candela.push_back(own[k]);
    candela.insert(candela.end(), own, own + count);
  }
  p_.vertical_deg = std::move(angles);
  p_.candela = std::move(candela);
}

Photometry IesReader::read() {
  read_format();
  const std::string tilt = read_labels();
  read_tilt(tilt);
  read_quantities();
  read_intensities();
  find_symmetry();
  complete_type_b();
  p_.name = labels_["LUMINAIRE"].empty() ? labels_["label"] : labels_["LUMINAIRE"];
  p_.maker = labels_["MANUFAC"];
  p_.catalogue_number = labels_["LUMCAT"];
  check_photometry(p_, lines_.file());
  return std::move(p_);
}

}  // namespace

Photometry read_ies(const fs::path& path) {
  require_file_of_at_most(path, "photometric file", kLargestPhotometry);
  return IesReader(path).read();
}

}  // namespace clerestory::io
