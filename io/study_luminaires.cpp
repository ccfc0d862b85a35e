// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "io/photometry_file.h"
#include "io/study_tables.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

namespace fs = std::filesystem;
using lighting::Luminaire;
using lighting::Photometry;
using mesh::Point;
using mesh::Vector;

constexpr double kMostOfOne = 10'000;  // luminaires along a side of an array
constexpr double kPerRadian = 57.295779513082323;

/// What a photometric file gives, read once however many luminaires it stands for.
struct LuminaireType {
  Photometry photometry;
  std::shared_ptr<const lighting::PhotometricWeb> web;
};

class LuminairesReader {
 public:
  LuminairesReader(StudyPlace& place, lighting::Study& study) : place_(place), study_(study) {}

  void read(const StudyValue& table);
  void place_fixture(const StudyValue& table, const ModelFixture& fixture);

 private:
  const LuminaireType& type_of(const StudyValue& table);
  std::vector<Point> places_of(const StudyValue& table) const;
  Luminaire luminaire_of(const StudyValue& table, const Vector& aim);

  StudyPlace& place_;
  lighting::Study& study_;
  std::map<std::pair<std::string, std::size_t>, LuminaireType> types_;
};

const LuminaireType& LuminairesReader::type_of(const StudyValue& table) {
  const StudyValue* file = table.find("photometry");
  if (file == nullptr)
    throw table.error("these luminaires have no photometry", "write for example photometry = \"panel.ies\"");
  const auto lamp_set = static_cast<std::size_t>(number_or(table, "lamp_set", 1.0)) - 1;
  const auto [found, is_new] = types_.try_emplace({file->text, lamp_set});
  if (!is_new) return found->second;
  const fs::path path = place_.folder / file->text;
  std::error_code error;
  if (!fs::exists(path, error))
    throw file->error(fmt::format("there is no photometric file {}", in_quotes(path.string())),
                      "paths are relative to the study file");
  LuminaireType& type = found->second;
  type.photometry = read_photometry(path, lamp_set);
  type.web = std::make_shared<lighting::PhotometricWeb>(lighting::web_of(type.photometry));
  place_.files.push_back(path);
  for (const std::string& note : type.photometry.notes)
    study_.assumptions.push_back(fmt::format("{}: {}", printable(file->text), note));
  return type;
}

/// Each place, or each as the first of an array.
std::vector<Point> LuminairesReader::places_of(const StudyValue& table) const {
  const StudyValue* at = table.find("at");
  if (at == nullptr) throw table.error("these luminaires have no place", "write for example at = [[1.5, 2.0, 2.8]]");
  const bool one = !at->children.empty() && at->children.front().is_number();
  std::vector<Point> firsts;
  const auto add = [&](const StudyValue& list) {
    const auto p = numbers_of(list, 3, "[x, y, z]");
    firsts.push_back({p[0], p[1], p[2]});
  };
  if (one) add(*at);
  if (!one) {
    for (const StudyValue& item : at->children) add(item);
  }
  const StudyValue* array = table.find("array");
  if (array == nullptr) return firsts;
  const StudyValue* count = array->find("count");
  const StudyValue* spacing = array->find("spacing");
  if (count == nullptr || spacing == nullptr)
    throw array->error("an array has count and spacing", "write array = { count = [3, 4], spacing = [2.0, 2.4] }");
  const auto counts = numbers_of(*count, 2, "count = [3, 4]");
  const auto steps = numbers_of(*spacing, 2, "spacing = [2.0, 2.4]");
  for (const double n : counts) {
    if (n < 1.0 || n > kMostOfOne || n != std::floor(n))
      throw count->error(fmt::format("{:g} is no count of luminaires", n), "write count = [3, 4]");
  }
  std::vector<Point> places;
  for (const Point& first : firsts) {
    for (int j = 0; j < static_cast<int>(counts[1]); ++j) {
      for (int i = 0; i < static_cast<int>(counts[0]); ++i)
        places.push_back(first + Vector{i * steps[0], j * steps[1], 0.0});
    }
  }
  return places;
}

/// All but its place and axes.
/// @param aim  of unit length
Luminaire LuminairesReader::luminaire_of(const StudyValue& table, const Vector& aim) {
  const LuminaireType& type = type_of(table);
  Luminaire luminaire;
  luminaire.name = printable(table.find("photometry")->text);
  luminaire.web = type.web;
  luminaire.opening = type.photometry.opening;
  luminaire.power_w = type.photometry.power_w;
  luminaire.group = text_or(table, "group", "lamps");
  luminaire.factor = number_or(table, "maintenance", 0.8) * number_or(table, "dimming", 1.0);
  if (type.photometry.tilt)
    luminaire.factor *= type.photometry.tilt->at(std::atan2(std::hypot(aim.x, aim.y), -aim.z) * kPerRadian);
  return luminaire;
}

