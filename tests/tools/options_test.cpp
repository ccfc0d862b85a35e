// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clerestory::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Request read(std::vector<const char*> words) {
  words.insert(words.begin(), "clerestory");
  return read_command_line(words);
}

std::string complaint(std::vector<const char*> words) {
  try {
    read(std::move(words));
  } catch (const CommandLineError& error) {
    return error.what();
  }
  return "none";
}

TEST(Options, ResultsGoBesideTheStudyByDefault) {
  const Options options = read({"daylight", "projects/office.toml"}).options;
  EXPECT_EQ(options.study, "projects/office.toml");
  EXPECT_EQ(options.out, "projects/office-results");
  EXPECT_EQ(options.threads, 0);
  EXPECT_FALSE(options.quiet || options.json);
}

TEST(Options, AreReadForBothCommands) {
  EXPECT_EQ(read({"daylight", "a.obj"}).what, Request::What::kDaylight);
  const Request request = read({"illuminance", "--threads", "2", "-o", "out", "--quiet", "a.obj", "--json"});
  EXPECT_EQ(request.what, Request::What::kIlluminance);
  EXPECT_EQ(request.options.threads, 2);
  EXPECT_EQ(request.options.out, "out");
  EXPECT_TRUE(request.options.quiet && request.options.json);
}

TEST(Options, WhatTheModelIsBecomesKeysOfTheStudy) {
  const Request request = read({"inspect", "a.obj", "--units", "mm", "--up", "y", "--gap", "0.01", "--repair", "report",
                                "--set", "model.units=m", "--strict"});
  EXPECT_EQ(request.what, Request::What::kInspect);
  EXPECT_TRUE(request.options.strict);
  EXPECT_THAT(request.options.set,
              ElementsAre("model.units=m", "model.units=mm", "model.up=y", "model.gap=0.01", "model.repair=report"));
  EXPECT_THAT(complaint({"inspect", "a.obj", "--gap", "2"}), HasSubstr("--gap"));
  EXPECT_THAT(complaint({"inspect", "a.obj", "--up", "x"}), HasSubstr("--up"));
}

TEST(Options, CleanNeedsAFileToWrite) {
  EXPECT_THAT(complaint({"clean", "a.obj"}), HasSubstr("no file to write given"));
  EXPECT_EQ(read({"clean", "a.obj", "-o", "b.ply"}).options.out, "b.ply");
}

TEST(Options, MeshHasAFolderOfItsOwnAndMayAskForLinesAlone) {
  EXPECT_EQ(read({"mesh", "a.toml"}).options.out, "a-mesh");
  EXPECT_FALSE(read({"mesh", "a.toml"}).options.lines);
  EXPECT_TRUE(read({"mesh", "a.toml", "--lines"}).options.lines);
  EXPECT_THAT(complaint({"daylight", "a.toml", "--lines"}), HasSubstr("unknown option '--lines'"));
}

TEST(Options, OverridesKeepTheirOrderAndTheAccuracyIsTheLast) {
  const auto set = read({"daylight", "--accuracy", "5%", "--set", "a=1", "a.toml", "--set=b.c=[1, 2]"}).options.set;
  EXPECT_THAT(set, ElementsAre("a=1", "b.c=[1, 2]", "accuracy.target=0.05"));
}

TEST(Options, TheCommandCanBeTypedAgain) {
  EXPECT_EQ(read({"daylight", "my office.toml", "--set", "a='x'"}).options.command,
            R"(clerestory daylight 'my office.toml' --set 'a='\''x'\''')");
}

TEST(Options, AnAccuracyIsAShareOrAPercentage) {
  EXPECT_DOUBLE_EQ(parse_accuracy("2%"), 0.02);
  EXPECT_DOUBLE_EQ(parse_accuracy("0.5 %"), 0.005);
  EXPECT_DOUBLE_EQ(parse_accuracy("0.02"), 0.02);
  for (const char* bad : {"2", "0.51", "0", "-1%", "100%", "nan", "%", "", "two", "0.02x"})
    EXPECT_THROW(parse_accuracy(bad), CommandLineError) << bad;
}

TEST(Options, AnUnknownWordNamesTheNearestKnownOne) {
  EXPECT_EQ(complaint({"daylihgt", "a.toml"}), "unknown command 'daylihgt'; did you mean daylight?");
  EXPECT_EQ(complaint({"daylight", "a.toml", "--acuracy", "5%"}),
            "unknown option '--acuracy'; did you mean --accuracy?");
  EXPECT_EQ(complaint({"daylight", "--ouput=x"}), "unknown option '--ouput'; did you mean --out?");
  EXPECT_EQ(complaint({"--verson"}), "unknown option '--verson'; did you mean --version?");
}

TEST(Options, ACommandLineAtFaultSaysWhatToDo) {
  EXPECT_THAT(complaint({}), HasSubstr("--help"));
  EXPECT_THAT(complaint({"daylight"}), HasSubstr("clerestory daylight office.toml"));
  EXPECT_THAT(complaint({"xyzzy"}), HasSubstr("daylight, illuminance"));
  EXPECT_THAT(complaint({"daylight", "a", "b"}), HasSubstr("'b'"));
  EXPECT_THAT(complaint({"daylight", "a", "--set", "b"}), HasSubstr("--set key=value"));
  EXPECT_THAT(complaint({"daylight", "a", "--threads", "0"}), HasSubstr("1 to 1024"));
  EXPECT_THAT(complaint({"daylight", "a", "--out"}), HasSubstr("--out"));
  for (const auto& words : std::vector<std::vector<const char*>>{{}, {"daylight", "a", "-o", "b", "-o", "c"}})
    EXPECT_THAT(complaint(words), testing::Not(HasSubstr("\n")));
}

