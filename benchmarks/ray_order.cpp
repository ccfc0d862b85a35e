// SPDX-License-Identifier: GPL-3.0-or-later
// What it saves to cast rays in bundles: all rays of a study, phase by phase at one thread, cast once more in the order of the run and then in
// random order, the same rays by the same functions. A line of JSON for each phase, CPU seconds of the least of three.
//   ray_order STUDY daylight|illuminance ACCURACY
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/study_arguments.h"
#include "lighting/run.h"
#include "mesh/rays.h"

using namespace clerestory;

namespace {

constexpr int kRepeats = 3;

/// What was cast since the phase began. Rays of a call stay together.
struct Recording {
  const mesh::Rays* rays = nullptr;
  std::vector<mesh::Segment> segments;
  std::vector<std::size_t> calls;  ///< segments of each call
  std::vector<mesh::Ray> hits;
  bool on = true;
};

Recording recording;

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// CPU seconds of all rays of a recording, and what passes and is hit, so that orders can be compared.
struct Replay {
  double seconds = 0.0;
  double passed = 0.0;
  std::size_t hit = 0;
};

Replay replay(const Recording& what) {
  std::vector<float> passed(what.segments.size());
  std::size_t hit = 0;
  const double begin = cpu_s();
  std::size_t first = 0;
  for (const std::size_t count : what.calls) {
    what.rays->transmittance(std::span(what.segments).subspan(first, count), std::span(passed).subspan(first, count));
    first += count;
  }
  for (const mesh::Ray& ray : what.hits) hit += what.rays->first_hit(ray).face.valid() ? 1 : 0;
  const double seconds = cpu_s() - begin;
  return {seconds, std::accumulate(passed.begin(), passed.end(), 0.0), hit};
}

Replay best_replay(const Recording& what) {
  Replay best = replay(what);
  for (int i = 1; i < kRepeats; ++i) best.seconds = std::min(best.seconds, replay(what).seconds);
  return best;
}

/// Casts what was recorded whenever a phase has ended, while the scene is there.
class Replayer final : public Progress {
 public:
  void phase(std::string_view name) override {
    recording.on = false;
    if (recording.rays != nullptr) tell();
    recording = {};
    name_ = std::string(name);
  }
  void advance(double /*fraction*/) override {}

 private:
  void tell() const {
    const std::size_t count = recording.segments.size() + recording.hits.size();
    const Replay ordered = best_replay(recording);
    std::mt19937 generator(1);
    std::shuffle(recording.segments.begin(), recording.segments.end(), generator);
    std::shuffle(recording.hits.begin(), recording.hits.end(), generator);
    const Replay shuffled = best_replay(recording);
    if (shuffled.hit != ordered.hit || std::abs(shuffled.passed - ordered.passed) > 1e-6 * ordered.passed) {
      fmt::print(stderr, "{}: rays give something else in another order\n", name_);
      std::exit(1);
    }
    fmt::print("{{\"phase\": \"{}\", \"rays\": {}, \"in_order_s\": {:.4f}, \"shuffled_s\": {:.4f}}}\n", name_, count,
               ordered.seconds, shuffled.seconds);
  }

  std::string name_;
};

}  // namespace

// The linker puts wrappers before functions of mesh::Rays (--wrap), which bear the functions' mangled names.
#define CLERESTORY_TRANSMITTANCE                                                                \
  "_ZNK10clerestory4mesh4Rays13transmittanceESt4spanIKNS0_7SegmentELm18446744073709551615EES2_" \
  "IfLm18446744073709551615EE"
#define CLERESTORY_FIRST_HIT "_ZNK10clerestory4mesh4Rays9first_hitERKNS0_3RayE"

void transmittance(const mesh::Rays* rays, std::span<const mesh::Segment> segments,
                   std::span<float> passed) asm("__real_" CLERESTORY_TRANSMITTANCE);
mesh::Hit first_hit(const mesh::Rays* rays, const mesh::Ray& ray) asm("__real_" CLERESTORY_FIRST_HIT);
void recorded_transmittance(const mesh::Rays* rays, std::span<const mesh::Segment> segments,
                            std::span<float> passed) asm("__wrap_" CLERESTORY_TRANSMITTANCE);
mesh::Hit recorded_first_hit(const mesh::Rays* rays, const mesh::Ray& ray) asm("__wrap_" CLERESTORY_FIRST_HIT);

void recorded_transmittance(const mesh::Rays* rays, std::span<const mesh::Segment> segments, std::span<float> passed) {
  if (recording.on) {
    recording.rays = rays;
    recording.segments.insert(recording.segments.end(), segments.begin(), segments.end());
    recording.calls.push_back(segments.size());
  }
  transmittance(rays, segments, passed);
}

mesh::Hit recorded_first_hit(const mesh::Rays* rays, const mesh::Ray& ray) {
  if (recording.on) {
    recording.rays = rays;
    recording.hits.push_back(ray);
  }
  return first_hit(rays, ray);
}

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: {} {}\n", argv[0], kStudyArguments);
    return 2;
  }
  Replayer replayer;
  lighting::run(study_of_arguments(argv), replayer);
  return 0;
}
