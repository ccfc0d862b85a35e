// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/inspect_weather.h"

#include "clerestory_version.h"
#include "io/epw.h"
#include "io/weather_report.h"
#include "io/whole_file.h"
#include "tools/exit_status.h"
#include "tools/picture_line.h"
#include "tools/standard_output.h"

namespace clerestory::tools {

int inspect_weather(const Options& options) {
  const lighting::Weather weather = io::read_weather(options.study);
  if (!options.out.empty()) io::write_whole_file(options.out, io::weather_picture(weather).png());
  if (options.json) {
    print(io::weather_json(weather, options.study.string(), kVersion));
  } else if (!options.quiet) {
    print(io::weather_text(weather, options.study.string()) +
          picture_line(options, "the hours and days of its year in false colour"));
  }
  return kDone;
}

}  // namespace clerestory::tools
