// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/model_file.h"
#include "lighting/study.h"
#include "mesh/subdivision.h"

namespace clerestory::io {

/// How a study is read.
struct ReadOptions {
  /// The study answers the daylight factor: the sky becomes the CIE overcast sky whatever the file says, and where that
  /// differs an assumption says so.
  lighting::Study::Kind kind = lighting::Study::Kind::kIlluminance;
  /// Overrides in the order given, each "table.key=value" with TOML's value syntax; a bare word stands for a string.
  /// Elements of arrays by number: "grids.0.spacing=0.5". Relative paths in them are relative to the study file.
  std::vector<std::string> set;
  /// Grids in place of the study's, each by the keys of [[grids]]: "name = 'desks', surface = 'desk*'".
  std::vector<std::string> grids = {};
  /// Reads what describes the model, [model], [parts] and [materials], and leaves out sky, grids and accuracy.
  bool model_only = false;
};

/// A study as read, with what a record of the run needs.
struct StudyInput {
  lighting::Study study;
  /// The study with all defaults filled in, as a JSON object in the words of the study file.
  std::string effective_json;
  /// The model's file as read, but for its polygons, which are study.model.
  ModelFile model;
  /// What became of the model's control cages; in study.model their triangles stand in their place.
  mesh::SubdivisionReport curved;
  /// Every file that was read: study, model, MTL, .pts.
  std::vector<std::filesystem::path> input_files;
};

/// Reads a study file (.toml), or a model file alone with every default.
/// Throws InputError with file and line for whatever is wrong with any of the files, unknown keys and values out of range
/// included, and for what this version does not support.
StudyInput read_study(const std::filesystem::path& study_or_model, const ReadOptions& options = {});

}  // namespace clerestory::io
