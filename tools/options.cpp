// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <string_view>

#include "clerestory_version.h"
#include "io/study_schema.h"
#include "io/words.h"

namespace clerestory::tools {

namespace {

constexpr int kMostThreads = 1024;

constexpr const char* kMainFooter = R"(Examples:
  clerestory inspect office.ifc                       parts, materials, rooms and defects of a model
  clerestory clean office.ifc -o office.obj           the mended model
  clerestory mesh office.toml                         its elements and shadow lines, for ParaView
  clerestory daylight office.obj                      daylight factors of a model, every setting at its default
  clerestory daylight office.toml -o results          of a study, results in the folder results/
  clerestory illuminance office.toml --accuracy 5%    illuminance under the study's sky and lamps, quickly

Exit status: 0 done, 1 the input is at fault, 2 the command line is at fault, 3 the machine failed (memory, disk),
4 the accuracy was not reached, or not within the limits (results are written, and marked so), 130 interrupted.
)";

constexpr const char* kInspectFooter = R"(Examples:
  clerestory inspect office.obj                       what is in a model, what its materials became, what was mended
  clerestory inspect office.toml                      the model of a study, with the study's materials
  clerestory inspect office.obj --units mm --up y     where the file does not say it and the guess is wrong
  clerestory inspect office.obj --strict --quiet      for a script: status 1 where something cannot be mended
  clerestory inspect office.obj --json                the report for a program
  clerestory inspect turin.epw -o turin.png           a weather file: its sums by month, a picture of its year
  clerestory inspect panel.ldt -o panel.png           a photometric file: fluxes, UGR table, polar diagram
)";

constexpr const char* kCleanFooter = R"(Examples:
  clerestory clean office.ifc -o clean.obj            beside it clean.mtl, clean.obj.report.txt, .report.json, .defects.vtp
  clerestory clean scan.ply -o clean.glb --gap 0.005  gaps of up to 5 mm are closed
  clerestory clean office.obj -o copy.vtp --repair off
                                                      another format, mended in nothing
)";

constexpr const char* kMeshFooter = R"(Examples:
  clerestory mesh office.toml                         office-mesh/elements.vtp and discontinuities.vtp, for ParaView
  clerestory mesh office.obj -o mesh --lines          the shadow lines alone
  clerestory mesh office.toml --accuracy 1%           more lines than at the 2 % of the default
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
  clerestory illuminance office.toml --set sky.type=weather --set sky.sun=true --time 2026-03-21T12:00
                                                      daylight and sun at a moment, with site.weather in the study
  clerestory illuminance office.toml --time 2026-03-21T09:00,2026-03-21T12:00,2026-03-21T15:00
                                                      several moments from one solution, in columns of their own
  clerestory illuminance office.toml --threads 1 --accuracy 1%
  clerestory illuminance city.toml --max-time 10min --max-memory 8GB --keep-partial
                                                      what can be had within the limits, or until ctrl-C
)";

constexpr const char* kSenseFooter = R"(Examples:
  clerestory daylight office.toml --save-solution     first: office-results/solution.h5
  clerestory sense office-results                     the grids that stand in office.toml now, without solving
  clerestory sense office-results --grid 'name = "desks", surface = "desk*", height = 0.0, spacing = 0.1'
  clerestory sense office-results --grid 'name = "eyes", points = "eyes.pts"' -o eyes
                                                      a grid has the keys of [[grids]] in a study
  clerestory sense office-results --time 2026-06-21T15:00 --set groups.row-a.dimming=0.4 -o later
                                                      another moment, other dimming: by the stored links
)";

/// A subcommand, in the order of the help.
struct Command {
  Request::What what;
  const char* name;
  const char* meaning;
  const char* footer;
  const char* example;  ///< of its arguments
};

constexpr std::array kCommands{
    Command{Request::What::kInspect, "inspect", "What is in a model, weather or photometric file", kInspectFooter,
            "inspect office.obj"},
    Command{Request::What::kClean, "clean", "Writes the mended model", kCleanFooter, "clean office.ifc -o clean.obj"},
    Command{Request::What::kMesh, "mesh", "The elements and shadow lines of a study, for ParaView", kMeshFooter,
            "mesh office.toml"},
    Command{Request::What::kDaylight, "daylight", "Daylight factors under the CIE overcast sky", kDaylightFooter,
            "daylight office.toml"},
    Command{Request::What::kIlluminance, "illuminance", "Illuminance under the study's sky and lamps",
            kIlluminanceFooter, "illuminance office.toml"},
    Command{Request::What::kSense, "sense", "New grids from a stored solution, without solving", kSenseFooter,
            "sense office-results"}};

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  names.reserve(kCommands.size());
  for (const Command& command : kCommands) names.emplace_back(command.name);
  return names;
}

