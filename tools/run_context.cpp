// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/run_context.h"

#include <fmt/format.h>

#include <ctime>
#include <string>

#include "clerestory_version.h"

namespace clerestory::tools {

namespace {

std::string sky_alone_in_words(const lighting::Sky& sky) {
  switch (sky.type) {
    case lighting::Sky::Type::kNone:
      return "no sky";
    case lighting::Sky::Type::kUniform:
      return fmt::format("uniform sky of {:.6g} lx", sky.horizontal_illuminance_lux);
    case lighting::Sky::Type::kCieOvercast:
      return fmt::format("CIE overcast sky of {:.6g} lx", sky.horizontal_illuminance_lux);
    case lighting::Sky::Type::kSum:
      return "daylight at several moments";
    case lighting::Sky::Type::kDistribution:
      return fmt::format("{} of {:.6g} lx", sky.name, sky.horizontal_illuminance_lux);
  }
  return {};
}

std::string sky_in_words(const lighting::Sky& sky) {
  if (!sky.sun.shines()) return sky_alone_in_words(sky);
  return fmt::format("{}, sun of {:.6g} lx", sky_alone_in_words(sky), sky.sun.normal_illuminance_lux);
}

/// Local time with its offset, as in ISO 8601.
std::string now_text() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[40];
  std::string date(text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S%z", &local));
  return date.insert(date.size() - 2, ":");
}

}  // namespace

io::ResultContext context_of(const io::StudyInput& input, const std::filesystem::path& file, const Options& options) {
  const lighting::Study& study = input.study;
  return {study.name,
          study.kind,
          kVersion,
          sky_in_words(study.sky),
          study.north_deg,
          options.command,
          input.effective_json,
          now_text(),
          std::filesystem::absolute(file).lexically_normal(),
          options.set};
}

}  // namespace clerestory::tools
