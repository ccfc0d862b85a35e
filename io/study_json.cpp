// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "io/study_tree.h"

namespace clerestory::io {

namespace {

nlohmann::ordered_json json_of(const StudyValue& value) {
  switch (value.kind) {
    case StudyValue::Kind::kTable: {
      auto object = nlohmann::ordered_json::object();
      for (const StudyValue& child : value.children) object[child.key] = json_of(child);
      return object;
    }
    case StudyValue::Kind::kArray: {
      auto array = nlohmann::ordered_json::array();
      for (const StudyValue& child : value.children) array.push_back(json_of(child));
      return array;
    }
    case StudyValue::Kind::kInteger:
      return static_cast<std::int64_t>(value.number);
    case StudyValue::Kind::kNumber:
      return value.number;
    case StudyValue::Kind::kBoolean:
      return value.boolean;
    case StudyValue::Kind::kText:
    case StudyValue::Kind::kDate:
      return value.text;
  }
  return nullptr;
}

}  // namespace

std::string to_json(const StudyValue& study) {
  return json_of(study).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace clerestory::io
