// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/material_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/words.h"

namespace clerestory::io {

namespace {

constexpr double kGlassTransmittance = 0.70;  // of a common double glazing, at normal incidence
constexpr double kMostDiffuse = 0.95;         // fresh snow; programs export Kd 1 1 1 for "white"
constexpr double kClearBelow = 0.5;           // opacity

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

bool is_letter(char c) {
  // Bytes of UTF-8 beyond ASCII are letters with accents.
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}

std::vector<std::string> words_of_name(std::string_view name) {
  std::vector<std::string> words(1);
  char before = ' ';
  for (const char c : name) {
    const bool hump = before >= 'a' && before <= 'z' && c >= 'A' && c <= 'Z';
    if ((hump || !is_letter(c)) && !words.back().empty()) words.emplace_back();
    if (is_letter(c)) words.back() += c;
    before = c;
  }
  for (std::string& word : words) word = lower(word);
  return words;
}

/// German compounds end in the thing itself: Isolierglas; English ones too: safetyglass.
bool is_compound_of_glass(const std::string& word) {
  if (contains(kOtherWords, word)) return false;
  const bool other = word.starts_with("fibre") || word.starts_with("fiber") || word.starts_with("faser") ||
                     word.starts_with("foam") || word.starts_with("schaum") || word.starts_with("hour");
  return !other && (word.ends_with("glas") || word.ends_with("glass"));
}

bool is_grey(const std::array<double, 3>& colour) { return colour[0] == colour[1] && colour[1] == colour[2]; }

std::string told(const std::vector<std::string>& names) { return (names.size() == 1 ? " " : "s ") + list_names(names); }

}  // namespace

bool is_named_like_glass(std::string_view name) {
  const auto words = words_of_name(name);
  const auto is_other = [](const std::string& word) { return contains(kOtherWords, word); };
  const auto is_glass = [](const std::string& word) {
    return contains(kGlassWords, word) || is_compound_of_glass(word);
  };
  return std::any_of(words.begin(), words.end(), is_glass) && std::none_of(words.begin(), words.end(), is_other);
}

std::string reflectance_words(const lighting::Spectrum& reflectance) {
  if (reflectance.size() != 3) return fmt::format("{:.2f}", reflectance.front());
  return fmt::format("{:.2f}, {:.2f}, {:.2f} (red, green, blue)", reflectance[0], reflectance[1], reflectance[2]);
}

std::optional<lighting::Spectrum> MaterialAssumptions::diffuse_reflectance(const SourceMaterial& mtl) {
  if (!mtl.diffuse) return std::nullopt;
  if (mtl.textured) {
    textured_.push_back(mtl.name);
    return std::nullopt;
  }
  std::array<double, 3> colour = *mtl.diffuse;
  if (*std::max_element(colour.begin(), colour.end()) > kMostDiffuse) clamped_.push_back(mtl.name);
  for (double& band : colour) band = std::min(band, kMostDiffuse);
  by_colour_.push_back(mtl.name);
  if (is_grey(colour)) return lighting::Spectrum{static_cast<float>(colour[0])};
  return lighting::Spectrum{static_cast<float>(colour[0]), static_cast<float>(colour[1]),
                            static_cast<float>(colour[2])};
}

void MaterialAssumptions::decide(const SourceMaterial& mtl, lighting::Material& material) {
  if (mtl.shines) shining_.push_back(mtl.name);
  const bool like_glass = is_named_like_glass(mtl.name);
  if (like_glass || mtl.opacity.value_or(1.0) < kClearBelow) {
    (like_glass ? named_like_glass_ : transparent_).push_back(mtl.name);
    material.glazing = lighting::Glazing{.transmittance_normal = kGlassTransmittance};
    material.became = fmt::format("glazing {:.2f}", kGlassTransmittance);
    material.why = like_glass ? "named like glass" : "transparent in the MTL";
    return;
  }
  material.front.reflectance = diffuse_reflectance(mtl);
  material.back.reflectance = material.front.reflectance;
  if (material.front.reflectance) {
    material.became = "reflectance " + reflectance_words(*material.front.reflectance);
    material.why = "Kd of the MTL";
    return;
  }
  if (!mtl.textured) by_orientation_.push_back(mtl.name);
  material.became = "reflectance by orientation";
  material.why = mtl.textured ? "a texture, which is not read" : "nothing says what it is";
}

std::vector<std::string> MaterialAssumptions::sentences() const {
  std::vector<std::string> text;
  if (!named_like_glass_.empty())
    text.push_back(fmt::format("Named like glass, and so glazing with a transmittance of {:.2f}: material{}.",
                               kGlassTransmittance, told(named_like_glass_)));
  if (!transparent_.empty())
    text.push_back(fmt::format("Transparent in the MTL, and so glazing with a transmittance of {:.2f}: material{}.",
                               kGlassTransmittance, told(transparent_)));
  if (!by_colour_.empty())
    text.push_back(fmt::format("Kd of the MTL was taken as diffuse reflectance: material{}.", told(by_colour_)));
  if (!clamped_.empty())
    text.push_back(fmt::format(
        "Kd of the MTL is over {0:.2f}, no real surface reflects so much, and {0:.2f} was taken: material{1}.",
        kMostDiffuse, told(clamped_)));
  constexpr const char* kByOrientation =
      "their sides reflect by orientation (up 0.2, down 0.7, vertical 0.5, outdoors 0.2)";
  if (!textured_.empty())
    text.push_back(fmt::format("Textures are not read; {}: material{}.", kByOrientation, told(textured_)));
  if (!by_orientation_.empty())
    text.push_back(
        fmt::format("Nothing says what they are made of, and {}: material{}.", kByOrientation, told(by_orientation_)));
  if (!shining_.empty())
    text.push_back(fmt::format(
        "Ke of the MTL has no photometric meaning, and they stay dark; give emission in the study: material{}.",
        told(shining_)));
  return text;
}

}  // namespace clerestory::io
