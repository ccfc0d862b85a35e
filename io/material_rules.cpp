// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/material_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/finishes.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

constexpr double kGlassTransmittance = 0.70;   // of a common double glazing, at normal incidence
constexpr double kLeastTransmittance = 0.001;  // of glazing; less is opaque
constexpr double kClearBelow = 0.5;            // opacity

constexpr std::array<std::string_view, 27> kGlassWords{
    "glass",   "glasses",    "glazing",    "glazed",   "glas",      "pane",      "panes",
    "window",  "windows",    "windowpane", "skylight", "skylights", "rooflight", "rooflights",
    "fenster", "verglasung", "scheibe",    "verre",    "vitre",     "vitres",    "vitrage",
    "vidrio",  "vidrios",    "vetro",      "vetri",    "plexiglas", "plexiglass"};

constexpr std::array<std::string_view, 35> kOtherWords{
    "frame",      "frames", "framing", "sill",     "sills",   "reveal", "reveals", "jamb",  "lintel",
    "ledge",      "seat",   "mullion", "mullions", "transom", "handle", "casing",  "trim",  "board",
    "blind",      "blinds", "shade",   "shutter",  "curtain", "wool",   "fibre",   "fiber", "fibreglass",
    "fiberglass", "foam",   "mirror",  "spandrel", "rahmen",  "bank",   "brett",   "wolle"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// German compounds end in the thing itself: Isolierglas; English ones too: safetyglass.
bool is_compound_of_glass(const std::string& word) {
  if (contains(kOtherWords, word)) return false;
  const bool other = word.starts_with("fibre") || word.starts_with("fiber") || word.starts_with("faser") ||
                     word.starts_with("foam") || word.starts_with("schaum") || word.starts_with("hour");
  return !other && (word.ends_with("glas") || word.ends_with("glass"));
}

bool is_grey(const std::array<double, 3>& colour) { return colour[0] == colour[1] && colour[1] == colour[2]; }

std::string capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string how_it_was_told(const SourceMaterial& source) {
  if (source.photometric) return "What the file says in photometric terms was taken as diffuse reflectance";
  return capitalised(source.told_by) + (source.gamma_removed
                                            ? " was taken as diffuse reflectance, after its gamma (sRGB) was taken off"
                                            : " was taken as diffuse reflectance, linear, without a gamma to take off");
}

std::string told(const std::vector<std::string>& names) { return (names.size() == 1 ? " " : "s ") + list_names(names); }

}  // namespace

bool is_named_like_glass(std::string_view name) {
  const auto words = name_words(name);
  const auto is_other = [](const std::string& word) { return contains(kOtherWords, word); };
  const auto is_glass = [](const std::string& word) {
    return contains(kGlassWords, word) || is_compound_of_glass(word);
  };
  return std::any_of(words.begin(), words.end(), is_glass) && std::none_of(words.begin(), words.end(), is_other);
}

std::string reflectance_words(const lighting::Spectrum& reflectance) {
  if (reflectance.size() == 1) return fmt::format("{:.2f}", reflectance.front());
  if (reflectance.size() != lighting::kPrimaries) {
    const auto [least, most] = std::minmax_element(reflectance.begin(), reflectance.end());
    return fmt::format("{:.2f} to {:.2f} ({} bands)", *least, *most, reflectance.size());
  }
  return fmt::format("{:.2f}, {:.2f}, {:.2f} (red, green, blue)", reflectance[0], reflectance[1], reflectance[2]);
}

std::optional<lighting::Emission> told_emission(const SourceMaterial& source) {
  if (!(source.luminance_cd_m2.value_or(0.0) > 0.0)) return std::nullopt;
  return lighting::Emission{.flux_lm = {}, .luminance_cd_m2 = source.luminance_cd_m2};
}

std::string side_words(const lighting::SideMaterial& side) {
  std::string words =
      side.reflectance ? "reflectance " + reflectance_words(*side.reflectance) : "reflectance by orientation";
  if (!side.emission) return words;
  return words + (side.emission->flux_lm ? fmt::format(", shines with {:g} lm", *side.emission->flux_lm)
                                         : fmt::format(", shines with {:g} cd/m²", *side.emission->luminance_cd_m2));
}

MaterialAssumptions::Reflectance MaterialAssumptions::reflectance(const SourceMaterial& source) {
  if (auto told = told_reflectance(source)) return {std::move(told), source.told_by};
  if (const Finish* finish = finish_named_like(source.name)) {
    const double reflectance = finish->reflectance + finish->specular;
    named_like_[fmt::format("Named like {}, and so with a reflectance of {:.2f}", finish->name, reflectance)].push_back(
        source.name);
    if (finish->specular > 0.0) join_specular(source.name);
    return {lighting::Spectrum{static_cast<float>(reflectance)}, fmt::format("named like {}", finish->name)};
  }
  if (source.textured) {
    textured_.push_back(source.name);
    return {std::nullopt, "a texture, which is not read"};
  }
  if (told_emission(source)) return {std::nullopt, source.told_by};
  by_orientation_.push_back(source.name);
  return {std::nullopt, "nothing says what it is"};
}

