// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/failure.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <new>
#include <stdexcept>

#include "mesh/error.h"
#include "tools/options.h"

namespace clerestory::tools {
namespace {

TEST(Failure, HasTheDocumentedExitStatus) {
  EXPECT_EQ(describe(InputError("a.obj", 3, "wrong")).status, 1);
  EXPECT_EQ(describe(CommandLineError("wrong")).status, 2);
  EXPECT_EQ(describe(InputError("--set a=1", 0, "unknown key")).status, 2);
  EXPECT_EQ(describe(InputError("--grid nam = 1", 0, "unknown key")).status, 2);
  EXPECT_EQ(describe(MachineError("full")).status, 3);
  EXPECT_EQ(describe(std::bad_alloc()).status, 3);
  EXPECT_EQ(describe(std::filesystem::filesystem_error("gone", std::error_code())).status, 3);
  EXPECT_EQ(describe(std::logic_error("bug")).status, 3);
  EXPECT_EQ(describe(LimitReached("late")).status, 4);
  EXPECT_EQ(describe(Interrupted()).status, 130);
}

TEST(Failure, SaysWhereWhatAndWhatToDo) {
  EXPECT_EQ(describe(InputError("a.obj", 3, "wrong", "mend it")).line, "a.obj:3: wrong; mend it");
}

TEST(Failure, IsOneLineWhateverAFileIsCalled) {
  EXPECT_EQ(describe(InputError("a\nb\x1b[31m.obj", 0, "wrong")).line, "a b [31m.obj: wrong");
}

}  // namespace
}  // namespace clerestory::tools
