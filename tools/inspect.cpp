// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/inspect.h"

#include <cstdio>

#include "clerestory_version.h"
#include "io/defect_advice.h"
#include "io/epw.h"
#include "io/model_report.h"
#include "io/photometry_file.h"
#include "io/photometry_report.h"
#include "io/polar_diagram.h"
#include "io/study_file.h"
#include "io/whole_file.h"
#include "lighting/run.h"
#include "tools/exit_status.h"
#include "tools/inspect_weather.h"
#include "tools/picture_line.h"
#include "tools/standard_output.h"
#include "tools/terminal_progress.h"
#include "tools/with_file.h"

namespace clerestory::tools {

namespace {

int inspect_photometry(const Options& options) {
  const lighting::Photometry photometry = io::read_photometry(options.study);
  if (!options.out.empty()) {
    const std::string title = photometry.name.empty() ? options.study.filename().string() : photometry.name;
    io::write_whole_file(options.out, io::polar_diagram(lighting::web_of(photometry), title).png());
  }
  if (options.json) {
    print(io::photometry_json(photometry, options.study.string(), kVersion));
  } else if (!options.quiet) {
    print(io::photometry_text(photometry, options.study.string()) + picture_line(options, "its polar diagram"));
  }
  return kDone;
}

}  // namespace

int inspect(const Options& options) {
  if (io::is_weather_file(options.study)) return inspect_weather(options);
  if (io::is_photometry_file(options.study)) return inspect_photometry(options);
  if (!options.out.empty())
    throw CommandLineError("--out of inspect is for pictures of weather and photometric files; leave it out");
  lighting::set_threads(options.threads);
  const io::StudyInput input = io::read_study(options.study, {.set = options.set, .model_only = true});
  TerminalProgress progress(!options.quiet && stderr_is_terminal());
  const io::ModelReport report =
      with_file(options.study, [&] { return io::look_at(input, options.study.string(), kVersion, progress); });
  progress.clear();
  if (options.json) {
    print(io::report_json_text(report));
  } else if (!options.quiet) {
    print(io::report_text(report));
  }
  if (!options.strict || !io::has_unmended(report.clean)) return kDone;
  std::fputs("error: the model has defects that are not mended; the report names them and what to do\n", stderr);
  return kInputAtFault;
}

}  // namespace clerestory::tools
