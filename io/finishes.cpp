// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/finishes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/words.h"

namespace clerestory::io {

namespace {

constexpr Finish kFinishes[] = {
    // What standards and programs take where nothing is known.
    {.name = "generic-ceiling", .reflectance = 0.70, .source = "Daysim"},
    {.name = "generic-wall", .reflectance = 0.50, .source = "Daysim"},
    {.name = "generic-floor", .reflectance = 0.20, .source = "Daysim"},
    {.name = "generic-furniture", .reflectance = 0.50, .source = "Daysim"},
    {.name = "generic-facade", .reflectance = 0.35, .source = "Daysim"},
    {.name = "generic-ground", .reflectance = 0.20, .source = "Daysim"},

    // Paint and plaster.
    {.name = "white-paint",
     .reflectance = 0.80,
     .named = "white paint, white emulsion, white painted, weiss gestrichen, peinture blanche",
     .source = "OsramReflection"},
    {.name = "light-grey-paint", .reflectance = 0.40, .source = "OsramReflection"},
    {.name = "grey-paint", .reflectance = 0.20, .source = "OsramReflection: mid-grey"},
    {.name = "black-paint", .reflectance = 0.10, .source = "OsramReflection"},
    {.name = "plaster",
     .reflectance = 0.75,
     .named = "plaster, plasterboard, drywall, gypsum, gyp, sheetrock, gips, gipskarton, gipsputz, innenputz, platre, "
              "plâtre, "
              "placo, gesso, cartongesso, yeso, pladur",
     .source = "DialReflexion: 0.70 to 0.80"},

    // Mineral.
    {.name = "concrete",
     .reflectance = 0.30,
     .named = "concrete, cement, screed, beton, leichtbeton, stahlbeton, ortbeton, sichtbeton, estrich, zement, béton, "
              "ciment, calcestruzzo, "
              "hormigon, hormigón, cemento",
     .source = "OsramReflection; DialReflexion: raw 0.20 to 0.30"},
    {.name = "red-brick",
     .reflectance = 0.20,
     .named =
         "brick, bricks, brickwork, red brick, ziegel, ziegelstein, backstein, klinker, mauerwerk, brique, briques, "
         "mattone, mattoni, ladrillo, ladrillos",
     .source = "OsramReflection"},
    {.name = "buff-brick", .reflectance = 0.48, .named = "buff brick, yellow brick", .source = "Rea2000"},
    {.name = "breeze-block",
     .reflectance = 0.10,
     .named = "breeze block, breezeblock, cinder block",
     .source = "OsramReflection"},
    {.name = "sandstone", .reflectance = 0.18, .named = "sandstone, bluestone, sandstein", .source = "Rea2000"},
    {.name = "marble",
     .reflectance = 0.45,
     .named = "marble, marmor, marbre, marmo, mármol, white marble",
     .source = "Rea2000: white marble"},
    {.name = "slate", .reflectance = 0.08, .named = "slate, schiefer, ardoise, ardesia, pizarra", .source = "Rea2000"},
    {.name = "white-tiles",
     .reflectance = 0.70,
     .named = "white tile, white tiles, white ceramic",
     .source = "OsramReflection"},

    // Wood.
    {.name = "wood",
     .reflectance = 0.40,
     .named = "wood, wooden, timber, plywood, parquet, holz, parkett, sperrholz, bois, legno, madera",
     .source = "Rushmeier1988: between dark and blond"},
    {.name = "blond-wood",
     .reflectance = 0.50,
     .named = "blond wood, light wood, light timber, holz hell, helles holz, bois clair",
     .source = "Rushmeier1988"},
    {.name = "dark-wood",
     .reflectance = 0.30,
     .named = "dark wood, dark timber, holz dunkel, dunkles holz, bois foncé",
     .source = "Rushmeier1988"},
    {.name = "maple",
     .reflectance = 0.60,
     .named = "maple, birch, ahorn, birke, érable, bouleau, betulla, abedul",
     .source = "OsramReflection"},
    {.name = "oak",
     .reflectance = 0.30,
     .named = "oak, eiche, chêne, rovere, roble",
     .source = "OsramReflection: between light and dark"},
    {.name = "light-oak",
     .reflectance = 0.40,
     .named = "light oak, eiche hell, chêne clair",
     .source = "OsramReflection"},
    {.name = "dark-oak",
     .reflectance = 0.20,
     .named = "dark oak, eiche dunkel, chêne foncé",
     .source = "OsramReflection"},
    {.name = "walnut", .reflectance = 0.20, .named = "walnut, nussbaum, noyer, nogal", .source = "OsramReflection"},

    // Floor coverings.
    {.name = "carpet",
     .reflectance = 0.20,
     .named = "carpet, carpets, carpeting, rug, teppich, teppichboden, moquette, alfombra, moqueta",
     .source = "Lightrechner: between dark and light"},
    {.name = "light-carpet",
     .reflectance = 0.30,
     .named = "light carpet, carpet beige, teppich hell",
     .source = "Lightrechner: 0.20 to 0.40"},
    {.name = "dark-carpet",
     .reflectance = 0.10,
     .named = "dark carpet, carpet anthracite, carpet black, teppich dunkel",
     .source = "Lightrechner: 0.05 to 0.15"},

    // Metal.
    {.name = "sheet-metal", .specular = 0.80, .source = "Daysim"},
    {.name = "polished-aluminium", .specular = 0.65, .source = "Rushmeier1988"},
    {.name = "mirror",
     .specular = 0.99,
     .named = "mirror, mirrors, spiegel, miroir, specchio, espejo",
     .source = "Rushmeier1988"},

    // Glass: names that only say glass are decided before, by a rule of their own.
    {.name = "single-glazing", .transmittance_normal = 0.90, .source = "DialReflexion: clear glass 0.90 to 0.92"},
    {.name = "double-glazing", .transmittance_normal = 0.80, .source = "Daysim: clear double glazing"},

    // Outdoors.
    {.name = "asphalt",
     .reflectance = 0.07,
     .named = "asphalt, tarmac, bitumen, asphalte, asfalto",
     .source = "Rea2000"},
    {.name = "macadam", .reflectance = 0.18, .named = "macadam", .source = "Rea2000"},
    {.name = "gravel",
     .reflectance = 0.13,
     .named = "gravel, kies, schotter, gravier, ghiaia, grava",
     .source = "Rea2000"},
    {.name = "earth", .reflectance = 0.07, .named = "earth, soil, erde, erdreich, terreno", .source = "Rea2000"},
    {.name = "grass",
     .reflectance = 0.06,
     .named = "grass, lawn, gras, rasen, wiese, gazon, pelouse, prato, césped",
     .source = "Rea2000"},
    {.name = "vegetation",
     .reflectance = 0.25,
     .named = "vegetation, foliage, shrubs, hedge, hecke",
     .source = "Rea2000"},
    {.name = "snow", .reflectance = 0.74, .named = "snow, schnee, neige, neve, nieve", .source = "Rea2000"},
};

/// What covers the material that a name tells, gives it a colour of its own, or makes something else of it.
constexpr std::array<std::string_view, 32> kOtherwise{
    "paint",   "painted",    "coated", "coating",    "papered", "wallpaper", "lacquered",  "varnished",
    "peint",   "gestrichen", "peinte", "lackiert",   "tapete",  "laqué",     "verniciato", "beschichtet",
    "pintado", "wool",       "wolle",  "insulation", "foam",    "look",      "optik",      "white",
    "weiss",   "weiß",       "blanc",  "blanche",    "bianco",  "black",     "schwarz",    "noir"};

bool contains(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// How many words of an alternative are in the name, where all are; else 0.
std::size_t words_met(std::string_view alternative, const std::vector<std::string>& name) {
  const auto wanted = split_words(alternative);
  const bool all =
      std::all_of(wanted.begin(), wanted.end(), [&](std::string_view word) { return contains(name, word); });
  return all ? wanted.size() : 0;
}

std::size_t words_met(const Finish& finish, const std::vector<std::string>& name) {
  std::size_t most = 0;
  for (std::string_view rest = finish.named; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    most = std::max(most, words_met(rest.substr(0, comma), name));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return most;
}

}  // namespace

std::span<const Finish> finishes() { return kFinishes; }

std::vector<std::string> finish_names() {
  std::vector<std::string> names;
  for (const Finish& finish : kFinishes) names.emplace_back(finish.name);
  return names;
}

const Finish* find_finish(std::string_view name) {
  const auto at =
      std::find_if(std::begin(kFinishes), std::end(kFinishes), [&](const Finish& f) { return f.name == name; });
  return at == std::end(kFinishes) ? nullptr : at;
}

const Finish* finish_named_like(std::string_view material) {
  const auto words = name_words(material);
  const Finish* best = nullptr;
  std::size_t most = 0;
  for (const Finish& finish : kFinishes) {
    const std::size_t met = words_met(finish, words);
    if (met <= most) continue;
    most = met;
    best = &finish;
  }
  const bool otherwise =
      std::any_of(kOtherwise.begin(), kOtherwise.end(), [&](auto word) { return contains(words, word); });
  return otherwise && most < 2 ? nullptr : best;
}

std::string finish_words(const Finish& finish) {
  if (finish.transmittance_normal) return fmt::format("glazing {:.2f}", *finish.transmittance_normal);
  if (finish.specular > 0.0) return fmt::format("specular {:.2f}", finish.specular);
  return fmt::format("diffuse {:.2f}", finish.reflectance);
}

std::string finish_table() {
  std::string text = "| finish | value | source | names of materials that say it |\n|---|---|---|---|\n";
  for (const Finish& finish : kFinishes)
    text += fmt::format("| `{}` | {} | {} | {} |\n", finish.name, finish_words(finish), finish.source, finish.named);
  return text;
}

}  // namespace clerestory::io
