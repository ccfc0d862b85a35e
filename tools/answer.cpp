// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/answer.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <utility>

#include "io/result_folder.h"
#include "io/stopwatch.h"
#include "io/study_file.h"
#include "io/write_results.h"
#include "lighting/run.h"
#include "mesh/error.h"
#include "tools/exit_status.h"
#include "tools/failure.h"
#include "tools/interruption.h"
#include "tools/report.h"
#include "tools/run_context.h"
#include "tools/standard_output.h"
#include "tools/terminal_progress.h"
#include "tools/with_file.h"

namespace clerestory::tools {

namespace {

constexpr const char* kConsolation = "; the results are in their folder all the same";

/// What a finished run gives to the terminal.
struct Answer {
  lighting::Results results;
  std::string summary;
};

/// Runs and writes. What goes wrong by nobody's wish is told in the folder before it is told to the user.
Answer run_and_write(const lighting::Study& study, const io::ResultContext& context, io::RunFigures figures,
                     const Options& options) {
  TerminalProgress progress(!options.quiet && stderr_is_terminal());
  try {
    Answer answer;
    answer.results = with_file(options.study, [&] { return lighting::run(study, progress); });
    end_orderly();  // until here there is nothing on the disk
    answer.summary = io::write_results(options.out, answer.results, context, std::move(figures), progress);
    return answer;
  } catch (const InputError&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    try {
      io::write_failure(options.out, context, describe(error).line);
    } catch (const std::exception&) {
      // The disk that is full, most likely: the first error is the one to tell, and the older results stand as they
      // were.
    }
    throw;
  }
}

}  // namespace

int answer(lighting::Study::Kind kind, const Options& options) {
  const io::Stopwatch reading;
  const io::StudyInput input = io::read_study(options.study, {kind, options.set});
  const io::ResultContext context = context_of(input, options);
  io::check_result_folder(options.out, io::result_names(input.study, options.study));
  io::RunFigures figures;
  figures.before.push_back(reading.elapsed("reading"));
  figures.threads = options.threads;
  lighting::set_threads(options.threads);

  const Answer answer = run_and_write(input.study, context, std::move(figures), options);
  if (options.json) {
    print(answer.summary, kConsolation);
  } else if (!options.quiet) {
    print(report(answer.results, context, options.out), kConsolation);
  }
  if (answer.results.accuracy_met) return kDone;
  fmt::print(stderr,
             "error: the accuracy of {:.3g} % was not reached, only {:.3g} %; the results in {} are marked so\n",
             100.0 * answer.results.accuracy_target, 100.0 * answer.results.accuracy_reached, options.out.string());
  return kAccuracyNotReached;
}

}  // namespace clerestory::tools
