// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/solution_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "io/whole_file.h"
#include "mesh/error.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using testing::HasSubstr;

SolutionFile example() {
  SolutionFile file;
  file.study = "/studies/Büro/office.toml";
  file.kind = lighting::Study::Kind::kIlluminance;
  file.set = {"accuracy.target=0.02", "materials.wall.reflectance=[0.1, 0.2,\n 0.3]"};
  lighting::StoredSolution& s = file.solution;
  s.scene = {0xFEDCBA9876543210ULL, 2, 3, 4, 5};
  s.accuracy = 0.02;
  s.channels = 3;
  s.roots = 7;
  s.divided = {4, 2, 9};
  s.open = {2, 4, 9};
  s.elements = {5, 6};
  for (int i = 0; i < 6; ++i) s.irradiance.push_back({100.0F + static_cast<float>(i), -0.5F, 1e-3F});
  s.misfit_lux = {0.5F, 0.25F};
  s.errors = {{1, -1, 2, -2, 3, -3, 4, -4}, {}};
  s.seed = 12345678901234567ULL;
  s.energy.emitted_lm = 4000.0;
  s.energy.residual = -1e-6;
  s.links = 51042;
  s.receivers = {{5, 1}};
  s.arrivals = {{0x80000001U, 0x3E800000U, 0x12345678U, 0xFEDCBA98U}};
  s.arrival_errors = {{0.5F, 0.25F}};
  s.arrivals_made = {3};
  s.closing = {{1, 0, 0}, {1.5F, 0.5F, -0.5F}};
  s.group_names = {"sky-1", "ground", "row a"};
  s.group_strengths = {1000.5, 200.25, 1.0};
  s.group_kinds = {1, 2, 4};
  s.group_sources = {0, 7, 0xFFFFFFFFFFFFFFFFULL};
  s.group_error_nodes = {{5, 1}};
  s.group_errors = {{0.125F, 0.0625F}};
  s.start_faces = {3};
  s.start_refined = {0, 3, 5};
  s.start_lines = {{0.1, 0.2, 0.3, 1.1, 1.2, 1.3}};
  s.group_nodes = {{5, 0}, {6, 2}};
  s.group_lux = {{10, 1, -1}, {20, 2, -2}};
  s.given_errors = {{0.5F, 0.25F}};
  s.given_lm = {12.5};
  return file;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What read_solution() says of some bytes.
std::string refusal(const std::filesystem::path& file, const std::string& bytes) {
  write_whole_file(file, bytes);
  try {
    read_solution(file);
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), file.string());
    return error.problem();
  }
  return "no error";
}

class SolutionFiles : public testing::Test {
 protected:
  test::ScratchFolder folder_;
  std::filesystem::path file_ = folder_.path() / "solution.h5";
};

TEST_F(SolutionFiles, ComeBackAsTheyWereWritten) {
  const SolutionFile written = example();
  write_solution(file_, written);
  const SolutionFile read = read_solution(file_);
  EXPECT_EQ(read.study, written.study);
  EXPECT_EQ(read.kind, written.kind);
  EXPECT_EQ(read.set, written.set);
  const lighting::StoredSolution& a = read.solution;
  const lighting::StoredSolution& b = written.solution;
  EXPECT_EQ(a.scene, b.scene);
  EXPECT_EQ(a.accuracy, b.accuracy);
  EXPECT_EQ(a.channels, b.channels);
  EXPECT_EQ(a.roots, b.roots);
  EXPECT_EQ(a.divided, b.divided);
  EXPECT_EQ(a.open, b.open);
  EXPECT_EQ(a.elements, b.elements);
  EXPECT_EQ(a.irradiance, b.irradiance);
  EXPECT_EQ(a.misfit_lux, b.misfit_lux);
  EXPECT_EQ(a.errors, b.errors);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.energy.emitted_lm, b.energy.emitted_lm);
  EXPECT_EQ(a.energy.residual, b.energy.residual);
  EXPECT_EQ(a.links, b.links);
  EXPECT_EQ(a.receivers, b.receivers);
  EXPECT_EQ(a.arrivals, b.arrivals);
  EXPECT_EQ(a.arrival_errors, b.arrival_errors);
  EXPECT_EQ(a.arrivals_made, b.arrivals_made);
  EXPECT_EQ(a.closing, b.closing);
  EXPECT_EQ(a.group_names, b.group_names);
  EXPECT_EQ(a.group_strengths, b.group_strengths);
  EXPECT_EQ(a.group_kinds, b.group_kinds);
  EXPECT_EQ(a.group_sources, b.group_sources);
  EXPECT_EQ(a.group_error_nodes, b.group_error_nodes);
  EXPECT_EQ(a.group_errors, b.group_errors);
  EXPECT_EQ(a.start_faces, b.start_faces);
  EXPECT_EQ(a.start_lines, b.start_lines);
  EXPECT_EQ(a.group_nodes, b.group_nodes);
  EXPECT_EQ(a.group_lux, b.group_lux);
  EXPECT_EQ(a.given_errors, b.given_errors);
  EXPECT_EQ(a.given_lm, b.given_lm);
}

TEST_F(SolutionFiles, WithoutElementsComeBackToo) {
  SolutionFile empty = example();
  empty.solution.divided.clear();
  empty.solution.elements.clear();
  empty.solution.irradiance.clear();
  write_solution(file_, empty);
  EXPECT_TRUE(read_solution(file_).solution.elements.empty());
}

TEST_F(SolutionFiles, TwiceAreTheSameBytes) {
  write_solution(file_, example());
  const std::string first = bytes_of(file_);
  write_solution(file_, example());
  EXPECT_EQ(bytes_of(file_), first);
}

TEST_F(SolutionFiles, CutOffAnywhereOrDamagedAreRefused) {
  write_solution(file_, example());
  const std::string whole = bytes_of(file_);
  for (const std::size_t length : {std::size_t{512}, std::size_t{600}, whole.size() / 2, whole.size() - 1})
    EXPECT_THAT(refusal(file_, whole.substr(0, length)), HasSubstr("cut off or damaged")) << length;
  for (std::size_t at = 512; at < whole.size(); at += 97) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    EXPECT_THAT(refusal(file_, damaged), HasSubstr("cut off or damaged")) << at;
  }
}

TEST_F(SolutionFiles, OfOthersAreRefused) {
  EXPECT_THAT(refusal(file_, "no solution"), HasSubstr("no stored solution"));
  EXPECT_THAT(refusal(file_, std::string(600, 'x')), HasSubstr("no stored solution"));
  write_solution(file_, example());
  std::string older = bytes_of(file_);
  older[older.find("version ") + 8] = '0';
  EXPECT_THAT(refusal(file_, older), HasSubstr("another version"));
}

TEST_F(SolutionFiles, ThatAreMissingAreRefused) { EXPECT_THROW(read_solution(file_), InputError); }

}  // namespace
}  // namespace clerestory::io
