// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh_files.h"

#include <fmt/format.h>

#include "io/report_json.h"
#include "io/result_folder.h"
#include "io/vtk_files.h"
#include "io/whole_file.h"

namespace clerestory::io {

namespace {

constexpr const char* kElements = "elements.vtp";
constexpr const char* kLines = "discontinuities.vtp";
constexpr const char* kSummary = "summary.json";

Json elements_json(const lighting::MeshedStudy& meshed) {
  Json json{{"cells", meshed.elements.cells.size()}};
  json.update(mesh_json(meshed.report));
  return json;
}

std::string summary_of(const lighting::MeshedStudy& meshed, const ResultContext& context,
                       const std::vector<std::string>& files) {
  Json json{{"program", kProgram},  {"version", context.version},
            {"status", "done"},     {"command", context.command},
            {"date", context.date}, {"lines", shadow_lines_json(meshed.selection, meshed.lines.source_names.size())}};
  if (!meshed.elements.cells.empty()) json["elements"] = elements_json(meshed);
  json["notices"] = without_repeats(meshed.notices);
  if (!context.effective_study.empty()) json["study"] = Json::parse(context.effective_study);
  json["files"] = files;
  return json_text(json);
}

std::size_t total(const mesh::LineSelection::Counts& counts) { return counts[0] + counts[1] + counts[2]; }

}  // namespace

std::vector<std::string> mesh_file_names() { return {kElements, kLines, kSummary}; }

std::string write_mesh(const std::filesystem::path& folder, const lighting::MeshedStudy& meshed,
                       const ResultContext& context, Progress& progress) {
  progress.phase("writing");
  ResultFolder target(folder);
  try {
    std::vector<std::string> files;
    if (!meshed.elements.cells.empty()) {
      write_elements_vtp(target.staging() / kElements, meshed.elements, context);
      files.emplace_back(kElements);
    }
    write_discontinuities_vtp(target.staging() / kLines, meshed.lines, context);
    files.emplace_back(kLines);
    files.emplace_back(kSummary);
    const std::string summary = summary_of(meshed, context, files);
    write_whole_file(target.staging() / kSummary, summary);
    progress.advance(1.0);  // the last moment at which the user can turn back
    target.commit(files);
    return summary;
  } catch (const WriteError& error) {  // by the name that the file would have had
    throw WriteError(folder / error.file().filename(), error.reason());
  }
}

std::string mesh_report(const lighting::MeshedStudy& meshed, const std::filesystem::path& folder) {
  const mesh::LineSelection& selection = meshed.selection;
  std::string text = fmt::format(
      "shadow lines   {} kept of {} found ({} D0, {} D1, {} D2 kept) from {} sources\n"
      "               {} run along others, {} matter less than the accuracy asked, {} are over a surface's limit\n",
      total(selection.kept_count), total(selection.found), selection.kept_count[0], selection.kept_count[1],
      selection.kept_count[2], meshed.lines.source_names.size(), selection.merged, selection.light, selection.over_cap);
  if (!meshed.elements.cells.empty()) {
    text += fmt::format(
        "elements       {} on {} triangles, least angle {:.1f} degrees; {} below the bound, {} of them at input "
        "angles\n",
        meshed.elements.cells.size(), meshed.report.triangles, meshed.report.min_angle_deg, meshed.report.small_angles,
        meshed.report.small_input_angles);
  }
  for (const std::string& notice : without_repeats(meshed.notices)) {
    text += "notice         " + notice + "\n";
  }
  return text + "written to     " + folder.string() + "\n";
}

}  // namespace clerestory::io
