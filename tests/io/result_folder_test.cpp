// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result_folder.h"

#include <gtest/gtest.h>

#include "io/summary.h"
#include "mesh/error.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

namespace fs = std::filesystem;
using test::names_below;
using test::read_text;
using test::write_text;
using Names = std::set<std::string>;

std::string summary_of(const std::vector<std::string>& files, const std::string& status = "done") {
  std::string list;
  for (const auto& file : files) list += (list.empty() ? "\"" : ", \"") + file + "\"";
  return R"({"program": "clerestory", "status": ")" + status + R"(", "files": [)" + list + "]}";
}

/// A run that writes the files with `content` in each, and its summary.
void write_run(const fs::path& folder, std::vector<std::string> files, const std::string& content) {
  ResultFolder results(folder);
  for (const auto& file : files) write_text(results.staging() / file, content);
  files.push_back("summary.json");
  write_text(results.staging() / "summary.json", summary_of(files));
  results.commit(files);
}

void fail_run(const fs::path& folder) {
  ResultFolder results(folder);
  results.commit_failure(summary_of({"summary.json"}, kStatusFailed));
}

TEST(ResultFolder, HoldsTheFilesOfTheRunAndNothingElse) {
  const test::ScratchFolder scratch;
  write_run(scratch.path() / "a" / "b", {"grid.csv", "grid.vtp"}, "1");
  EXPECT_EQ(names_below(scratch.path() / "a" / "b"), (Names{"grid.csv", "grid.vtp", "summary.json"}));
}

TEST(ResultFolder, ReplacesOurFilesAndRemovesThoseWithoutSuccessor) {
  const test::ScratchFolder scratch;
  write_run(scratch.path(), {"grid.csv", "old.csv"}, "1");
  write_run(scratch.path(), {"grid.csv"}, "2");
  EXPECT_EQ(names_below(scratch.path()), (Names{"grid.csv", "summary.json"}));
  EXPECT_EQ(read_text(scratch.path() / "grid.csv"), "2");
}

TEST(ResultFolder, LeavesTheUsersFilesAlone) {
  const test::ScratchFolder scratch;
  write_text(scratch.path() / "thesis.doc", "years of work");
  write_run(scratch.path(), {"grid.csv"}, "1");
  write_run(scratch.path(), {"other.csv"}, "2");
  EXPECT_EQ(names_below(scratch.path()), (Names{"other.csv", "summary.json", "thesis.doc"}));
  EXPECT_EQ(read_text(scratch.path() / "thesis.doc"), "years of work");
}

TEST(ResultFolder, AUsersFileOfOurNameIsRefusedBeforeTheRun) {
  const test::ScratchFolder scratch;
  write_text(scratch.path() / "grid.csv", "mine");
  try {
    check_result_folder(scratch.path(), {"grid.csv", "summary.json"});
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), (scratch.path() / "grid.csv").string());
  }
  EXPECT_THROW(write_run(scratch.path(), {"grid.csv"}, "1"), InputError);
  EXPECT_EQ(names_below(scratch.path()), (Names{"grid.csv"}));
  EXPECT_EQ(read_text(scratch.path() / "grid.csv"), "mine");
}

TEST(ResultFolder, ASummaryOfSomebodyElseIsTheUsers) {
  const test::ScratchFolder scratch;
  write_text(scratch.path() / "summary.json", R"({"files": ["grid.csv"]})");
  EXPECT_THROW(check_result_folder(scratch.path(), {"summary.json"}), InputError);
}

TEST(ResultFolder, AFolderOfOurNameIsTheUsers) {
  const test::ScratchFolder scratch;
  write_run(scratch.path(), {"grid.csv"}, "1");
  fs::remove(scratch.path() / "grid.csv");
  fs::create_directory(scratch.path() / "grid.csv");
  EXPECT_THROW(check_result_folder(scratch.path(), {"grid.csv", "summary.json"}), InputError);
}

TEST(ResultFolder, TheCheckChangesNothing) {
  const test::ScratchFolder scratch;
  check_result_folder(scratch.path() / "new" / "deep", {"summary.json"});
  EXPECT_TRUE(names_below(scratch.path()).empty());
  write_run(scratch.path(), {"grid.csv"}, "1");
  check_result_folder(scratch.path(), {"grid.csv", "summary.json"});
  EXPECT_EQ(names_below(scratch.path()), (Names{"grid.csv", "summary.json"}));
}

