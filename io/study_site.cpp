// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "io/study_tables.h"

namespace clerestory::io {

namespace {

void set_number(StudyValue& table, std::string_view key, double number) {
  StudyValue value;
  value.kind = StudyValue::Kind::kNumber;
  value.key = key;
  value.number = number;
  table.children.push_back(std::move(value));
}

StudyValue& site_table(StudyValue& root) {
  if (StudyValue* table = root.find("site")) return *table;
  StudyValue table;
  table.key = "site";
  root.children.push_back(std::move(table));
  return root.children.back();
}

/// Latitude and longitude make one place: both are the study's or both the file's.
void take_place(StudyValue& root, const ModelSite& site, lighting::Study& study) {
  if (!site.latitude_deg || !site.longitude_deg) return;
  StudyValue& table = site_table(root);
  if (table.find("latitude") != nullptr || table.find("longitude") != nullptr) return;
  set_number(table, "latitude", *site.latitude_deg);
  set_number(table, "longitude", *site.longitude_deg);
  study.assumptions.push_back(
      fmt::format("The building stands at latitude {:.4f} and longitude {:.4f} degrees, as the model's file says. Set "
                  "site.latitude and site.longitude where that is wrong.",
                  *site.latitude_deg, *site.longitude_deg));
}

}  // namespace

void read_site_table(StudyValue& root, const ModelSite& site, lighting::Study& study) {
  StudyValue& north = *root.find("model")->find("north");
  if (!north.is_given() && site.north_deg) {
    north.kind = StudyValue::Kind::kNumber;
    north.number = *site.north_deg;
    study.assumptions.push_back(
        fmt::format("True north is {:.2f} degrees from +y, counter-clockwise, as the model's file says. Set "
                    "model.north where that is wrong.",
                    north.number));
  }
  study.north_deg = north.number;
  take_place(root, site, study);
}

}  // namespace clerestory::io
