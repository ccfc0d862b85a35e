// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "io/study_tables.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

/// The entry with the exact name, else the first pattern that fits.
const StudyValue* entry_of(const StudyValue* table, const std::string& part) {
  if (table == nullptr) return nullptr;
  const StudyValue* pattern = nullptr;
  for (const StudyValue& entry : table->children) {
    if (entry.key == part) return &entry;
    if (pattern == nullptr && is_glob(entry.key) && matches_glob(entry.key, part)) pattern = &entry;
  }
  return pattern;
}

std::optional<mesh::CurvedPart> curved_part(const StudyValue* entry, bool tagged) {
  const std::string word = entry != nullptr ? text_or(*entry, "subdivision", "") : std::string();
  if (word == "none" || (word.empty() && !tagged)) return std::nullopt;
  mesh::CurvedPart part;
  if (word == "loop") part.scheme = mesh::SubdivisionScheme::kLoop;
  if (entry == nullptr) return part;
  const StudyValue* tolerance = entry->find("chord_tolerance");
  if (tolerance != nullptr && tolerance->is_number()) part.chord_tolerance_m = tolerance->number;
  return part;
}

void refuse_unmatched(const StudyValue* table, const std::vector<std::string>& parts) {
  if (table == nullptr) return;
  for (const StudyValue& entry : table->children) {
    const bool matched = std::any_of(parts.begin(), parts.end(), [&](const std::string& part) {
      return part == entry.key || (is_glob(entry.key) && matches_glob(entry.key, part));
    });
    if (matched) continue;
    const auto meant = nearest(entry.key, parts);
    throw entry.error(fmt::format("no part of the model is named {}", in_quotes(entry.key)),
                      meant ? fmt::format("did you mean \"{}\"?", printable(*meant)) : "it has " + list_names(parts));
  }
}

}  // namespace

mesh::SubdivisionReport read_parts_table(const StudyValue& root, const std::filesystem::path& model,
                                         lighting::Study& study) {
  const StudyValue* table = find_table(root, "parts");
  refuse_unmatched(table, study.model.part_names);
  const std::vector<bool> tagged = mesh::tagged_parts(study.model);
  std::vector<std::optional<mesh::CurvedPart>> parts;
  for (std::size_t p = 0; p < tagged.size(); ++p)
    parts.push_back(curved_part(entry_of(table, study.model.part_names[p]), tagged[p]));
  mesh::SubdivisionReport report;
  if (std::none_of(parts.begin(), parts.end(), [](const auto& part) { return part.has_value(); })) return report;
  try {
    study.model = mesh::subdivide(study.model, parts, &report);
  } catch (const InputError& error) {
    throw InputError(model.string(), error.line(), error.problem(), error.hint());
  }
  for (const std::string& notice : report.notices) study.assumptions.push_back(notice);
  return report;
}

}  // namespace clerestory::io