void LuminairesReader::read(const StudyValue& table) {
  const StudyValue& aim = *table.find("aim");
  const auto a = numbers_of(aim, 3, "aim = [0, 0, -1]");
  const Vector direction{a[0], a[1], a[2]};
  if (!(norm(direction) > 1e-12))
    throw aim.error("the aim of these luminaires is zero", "write aim = [0, 0, -1] for downwards");
  Luminaire luminaire = luminaire_of(table, normalized(direction));
  luminaire.axes = lighting::luminaire_axes(direction, number_or(table, "rotate", 0.0));
  for (const Point& at : places_of(table)) {
    luminaire.at = at;
    study_.luminaires.push_back(luminaire);
  }
}

/// A fixture shines along -z of its own coordinates, with C0 along its x; `rotate` turns it from C0 to C90, and `offset` leads to the opening.
void LuminairesReader::place_fixture(const StudyValue& table, const ModelFixture& fixture) {
  const auto offset = numbers_of(*table.find("offset"), 3, "offset = [0, 0, 0]");
  const mesh::Affine& own = fixture.placement;
  const Vector w = normalized(own.z);
  const Vector u = normalized(own.x - dot(own.x, w) * w);
  const Vector v = cross(w, u);
  const double angle = number_or(table, "rotate", 0.0) / kPerRadian;
  Luminaire luminaire = luminaire_of(table, -w);
  luminaire.axes = {std::cos(angle) * u + std::sin(angle) * v, std::cos(angle) * v - std::sin(angle) * u, w};
  luminaire.at = own(Point{offset[0], offset[1], offset[2]});
  study_.luminaires.push_back(std::move(luminaire));
}

/// The entry for a type of fixture: the exact name, else the first pattern that fits.
const StudyValue* entry_for(const std::vector<StudyValue>& entries, const std::string& type) {
  const auto find = [&](const auto& fits) {
    const auto at = std::find_if(entries.begin(), entries.end(), fits);
    return at == entries.end() ? nullptr : &*at;
  };
  if (const StudyValue* exact = find([&](const StudyValue& e) { return e.key == type; })) return exact;
  return find([&](const StudyValue& e) { return matches_glob(e.key, type); });
}

void check_entries_fit(const std::vector<StudyValue>& entries, const std::vector<ModelFixture>& fixtures) {
  std::set<std::string> types;
  for (const ModelFixture& fixture : fixtures) types.insert(fixture.type);
  const std::vector<std::string> names(types.begin(), types.end());
  for (const StudyValue& entry : entries) {
    const bool fits = std::any_of(names.begin(), names.end(), [&](const std::string& type) {
      return entry.key == type || matches_glob(entry.key, type);
    });
    if (!fits)
      throw entry.error(fmt::format("the model has no light fixture of the type {}", in_quotes(entry.key)),
                        names.empty() ? "it has no light fixtures" : "it has " + list_names(names));
  }
}

}  // namespace

void read_fixtures_table(const StudyValue& root, const std::vector<ModelFixture>& fixtures, StudyPlace& place,
                         lighting::Study& study) {
  if (study.kind == lighting::Study::Kind::kDaylight) return;
  static const std::vector<StudyValue> kNone;
  const StudyValue* table = root.find("fixtures");
  const std::vector<StudyValue>& entries = table != nullptr ? table->children : kNone;
  check_entries_fit(entries, fixtures);
  LuminairesReader reader(place, study);
  std::map<std::string, std::size_t> dark;
  for (const ModelFixture& fixture : fixtures) {
    if (const StudyValue* entry = entry_for(entries, fixture.type))
      reader.place_fixture(*entry, fixture);
    else
      ++dark[fixture.type];
  }
  for (const auto& [type, count] : dark)
    study.assumptions.push_back(
        fmt::format("{} of the type {} in the model {} dark: [fixtures.{}] photometry would give {} light.",
                    count == 1 ? "The light fixture" : fmt::format("The {} light fixtures", count), in_quotes(type),
                    count == 1 ? "stays" : "stay", in_quotes(type), count == 1 ? "it" : "them"));
}

void read_luminaires_table(const StudyValue& root, StudyPlace& place, lighting::Study& study) {
  const StudyValue* tables = root.find("luminaires");
  if (tables == nullptr || study.kind == lighting::Study::Kind::kDaylight) return;
  LuminairesReader reader(place, study);
  for (const StudyValue& table : tables->children) reader.read(table);
}

}  // namespace clerestory::io
