// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "clerestory_version.h"
#include "io/words.h"

namespace clerestory::tools {

namespace {

constexpr int kMostThreads = 1024;
constexpr double kCoarsestAccuracy = 0.5;  // as the study file has it

const std::vector<std::string> kCommands = {"daylight", "illuminance"};

constexpr const char* kMainFooter = R"(Examples:
  clerestory daylight office.obj                      daylight factors of a model, every setting at its default
  clerestory daylight office.toml -o results          of a study, results in the folder results/
  clerestory illuminance office.toml --accuracy 5%    illuminance under the study's sky and lamps, quickly

Exit status: 0 done, 1 the input is at fault, 2 the command line is at fault, 3 the machine failed (memory, disk),
4 the accuracy was not reached (results are written, and marked so), 130 interrupted.
)";

constexpr const char* kDaylightFooter = R"(Examples:
  clerestory daylight office.obj                      a model alone: work plane 0.8 m above every room's floor
  clerestory daylight office.toml -o results          a study; the map is results/workplane.png
  clerestory daylight office.toml --accuracy 5%       faster and coarser than the 2 % of the default
  clerestory daylight office.toml --set materials.wall.reflectance=0.7 --set grids.0.spacing=0.5
  clerestory daylight office.toml --json --quiet      the summary for a script, on stdout
)";

constexpr const char* kIlluminanceFooter = R"(Examples:
  clerestory illuminance office.toml                  results in office-results/ beside the study
  clerestory illuminance office.toml --set sky.type=none -o night
  clerestory illuminance office.toml --threads 1 --accuracy 1%
)";

