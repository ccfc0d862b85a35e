// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "io/study_tables.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

lighting::Columns columns_of(const std::string& word) {
  if (word == "groups") return lighting::Columns::kGroups;
  if (word == "sky-145") return lighting::Columns::kSky145;
  return word == "sky-577" ? lighting::Columns::kSky577 : lighting::Columns::kMix;
}

/// Groups name columns of tables.
void check_group(const StudyValue* table) {
  const StudyValue* group = table != nullptr ? table->find("group") : nullptr;
  if (group == nullptr) return;
  const std::string& name = group->text;
  const bool fits = !name.empty() && trim(name) == name && name.find_first_of(",;\"") == std::string::npos &&
                    std::none_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  if (!fits)
    throw group->error(fmt::format("the group's name {} cannot name a column", in_quotes(name)),
                       "use letters, digits, - and _");
  if (name == "sky" || name == "ground" || name == "sun" || name.starts_with("sky-"))
    throw group->error(fmt::format("the group's name {} belongs to a part of the daylight", in_quotes(name)),
                       "choose another name");
}

}  // namespace

void read_results_table(const StudyValue& root, lighting::Study& study) {
  study.columns = columns_of(text_or(*root.find("results"), "columns", "mix"));
  if (const StudyValue* materials = find_table(root, "materials")) {
    for (const StudyValue& entry : materials->children) {
      check_group(find_table(entry, "emission"));
      if (const StudyValue* back = find_table(entry, "back")) check_group(find_table(*back, "emission"));
    }
  }
  if (const StudyValue* luminaires = root.find("luminaires")) {
    for (const StudyValue& table : luminaires->children) check_group(&table);
  }
  // The daylight factor leaves all lamps dark.
  if (study.kind == lighting::Study::Kind::kDaylight) return;
  for (const StudyValue& group : find_table(root, "groups")->children)
    study.dimming.push_back({group.key, number_or(group, "dimming", 1.0)});
}

}  // namespace clerestory::io