TEST(Options, HelpHasExamplesAndExitStatuses) {
  EXPECT_THAT(read({"--help"}).text, testing::AllOf(HasSubstr("Examples:"), HasSubstr("130 interrupted")));
  EXPECT_THAT(read({"daylight", "--help"}).text, HasSubstr("--set materials.wall.reflectance=0.7"));
  EXPECT_THAT(read({"illuminance", "-h"}).text, HasSubstr("clerestory illuminance office.toml"));
  EXPECT_EQ(read({"--version"}).text, read({"daylight", "--version"}).text);
}

TEST(Options, AnAccuracyOutOfReachIsRefusedWithWhatIsReachable) {
  EXPECT_DOUBLE_EQ(parse_accuracy("0.01%"), 1e-4);
  EXPECT_THAT(complaint({"daylight", "a.obj", "--accuracy", "0.0001%"}), HasSubstr("ask for 0.01 % or more"));
}

TEST(Options, LimitsHaveUnits) {
  EXPECT_EQ(parse_duration("90"), 90.0);
  EXPECT_EQ(parse_duration("90 s"), 90.0);
  EXPECT_EQ(parse_duration("10min"), 600.0);
  EXPECT_EQ(parse_duration(" 1.5 h "), 5400.0);
  EXPECT_EQ(parse_size("500MB"), 500ULL << 20);
  EXPECT_EQ(parse_size("1.5 GB"), 1536ULL << 20);
  for (const char* wrong : {"", "s", "-3s", "0", "10 days", "nan", "1e400"}) {
    EXPECT_THROW(parse_duration(wrong), CommandLineError) << wrong;
  }
  for (const char* wrong : {"", "GB", "4", "-4GB", "4 TBs", "1e9GB"}) {
    EXPECT_THROW(parse_size(wrong), CommandLineError) << wrong;
  }
}

TEST(Options, GridsOfSenseAreThoseOfTheStudy) {
  const Options options =
      read({"sense", "a-results", "--grid", "name = 'b', height = 1", "--grid", "name = 'c'"}).options;
  EXPECT_EQ(options.study, "a-results");
  EXPECT_EQ(options.out, "a-results-sense");
  EXPECT_THAT(options.grids, ElementsAre("name = 'b', height = 1", "name = 'c'"));
  EXPECT_EQ(read({"sense", "x/a-results/"}).options.out, "x/a-results-sense");
  EXPECT_EQ(read({"sense", "x/a-results/solution.h5"}).options.out, "x/a-results-sense");
  EXPECT_TRUE(read({"daylight", "a.obj", "--save-solution"}).options.save_solution);
  EXPECT_THAT(complaint({"sense", "a-results", "--save-solution"}), HasSubstr("unknown option"));
  EXPECT_THAT(complaint({"sense"}), HasSubstr("no results given"));
}

TEST(Options, LimitsAreOfRunsAlone) {
  const Options options =
      read({"illuminance", "a.obj", "--max-time", "2min", "--max-memory", "4GB", "--keep-partial"}).options;
  EXPECT_EQ(options.max_time_s, 120.0);
  EXPECT_EQ(options.max_memory_bytes, 4ULL << 30);
  EXPECT_TRUE(options.keep_partial);
  EXPECT_FALSE(read({"daylight", "a.obj"}).options.max_time_s);
  EXPECT_THAT(complaint({"daylight", "a.obj", "--max-time", "soon"}), HasSubstr("10min"));
  EXPECT_THAT(complaint({"daylight", "a.obj", "--max-memory", "4"}), HasSubstr("4GB"));
  EXPECT_THAT(complaint({"clean", "a.obj", "-o", "b.obj", "--max-time", "1s"}), HasSubstr("unknown option"));
}

TEST(Options, MomentsAreGivenOneByOneOrInAListWithCommas) {
  const auto one = read({"illuminance", "--time", "2026-03-21T12:00", "a.toml"}).options;
  EXPECT_EQ(one.study, "a.toml");
  EXPECT_THAT(one.set, testing::ElementsAre("sky.time=2026-03-21T12:00:00"));
  const std::string both = "sky.time=[2026-03-21T09:00:00, 2026-03-21T12:00:00]";
  const char* const first = "2026-03-21T09:00";
  const char* const second = "2026-03-21 12:00";
  EXPECT_THAT(read({"illuminance", "a.toml", "--time", first, "--time", second}).options.set,
              testing::ElementsAre(both));
  EXPECT_THAT(read({"sense", "results", "--time", "2026-03-21T09:00,2026-03-21T12:00"}).options.set,
              testing::ElementsAre(both));
  EXPECT_THAT(complaint({"illuminance", "a.toml", "--time", "2026-03-21T09:00,noon"}),
              HasSubstr("'noon' is no moment"));
}

}  // namespace
}  // namespace clerestory::tools
