// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/sense.h"

#include <filesystem>
#include <memory>
#include <utility>

#include "io/solution_file.h"
#include "lighting/run.h"
#include "mesh/error.h"
#include "tools/answer.h"
#include "tools/with_file.h"

namespace clerestory::tools {

namespace {

std::filesystem::path solution_in(const std::filesystem::path& results) {
  if (!std::filesystem::is_directory(results)) return results;
  const std::filesystem::path file = results / "solution.h5";
  if (!std::filesystem::exists(file))
    throw InputError(results.string(), 0, "these results have no stored solution",
                     "run the study again with --save-solution");
  return file;
}

/// Its files would be replaced, the solution among them.
void expect_another_folder(const std::filesystem::path& out, const std::filesystem::path& file) {
  std::error_code none;
  if (!std::filesystem::equivalent(out, file.parent_path(), none)) return;
  throw InputError(out.string(), 0, "the results would replace those that they are made from",
                   "give another folder by --out");
}

}  // namespace

int sense(const Options& options) {
  return answer(options, [&] {
    const std::filesystem::path file = solution_in(options.study);
    expect_another_folder(options.out, file.has_parent_path() ? file : std::filesystem::path(".") / file);
    const auto stored = std::make_shared<const io::SolutionFile>(io::read_solution(file));
    std::vector<std::string> set = stored->set;
    set.insert(set.end(), options.set.begin(), options.set.end());
    Question question{
        stored->study,
        io::read_study(stored->study, {.kind = stored->kind, .set = std::move(set), .grids = options.grids}),
        {},
        true};
    question.compute = [study = question.input.study, stored, file](Progress& progress,
                                                                    const lighting::Limits& limits) {
      return with_file(file, [&] { return lighting::sense(study, stored->solution, progress, limits); });
    };
    return question;
  });
}

}  // namespace clerestory::tools
