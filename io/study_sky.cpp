// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "io/study_schema.h"
#include "io/study_tables.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

lighting::Sky::Type type_of(const std::string& word) {
  if (word == "none") return lighting::Sky::Type::kNone;
  return word == "uniform" ? lighting::Sky::Type::kUniform : lighting::Sky::Type::kCieOvercast;
}

/// Puts the CIE overcast sky in place of what the study says, and says so where that differs.
void make_overcast(StudyValue& table, lighting::Study& study) {
  StudyValue& type = *table.find("type");
  std::vector<std::string> set_aside;
  if (type.text != "cie-overcast") set_aside.push_back("type = \"" + type.text + "\"");
  std::erase_if(table.children, [&](const StudyValue& member) {
    const StudyKey* key = find_key("sky." + member.key);
    const bool given = !key->supported && !is_default(*key, member);
    if (given) set_aside.push_back(member.key);
    return !key->supported;
  });
  table.find("type")->text = "cie-overcast";
  if (!set_aside.empty())
    study.assumptions.push_back(
        fmt::format("The daylight factor is that under the CIE overcast sky; the study's {} in [sky] was set aside.",
                    list_names(set_aside)));
}

}  // namespace

void read_sky_table(StudyValue& root, lighting::Study& study) {
  StudyValue& table = *root.find("sky");
  if (study.kind == lighting::Study::Kind::kDaylight) make_overcast(table, study);
  study.sky.type = type_of(text_or(table, "type", "cie-overcast"));
  study.sky.horizontal_illuminance_lux = number_or(table, "horizontal_illuminance", 10'000.0);
  study.sky.ground_reflectance = number_or(table, "ground_reflectance", 0.2);
}

void read_mesh_table(const StudyValue& root, lighting::Study& study) {
  const StudyValue& table = *root.find("mesh");
  study.mesh.discontinuities = text_or(table, "discontinuities", "auto") != "off";
  study.mesh.max_elements = static_cast<std::size_t>(table.find("max_elements")->number);
}

void read_accuracy_table(StudyValue& root, lighting::Study& study) {
  StudyValue& target = *root.find("accuracy")->find("target");
  if (target.kind == StudyValue::Kind::kText) {
    target.number = parse_share(target.text).value_or(target.number);
    target.kind = StudyValue::Kind::kNumber;
  }
  study.accuracy.target = target.number;
}

}  // namespace clerestory::io
