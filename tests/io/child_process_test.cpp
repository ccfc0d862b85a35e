// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <list>
#include <stdexcept>

#include "io/model_stream.h"
#include "mesh/error.h"
#include "tests/io/refusal.h"
#include "tests/io/sample_model.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using test::refusal_of;
using testing::HasSubstr;

using Path = std::filesystem::path;

/// What is refused when that reader runs under narrow limits.
std::string refusal(ModelReaderFunction reader, std::uint32_t wall_s = 60) {
  const ChildLimits narrow{.cpu_s = 1, .wall_s = wall_s, .memory_bytes = std::uint64_t{256} << 20};
  return refusal_of([&] { read_in_child("house.ifc", {}, reader, narrow); });
}

/// Keeps a computation whose result nobody needs.
volatile std::uint64_t g_sink = 0;

TEST(ChildProcess, TheModelOfTheReaderComesBackWhole) {
  const ModelFile file =
      read_in_child("house.ifc", {}, [](const Path&, const ModelFormat&) { return test::sample_model_file(); });
  ModelAnswer expected;
  ModelAnswer got;
  expected.model = test::sample_model_file();
  got.model = file;
  EXPECT_EQ(pack(got), pack(expected));
}

TEST(ChildProcess, TheReaderGetsPathAndFormat) {
  const ModelFormat format{.unit = LengthUnit::kInch, .up = UpAxis::kY};
  const ModelFile file = read_in_child("a b.ifc", format, [](const Path& path, const ModelFormat& given) {
    ModelFile told;
    told.files = {path};
    told.unit = given.unit.value();
    told.up = given.up.value();
    return told;
  });
  EXPECT_THAT(file.files, testing::ElementsAre("a b.ifc"));
  EXPECT_EQ(file.unit, LengthUnit::kInch);
  EXPECT_EQ(file.up, UpAxis::kY);
}

TEST(ChildProcess, AModelOfManyMegabytesPasses) {
  const ModelFile file = read_in_child("big", {}, [](const Path&, const ModelFormat&) {
    ModelFile big;
    big.model.vertices.assign(2'000'000, {1.0, 2.0, 3.0});
    return big;
  });
  ASSERT_EQ(file.model.vertices.size(), 2'000'000U);
  EXPECT_EQ(file.model.vertices.back(), (mesh::Point{1.0, 2.0, 3.0}));
}

TEST(ChildProcess, AnInputErrorKeepsPlaceProblemAndHint) {
  try {
    read_in_child("house.ifc", {}, [](const Path&, const ModelFormat&) -> ModelFile {
      throw InputError("house.bin", 12, "no wall", "draw one");
    });
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), "house.bin");
    EXPECT_EQ(error.line(), 12U);
    EXPECT_EQ(error.problem(), "no wall");
    EXPECT_EQ(error.hint(), "draw one");
  }
}

TEST(ChildProcess, AMachineErrorStaysOne) {
  EXPECT_THROW(
      read_in_child("house.ifc", {}, [](const Path&, const ModelFormat&) -> ModelFile { throw MachineError("disk"); }),
      MachineError);
}

TEST(ChildProcess, AnyOtherExceptionIsToldInOneLine) {
  EXPECT_THAT(refusal([](const Path&, const ModelFormat&) -> ModelFile { throw std::logic_error("bad\nthing"); }),
              testing::StartsWith("house.ifc: its importer failed: bad?thing; "));
  EXPECT_THAT(refusal([](const Path&, const ModelFormat&) -> ModelFile { throw 7; }), HasSubstr("its importer failed"));
}

TEST(ChildProcess, ACrashIsTheFilesFault) {
  EXPECT_THAT(refusal([](const Path&, const ModelFormat&) -> ModelFile { std::abort(); }),
              testing::StartsWith("house.ifc: its importer crashed (Aborted); "));
  EXPECT_THAT(refusal([](const Path&, const ModelFormat&) -> ModelFile {
                ::raise(SIGSEGV);
                return {};
              }),
              HasSubstr("its importer crashed (Segmentation fault)"));
  EXPECT_THAT(refusal([](const Path&, const ModelFormat&) -> ModelFile { ::_exit(3); }),
              HasSubstr("its importer ended without a word (status 3)"));
}

