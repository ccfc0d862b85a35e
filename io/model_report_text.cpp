// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "io/defect_advice.h"
#include "io/model_report.h"
#include "io/text_table.h"
#include "io/words.h"
#include "lighting/scene.h"

namespace clerestory::io {

namespace {

/// Of models with very many parts, the first are listed; the JSON has all.
constexpr std::size_t kMostParts = 40;

template <class Ids>
std::vector<std::size_t> uses_of(const Ids& ids, std::size_t names) {
  std::vector<std::size_t> uses(names, 0);
  for (const auto id : ids) ++uses[id.index()];
  return uses;
}

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string point_text(const mesh::Point& p) { return fmt::format("({:.3f}, {:.3f}, {:.3f})", p.x, p.y, p.z); }

std::string length_text(double metres) {
  constexpr double kInMillimetres = 0.1;
  return metres < kInMillimetres ? fmt::format("{:.3g} mm", 1000.0 * metres) : fmt::format("{:.3g} m", metres);
}

std::string head_text(const ModelReport& report) {
  const ModelFile& file = report.input.model;
  const mesh::Model& model = report.input.study.model;
  mesh::Box box;
  for (const mesh::Point& p : model.vertices) box.add(p);
  const mesh::Vector size = box.size();
  std::string text = fmt::format("{}: {}\n\n", printable(report.file), file.format);
  text += fmt::format("unit      {}, {}\n", unit_word(file.unit), file.unit_source);
  text += fmt::format("up        {}\n", file.up == UpAxis::kZ ? "z" : "y, turned to z");
  text += fmt::format("size      {:.2f} x {:.2f} x {:.2f} m, from {} to {}\n", size.x, size.y, size.z,
                      point_text(box.low), point_text(box.high));
  const ModelSite& site = file.site;
  if (site.latitude_deg && site.longitude_deg)
    text +=
        fmt::format("site      {:.4f} degrees north, {:.4f} degrees east\n", *site.latitude_deg, *site.longitude_deg);
  if (site.north_deg) text += fmt::format("north     {:.2f} degrees from +y, counter-clockwise\n", *site.north_deg);
  return text + fmt::format("polygons  {} in {}\n\n", model.polygon_count(),
                            counted(model.part_names.size(), "part", "parts"));
}

std::string parts_text(const mesh::Model& model) {
  const auto uses = uses_of(model.polygon_part, model.part_names.size());
  std::vector<TextRow> rows = {{"part", "polygons"}};
  for (std::size_t p = 0; p < std::min(uses.size(), kMostParts); ++p)
    rows.push_back({printable(model.part_names[p]), std::to_string(uses[p])});
  std::string text = text_table(rows);
  if (uses.size() > kMostParts) text += fmt::format("and {} more: --json lists all\n", uses.size() - kMostParts);
  return text + "\n";
}

/// The curved parts, how finely each stands in the model.
std::string curved_text(const ModelReport& report) {
  const mesh::SubdivisionReport& curved = report.input.curved;
  if (curved.parts.empty()) return {};
  std::vector<TextRow> rows = {{"curved part", "scheme", "cage", "triangles", "farthest off", "tolerance"}};
  for (const auto& part : curved.parts)
    rows.push_back({printable(report.input.study.model.part_names[part.part.index()]), scheme_word(part.scheme),
                    std::to_string(part.cage_faces), std::to_string(part.facets), length_text(part.deviation_m),
                    length_text(part.chord_tolerance_m)});
  return text_table(rows, "llrrrr") + "\n";
}

std::string materials_text(const lighting::Study& study) {
  const auto uses = uses_of(study.model.polygon_material, study.model.material_names.size());
  std::vector<TextRow> rows = {{"material", "polygons", "became", "why"}};
  const auto materials = lighting::material_uses(study);
  for (std::size_t m = 0; m < materials.size(); ++m)
    rows.push_back({printable(materials[m].name), std::to_string(uses[m]), materials[m].became, materials[m].why});
  return text_table(rows, "lrl") + "\n";
}

/// "glazing 3.2 m², hole to 'Hall' 2.1 m²", of each kind and room the sum.
std::string openings_text(const mesh::Room& room, const std::vector<mesh::Room>& rooms) {
  std::vector<std::pair<std::string, double>> sums;
  for (const mesh::RoomOpening& o : room.openings) {
    using Kind = mesh::RoomOpening::Kind;
    std::string what = o.kind == Kind::kGlazing ? "glazing" : o.kind == Kind::kAir ? "air" : "hole";
    if (o.beyond != mesh::kNoRoom) what += " to " + in_quotes(rooms[o.beyond].name);
    if (o.is_leak()) what += " to the outside";
    const auto known = std::find_if(sums.begin(), sums.end(), [&](const auto& sum) { return sum.first == what; });
    known == sums.end() ? sums.emplace_back(what, o.area_m2) : * known = {what, known->second + o.area_m2};
  }
  std::string text;
  for (const auto& [what, area] : sums) text += fmt::format("{}{} {} m²", text.empty() ? "" : ", ", what, figure(area));
  return text.empty() ? "none" : text;
}

std::string rooms_text(const ModelReport::Spaces& spaces) {
  if (spaces.rooms.empty()) return "no room was found\n\n";
  std::vector<TextRow> rows = {{"room", "floor area", "volume", "closed", "openings"}};
  for (const mesh::Room& room : spaces.rooms)
    rows.push_back({printable(room.name), fmt::format("{:.2f} m²", room.floor_area_m2),
                    fmt::format("{:.2f} m³", room.volume_m3), room.closed() ? "yes" : "no",
                    openings_text(room, spaces.rooms)});
  std::string text = text_table(rows, "lrrll");
  for (const mesh::Room& room : spaces.rooms) {
    if (!room.not_apart.empty())
      text += fmt::format("{} is a room by the file alone: {}\n", in_quotes(room.name), printable(room.not_apart));
  }
  return text +
         fmt::format("\nopenings to brighter places  {}, {} m²\n\n", spaces.openings, figure(spaces.openings_area_m2));
}

std::string place_text(const mesh::Model& model, const mesh::Defect::Place& place) {
  std::string text = fmt::format("  at {}, part {}", point_text(place.at),
                                 in_quotes(model.part_names[model.polygon_part[place.polygon].index()]));
  if (model.polygon_line[place.polygon] != 0) text += fmt::format(", line {}", model.polygon_line[place.polygon]);
  if (place.size_m > 0.0) text += ": " + length_text(place.size_m);
  if (!place.mended) text += ", left";
  return text + (place.note.empty() ? "\n" : ": " + place.note + "\n");
}

std::string defects_text(const ModelReport& report) {
  using Repair = mesh::CleanOptions::Repair;
  const Repair repair = report.input.study.clean.repair;
  if (repair == Repair::kOff) return "defects  not looked for\n";
  if (report.clean.defects.empty()) return "defects  none\n";
  std::string text = "defects\n";
  for (const mesh::Defect& defect : report.clean.defects) {
    text += fmt::format("{}: {} found, {} mended\n", defect.kind, defect.found, defect.mended);
    for (const auto& [reason, count] : reasons_of_left(defect)) text += fmt::format("  {} left: {}\n", count, reason);
    for (const auto& place : worst_places(defect)) text += place_text(report.input.study.model, place);
    text += fmt::format("  to do: {}\n", defect_advice(defect, repair));
  }
  return text;
}

std::string clean_figures(const mesh::CleanReport& clean) {
  return fmt::format("surface  {} m² as read, {} m² clean; {}, {}\n", figure(clean.area_before_m2),
                     figure(clean.area_after_m2), counted(clean.closed_shells, "closed shell", "closed shells"),
                     counted(clean.open_edges, "open edge", "open edges"));
}

}  // namespace

std::string report_text(const ModelReport& report) {
  std::string text = head_text(report) + parts_text(report.input.study.model) + curved_text(report) +
                     materials_text(report.input.study);
  if (report.spaces) text += rooms_text(*report.spaces);
  text += defects_text(report) + clean_figures(report.clean);
  for (const std::string& sentence : report.assumptions) text += "assumed: " + sentence + "\n";
  for (const std::string& sentence : report.notices) text += "note: " + sentence + "\n";
  return text;
}

}  // namespace clerestory::io