TEST(ResultFolder, APlaceThatCannotBeWrittenToIsFoundBeforeTheRun) {
  const test::ScratchFolder scratch;
  write_text(scratch.path() / "file", "");
  EXPECT_THROW(check_result_folder(scratch.path() / "file", {"summary.json"}), MachineError);
  EXPECT_THROW(check_result_folder(scratch.path() / "file" / "below", {"summary.json"}), MachineError);
  EXPECT_THROW(check_result_folder("/proc/clerestory", {"summary.json"}), MachineError);
}

TEST(ResultFolder, ARunThatGivesUpLeavesTheFolderAsItWas) {
  const test::ScratchFolder scratch;
  write_run(scratch.path(), {"grid.csv"}, "1");
  {
    const ResultFolder results(scratch.path());
    write_text(results.staging() / "grid.csv", "2");
    const ResultFolder in_vain(scratch.path() / "new" / "deep");
  }
  EXPECT_EQ(names_below(scratch.path()), (Names{"grid.csv", "summary.json"}));
  EXPECT_EQ(read_text(scratch.path() / "grid.csv"), "1");
}

TEST(ResultFolder, AFileThatWasNotWrittenStopsTheCommit) {
  const test::ScratchFolder scratch;
  write_run(scratch.path(), {"grid.csv"}, "1");
  {
    ResultFolder results(scratch.path());
    write_text(results.staging() / "summary.json", summary_of({"grid.csv", "summary.json"}));
    EXPECT_THROW(results.commit({"grid.csv", "summary.json"}), MachineError);
    write_text(results.staging() / "grid.csv", "");
    EXPECT_THROW(results.commit({"grid.csv", "summary.json"}), MachineError);
  }
  EXPECT_EQ(read_text(scratch.path() / "grid.csv"), "1");
}

TEST(ResultFolder, WhatAKilledRunLeftIsRemoved) {
  const test::ScratchFolder scratch;
  fs::create_directories(scratch.path() / ".clerestory-writing" / "older");
  write_text(scratch.path() / ".clerestory-writing" / "grid.csv", "half");
  write_run(scratch.path(), {"grid.csv"}, "1");
  EXPECT_EQ(names_below(scratch.path()), (Names{"grid.csv", "summary.json"}));
}

TEST(ResultFolder, AFailureMovesOurOlderFilesToPrevious) {
  const test::ScratchFolder scratch;
  write_text(scratch.path() / "thesis.doc", "years of work");
  write_run(scratch.path(), {"grid.csv"}, "1");
  fail_run(scratch.path());
  EXPECT_EQ(names_below(scratch.path()),
            (Names{"previous", "previous/grid.csv", "previous/summary.json", "summary.json", "thesis.doc"}));
  EXPECT_EQ(read_earlier_summary(scratch.path() / "summary.json")->status, "failed");
  EXPECT_EQ(read_earlier_summary(scratch.path() / "previous/summary.json")->status, "done");
}

TEST(ResultFolder, AFailureAfterAFailureKeepsThePreviousResults) {
  const test::ScratchFolder scratch;
  write_run(scratch.path(), {"grid.csv"}, "1");
  fail_run(scratch.path());
  fail_run(scratch.path());
  EXPECT_EQ(names_below(scratch.path()),
            (Names{"previous", "previous/grid.csv", "previous/summary.json", "summary.json"}));
}

TEST(ResultFolder, PreviousHoldsTheLastGoodResultsAlone) {
  const test::ScratchFolder scratch;
  write_run(scratch.path(), {"a.csv", "b.csv"}, "1");
  fail_run(scratch.path());
  write_run(scratch.path(), {"a.csv"}, "2");
  fail_run(scratch.path());
  EXPECT_EQ(names_below(scratch.path() / "previous"), (Names{"a.csv", "summary.json"}));
  EXPECT_EQ(read_text(scratch.path() / "previous/a.csv"), "2");
}

TEST(ResultFolder, TheUsersFilesInPreviousStay) {
  const test::ScratchFolder scratch;
  write_run(scratch.path(), {"a.csv"}, "1");
  fs::create_directory(scratch.path() / "previous");
  write_text(scratch.path() / "previous/a.csv", "mine");
  fail_run(scratch.path());
  EXPECT_EQ(read_text(scratch.path() / "previous/a.csv"), "mine");
  EXPECT_EQ(read_text(scratch.path() / "previous-2/a.csv"), "1");
}

}  // namespace
}  // namespace clerestory::io
