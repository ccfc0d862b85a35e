// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write_results.h"

#include <algorithm>
#include <span>

#include "io/csv.h"
#include "io/map.h"
#include "io/result_folder.h"
#include "io/solution_file.h"
#include "io/stopwatch.h"
#include "io/vtk_files.h"
#include "io/whole_file.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

constexpr const char* kSummary = "summary.json";
constexpr const char* kSurfaces = "surfaces.vtp";
constexpr const char* kLines = "discontinuities.vtp";
constexpr const char* kSolution = "solution.h5";
constexpr const char* kLeaks = "leaks.vtp";
constexpr const char* kObservers = "observers.csv";
constexpr const char* kCollection = "result.vtm";

/// Leaves room for an ending within the 255 bytes of a file name.
constexpr std::size_t kLongestGridName = 200;

void expect_usable_as_file_name(const std::string& grid, const std::filesystem::path& study_file) {
  const auto is_bad = [](unsigned char c) { return c == '/' || c < 0x20 || c == 0x7f; };
  const bool usable = !grid.empty() && grid.size() <= kLongestGridName && grid.front() != '.' &&
                      std::none_of(grid.begin(), grid.end(), is_bad);
  if (!usable)
    throw InputError(study_file.string(), 0,
                     "the grid's name '" + grid.substr(0, 60) + "' cannot be the name of a file",
                     "use letters, digits, - and _");
}

/// What has been written so far.
struct Output {
  std::filesystem::path folder;
  std::vector<std::string> names;
  std::vector<VtmEntry> collection;

  std::filesystem::path add(const std::string& name) {
    names.push_back(name);
    return folder / name;
  }
};

/// @param moments  of one grid
void write_grid(Output& output, const lighting::Results& results, std::span<const lighting::GridResult> moments,
                const ResultContext& context) {
  const std::string& name = moments.front().name;
  write_grid_csv(output.add(name + ".csv"), moments);
  write_grid_vtp(output.add(name + ".vtp"), results, moments, context);
  output.collection.push_back({name, name + ".vtp"});
  for (const lighting::GridResult& grid : moments)
    write_map_png(output.add(full_name(grid) + ".png"), grid, results, context);
}

/// Writes all files but the summary.
void write_files(Output& output, const lighting::Results& results, const ResultContext& context, Progress& progress) {
  const double steps = static_cast<double>(results.grids.size()) + 2.0;
  double step = 0.0;
  for (std::size_t first = 0; first < results.grids.size();) {
    std::size_t end = first + 1;
    while (end < results.grids.size() && results.grids[end].name == results.grids[first].name) ++end;
    write_grid(output, results, std::span(results.grids).subspan(first, end - first), context);
    step += static_cast<double>(end - first);
    progress.advance(step / steps);
    first = end;
  }
  if (!results.surfaces.cells.empty()) {
    write_surfaces_vtp(output.add(kSurfaces), results, context);
    output.collection.push_back({"surfaces", kSurfaces});
  }
  if (results.solution)
    write_solution(output.add(kSolution), {context.study_file, context.kind, context.set, *results.solution});
  progress.advance(++step / steps);
  if (results.shadow_lines) {
    write_discontinuities_vtp(output.add(kLines), results.shadow_lines->lines, context);
    output.collection.push_back({"discontinuities", kLines});
  }
  if (has_leaks(results)) {
    write_leaks_vtp(output.add(kLeaks), results, context);
    output.collection.push_back({"leaks", kLeaks});
  }
  if (!results.observers.empty()) write_whole_file(output.add(kObservers), observers_csv(results.observers));
  write_result_vtm(output.add(kCollection), output.collection);
}

}  // namespace

std::vector<std::string> result_names(const lighting::Study& study, const std::filesystem::path& file) {
  std::vector<std::string> names = {kSummary, kSurfaces, kCollection};
  if (study.mesh.discontinuities) names.emplace_back(kLines);
  if (study.keep_solution) names.emplace_back(kSolution);
  if (!study.observers.empty() || !study.tasks.empty()) names.emplace_back(kObservers);
  for (const lighting::GridRequest& grid : study.grids) {
    if (grid.by_room) continue;  // named after rooms that are not known yet
    expect_usable_as_file_name(grid.name, file);
    std::vector<std::string> endings{".csv", ".vtp"};
    if (study.moments.empty()) endings.emplace_back(".png");
    for (const lighting::Sky& moment : study.moments) endings.push_back("_" + column_word(moment.moment) + ".png");
    for (const std::string& ending : endings) {
      const std::string name = grid.name + ending;
      if (std::find(names.begin(), names.end(), name) != names.end())
        throw InputError(file.string(), 0, "the grid '" + grid.name + "' would write " + name + ", as other results do",
                         "give it another name");
      names.push_back(name);
    }
  }
  return names;
}

std::string write_results(const std::filesystem::path& folder, const lighting::Results& results,
                          const ResultContext& context, RunFigures figures, Progress& progress) {
  const Stopwatch writing;
  progress.phase("writing");
  ResultFolder target(folder);
  try {
    Output output{target.staging(), {}, {}};
    write_files(output, results, context, progress);
    const std::filesystem::path summary_file = output.add(kSummary);
    figures.files = output.names;
    figures.after.push_back(writing.elapsed("writing"));
    const std::string summary = summary_json(results, context, figures);
    write_whole_file(summary_file, summary);
    progress.advance(1.0);  // the last moment at which the user can turn back
    target.commit(output.names);
    return summary;
  } catch (const WriteError& error) {  // by the name that the file would have had
    throw WriteError(folder / error.file().filename(), error.reason());
  }
}

void write_failure(const std::filesystem::path& folder, const ResultContext& context, const std::string& why) {
  ResultFolder(folder).commit_failure(failure_json(context, why));
}

}  // namespace clerestory::io