TEST(ChildProcess, EndlessWorkIsStopped) {
  EXPECT_THAT(refusal([](const Path&, const ModelFormat&) -> ModelFile {
                for (;;) g_sink = g_sink + 1;
              }),
              HasSubstr("house.ifc: reading it was given up after 1 s of CPU time"));
}

TEST(ChildProcess, EndlessWaitingIsStopped) {
  EXPECT_THAT(refusal(
                  [](const Path&, const ModelFormat&) -> ModelFile {
                    for (;;) ::pause();
                  },
                  1),
              HasSubstr("house.ifc: reading it was given up after 1 s;"));
}

TEST(ChildProcess, HungerForMemoryIsStopped) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer ends a process without memory by itself";
#endif
  EXPECT_THAT(refusal([](const Path&, const ModelFormat&) -> ModelFile {
                std::list<std::vector<char>> hoard;
                for (;;) hoard.emplace_back(std::size_t{16} << 20, 'x');
              }),
              HasSubstr("house.ifc: reading it takes more than 256 MiB of memory"));
}

TEST(ChildProcess, AModelThatContradictsItselfIsRefused) {
  EXPECT_THAT(refusal([](const Path&, const ModelFormat&) -> ModelFile {
                ModelFile file = test::sample_model_file();
                file.model.corners[0] = 1000;
                return file;
              }),
              HasSubstr("its importer went astray"));
}

TEST(ChildProcess, WhatTheReaderPrintsGoesNowhere) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  read_in_child("house.ifc", {}, [](const Path&, const ModelFormat&) {
    std::cout << "chatter" << std::endl;
    std::fprintf(stderr, "noise\n");
    return ModelFile{};
  });
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ChildProcess, ASignalOfTheUserIsAnInterruption) {
  for (const int signal : {SIGINT, SIGTERM}) {
    static int g_signal = 0;
    g_signal = signal;
    EXPECT_THROW(read_in_child("house.ifc", {},
                               [](const Path&, const ModelFormat&) -> ModelFile {
                                 ::raise(g_signal);
                                 return {};
                               }),
                 Interrupted);
  }
}

TEST(ChildProcess, NoChildStaysBehind) {
  (void)refusal(
      [](const Path&, const ModelFormat&) -> ModelFile {
        for (;;) ::pause();
      },
      1);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

/// Runs in a process of its own: reads in a child that writes its id and then waits.
[[noreturn]] void read_for_ever(const Path& id_file) {
  try {
    read_in_child(id_file, {}, [](const Path& path, const ModelFormat&) -> ModelFile {
      test::write_text(path.string() + ".new", std::to_string(::getpid()));
      std::filesystem::rename(path.string() + ".new", path);
      for (;;) ::pause();
    });
  } catch (...) {
  }
  ::_exit(0);
}

TEST(ChildProcess, TheChildDiesWithItsParent) {
  const test::ScratchFolder scratch;
  const Path id_file = scratch.path() / "id";
  const pid_t parent = ::fork();
  if (parent == 0) read_for_ever(id_file);
  while (!std::filesystem::exists(id_file)) ::usleep(1000);
  const pid_t child = std::stoi(test::read_text(id_file));
  EXPECT_EQ(::kill(child, 0), 0);
  ::kill(parent, SIGKILL);
  ASSERT_EQ(::waitpid(parent, nullptr, 0), parent);
  // An orphan may stay a zombie where nobody reaps it: dead is what can no longer hold a file open. A zombie's are root's to see.
  std::error_code denied;
  const Path open_files = "/proc/" + std::to_string(child) + "/fd/0";
  bool gone = false;
  for (int tries = 0; tries < 5000 && !gone; ++tries) {
    gone = !std::filesystem::is_symlink(std::filesystem::symlink_status(open_files, denied));
    if (!gone) ::usleep(1000);
  }
  EXPECT_TRUE(gone);
}

}  // namespace
}  // namespace clerestory::io
