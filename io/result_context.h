// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lighting/study.h"

namespace clerestory::io {

/// What the files of one run say about it beyond its results. All text is UTF-8 and ready to print.
struct ResultContext {
  std::string study_name;  ///< stem of the study or model file
  lighting::Study::Kind kind = lighting::Study::Kind::kDaylight;
  std::string version;               ///< of the program, "0.1.0"
  std::string sky;                   ///< in words: "CIE overcast sky, 10000 lx horizontal"
  double north_deg = 0.0;            ///< from +y, counter-clockwise
  std::string command;               ///< the command line, words quoted where needed
  std::string effective_study;       ///< the study with all defaults filled in, a JSON object
  std::string date;                  ///< of the run, local time with offset, "2026-03-21T12:00:00+01:00"
  std::filesystem::path study_file;  ///< absolute
  std::vector<std::string> set;      ///< what the command line overrides in it
};

}  // namespace clerestory::io
