// SPDX-License-Identifier: GPL-3.0-or-later
// A study with a part of the solver switched off, at one thread: figures as a line of JSON, and the illuminance [lx] of each sensor below it.
//   solver_parts STUDY daylight|illuminance ACCURACY all|clusters|importance|proofs
#include <fmt/format.h>

#include <ctime>
#include <string>

#include "benchmarks/study_arguments.h"
#include "lighting/run.h"

using namespace clerestory;

namespace {

lighting::Study study_without(const std::string& part, lighting::Study study) {
  study.parts = {.clusters = part != "clusters", .importance = part != "importance", .proofs = part != "proofs"};
  study.mesh.discontinuities = false;  // what is shown does not tell of the solution
  return study;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    fmt::print(stderr, "usage: {} {} all|clusters|importance|proofs\n", argv[0], kStudyArguments);
    return 2;
  }
  const lighting::Study study = study_without(argv[4], study_of_arguments(argv));
  NoProgress nobody;
  const lighting::Results results = lighting::run(study, nobody);
  double linking_s = 0.0;
  for (const lighting::PhaseTime& phase : results.phases) linking_s += phase.name == "linking" ? phase.cpu_s : 0.0;
  fmt::print(
      "{{\"cpu_s\": {:.4f}, \"linking_s\": {:.4f}, \"rays\": {}, \"links\": {}, \"elements\": {}, \"reached\": "
      "{:.6f}}}\n",
      static_cast<double>(std::clock()) / CLOCKS_PER_SEC, linking_s, results.counts.rays, results.counts.links,
      results.counts.elements, results.accuracy_reached);
  for (const float lux : results.grids.at(0).illuminance_lux) fmt::print("{:.6g}\n", lux);
  return 0;
}
