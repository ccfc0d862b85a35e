// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/answer.h"

#include <fmt/format.h>

#include <cstdint>
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
#include "mesh/memory.h"
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

/// Of the memory that the system would let us have: it and others need some.
constexpr double kShareOfMemory = 0.9;

/// Time counts from here on. Memory that the machine does not have is refused, wherever it is asked for.
lighting::Limits limits_of(const Options& options) {
  lighting::Limits limits;
  if (options.max_time_s) limits.time_s = *options.max_time_s;
  limits.memory_asked = options.max_memory_bytes.has_value();
  const std::uint64_t reach = memory_within_reach();
  refuse_memory_beyond(reach);
  limits.memory_bytes =
      options.max_memory_bytes.value_or(static_cast<std::uint64_t>(kShareOfMemory * static_cast<double>(reach)));
  return limits;
}

/// Runs and writes. What goes wrong by nobody's wish is told in the folder before it is told to the user.
Answer run_and_write(const Question& question, const io::ResultContext& context, io::RunFigures figures,
                     const Options& options, const lighting::Limits& limits) {
  TerminalProgress progress(!options.quiet && stderr_is_terminal(),
                            options.keep_partial ? OnInterruption::kFinish : OnInterruption::kEnd);
  if (options.keep_partial) end_orderly();
  try {
    Answer answer;
    answer.results = with_file(options.study, [&] { return question.compute(progress, limits); });
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

/// The exit status, and the line on stderr that belongs to it.
int conclude(const lighting::Results& results, const Options& options, bool from_stored) {
  const bool by_user = results.stopped && results.stopped->by == lighting::Stop::By::kUser;
  if (!by_user && results.accuracy_met) return kDone;
  fmt::print(stderr, "error: {}; the results in {} are marked so; {}\n", shortfall(results), options.out.string(),
             remedy(results, from_stored));
  return by_user ? kInterruptedByUser : kAccuracyNotReached;
}

}  // namespace

int answer(const Options& options, const std::function<Question()>& read) {
  const lighting::Limits limits = limits_of(options);
  const io::Stopwatch reading;
  const Question question = read();
  const io::ResultContext context = context_of(question.input, question.file, options);
  io::check_result_folder(options.out, io::result_names(question.input.study, question.file));
  io::RunFigures figures;
  figures.before.push_back(reading.elapsed("reading"));
  figures.threads = options.threads;
  lighting::set_threads(options.threads);

  const Answer answer = run_and_write(question, context, std::move(figures), options, limits);
  if (options.json) {
    print(answer.summary, kConsolation);
  } else if (!options.quiet) {
    print(report(answer.results, context, options.out), kConsolation);
  }
  return conclude(answer.results, options, question.from_stored);
}

int answer(lighting::Study::Kind kind, const Options& options) {
  return answer(options, [&] {
    Question question{options.study, io::read_study(options.study, {kind, options.set}), {}};
    question.input.study.keep_solution = options.save_solution;
    question.compute = [study = question.input.study](Progress& progress, const lighting::Limits& limits) {
      return lighting::run(study, progress, limits);
    };
    return question;
  });
}

}  // namespace clerestory::tools
