// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clerestory::io {

/// A common finish of buildings, grey, with a value from the literature: what a study can name, and what the name of a material can say.
struct Finish {
  std::string_view name;                            ///< as the study writes it
  double reflectance = 0.0;                         ///< diffuse
  double specular = 0.0;                            ///< mirrored, beside the diffuse one
  std::optional<double> transmittance_normal = {};  ///< of glazing; the reflectances mean nothing then
  /// Names of materials that say it: alternatives between commas, of each all words are in the name, in any order. Empty: no name does.
  std::string_view named = {};
  std::string_view source = {};  ///< key in docs/references.bib, with what it says where that is a range
};

/// All finishes.
std::span<const Finish> finishes();

/// Their names, for messages.
std::vector<std::string> finish_names();

/// The finish of that name; nullptr if there is none.
const Finish* find_finish(std::string_view name);

/// What the name of a material says that it is made of: the finish of which most words are in the name, of several the first; "Concrete,
/// cast in place" and "Beton 2" are concrete. nullptr where the name says none, and where one word does and another says that it is painted, white, wool …
const Finish* finish_named_like(std::string_view material);

/// "diffuse 0.30", for messages and the page.
std::string finish_words(const Finish& finish);

/// The table of finishes in docs/materials.md.
std::string finish_table();

}  // namespace clerestory::io
