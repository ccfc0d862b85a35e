// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace clerestory::tools {

/// The command line is at fault. what() gives it as one line. Exit status 2.
class CommandLineError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the subcommands are asked for.
struct Options {
  std::filesystem::path study;  ///< or a model; of sense, the folder of results
  std::filesystem::path out;    ///< the folder of the results; of clean, the model to write; of inspect, the diagram
  std::vector<std::string>
      set;  ///< "key=value", in the order given; last what has an option of its own: "accuracy.target=..."
  std::vector<std::string> grids;  ///< of sense, in place of the study's, each by the keys of [[grids]]
  int threads = 0;                 ///< 0: every core
  bool quiet = false;
  bool json = false;
  bool strict = false;  ///< of inspect: what cannot be mended is an error
  bool lines = false;   ///< of mesh: the shadow lines alone
  // Of daylight and illuminance:
  std::optional<double> max_time_s;
  std::optional<std::uint64_t> max_memory_bytes;
  bool save_solution = false;  ///< for sense
  bool keep_partial = false;   ///< ctrl-C ends the run with what it has
  std::string command;         ///< the whole command line, words quoted where a shell needs it
};

/// What the command line asks for: a subcommand, or a text to be printed.
struct Request {
  enum class What { kText, kInspect, kClean, kMesh, kDaylight, kIlluminance, kSense };

  What what = What::kText;
  std::string text;  ///< of --help and --version
  Options options;
};

/// Reads the command line, the program's own name first. Throws CommandLineError, with the nearest known word where a
/// subcommand or an option is unknown.
Request read_command_line(std::span<const char* const> words);

/// The accuracy that "2%", "2 %" or "0.02" means, a share as accuracy.target of a study may have it. Throws CommandLineError.
double parse_accuracy(const std::string& text);

/// The seconds that "90", "90 s", "10 min" or "1.5h" mean. Throws CommandLineError.
double parse_duration(const std::string& text);

/// The bytes that "500 MB" or "4GB" mean, in powers of 1024. Throws CommandLineError.
std::uint64_t parse_size(const std::string& text);

}  // namespace clerestory::tools
