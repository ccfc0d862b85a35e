// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model_report.h"

#include "io/defect_advice.h"
#include "io/report_json.h"
#include "lighting/scene.h"

namespace clerestory::io {

namespace {

mesh::Box box_of(const mesh::Model& model) {
  mesh::Box box;
  for (const mesh::Point& p : model.vertices) box.add(p);
  return box;
}

Json coordinates(const mesh::Point& p) { return {rounded(p.x), rounded(p.y), rounded(p.z)}; }

Json place_json(const mesh::Model& model, const mesh::Defect::Place& place) {
  Json json = {{"at", coordinates(place.at)},
               {"polygon", place.polygon},
               {"part", model.part_names[model.polygon_part[place.polygon].index()]}};
  if (model.polygon_line[place.polygon] != 0) json["line"] = model.polygon_line[place.polygon];
  if (place.size_m > 0.0) json["size_m"] = place.size_m;
  json["mended"] = place.mended;
  if (!place.note.empty()) json["note"] = place.note;
  return json;
}

/// What summary.json says of the defects, and of each kind the worst places and what to do.
Json told_defects(const ModelReport& report) {
  Json json = defects_json(report.clean);
  for (const mesh::Defect& defect : report.clean.defects) {
    Json worst = Json::array();
    for (const auto& place : worst_places(defect)) worst.push_back(place_json(report.input.study.model, place));
    json[defect.kind]["to_do"] = defect_advice(defect, report.input.study.clean.repair);
    json[defect.kind]["worst"] = std::move(worst);
  }
  return json;
}

Json site_json(const ModelSite& site) {
  Json json = Json::object();
  if (site.latitude_deg) json["latitude"] = *site.latitude_deg;
  if (site.longitude_deg) json["longitude"] = *site.longitude_deg;
  if (site.north_deg) json["north"] = *site.north_deg;
  return json;
}

Json curved_json(const ModelReport& report) {
  Json json = Json::array();
  for (const auto& part : report.input.curved.parts)
    json.push_back({{"part", report.input.study.model.part_names[part.part.index()]},
                    {"subdivision", scheme_word(part.scheme)},
                    {"cage_faces", part.cage_faces},
                    {"triangles", part.facets},
                    {"deviation_m", part.deviation_m},
                    {"chord_tolerance_m", part.chord_tolerance_m}});
  return json;
}

Json head_json(const ModelReport& report) {
  const ModelFile& file = report.input.model;
  const mesh::Model& model = report.input.study.model;
  const mesh::Box box = box_of(model);
  Json json;
  json["program"] = kProgram;
  json["version"] = report.version;
  json["model"] = report.file;
  json["format"] = file.format;
  json["unit"] = unit_word(file.unit);
  json["unit_source"] = file.unit_source;
  json["up"] = file.up == UpAxis::kZ ? "z" : "y";
  json["low"] = coordinates(box.low);
  json["high"] = coordinates(box.high);
  json["site"] = site_json(file.site);
  json["polygons"] = model.polygon_count();
  return json;
}

}  // namespace

std::string scheme_word(mesh::SubdivisionScheme scheme) {
  return scheme == mesh::SubdivisionScheme::kLoop ? "loop" : "catmull-clark";
}

ModelReport look_at(const StudyInput& input, const std::string& file, const std::string& version, Progress& progress) {
  const lighting::Scene scene = lighting::build_scene(input.study, &progress);
  ModelReport report{.input = input, .file = file, .version = version, .clean = scene.clean_report};
  ModelReport::Spaces spaces{.rooms = lighting::rooms_in_model(scene), .openings = scene.openings.size()};
  for (const lighting::Opening& opening : scene.openings) spaces.openings_area_m2 += opening.area_m2;
  report.spaces = std::move(spaces);
  report.assumptions = without_repeats(scene.assumptions);
  report.notices = without_repeats(scene.notices);
  return report;
}

std::string report_json_text(const ModelReport& report) {
  Json json = head_json(report);
  json["parts"] = report.input.study.model.part_names;
  json["curved_parts"] = curved_json(report);
  json["materials"] = materials_json(lighting::material_uses(report.input.study));
  if (report.spaces) {
    json["rooms"] = rooms_json(report.spaces->rooms);
    json["openings"] = {{"count", report.spaces->openings}, {"area_m2", rounded(report.spaces->openings_area_m2)}};
  }
  json["defects"] = told_defects(report);
  json.update(meetings_json(report.clean));
  json["area_before_m2"] = rounded(report.clean.area_before_m2);
  json["area_after_m2"] = rounded(report.clean.area_after_m2);
  json["gap_m"] = report.clean.gap_m;
  json["open_edges"] = report.clean.open_edges;
  json["closed_shells"] = report.clean.closed_shells;
  json["assumptions"] = report.assumptions;
  json["notices"] = report.notices;
  if (!report.files.empty()) json["files"] = report.files;
  return json_text(json);
}

}  // namespace clerestory::io
