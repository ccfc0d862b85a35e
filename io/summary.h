// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/result_context.h"
#include "lighting/results.h"

namespace clerestory::io {

/// What the summary says of the run beyond its results.
struct RunFigures {
  /// Phases outside lighting::run, in their order about it: reading the study before it, writing the results after it.
  std::vector<lighting::PhaseTime> before;
  std::vector<lighting::PhaseTime> after;
  int threads = 0;                 ///< as asked for; 0: every core
  std::vector<std::string> files;  ///< names of all files of the run, summary.json included
};

/// Status words of summary.json.
inline constexpr const char* kStatusDone = "done";
inline constexpr const char* kStatusAccuracyNotReached = "accuracy-not-reached";
inline constexpr const char* kStatusPartial = "partial";  ///< the user has stopped it
inline constexpr const char* kStatusFailed = "failed";

/// The text of summary.json: every metric by grid, accuracy, energy balance, counts, time, memory, study and files
/// (docs/results.md lists the keys). Text that is not UTF-8 has its bad bytes replaced.
/// A number that is not finite is our own bug: throws std::logic_error.
std::string summary_json(const lighting::Results& results, const ResultContext& context, const RunFigures& figures);

/// What has stopped a run, as the summary names it.
const char* word_of(lighting::Stop::By by);

/// "pass", "fail" or "not decided".
const char* word_of(lighting::Criterion::Verdict verdict);

/// The text of the summary.json of a run that failed, and why.
std::string failure_json(const ResultContext& context, const std::string& why);

/// What a summary.json says that we need of it later.
struct EarlierSummary {
  std::string status;
  std::vector<std::string> files;  ///< plain names, the summary's own included
};

/// Reads the summary of an earlier run; none where the file is missing or not one of ours. Never throws on bad content.
std::optional<EarlierSummary> read_earlier_summary(const std::filesystem::path& file);

}  // namespace clerestory::io
