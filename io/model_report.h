// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/study_file.h"
#include "lighting/results.h"
#include "mesh/progress.h"

namespace clerestory::io {

/// What is known of a model: what `inspect` tells, and `clean` beside the model that it writes. Model coordinates [m].
struct ModelReport {
  /// What is found in a clean model.
  struct Spaces {
    std::vector<mesh::Room> rooms;
    std::size_t openings = 0;  ///< panes and air polygons that look into a brighter place
    double openings_area_m2 = 0.0;
  };

  const StudyInput& input;  ///< outlives the report
  std::string file;         ///< as the user named it
  std::string version;      ///< of the program
  mesh::CleanReport clean;
  std::optional<Spaces> spaces = {};  ///< none where they were not looked for
  std::vector<std::string> assumptions = {};
  std::vector<std::string> notices = {};
  std::vector<std::string> files = {};  ///< names of files that were written
};

/// Cleans the model of a study and looks for its rooms and openings.
/// @param file  as the user named it
/// Throws InputError as the computation would: nothing left of the model …
ModelReport look_at(const StudyInput& input, const std::string& file, const std::string& version, Progress& progress);

/// A scheme in the words of the study file.
std::string scheme_word(mesh::SubdivisionScheme scheme);

/// The report for a reader: head, parts, curved parts, materials, rooms, defects with the worst three of each kind, assumptions.
std::string report_text(const ModelReport& report);

/// The report for a program, in the words of summary.json (docs/command-line.md lists the keys).
std::string report_json_text(const ModelReport& report);

}  // namespace clerestory::io
