// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "io/finishes.h"
#include "io/material_rules.h"
#include "io/study_tables.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

constexpr double kMostInAll = 0.99;       // as the schema bounds each part of a reflectance
constexpr double kClearestGlass = 0.918;  // transmittance of a pane of n = 1.52 without any absorption

/// @param weights  of the study's bands; empty for red, green and blue
lighting::Spectrum spectrum_of(const StudyValue& value, std::span<const float> weights) {
  if (value.is_number()) return {static_cast<float>(value.number)};
  const std::size_t count = weights.empty() ? lighting::kPrimaries : weights.size();
  if (value.children.size() != count)
    throw value.error(fmt::format("{} has {} numbers, and there are {} bands", value.key, value.children.size(), count),
                      weights.empty() ? "give one number or [r, g, b]; [spectrum] weights gives a study other bands"
                                      : "give one number, or one for each of [spectrum] weights");
  lighting::Spectrum bands;
  for (const StudyValue& band : value.children) bands.push_back(static_cast<float>(band.number));
  const bool grey = std::all_of(bands.begin(), bands.end(), [&](float band) { return band == bands.front(); });
  if (grey) bands.resize(1);
  return bands;
}

/// Colours that are not of the study count as grey where its bands are not red, green and blue.
void to_bands(std::span<const float> weights, lighting::SideMaterial& side) {
  if (!side.reflectance || side.reflectance->size() == 1 || weights.empty()) return;
  if (side.reflectance->size() == weights.size()) return;
  const std::vector<float> primaries = lighting::luminance_weights(side.reflectance->size());
  side.reflectance = lighting::Spectrum{lighting::luminance(*side.reflectance, primaries)};
}

std::optional<lighting::Emission> emission_of(const StudyValue& entry) {
  const StudyValue* table = find_table(entry, "emission");
  if (table == nullptr) return std::nullopt;
  const StudyValue* flux = table->find("flux_lm");
  const StudyValue* luminance = table->find("luminance_cd_m2");
  if ((flux == nullptr) == (luminance == nullptr))
    throw table->error(flux == nullptr ? "emission says nothing" : "emission gives both a flux and a luminance",
                       "give flux_lm or luminance_cd_m2");
  lighting::Emission emission;
  if (flux != nullptr) emission.flux_lm = flux->number;
  if (luminance != nullptr) emission.luminance_cd_m2 = luminance->number;
  emission.group = text_or(*table, "group", "");
  return emission;
}

/// The finish that an entry names; nullptr where it names none.
const Finish* finish_of(const StudyValue& entry) {
  const StudyValue* name = entry.find("finish");
  if (name == nullptr) return nullptr;
  if (const Finish* finish = find_finish(name->text)) return finish;
  const auto meant = nearest(name->text, finish_names());
  throw name->error(fmt::format("there is no finish {}", in_quotes(name->text)),
                    meant ? fmt::format("did you mean \"{}\"?", *meant) : "docs/materials.md lists all");
}

/// An opening and glass have no other properties, and a finish no reflectances beside its own.
void expect_no_contradiction(const StudyValue& entry, const Finish* finish) {
  std::string_view whole;
  if (flag_or(entry, "opening", false)) {
    whole = "opening";
  } else if (entry.find("glazing") != nullptr) {
    whole = "glazing";
  } else if (finish != nullptr && finish->transmittance_normal) {
    whole = "finish";
  }
  for (const StudyValue& member : entry.children) {
    const bool other = !whole.empty() && member.key != whole && member.key != "opening";
    const bool double_told = finish != nullptr && (member.key == "reflectance" || member.key == "specular");
    if (!other && !double_told) continue;
    throw member.error(
        fmt::format("material {} cannot have {} beside {}", in_quotes(entry.key), member.key, other ? whole : "finish"),
        "remove one of the two");
  }
}

bool is_too_bright(const lighting::SideMaterial& side) {
  const auto is_more = [](float band) { return static_cast<double>(band) > kMostReflectance + 1e-6; };
  return side.reflectance && std::any_of(side.reflectance->begin(), side.reflectance->end(), is_more);
}

/// An entry of [materials], and whether anything of the model is named by it.
struct Entry {
  const StudyValue* value = nullptr;
  bool matched = false;
};

class MaterialReader {
 public:
  MaterialReader(const ModelFile& model, lighting::Study& study) : model_(model), study_(study) {}

  void read(const StudyValue* table);

