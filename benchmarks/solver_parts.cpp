// SPDX-License-Identifier: GPL-3.0-or-later
// A study with a part of the solver switched off, at one thread: figures as a line of JSON, and the illuminance [lx] of each sensor below it.
//   solver_parts STUDY daylight|illuminance ACCURACY all|clusters|importance|proofs
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <string>

#include "io/study_file.h"
#include "lighting/run.h"

using namespace clerestory;

namespace {

lighting::Study study_without(const std::string& part, const io::StudyInput& input, double accuracy) {
  lighting::Study study = input.study;
  study.accuracy.target = accuracy;
  study.parts = {.clusters = part != "clusters", .importance = part != "importance", .proofs = part != "proofs"};
  study.mesh.discontinuities = false;  // what is shown does not tell of the solution
  return study;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    fmt::print(stderr, "usage: {} STUDY daylight|illuminance ACCURACY all|clusters|importance|proofs\n", argv[0]);
    return 2;
  }
  lighting::set_threads(1);
  const auto kind =
      std::string(argv[2]) == "daylight" ? lighting::Study::Kind::kDaylight : lighting::Study::Kind::kIlluminance;
  const lighting::Study study =
      study_without(argv[4], io::read_study(argv[1], {.kind = kind, .set = {}}), std::strtod(argv[3], nullptr));
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
