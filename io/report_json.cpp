// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report_json.h"

#include <algorithm>
#include <cmath>

#include "io/defect_advice.h"

namespace clerestory::io {

namespace {

const char* word(mesh::RoomOpening::Kind kind) {
  switch (kind) {
    case mesh::RoomOpening::Kind::kGlazing:
      return "glazing";
    case mesh::RoomOpening::Kind::kAir:
      return "air";
    case mesh::RoomOpening::Kind::kHole:
      return "hole";
  }
  return "";
}

}  // namespace

Json materials_json(const std::vector<lighting::Results::MaterialUse>& uses) {
  Json list = Json::array();
  for (const auto& use : uses) list.push_back({{"name", use.name}, {"became", use.became}, {"why", use.why}});
  return list;
}

Json rooms_json(const std::vector<mesh::Room>& rooms) {
  Json list = Json::array();
  for (const mesh::Room& room : rooms) {
    Json openings = Json::array();
    for (const mesh::RoomOpening& o : room.openings) {
      openings.push_back({{"kind", word(o.kind)},
                          {"to", o.beyond == mesh::kNoRoom ? "outside" : rooms[o.beyond].name},
                          {"area_m2", rounded(o.area_m2)},
                          {"at", {rounded(o.at.x), rounded(o.at.y), rounded(o.at.z)}}});
    }
    list.push_back({{"name", room.name},
                    {"floor_area_m2", rounded(room.floor_area_m2)},
                    {"volume_m3", rounded(room.volume_m3)},
                    {"closed", room.closed()},
                    {"source", room.stated ? "file" : "geometry"},
                    {"openings", std::move(openings)}});
    if (!room.not_apart.empty()) list.back()["not_apart"] = room.not_apart;
  }
  return list;
}

Json defects_json(const mesh::CleanReport& report) {
  Json object = Json::object();
  for (const mesh::Defect& defect : report.defects) {
    Json& json = object[defect.kind] = {{"found", defect.found}, {"mended", defect.mended}};
    for (const auto& [reason, count] : reasons_of_left(defect))
      json["left"].push_back({{"reason", reason}, {"count", count}});
  }
  return object;
}

Json meetings_json(const mesh::CleanReport& report) {
  return {{"contacts", report.contacts},
          {"uncut_crossings", report.uncut_crossings},
          {"two_sided_polygons", report.two_sided}};
}

Json shadow_lines_json(const mesh::LineSelection& selection, std::size_t sources) {
  const auto by_order = [](const mesh::LineSelection::Counts& counts) {
    return Json{{"d0", counts[0]}, {"d1", counts[1]}, {"d2", counts[2]}};
  };
  return {{"found", by_order(selection.found)},  {"kept", by_order(selection.kept_count)}, {"merged", selection.merged},
          {"within_tolerance", selection.light}, {"over_cap", selection.over_cap},         {"sources", sources}};
}

Json mesh_json(const mesh::MeshReport& report) {
  return {{"triangles", report.triangles},
          {"min_angle_deg", report.min_angle_deg},
          {"below_angle_bound", report.small_angles},
          {"at_small_input_angles", report.small_input_angles},
          {"line_length_m", report.line_length_m},
          {"faces_with_fewer_lines", report.faces_with_fewer_lines}};
}

double rounded(double value) {
  constexpr double kSteps = 1e4;
  return std::round(value * kSteps) / kSteps;
}

std::vector<std::string> without_repeats(std::vector<std::string> sentences) {
  std::vector<std::string> kept;
  for (std::string& sentence : sentences)
    if (std::find(kept.begin(), kept.end(), sentence) == kept.end()) kept.push_back(std::move(sentence));
  return kept;
}

std::string json_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace clerestory::io
