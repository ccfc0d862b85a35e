// SPDX-License-Identifier: GPL-3.0-or-later
// Reads models and cleans them; prints CPU seconds by step, and memory:
//   benchmarks/city_block.py 100000 -o block.obj && build/release/benchmarks/clean_benchmark block.obj
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "io/model_file.h"
#include "io/stopwatch.h"
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
      const auto reached = std::ranges::find_if(told_, [&](const Told& t) { return t.fraction >= 0.1 * tenths; });
      shares += reached == told_.end() ? "    -" : fmt::format(" {:4.0f}", 100.0 * reached->seconds / seconds);
    }
    fmt::print("  {:<16} {:8.2f} s{}{}\n", name_, seconds, shares.empty() ? "" : "  % at each tenth:", shares);
    std::fflush(stdout);
  }

  std::string name_;
  double start_ = 0.0;
  std::vector<Told> told_;
};

void measure(const char* file) {
  const double start = clerestory::io::process_cpu_seconds();
  clerestory::mesh::CleanSurface surface;
  std::size_t polygons = 0;
  {
    PhaseTimes times("reading");
    const clerestory::io::ModelFile read = clerestory::io::read_model(file);
    polygons = read.model.polygon_count();
    surface = clerestory::mesh::clean(read.model, {}, &times);
  }
  fmt::print("{}: {} polygons, then {}; {:.2f} CPU s, {:.0f} MB\n", file, polygons, surface.polygons.polygon_count(),
             clerestory::io::process_cpu_seconds() - start, clerestory::io::peak_memory_mb());
  for (const clerestory::mesh::Defect& defect : surface.report.defects) {
    fmt::print("  {:<44} {:>9} found {:>9} mended\n", defect.kind, defect.found, defect.mended);
  }
  fmt::print("  area {:.6f} m2, then {:.6f} m2; {} open edges, {} closed shells, gap {:g} m\n",
             surface.report.area_before_m2, surface.report.area_after_m2, surface.report.open_edges,
             surface.report.closed_shells, surface.report.gap_m);
}

}  // namespace

int main(int count, char** arguments) {
  try {
    for (int i = 1; i < count; ++i) measure(arguments[i]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "clean_benchmark: {}\n", error.what());
    return 1;
  }
  return 0;
}
