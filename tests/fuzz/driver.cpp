// SPDX-License-Identifier: GPL-3.0-or-later
// Stands in for libFuzzer where the compiler is g++, with the same words: TARGET [-max_total_time=S] [-runs=N] [-seed=N] [FILE|FOLDER...]
// It knows nothing of coverage: damage done by chance, the same for one seed. One file alone is read as it is.
#include <fmt/format.h>
#include <sanitizer/common_interface_defs.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>

#include "tests/fuzz/mutation.h"
#include "tests/fuzz/target.h"

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestSeed = std::uintmax_t{128} << 10;  // larger ones make for few runs
constexpr unsigned kLongestRunSeconds = 25;
constexpr const char* kCrashFile = "crash-input";

std::string input;  // the latest

void save_input() {
  std::ofstream(kCrashFile, std::ios::binary) << input;
  std::cerr << "the input is in " << (fs::current_path() / kCrashFile).string() << '\n';
}

void stop_endless_run(int /*signal*/) {
  constexpr std::string_view kText = "this input takes too long\n";
  static_cast<void>(::write(STDERR_FILENO, kText.data(), kText.size()));
  std::abort();
}

struct Options {
  double max_total_time_s = 60.0;
  std::uint64_t runs = ~std::uint64_t{0};
  std::uint64_t seed = 1;
  std::vector<fs::path> seeds;
};

Options options_of(int count, char** words) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const std::string value = word.substr(std::min(word.find('='), word.size() - 1) + 1);
    if (word.starts_with("-max_total_time=")) {
      options.max_total_time_s = std::stod(value);
    } else if (word.starts_with("-runs=")) {
      options.runs = std::stoull(value);
    } else if (word.starts_with("-seed=")) {
      options.seed = std::stoull(value);
    } else {
      options.seeds.emplace_back(word);
    }
  }
  return options;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// In the order of their names, so that one seed gives one sequence.
std::vector<std::string> read_seeds(const std::vector<fs::path>& places) {
  std::vector<fs::path> files;
  for (const fs::path& place : places) {
    if (fs::is_regular_file(place)) files.push_back(place);
    if (!fs::is_directory(place)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(place))
      if (entry.is_regular_file() && entry.file_size() <= kLargestSeed) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> seeds;
  for (const fs::path& file : files) seeds.push_back(bytes_of(file));
  return seeds;
}

void run() {
  ::alarm(kLongestRunSeconds);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  ::alarm(0);
}

}  // namespace

/// Memory is bounded whatever the input promises.
extern "C" const char* __asan_default_options() {  // NOLINT: the sanitizer's name
  return "hard_rss_limit_mb=2048:max_allocation_size_mb=1024:allocator_may_return_null=0:handle_abort=1";
}

int main(int count, char** words) {
  const Options options = options_of(count, words);
  const std::vector<std::string> seeds = read_seeds(options.seeds);
  if (seeds.empty()) {
    std::cerr << "no seeds: name files or folders\n";
    return EXIT_FAILURE;
  }
  __sanitizer_set_death_callback(&save_input);
  ::signal(SIGALRM, &stop_endless_run);

  const auto start = std::chrono::steady_clock::now();
  for (const std::string& seed : seeds) {
    input = seed;
    run();
  }
  std::uint64_t runs = 0;
  clerestory::fuzz::Dice dice(options.seed << 32U);
  const bool as_it_is = options.seeds.size() == 1 && seeds.size() == 1 && fs::is_regular_file(options.seeds[0]);
  const auto seconds = [start] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  for (; !as_it_is && runs < options.runs && seconds() < options.max_total_time_s; ++runs) {
    input = clerestory::fuzz::mutated(seeds, dice);
    run();
  }
  std::cout << fmt::format("{} seeds and {} damaged inputs in {:.1f} s\n", seeds.size(), runs, seconds());
  return EXIT_SUCCESS;
}