/// What CLI11 fills in.
struct Raw {
  std::string study;
  std::string out;
  std::string accuracy;
  std::vector<std::string> set;
  int threads = 0;
  std::string units;
  std::string up;
  std::string gap;
  std::string repair;
  bool quiet = false;
  bool json = false;
  bool strict = false;
  bool lines = false;
  std::vector<std::string> times;
  std::string max_time;
  std::string max_memory;
  bool keep_partial = false;
  bool save_solution = false;
  std::vector<std::string> grids;
};

void add_common_options(CLI::App& app, const Command& command, Raw& raw) {
  // Not required as CLI11 means it: an unknown option is the more telling complaint.
  if (command.what == Request::What::kSense) {
    app.add_option("results", raw.study, "Folder of a run with --save-solution, or its solution.h5")
        ->type_name("RESULTS");
  } else {
    app.add_option("study", raw.study, "Study file (.toml), or model file with every key at its default")
        ->type_name("STUDY|MODEL");
  }
  app.add_option("--threads", raw.threads, "Number of threads (default: every core)")
      ->type_name("N")
      ->check(CLI::Range(1, kMostThreads).description(""));
  app.add_option("--set", raw.set, "Overrides a key of the study, as sky.ground_reflectance=0.1; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_flag("--quiet", raw.quiet, "Neither progress nor report");
  app.set_version_flag("--version", std::string("clerestory ") + kVersion, "The version");
  app.allow_extras();
}

void add_run_options(CLI::App& app, Raw& raw, const std::string& default_folder = "STUDY-results") {
  app.add_option("-o,--out", raw.out, "Folder of the results (default: " + default_folder + " beside the study)")
      ->type_name("DIR");
  app.add_option("--accuracy", raw.accuracy, "Accuracy to reach, as 2% or 0.02 (default: the study's, or 2 %)")
      ->type_name("SHARE");
  app.add_flag("--json", raw.json, "The summary as JSON on stdout, instead of the report");
}

void add_limits(CLI::App& app, Raw& raw) {
  app.add_option("--max-time", raw.max_time,
                 "Ends with what there is after so long, as 90s, 10min or 1.5h (default: no limit)")
      ->type_name("DURATION");
  app.add_option("--max-memory", raw.max_memory,
                 "Ends with what there is before it needs more, as 500MB or 4GB (default: what the machine has left)")
      ->type_name("SIZE");
  app.add_flag("--keep-partial", raw.keep_partial, "Ctrl-C ends with what there is, instead of nothing");
}

void add_model_options(CLI::App& app, Raw& raw) {
  app.add_option("--units", raw.units,
                 "Unit of length of the model: m, cm, mm, in, ft (default: as it says, or guessed)")
      ->type_name("UNIT")
      ->check(CLI::IsMember({"m", "cm", "mm", "in", "ft"}).description(""));
  app.add_option("--up", raw.up, "Axis of the model that points up: z, y (default: as its format has it)")
      ->type_name("AXIS")
      ->check(CLI::IsMember({"z", "y"}).description(""));
  app.add_option("--gap", raw.gap,
                 "Gaps of up to this width [m] are closed (default: 1 mm beside long sides, else the precision of the "
                 "coordinates)")
      ->type_name("METRES")
      ->check(CLI::Range(0.0, 0.1).description(""));
  app.add_option("--repair", raw.repair, "Defects are mended (auto), only reported (report), or not looked for (off)")
      ->type_name("HOW")
      ->check(CLI::IsMember({"auto", "report", "off"}).description(""));
  app.add_flag("--json", raw.json, "The report as JSON on stdout");
}

void add_times(CLI::App& app, Raw& raw) {
  app.add_option("--time", raw.times,
                 "The moment of the daylight, local standard time (sky.time); may be repeated, or a list with commas: "
                 "each moment has columns of its own then")
      ->type_name("YYYY-MM-DDTHH:MM")
      ->delimiter(',')
      ->allow_extra_args(false);
}

void add_command(CLI::App& app, const Command& command, Raw& raw) {
  CLI::App& own = *app.add_subcommand(command.name, command.meaning);
  own.footer(command.footer);
  add_common_options(own, command, raw);
  switch (command.what) {
    case Request::What::kInspect:
      add_model_options(own, raw);
      own.add_option(
             "-o,--out", raw.out,
             "Of a weather file (.epw, .wea) the picture of its year, of a photometric one (.ies, .ldt) its polar "
             "diagram: a PNG")
          ->type_name("FILE");
      own.add_flag("--strict", raw.strict, "Status 1 where something cannot be mended");
      break;
    case Request::What::kClean:
      own.add_option("-o,--out", raw.out, "The model to write: .obj, .ply, .gltf, .glb or .vtp")->type_name("FILE");
      add_model_options(own, raw);
      break;
    case Request::What::kMesh:
      add_run_options(own, raw, "STUDY-mesh");
      own.add_flag("--lines", raw.lines, "The shadow lines alone");
      break;
    case Request::What::kSense:
      add_run_options(own, raw, "RESULTS-sense");
      add_times(own, raw);
      own.add_option("--grid", raw.grids, "A grid in place of the study's, by the keys of [[grids]]; may be repeated")
          ->type_name("KEYS")
          ->allow_extra_args(false);
      add_limits(own, raw);
      break;
    default:
      add_run_options(own, raw);
      if (command.what == Request::What::kIlluminance) add_times(own, raw);
      own.add_flag("--save-solution", raw.save_solution, "Keeps the solution too, for clerestory sense");
      add_limits(own, raw);
  }
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
    const std::vector<std::string> known = command_names();
    if (std::find(known.begin(), known.end(), text) != known.end()) return;
    const bool option = text.starts_with('-');
    const std::string near = suggestion(text, option ? std::vector<std::string>{"--help", "--version"} : known);
    const std::string all = option ? "clerestory --help lists them" : "the commands are " + io::list_names(known);
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

std::filesystem::path default_out(const Command& command, const std::filesystem::path& study) {
  if (command.what == Request::What::kSense) {
    std::filesystem::path results = study.extension() == ".h5" ? study.parent_path() : study;
    if (results.filename().empty()) results = results.parent_path();
    return results.parent_path() / (results.filename().string() + "-sense");
  }
  if (command.what == Request::What::kInspect) return {};
  const char* const ending = command.what == Request::What::kMesh ? "-mesh" : "-results";
  return study.parent_path() / (study.stem().string() + ending);
}

/// A moment as the study has it, with its seconds. A blank stands for the T as well.
std::string parse_moment(std::string text) {
  constexpr std::size_t kUpToMinutes = 16;
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const bool like_one = text.size() >= kUpToMinutes && is_digit(text.front()) && is_digit(text[15]) && text[4] == '-' &&
                        text[7] == '-' && text[13] == ':' && (text[10] == 'T' || text[10] == ' ');
  if (!like_one)
    throw CommandLineError(
        fmt::format("--time {} is no moment; write for example --time 2026-03-21T12:00", io::in_quotes(text)));
  text[10] = 'T';
  if (text.size() == kUpToMinutes || text[kUpToMinutes] != ':') text.insert(kUpToMinutes, ":00");
  return text;
}

std::vector<std::string> moments_of(const std::vector<std::string>& times) {
  std::vector<std::string> moments;
  for (const std::string& time : times) moments.push_back(parse_moment(time));
  return moments;
}

/// The command line's own words for keys of the study, behind the user's --set.
std::vector<std::string> settings_of(const Raw& raw) {
  std::vector<std::string> set = raw.set;
  if (!raw.accuracy.empty()) set.push_back(fmt::format("accuracy.target={}", parse_accuracy(raw.accuracy)));
  if (!raw.units.empty()) set.push_back(fmt::format("model.units={}", raw.units));
  if (!raw.up.empty()) set.push_back(fmt::format("model.up={}", raw.up));
  if (!raw.gap.empty()) set.push_back(fmt::format("model.gap={}", raw.gap));
  if (!raw.repair.empty()) set.push_back(fmt::format("model.repair={}", raw.repair));
  if (raw.times.size() == 1) set.push_back("sky.time=" + parse_moment(raw.times.front()));
  if (raw.times.size() > 1) set.push_back(fmt::format("sky.time=[{}]", fmt::join(moments_of(raw.times), ", ")));
  return set;
}

Options options_of(const Command& command, const Raw& raw, std::span<const char* const> words) {
  if (raw.study.empty())
    throw CommandLineError(fmt::format("no {} given; as in: clerestory {}",
                                       command.what == Request::What::kSense ? "results" : "study or model",
                                       command.example));
  if (command.what == Request::What::kClean && raw.out.empty())
    throw CommandLineError(fmt::format("no file to write given; as in: clerestory {}", command.example));
  for (const std::string& assignment : raw.set)
    if (assignment.find('=') == std::string::npos || assignment.front() == '=')
      throw CommandLineError(fmt::format("--set {} has no value; write --set key=value", io::in_quotes(assignment)));
  Options options;
  options.study = raw.study;
  options.out = raw.out.empty() ? default_out(command, raw.study) : std::filesystem::path(raw.out);
  options.set = settings_of(raw);
  options.grids = raw.grids;
  options.threads = raw.threads;
  options.quiet = raw.quiet;
  options.json = raw.json;
  options.strict = raw.strict;
  options.lines = raw.lines;
  if (!raw.max_time.empty()) options.max_time_s = parse_duration(raw.max_time);
  if (!raw.max_memory.empty()) options.max_memory_bytes = parse_size(raw.max_memory);
  options.keep_partial = raw.keep_partial;
  options.save_solution = raw.save_solution;
  options.command = command_text(words);
  return options;
}

struct NamedUnit {
  std::string_view name;
  double size;
};

/// A number with one of the units behind it; 0 where it is none.
double parse_quantity(std::string_view text, std::initializer_list<NamedUnit> units) {
  const std::string_view trimmed = io::trim(text);
  const std::size_t digits = std::min(trimmed.find_first_not_of("0123456789.eE+-"), trimmed.size());
  const auto value = io::parse_number(io::trim(trimmed.substr(0, digits)));
  const std::string_view unit = io::trim(trimmed.substr(digits));
  for (const NamedUnit& known : units)
    if (value && unit == known.name) return *value * known.size;
  return 0.0;
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
  for (const Command& command : kCommands) add_command(app, command, raw);
  const auto chosen = [&app]() -> const CLI::App* {
    const auto parsed = app.get_subcommands();
    return parsed.empty() ? nullptr : parsed.front();
  };
  try {
    app.parse(static_cast<int>(words.size()), words.data());
  } catch (const CLI::CallForHelp&) {
    const CLI::App* asked = chosen();
    return {Request::What::kText, asked == nullptr ? app.help() : asked->help("clerestory"), {}};
  } catch (const CLI::CallForVersion& version) {
    return {Request::What::kText, std::string(version.what()) + "\n", {}};
  } catch (const CLI::ParseError& error) {
    throw CommandLineError(one_line(error.what()) + "; --help explains the options");
  }
  expect_nothing_left(*chosen(), chosen()->remaining());
  const Command& command = *std::find_if(kCommands.begin(), kCommands.end(),
                                         [&](const Command& c) { return chosen()->get_name() == c.name; });
  return {command.what, {}, options_of(command, raw, words)};
}

double parse_accuracy(const std::string& text) {
  std::string_view number = io::trim(text);
  const bool percent = number.ends_with('%');
  if (percent) number = io::trim(number.substr(0, number.size() - 1));
  const auto value = io::parse_number(number);
  const double share = value ? (percent ? *value / 100.0 : *value) : 0.0;
  if (share > 0.0 && share < io::kFinestAccuracy)
    throw CommandLineError(fmt::format("--accuracy {} is out of reach; ask for {:.6g} % or more", io::in_quotes(text),
                                       100.0 * io::kFinestAccuracy));
  if (!(share > 0.0 && share <= io::kCoarsestAccuracy))
    throw CommandLineError(
        fmt::format("--accuracy {} is not a share up to 50 %; write 2% or 0.02", io::in_quotes(text)));
  return share;
}

double parse_duration(const std::string& text) {
  const double seconds = parse_quantity(text, {{"", 1.0}, {"s", 1.0}, {"min", 60.0}, {"h", 3600.0}});
  if (seconds > 0.0) return seconds;
  throw CommandLineError(fmt::format("--max-time {} is no duration; write 90s, 10min or 1.5h", io::in_quotes(text)));
}

std::uint64_t parse_size(const std::string& text) {
  constexpr double kMega = 1 << 20;
  constexpr double kMost = 1e15;
  const double bytes = parse_quantity(text, {{"MB", kMega}, {"GB", 1024.0 * kMega}});
  if (bytes >= 1.0 && bytes <= kMost) return static_cast<std::uint64_t>(bytes);
  throw CommandLineError(fmt::format("--max-memory {} is no size; write 500MB or 4GB", io::in_quotes(text)));
}

}  // namespace clerestory::tools