/// What CLI11 fills in.
struct Raw {
  std::string study;
  std::string out;
  std::string accuracy;
  std::vector<std::string> set;
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

void add_common_options(CLI::App& app, Raw& raw) {
  // Not required as CLI11 means it: an unknown option is the more telling complaint.
  app.add_option("study", raw.study, "Study file (.toml) or model file (.obj)")->type_name("STUDY|MODEL");
  app.add_option("-o,--out", raw.out, "Folder of the results (default: STUDY-results beside the study)")
      ->type_name("DIR");
  app.add_option("--accuracy", raw.accuracy, "Accuracy to reach, as 2% or 0.02 (default: the study's, or 2 %)")
      ->type_name("SHARE");
  app.add_option("--threads", raw.threads, "Number of threads (default: every core)")
      ->type_name("N")
      ->check(CLI::Range(1, kMostThreads).description(""));
  app.add_option("--set", raw.set, "Overrides a key of the study, as sky.ground_reflectance=0.1; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_flag("--quiet", raw.quiet, "Neither progress nor report");
  app.add_flag("--json", raw.json, "The summary as JSON on stdout, instead of the report");
  app.allow_extras();
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  const auto near = io::nearest(word, known);
  return near ? fmt::format("did you mean {}?", *near) : std::string();
}

/// Complains about the first of the words that nothing has taken.
void expect_nothing_left(const CLI::App& app, const std::vector<std::string>& left) {
  if (left.empty()) return;
  const auto option = std::find_if(left.begin(), left.end(), [](const auto& w) { return w.size() > 1 && w[0] == '-'; });
  if (option == left.end())
    throw CommandLineError(fmt::format("unexpected word {}; give one study or model", io::in_quotes(left.front())));
  const std::string name = option->substr(0, option->find('='));
  const std::string near = suggestion(name, option_names(app));
  throw CommandLineError(fmt::format("unknown option {}; {}", io::in_quotes(name),
                                     near.empty() ? "clerestory " + app.get_name() + " --help lists them" : near));
}

/// The first word that is no option must be a subcommand: CLI11 would only say that one is missing.
void expect_a_known_command(std::span<const char* const> words) {
  for (const char* const word : words.subspan(std::min<std::size_t>(1, words.size()))) {
    const std::string_view text = word;
    if (text == "--help" || text == "-h" || text == "--version") return;
    if (std::find(kCommands.begin(), kCommands.end(), text) != kCommands.end()) return;
    const bool option = text.starts_with('-');
    const std::string near = suggestion(text, option ? std::vector<std::string>{"--help", "--version"} : kCommands);
    const std::string all = option ? "clerestory --help lists them" : "the commands are " + io::list_names(kCommands);
    const std::string hint = near.empty() ? all : near;
    throw CommandLineError(fmt::format("unknown {} {}; {}", option ? "option" : "command", io::in_quotes(text), hint));
  }
  throw CommandLineError("no command given; clerestory --help shows what there is");
}

std::string in_shell_quotes(std::string_view word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || std::string_view("_@%+=:,./-").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return std::string(word);
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// The command as it could be typed again, the program by its name alone.
std::string command_text(std::span<const char* const> words) {
  std::string text = "clerestory";
  for (const char* const word : words.subspan(1)) text += " " + in_shell_quotes(word);
  return text;
}

std::filesystem::path default_out(const std::filesystem::path& study) {
  return study.parent_path() / (study.stem().string() + "-results");
}

Options options_of(const Raw& raw, std::span<const char* const> words) {
  if (raw.study.empty()) throw CommandLineError("no study or model given; as in: clerestory daylight office.toml");
  for (const std::string& assignment : raw.set)
    if (assignment.find('=') == std::string::npos || assignment.front() == '=')
      throw CommandLineError(fmt::format("--set {} has no value; write --set key=value", io::in_quotes(assignment)));
  Options options;
  options.study = raw.study;
  options.out = raw.out.empty() ? default_out(raw.study) : std::filesystem::path(raw.out);
  options.set = raw.set;
  if (!raw.accuracy.empty()) options.set.push_back(fmt::format("accuracy.target={}", parse_accuracy(raw.accuracy)));
  options.threads = raw.threads;
  options.quiet = raw.quiet;
  options.json = raw.json;
  options.command = command_text(words);
  return options;
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

Request read_command_line(std::span<const char* const> words) {
  expect_a_known_command(words);
  CLI::App app("Architectural lighting simulation: how light is it here, and why?", "clerestory");
  app.footer(kMainFooter);
  app.set_help_flag("-h,--help", "This text");
  app.set_version_flag("--version", std::string("clerestory ") + kVersion, "The version");
  Raw raw;
  CLI::App* const daylight = app.add_subcommand("daylight", "Daylight factors under the CIE overcast sky");
  daylight->footer(kDaylightFooter);
  CLI::App* const illuminance = app.add_subcommand("illuminance", "Illuminance under the study's sky and lamps");
  illuminance->footer(kIlluminanceFooter);
  for (CLI::App* command : {daylight, illuminance}) {
    add_common_options(*command, raw);
    command->set_version_flag("--version", std::string("clerestory ") + kVersion, "The version");
  }
  try {
    app.parse(static_cast<int>(words.size()), words.data());
  } catch (const CLI::CallForHelp&) {
    const CLI::App* asked = daylight->parsed() ? daylight : illuminance->parsed() ? illuminance : &app;
    return {Request::What::kText, asked->help(asked == &app ? "" : "clerestory"), {}};
  } catch (const CLI::CallForVersion& version) {
    return {Request::What::kText, std::string(version.what()) + "\n", {}};
  } catch (const CLI::ParseError& error) {
    throw CommandLineError(one_line(error.what()) + "; --help explains the options");
  }
  const CLI::App* command = daylight->parsed() ? daylight : illuminance;
  expect_nothing_left(*command, command->remaining());
  const auto what = command == daylight ? Request::What::kDaylight : Request::What::kIlluminance;
  return {what, {}, options_of(raw, words)};
}

double parse_accuracy(const std::string& text) {
  std::string_view number = io::trim(text);
  const bool percent = number.ends_with('%');
  if (percent) number = io::trim(number.substr(0, number.size() - 1));
  const auto value = io::parse_number(number);
  const double share = value ? (percent ? *value / 100.0 : *value) : 0.0;
  if (!(share > 0.0 && share <= kCoarsestAccuracy))
    throw CommandLineError(
        fmt::format("--accuracy {} is not a share between 0 and 50 %; write 2% or 0.02", io::in_quotes(text)));
  return share;
}

}  // namespace clerestory::tools
