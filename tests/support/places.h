// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace clerestory::test {

/// The root of the project.
std::filesystem::path source_dir();

/// The studies that come with the program.
std::filesystem::path samples_dir();

/// The reference scenes and values: $CLERESTORY_VALIDATION_DIR, or ../shared/validation beside the project.
/// It may not exist; see CLERESTORY_NEEDS_VALIDATION.
std::filesystem::path validation_dir();

/// The collected models and photometry that lie beside the reference scenes. It may not exist.
std::filesystem::path shared_data_dir();

}  // namespace clerestory::test

/// Skips the running test where a file or folder of validation_dir() is missing:
/// CLERESTORY_NEEDS_VALIDATION("office"). The test must include <gtest/gtest.h>.
#define CLERESTORY_NEEDS_VALIDATION(name)                                      \
  if (!std::filesystem::exists(::clerestory::test::validation_dir() / (name))) \
  GTEST_SKIP() << "no " << (::clerestory::test::validation_dir() / (name)).string()

/// The same for shared_data_dir().
#define CLERESTORY_NEEDS_SHARED_DATA(name)                                      \
  if (!std::filesystem::exists(::clerestory::test::shared_data_dir() / (name))) \
  GTEST_SKIP() << "no " << (::clerestory::test::shared_data_dir() / (name)).string()
