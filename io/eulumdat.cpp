// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/eulumdat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/photometry_checks.h"
#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

namespace fs = std::filesystem;
using lighting::LuminousOpening;
using lighting::Photometry;
using Symmetry = Photometry::Symmetry;

constexpr double kMillimetreM = 1e-3;
constexpr double kLargestMm = 1e5;
constexpr double kMostLampSets = 20;
constexpr int kDirectRatios = 10;

class EulumdatReader {
 public:
  EulumdatReader(const fs::path& path, std::size_t lamp_set) : lines_(path, "photometric file") {
    p_.fitted = lamp_set;
  }

  Photometry read();

 private:
  enum class Blank { kRefused, kZero };

  [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
    throw InputError(lines_.file(), lines_.number(), what, hint);
  }
  std::string text(std::string_view what);
  double number(std::string_view what, double low, double high, Blank blank = Blank::kRefused);
  std::size_t count(std::string_view what, double low, double high);
  void read_names();
  void read_grid();
  void read_opening();
  void read_lamps();
  void read_angles(std::vector<double>& angles, std::size_t count, std::string_view which, double high);
  void choose_planes();
  void read_intensities();
  void expect_end();

  LineReader lines_;
  Photometry p_;
  int symmetry_ = 0;
  std::size_t planes_ = 0;
  std::size_t gammas_ = 0;
  double plane_step_deg_ = 0.0;
  double conversion_ = 1.0;
};

std::string EulumdatReader::text(std::string_view what) {
  if (!lines_.next())
    throw InputError(lines_.file(), lines_.number(), fmt::format("the file ends before {}", what),
                     "it is cut off, or no EULUMDAT file; take the maker's file again");
  return std::string(trim(lines_.line()));
}

/// A number of a line of its own; what follows a blank behind it is a unit or a remark.
double EulumdatReader::number(std::string_view what, double low, double high, Blank blank) {
  std::string line = text(what);
  std::replace(line.begin(), line.end(), ',', '.');
  const auto words = split_words(line);
  if (words.empty() && blank == Blank::kZero) return 0.0;
  const auto value = words.empty() ? std::nullopt : parse_number(words.front());
  if (!value && blank == Blank::kZero) return 0.0;
  if (!value)
    fail(fmt::format("{} is no number, for {}", in_quotes(line), what),
         "check the counts of angles and lamp sets before it");
  if (*value < low || *value > high)
    fail(fmt::format("{} cannot be {}", what, in_quotes(words.front())),
         fmt::format("it lies between {:g} and {:g}", low, high));
  return *value;
}

std::size_t EulumdatReader::count(std::string_view what, double low, double high) {
  const double value = number(what, low, high);
  if (value != std::floor(value)) fail(fmt::format("{} is no whole number", what), "check the lines before it");
  return static_cast<std::size_t>(value);
}

void EulumdatReader::read_names() {
  text("the type of the luminaire's measurement");  // the report's number
  p_.name = text("the luminaire's name");
  p_.catalogue_number = text("the luminaire's number");
  text("the file's name");
  text("the date");
}

void EulumdatReader::read_grid() {
  p_.format = "EULUMDAT";
  p_.maker = text("the maker");
  number("the type of source", 0, 3, Blank::kZero);
  symmetry_ = static_cast<int>(count("the symmetry", 0, 4));
  planes_ = count("the number of planes", 1, kMostAngles);
  plane_step_deg_ = number("the distance of the planes", 0, 360, Blank::kZero);
  gammas_ = count("the number of angles in a plane", 2, kMostAngles);
  number("the distance of the angles", 0, 180, Blank::kZero);
  const bool fits = symmetry_ < 2 || planes_ % (symmetry_ == 4 ? 4 : 2) == 0;
  if (!fits)
    fail(fmt::format("{} planes cannot have the symmetry {}", planes_, symmetry_),
         "it asks for a multiple of 2, or of 4");
}

/// The luminaire's own measures come first; a width of zero is round.
void EulumdatReader::read_opening() {
  for (const char* what : {"the luminaire's length", "the luminaire's width", "the luminaire's height"})
    number(what, 0, kLargestMm, Blank::kZero);
  LuminousOpening& o = p_.opening;
  o.y_m = kMillimetreM * number("the length of the luminous area", 0, kLargestMm, Blank::kZero);
  o.x_m = kMillimetreM * number("the width of the luminous area", 0, kLargestMm, Blank::kZero);
  for (double& side : o.sides_m)
    side = kMillimetreM * number("the height of the luminous area", 0, kLargestMm, Blank::kZero);
  o.z_m = *std::max_element(o.sides_m.begin(), o.sides_m.end());
  if (o.y_m == 0.0 && o.x_m == 0.0) {
    o = {};
  } else if (o.x_m == 0.0 || o.y_m == 0.0) {
    o.shape = LuminousOpening::Shape::kEllipse;
    o.x_m = o.y_m = std::max(o.x_m, o.y_m);
  } else {
    o.shape = LuminousOpening::Shape::kRectangle;
  }
}

