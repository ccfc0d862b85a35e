// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/study_schema.h"
#include "io/study_tables.h"
#include "io/study_tree.h"
#include "io/text_file.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestStudy = std::uint64_t{16} << 20;  // bytes

bool is_study_file(const fs::path& path) { return lower(path.extension().string()) == ".toml"; }

/// The tree of a study that consists of a model file alone.
StudyValue study_of_model(const fs::path& model) {
  StudyValue file;
  file.kind = StudyValue::Kind::kText;
  file.key = "file";
  file.text = model.filename().string();
  file.file = model.string();
  StudyValue table;
  table.key = "model";
  table.children.push_back(std::move(file));
  StudyValue root;
  root.file = model.string();
  root.children.push_back(std::move(table));
  return root;
}

StudyValue read_tree(const fs::path& path, const ReadOptions& options) {
  const bool is_study = is_study_file(path);
  require_file(path, is_study ? "study" : "study or model");
  StudyValue root =
      is_study ? parse_study(read_text_file(path, "study", kLargestStudy), path.string()) : study_of_model(path);
  for (const std::string& setting : options.set) apply_override(root, setting);
  if (!options.grids.empty()) replace_grids(root, options.grids);
  return root;
}

/// Takes the unit that was found into the tree, so that the record of the run says what was computed.
void record_unit(StudyValue& root, LengthUnit unit) {
  StudyValue& table = *root.find("model");
  if (table.find("units") != nullptr) return;
  StudyValue value = parse_value("\"" + std::string(unit_word(unit)) + "\"", {});
  value.key = "units";
  table.children.push_back(std::move(value));
}

/// The same for the axis that points up. Where nothing but a model was given, that is said.
void record_up(StudyValue& root, UpAxis up, bool is_study, lighting::Study& study) {
  StudyValue& value = *root.find("model")->find("up");
  if (value.is_given()) return;
  value.text = up == UpAxis::kZ ? "z" : "y";
  if (!is_study)
    study.assumptions.push_back(
        fmt::format("The model's {} axis points up. Set model.up where that is wrong.", value.text));
}

}  // namespace

StudyInput read_study(const fs::path& study_or_model, const ReadOptions& options) {
  StudyValue root = read_tree(study_or_model, options);
  check_study(root, options.kind);
  StudyPlace place{.folder = study_or_model.parent_path(), .files = {study_or_model}};
  fill_defaults(root);

  StudyInput input;
  lighting::Study& study = input.study;
  study.kind = options.kind;
  study.name = study_or_model.stem().string();
  input.model = read_model_table(root, place, study);
  const ModelFile& model = input.model;
  input.curved = read_parts_table(root, model.files.front(), study);
  record_up(root, model.up, is_study_file(study_or_model), study);
  read_site_table(root, model.site, study);
  read_spectrum_table(root, study);
  read_materials_table(root, model, study);
  if (!options.model_only) {
    read_sky_table(root, place, study);
    read_luminaires_table(root, place, study);
    read_fixtures_table(root, model.fixtures, place, study);
    read_grids_table(root, place, study);
    read_observers_table(root, study);
    read_tasks_table(root, study);
    read_results_table(root, study);
    read_mesh_table(root, study);
    read_accuracy_table(root, study);
  }

  record_unit(root, model.unit);
  input.effective_json = to_json(root);
  for (fs::path& file : place.files)
    if (std::find(input.input_files.begin(), input.input_files.end(), file) == input.input_files.end())
      input.input_files.push_back(std::move(file));
  return input;
}

}  // namespace clerestory::io