 private:
  lighting::Material material(const SourceMaterial& mtl);
  const StudyValue* entry_of(const std::string& name);
  void apply(const StudyValue& entry, const SourceMaterial& mtl, lighting::Material& material);
  void apply_glazing(const lighting::Glazing& glazing, lighting::Material& material);
  void apply_sides(const StudyValue& entry, const Finish* finish, const SourceMaterial& mtl,
                   lighting::Material& material);
  std::optional<lighting::Spectrum> reflectance_of(const StudyValue& entry, const Finish* finish,
                                                   const SourceMaterial& mtl);
  void apply_back(const StudyValue& back, const SourceMaterial& mtl, lighting::Material& material);
  lighting::Spectrum reflectance_of(const Finish& finish, const std::string& material);
  void note_if_too_clear(const lighting::Material& material);
  void join_specular(const StudyValue& entry, lighting::Material& material);
  void darken(lighting::Material& material);
  void refuse_unmatched() const;

  const ModelFile& model_;
  lighting::Study& study_;
  std::vector<Entry> entries_;
  MaterialAssumptions assumed_;
  std::vector<std::string> darkened_;
  std::vector<std::string> too_clear_;
};

void MaterialReader::read(const StudyValue* table) {
  if (table != nullptr)
    for (const StudyValue& entry : table->children) entries_.push_back({&entry});
  for (const SourceMaterial& mtl : model_.materials) {
    study_.materials.push_back(material(mtl));
    const lighting::Material& read = study_.materials.back();
    study_.clean.sheet_materials.push_back(read.glazing.has_value());
    study_.clean.passable_materials.push_back(read.glazing.has_value() || read.opening);
  }
  refuse_unmatched();
  for (std::string& sentence : assumed_.sentences()) study_.assumptions.push_back(std::move(sentence));
  if (!too_clear_.empty())
    study_.assumptions.push_back(
        fmt::format("A pane of glass transmits at most {}; the whole curve over the angle was scaled to more: {}.",
                    kClearestGlass, list_names(too_clear_)));
  if (!darkened_.empty())
    study_.assumptions.push_back("The daylight factor counts daylight alone; dark were left the lamps of " +
                                 list_names(darkened_) + ".");
}

lighting::Material MaterialReader::material(const SourceMaterial& mtl) {
  lighting::Material material;
  material.name = mtl.name;
  if (const StudyValue* entry = entry_of(mtl.name)) {
    apply(*entry, mtl, material);
  } else {
    assumed_.decide(mtl, material);
    if (material.glazing) note_if_too_clear(material);
  }
  to_bands(study_.band_weights, material.front);
  to_bands(study_.band_weights, material.back);
  if (study_.kind == lighting::Study::Kind::kDaylight) darken(material);
  return material;
}

/// The entry with the exact name, else the first pattern that fits; all that fit count as matched.
const StudyValue* MaterialReader::entry_of(const std::string& name) {
  const StudyValue* exact = nullptr;
  const StudyValue* pattern = nullptr;
  for (Entry& entry : entries_) {
    const std::string& key = entry.value->key;
    const bool same = key == name;
    if (!same && !(is_glob(key) && matches_glob(key, name))) continue;
    entry.matched = true;
    if (same) exact = entry.value;
    if (!same && pattern == nullptr) pattern = entry.value;
  }
  return exact != nullptr ? exact : pattern;
}

void MaterialReader::apply(const StudyValue& entry, const SourceMaterial& mtl, lighting::Material& material) {
  material.why = is_glob(entry.key) && entry.key != material.name
                     ? fmt::format("the study's [materials.\"{}\"]", entry.key)
                     : "the study";
  const Finish* finish = finish_of(entry);
  if (finish != nullptr) material.why += fmt::format(", finish {}", finish->name);
  expect_no_contradiction(entry, finish);
  const StudyValue* glazing = entry.find("glazing");
  if (flag_or(entry, "opening", false)) {
    material.opening = true;
    material.became = "opening";
  } else if (glazing != nullptr) {
    apply_glazing({.transmittance_normal = number_or(*glazing, "transmittance", 0.70),
                   .panes = static_cast<int>(number_or(*glazing, "panes", 1.0))},
                  material);
  } else if (finish != nullptr && finish->transmittance_normal) {
    apply_glazing({.transmittance_normal = *finish->transmittance_normal}, material);
  } else {
    apply_sides(entry, finish, mtl, material);
  }
}

void MaterialReader::apply_glazing(const lighting::Glazing& glazing, lighting::Material& material) {
  material.glazing = glazing;
  material.became = fmt::format("glazing {:.2f}", glazing.transmittance_normal);
  note_if_too_clear(material);
}

void MaterialReader::note_if_too_clear(const lighting::Material& material) {
  if (material.glazing->transmittance_normal > kClearestGlass) too_clear_.push_back(material.name);
}