void EulumdatReader::read_lamps() {
  number("the downward flux fraction", -1e3, 1e3, Blank::kZero);
  const double output_ratio = number("the light output ratio", 0, 1e3, Blank::kZero) / 100.0;
  conversion_ = number("the conversion factor", 0, 1e6);
  number("the tilt", -360, 360, Blank::kZero);
  const std::size_t sets = count("the number of lamp sets", 1, kMostLampSets);
  for (std::size_t k = 0; k < sets; ++k) {
    const double lamps = number("the number of lamps", -1e4, 1e4);
    lighting::LampSet set;
    set.count = static_cast<int>(std::abs(lamps));
    set.type = text("the type of lamps");
    set.flux_lm = number("the flux of the lamps", 0, kMostCandela);
    set.colour = text("the colour of the light");
    set.rendering = text("the colour rendering");
    set.power_w = number("the power", 0, kMostCandela, Blank::kZero);
    if (k == p_.fitted) p_.absolute = lamps < 0.0;
    p_.lamps.push_back(std::move(set));
  }
  if (p_.fitted >= sets)
    fail(fmt::format("the file has {} lamp set{}, no {}", sets, sets == 1 ? "" : "s", p_.fitted + 1),
         "choose one of them");
  const lighting::LampSet& fitted = p_.lamps[p_.fitted];
  p_.power_w = fitted.power_w;
  p_.light_output_ratio = output_ratio;
  p_.stated_flux_lm = output_ratio * fitted.flux_lm;
  for (int k = 0; k < kDirectRatios; ++k) number("a direct ratio", -1e6, 1e6, Blank::kZero);
}

void EulumdatReader::read_angles(std::vector<double>& angles, std::size_t count, std::string_view which, double high) {
  for (std::size_t k = 0; k < count; ++k) {
    angles.push_back(number(fmt::format("{} {}", which, k + 1), 0, high));
    if (k > 0 && angles[k] <= angles[k - 1])
      fail(fmt::format("the angles are out of order: {:g} after {:g}", angles[k], angles[k - 1]), "they must ascend");
  }
}

/// Of the planes that the file lists, those whose intensities it states.
void EulumdatReader::choose_planes() {
  std::vector<double>& all = p_.horizontal_deg;
  std::vector<double> stated;
  const std::size_t half = planes_ / 2;
  switch (symmetry_) {
    case 0:
      return;
    case 1:
      p_.symmetry = Symmetry::kAboutAxis;
      all.resize(1);
      return;
    case 2:
      p_.symmetry = Symmetry::kMirrorC0;
      all.resize(std::min(all.size(), half + 1));
      break;
    case 3:
      p_.symmetry = Symmetry::kMirrorC90;
      for (std::size_t k = 0; k <= half; ++k) {
        const std::size_t plane = 3 * planes_ / 4 + k;
        stated.push_back(plane < planes_ ? all[plane] - 360.0 : all[plane - planes_]);
      }
      all = std::move(stated);
      break;
    default:
      p_.symmetry = Symmetry::kQuadrants;
      all.resize(std::min(all.size(), half / 2 + 1));
      break;
  }
  const double first = symmetry_ == 3 ? -90.0 : 0.0;
  const double last = symmetry_ == 2 ? 180.0 : 90.0;
  constexpr double kSame = 1e-6;
  if (std::abs(all.front() - first) > kSame || std::abs(all.back() - last) > kSame)
    fail(fmt::format("with the symmetry {} the planes must run from {:g} to {:g} degrees, not from {:g} to {:g}",
                     symmetry_, first, last, all.front(), all.back()),
         "check the number of planes, their angles and the symmetry");
}

void EulumdatReader::read_intensities() {
  const double factor = conversion_ * p_.lamps[p_.fitted].flux_lm / 1000.0;
  const std::size_t values = p_.horizontal_deg.size() * gammas_;
  for (std::size_t k = 0; k < values; ++k) p_.candela.push_back(factor * number("an intensity", 0, kMostCandela));
}

void EulumdatReader::expect_end() {
  while (lines_.next()) {
    const auto words = split_words(lines_.line());
    if (!words.empty() && parse_number(words.front()))
      fail("numbers follow after the last intensity", "the counts of planes or angles, or the symmetry, are wrong");
  }
}

Photometry EulumdatReader::read() {
  read_grid();
  read_names();
  read_opening();
  read_lamps();
  read_angles(p_.horizontal_deg, planes_, "the angle of plane", 360);
  read_angles(p_.vertical_deg, gammas_, "the angle in a plane, number", 180);
  choose_planes();
  read_intensities();
  expect_end();
  check_photometry(p_, lines_.file());
  return std::move(p_);
}

}  // namespace

Photometry read_eulumdat(const fs::path& path, std::size_t lamp_set) {
  require_file_of_at_most(path, "photometric file", kLargestPhotometry);
  return EulumdatReader(path, lamp_set).read();
}

}  // namespace clerestory::io
