// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/clean.h"

#include <utility>

#include "clerestory_version.h"
#include "io/cleaned_model.h"
#include "io/model_report.h"
#include "io/study_file.h"
#include "lighting/run.h"
#include "mesh/clean.h"
#include "tools/exit_status.h"
#include "tools/interruption.h"
#include "tools/standard_output.h"
#include "tools/terminal_progress.h"
#include "tools/with_file.h"

namespace clerestory::tools {

int clean(const Options& options) {
  lighting::set_threads(options.threads);
  const io::StudyInput input = io::read_study(options.study, {.set = options.set, .model_only = true});
  io::check_cleaned_model(options.out, input);
  TerminalProgress progress(!options.quiet && stderr_is_terminal());
  mesh::CleanSurface surface =
      with_file(options.study, [&] { return mesh::clean(input.study.model, input.study.clean, &progress); });
  io::ModelReport report{.input = input, .file = options.study.string(), .version = kVersion, .clean = surface.report};
  report.assumptions = input.study.assumptions;
  report.notices = surface.report.notices;
  end_orderly();  // until here there is nothing on the disk
  io::write_cleaned_model(options.out, std::move(surface), report, progress);
  progress.clear();
  constexpr const char* kConsolation = "; the files are written all the same";
  if (options.json) {
    print(io::report_json_text(report), kConsolation);
  } else if (!options.quiet) {
    print(io::report_text(report), kConsolation);
  }
  return kDone;
}

}  // namespace clerestory::tools
