// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <exception>
#include <span>

#include "tools/clean.h"
#include "tools/daylight.h"
#include "tools/failure.h"
#include "tools/illuminance.h"
#include "tools/inspect.h"
#include "tools/interruption.h"
#include "tools/mesh.h"
#include "tools/options.h"
#include "tools/sense.h"
#include "tools/standard_output.h"

namespace clerestory::tools {

namespace {

int run(const Request& request) {
  switch (request.what) {
    case Request::What::kDaylight:
      return daylight(request.options);
    case Request::What::kIlluminance:
      return illuminance(request.options);
    case Request::What::kInspect:
      return inspect(request.options);
    case Request::What::kClean:
      return clean(request.options);
    case Request::What::kMesh:
      return mesh(request.options);
    case Request::What::kSense:
      return sense(request.options);
    case Request::What::kText:
      break;
  }
  print(request.text);
  return kDone;
}

}  // namespace

}  // namespace clerestory::tools

/// The one place where errors end.
int main(int argc, char** argv) {
  using namespace clerestory::tools;
  try {
    take_signals();
    return run(read_command_line(std::span(argv, static_cast<std::size_t>(argc))));
  } catch (const std::exception& error) {
    const Failure failure = describe(error);
    std::fputs(("error: " + failure.line + "\n").c_str(), stderr);
    return failure.status;
  }
}
