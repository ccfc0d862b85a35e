// SPDX-License-Identifier: GPL-3.0-or-later
// Reads models and cleans them; with --rooms also looks for their openings and rooms, as `clerestory inspect` does. Prints CPU
// seconds by step, and memory:
//   benchmarks/city_block.py 100000 -o block.obj && build/release/benchmarks/clean_benchmark block.obj
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "io/stopwatch.h"
#include "io/study_file.h"
#include "lighting/scene.h"
#include "mesh/clean.h"

namespace {

/// Prints what each phase took when the next begins, and which share of that had passed when so many tenths of it were told as done.
class PhaseTimes final : public clerestory::Progress {
 public:
  explicit PhaseTimes(std::string_view first) { phase(first); }
  PhaseTimes(const PhaseTimes&) = delete;
  PhaseTimes& operator=(const PhaseTimes&) = delete;
  ~PhaseTimes() override { phase({}); }

  void phase(std::string_view name) override {
    const double now = clerestory::io::process_cpu_seconds();
    if (!name_.empty()) print(now - start_);
    name_ = name;
    start_ = now;
    told_.clear();
  }
  void advance(double fraction) override {
    told_.push_back({fraction, clerestory::io::process_cpu_seconds() - start_});
  }

 private:
  struct Told {
    double fraction = 0.0;
    double seconds = 0.0;
  };

  void print(double seconds) const {
    std::string shares;
    for (int tenths = 1; tenths < 10 && !told_.empty(); ++tenths) {
      const auto reached = std::ranges::find_if(told_, [&](const Told& t) { return 10.0 * t.fraction >= tenths; });
      shares += reached == told_.end() ? "    -" : fmt::format(" {:4.0f}", 100.0 * reached->seconds / seconds);
    }
    fmt::print("  {:<16} {:8.2f} s{}{}\n", name_, seconds, shares.empty() ? "" : "  % at each tenth:", shares);
    std::fflush(stdout);
  }

  std::string name_;
  double start_ = 0.0;
  std::vector<Told> told_;
};

void measure(const std::string& file, bool rooms) {
  const double start = clerestory::io::process_cpu_seconds();
  clerestory::mesh::CleanReport report;
  std::size_t polygons = 0;
  {
    PhaseTimes times("reading");
    const clerestory::io::StudyInput input = clerestory::io::read_study(file, {.set = {}, .model_only = true});
    polygons = input.study.model.polygon_count();
    report = rooms ? clerestory::lighting::build_scene(input.study, &times).clean_report
                   : clerestory::mesh::clean(input.study.model, input.study.clean, &times).report;
  }
  fmt::print("{}: {} polygons; {:.2f} CPU s, {:.0f} MB\n", file, polygons,
             clerestory::io::process_cpu_seconds() - start, clerestory::io::peak_memory_mb());
  for (const clerestory::mesh::Defect& defect : report.defects) {
    fmt::print("  {:<44} {:>9} found {:>9} mended\n", defect.kind, defect.found, defect.mended);
  }
  fmt::print("  {} contacts, {} uncut crossings, {} two-sided polygons\n", report.contacts, report.uncut_crossings,
             report.two_sided);
  fmt::print("  area {:.6f} m2, then {:.6f} m2; {} open edges, {} closed shells, gap {:g} m\n", report.area_before_m2,
             report.area_after_m2, report.open_edges, report.closed_shells, report.gap_m);
}

}  // namespace

int main(int count, char** arguments) {
  try {
    bool rooms = false;
    for (int i = 1; i < count; ++i) {
      const std::string argument = arguments[i];
      if (argument == "--rooms")
        rooms = true;
      else
        measure(argument, rooms);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "clean_benchmark: {}\n", error.what());
    return 1;
  }
  return 0;
}
