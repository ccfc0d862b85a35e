// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "io/study_tables.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

namespace fs = std::filesystem;

mesh::CleanOptions::Repair repair_of(const std::string& word) {
  if (word == "report") return mesh::CleanOptions::Repair::kReport;
  return word == "off" ? mesh::CleanOptions::Repair::kOff : mesh::CleanOptions::Repair::kAuto;
}

fs::path model_path(const StudyValue& root, const StudyValue& table, const fs::path& folder) {
  const StudyValue* file = table.find("file");
  if (file == nullptr)
    throw InputError(root.file, table.line, "the study names no model", "write [model] and file = \"room.obj\"");
  const fs::path path = folder / file->text;
  std::error_code error;
  if (fs::exists(path, error)) return path;
  throw file->error(fmt::format("there is no model {}", in_quotes(path.string())),
                    "paths are relative to the study file");
}

}  // namespace

ModelFile read_model_table(const StudyValue& root, StudyPlace& place, lighting::Study& study) {
  const StudyValue& table = *root.find("model");
  const fs::path path = model_path(root, table, place.folder);
  ModelFormat format;
  format.unit = length_unit(text_or(table, "units", ""));
  if (const StudyValue& up = *table.find("up"); up.is_given()) format.up = up.text == "y" ? UpAxis::kY : UpAxis::kZ;
  ModelFile model = read_model(path, format);
  study.model = std::move(model.model);
  for (const ModelSpace& space : model.spaces) study.spaces.push_back({space.name, space.boundary});
  study.clean.repair = repair_of(text_or(table, "repair", "auto"));
  if (const StudyValue* gap = table.find("gap"); gap != nullptr && gap->is_number()) study.clean.gap_m = gap->number;
  study.assumptions.insert(study.assumptions.end(), model.notices.begin(), model.notices.end());
  place.files.insert(place.files.end(), model.files.begin(), model.files.end());
  return model;
}

}  // namespace clerestory::io
