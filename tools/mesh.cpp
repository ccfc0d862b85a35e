// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/mesh.h"

#include <string>

#include "io/mesh_files.h"
#include "io/result_folder.h"
#include "io/study_file.h"
#include "lighting/element_mesh.h"
#include "lighting/run.h"
#include "tools/exit_status.h"
#include "tools/interruption.h"
#include "tools/run_context.h"
#include "tools/standard_output.h"
#include "tools/terminal_progress.h"
#include "tools/with_file.h"

namespace clerestory::tools {

int mesh(const Options& options) {
  lighting::set_threads(options.threads);
  const io::StudyInput input = io::read_study(options.study, {lighting::Study::Kind::kIlluminance, options.set});
  const io::ResultContext context = context_of(input, options.study, options);
  io::check_result_folder(options.out, io::mesh_file_names());
  TerminalProgress progress(!options.quiet && stderr_is_terminal());
  const lighting::MeshedStudy meshed =
      with_file(options.study, [&] { return lighting::mesh_study(input.study, options.lines, progress); });
  end_orderly();  // until here there is nothing on the disk
  const std::string summary = io::write_mesh(options.out, meshed, context, progress);
  progress.clear();
  constexpr const char* kConsolation = "; the files are written all the same";
  if (options.json) {
    print(summary, kConsolation);
  } else if (!options.quiet) {
    print(io::mesh_report(meshed, options.out), kConsolation);
  }
  return kDone;
}

}  // namespace clerestory::tools
