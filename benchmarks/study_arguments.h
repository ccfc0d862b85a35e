// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <string_view>

#include "io/study_file.h"
#include "lighting/run.h"

/// What benchmarks that time whole runs have on their command lines.
inline constexpr const char* kStudyArguments = "STUDY daylight|illuminance ACCURACY";

/// The study of the first three arguments. From here on the process runs at one thread.
inline clerestory::lighting::Study study_of_arguments(char** argv) {
  using Kind = clerestory::lighting::Study::Kind;
  clerestory::lighting::set_threads(1);
  const Kind kind = std::string_view(argv[2]) == "daylight" ? Kind::kDaylight : Kind::kIlluminance;
  clerestory::lighting::Study study = clerestory::io::read_study(argv[1], {.kind = kind, .set = {}}).study;
  study.accuracy.target = std::strtod(argv[3], nullptr);
  return study;
}