std::optional<lighting::Spectrum> MaterialAssumptions::told_reflectance(const SourceMaterial& source) {
  if (source.textured || !source.diffuse) return std::nullopt;
  std::array<double, 3> colour = *source.diffuse;
  const double specular = source.specular.value_or(0.0);
  if (specular != 0.0) join_specular(source.name);
  for (double& band : colour) band += specular;
  // Programs export a colour of 1 1 1 for "white".
  const auto [least, most] = std::minmax_element(colour.begin(), colour.end());
  if (*least < 0.0 || *most > kMostReflectance) implausible_.push_back(source.name);
  for (double& band : colour) band = std::clamp(band, 0.0, kMostReflectance);
  told_by_[how_it_was_told(source)].push_back(source.name);
  if (is_grey(colour)) return lighting::Spectrum{static_cast<float>(colour[0])};
  return lighting::Spectrum{static_cast<float>(colour[0]), static_cast<float>(colour[1]),
                            static_cast<float>(colour[2])};
}

void MaterialAssumptions::note_if_translucent(const SourceMaterial& source) {
  if (!(source.translucent.value_or(0.0) > 0.0)) return;
  translucent_.push_back(fmt::format("{} ({:.2f})", source.name, *source.translucent));
}

void MaterialAssumptions::decide(const SourceMaterial& source, lighting::Material& material) {
  if (source.shines) shining_.push_back(source.name);
  note_if_translucent(source);
  if (!decide_glazing(source, material)) decide_sides(source, material);
}

bool MaterialAssumptions::decide_glazing(const SourceMaterial& source, lighting::Material& material) {
  double transmittance = kGlassTransmittance;
  if (source.transmittance_normal.value_or(0.0) >= kLeastTransmittance) {
    transmittance = *source.transmittance_normal;
    if (transmittance > 1.0) implausible_.push_back(source.name);
    transmittance = std::min(transmittance, 1.0);
    told_glazing_.push_back(source.name);
    material.why = source.told_by;
  } else if (source.photometric) {
    return false;
  } else if (is_named_like_glass(source.name)) {
    named_like_glass_.push_back(source.name);
    material.why = "named like glass";
  } else if (source.opacity.value_or(1.0) < kClearBelow) {
    transparent_.push_back(source.name);
    material.why = "transparent in the model's file";
  } else {
    return false;
  }
  material.glazing = lighting::Glazing{.transmittance_normal = transmittance};
  material.became = fmt::format("glazing {:.2f}", transmittance);
  return true;
}

void MaterialAssumptions::decide_sides(const SourceMaterial& source, lighting::Material& material) {
  Reflectance decided = reflectance(source);
  material.front.reflectance = std::move(decided.value);
  material.back.reflectance = material.front.reflectance;
  material.front.emission = told_emission(source);
  material.became = side_words(material.front);
  material.why = std::move(decided.why);
}

std::vector<std::string> MaterialAssumptions::sentences() const {
  std::vector<std::string> text;
  const auto add = [&](const std::string& what, const Names& names) {
    if (!names.empty()) text.push_back(fmt::format("{}: material{}.", what, told(names)));
  };
  const std::string by_orientation =
      "their sides reflect by orientation (up 0.2, down 0.7, vertical 0.5, outdoors 0.2)";
  add(fmt::format("Named like glass, and so glazing with a transmittance of {:.2f}", kGlassTransmittance),
      named_like_glass_);
  add(fmt::format("Transparent in the model's file, and so glazing with a transmittance of {:.2f}",
                  kGlassTransmittance),
      transparent_);
  add("Glazing with the transmittance that the file tells", told_glazing_);
  for (const auto* by_sentence : {&told_by_, &named_like_})
    for (const auto& [sentence, names] : *by_sentence) add(sentence, names);
  add("The specular reflectance joins the diffuse one", specular_);
  add(fmt::format(
          "The file gives reflectances outside 0 … {0:.2f} or transmittances over 1, which no real surface has; "
          "the nearest possible was taken",
          kMostReflectance),
      implausible_);
  add(fmt::format("The study gives a reflectance over {:.2f}, which hardly any surface has; it was taken as given",
                  kMostReflectance),
      too_bright_);
  add("Diffuse transmission (in brackets) is not computed in this version, and they are opaque", translucent_);
  add("Textures are not read; " + by_orientation, textured_);
  add("Nothing says what they are made of, and " + by_orientation, by_orientation_);
  add("How they shine has no photometric meaning, and they stay dark; give emission in the study", shining_);
  return text;
}

}  // namespace clerestory::io