std::optional<lighting::Spectrum> MaterialReader::reflectance_of(const StudyValue& entry, const Finish* finish,
                                                                 const SourceMaterial& mtl) {
  if (finish != nullptr) return reflectance_of(*finish, mtl.name);
  const StudyValue* reflectance = entry.find("reflectance");
  return reflectance != nullptr ? std::optional(spectrum_of(*reflectance, study_.band_weights))
                                : assumed_.reflectance(mtl).value;
}

lighting::Spectrum MaterialReader::reflectance_of(const Finish& finish, const std::string& material) {
  if (finish.specular > 0.0) assumed_.join_specular(material);
  return {static_cast<float>(finish.reflectance + finish.specular)};
}

void MaterialReader::apply_back(const StudyValue& back, const SourceMaterial& mtl, lighting::Material& material) {
  const Finish* finish = finish_of(back);
  if (finish != nullptr && finish->transmittance_normal)
    throw back.find("finish")->error(
        fmt::format("the back of material {} cannot be glass alone", in_quotes(material.name)),
        "glass is the same from both sides: give the finish to the material itself");
  expect_no_contradiction(back, finish);
  if (finish != nullptr) {
    material.back.reflectance = reflectance_of(*finish, mtl.name);
    material.why += fmt::format(", finish {} on the back", finish->name);
  } else if (const StudyValue* reflectance = back.find("reflectance")) {
    material.back.reflectance = spectrum_of(*reflectance, study_.band_weights);
  }
  material.back.emission = emission_of(back);
}

void MaterialReader::apply_sides(const StudyValue& entry, const Finish* finish, const SourceMaterial& mtl,
                                 lighting::Material& material) {
  assumed_.note_if_translucent(mtl);
  material.front.reflectance = reflectance_of(entry, finish, mtl);
  if (entry.find("specular") != nullptr) join_specular(entry, material);
  material.back.reflectance = material.front.reflectance;
  material.front.emission = emission_of(entry);
  const StudyValue* back = find_table(entry, "back");
  if (back != nullptr) apply_back(*back, mtl, material);
  if (!material.front.emission) material.front.emission = told_emission(mtl);
  if (finish == nullptr && (is_too_bright(material.front) || is_too_bright(material.back)))
    assumed_.note_too_bright(material.name);
  material.became = side_words(material.front);
  if (back != nullptr && side_words(material.back) != material.became)
    material.became += "; back: " + side_words(material.back);
}

void MaterialReader::join_specular(const StudyValue& entry, lighting::Material& material) {
  const StudyValue& table = *entry.find("specular");
  if (entry.find("reflectance") == nullptr)
    throw table.error(fmt::format("material {} has a specular part and no diffuse one", in_quotes(entry.key)),
                      "give reflectance beside it");
  for (float& band : *material.front.reflectance) {
    band += static_cast<float>(number_or(table, "reflectance", 0.0));
    if (static_cast<double>(band) > kMostInAll + 1e-6)
      throw table.error(fmt::format("material {} reflects {:.2f} in all", in_quotes(entry.key), band),
                        fmt::format("give reflectance and specular.reflectance with a sum of at most {}", kMostInAll));
  }
  assumed_.join_specular(material.name);
}

void MaterialReader::darken(lighting::Material& material) {
  if (!material.front.emission && !material.back.emission) return;
  material.front.emission.reset();
  material.back.emission.reset();
  darkened_.push_back(material.name);
  material.became = side_words(material.front);
  if (side_words(material.back) != material.became) material.became += "; back: " + side_words(material.back);
}

void MaterialReader::refuse_unmatched() const {
  std::vector<std::string> names = study_.model.material_names;
  for (const Entry& entry : entries_) {
    const std::string& key = entry.value->key;
    // An MTL shared by several models defines more than each of them uses.
    const bool defined =
        std::any_of(model_.unused_materials.begin(), model_.unused_materials.end(),
                    [&](const std::string& name) { return name == key || (is_glob(key) && matches_glob(key, name)); });
    if (entry.matched || defined) continue;
    const auto meant = nearest(key, names);
    throw entry.value->error(
        fmt::format("no material of the model is named {}", in_quotes(key)),
        meant ? fmt::format("did you mean \"{}\"?", printable(*meant)) : "it has " + list_names(names));
  }
}

}  // namespace

void read_materials_table(const StudyValue& root, const ModelFile& model, lighting::Study& study) {
  MaterialReader(model, study).read(find_table(root, "materials"));
}

}  // namespace clerestory::io
