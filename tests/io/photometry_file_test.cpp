// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/photometry_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/io/refusal.h"
#include "tests/support/places.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

namespace fs = std::filesystem;
using lighting::Photometry;
using testing::HasSubstr;

TEST(ReadPhotometry, EndingsAndContentTellTheFormat) {
  EXPECT_TRUE(is_photometry_file("a.IES"));
  EXPECT_TRUE(is_photometry_file("a.ldt"));
  EXPECT_FALSE(is_photometry_file("a.obj"));
  const test::ScratchFolder scratch;
  const std::string ies = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 20\n0 90\n0\n100 100\n";
  test::write_text(scratch.path() / "lamp.txt", ies);
  EXPECT_EQ(read_photometry(scratch.path() / "lamp.txt").format, "IESNA:LM-63-2002");
  EXPECT_THAT(test::refusal_of([&] { read_photometry(scratch.path() / "lamp.txt", 1); }), HasSubstr("one lamp set"));
  EXPECT_THAT(test::refusal_of([&] { read_photometry(scratch.path() / "none.ldt"); }), HasSubstr("none.ldt"));
}

TEST(ReadPhotometry, TenMegabytesOfNoiseAreRefusedInALine) {
  const test::ScratchFolder scratch;
  std::string noise;
  std::uint32_t state = 1;
  while (noise.size() < 10'000'000) {
    state = state * 1664525U + 1013904223U;
    noise += static_cast<char>(state >> 24U);
  }
  for (const char* name : {"noise.ies", "noise.ldt"}) {
    test::write_text(scratch.path() / name, noise);
    const std::string text = test::refusal_of([&] { read_photometry(scratch.path() / name); });
    EXPECT_THAT(text, HasSubstr(name));
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

/// Every file is read, and either has the flux that it states within 1 % or says what it has.
void read_all(const fs::path& folder, int& count) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!is_photometry_file(entry.path())) continue;
    const Photometry p = read_photometry(entry.path());
    ++count;
    const double flux = lighting::web_of(p).flux_lm();
    EXPECT_GT(flux, 0.0) << entry.path();
    if (!p.stated_flux_lm) continue;
    const bool agrees = std::abs(flux / *p.stated_flux_lm - 1.0) <= 0.01;
    const bool said = std::any_of(p.notes.begin(), p.notes.end(), [](const std::string& note) {
      return note.find("against the") != std::string::npos;
    });
    EXPECT_NE(agrees, said) << entry.path() << ' ' << flux << ' ' << *p.stated_flux_lm;
  }
}

TEST(ReadPhotometry, AllCollectedFilesAreRead) {
  CLERESTORY_NEEDS_SHARED_DATA("photometry");
  int count = 0;
  read_all(test::shared_data_dir() / "photometry", count);
  EXPECT_EQ(count, 34);
  count = 0;
  read_all(test::shared_data_dir() / "photometry-ugr-tables", count);
  EXPECT_EQ(count, 11);
}

TEST(ReadPhotometry, NineOfElevenRealLuminairesHaveTheFluxThatTheyState) {
  CLERESTORY_NEEDS_SHARED_DATA("photometry-ugr-tables");
  std::vector<std::string> others;
  for (const auto& entry : fs::directory_iterator(test::shared_data_dir() / "photometry-ugr-tables")) {
    if (!is_photometry_file(entry.path())) continue;
    const Photometry p = read_photometry(entry.path());
    if (std::abs(lighting::web_of(p).flux_lm() / *p.stated_flux_lm - 1.0) <= 0.01) continue;
    others.push_back(entry.path().stem().string());
    EXPECT_THAT(p.notes.at(0), HasSubstr("narrow for the steps of its angles"));
  }
  // Spotlights in steps of 5°: +2.4 % and +1.0002 %.
  EXPECT_THAT(others, testing::UnorderedElementsAre("sample_05", "sample_08"));
}

}  // namespace
}  // namespace clerestory::io
