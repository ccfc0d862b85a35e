// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mtl_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// The file that a name means, seen from the model's folder.
std::optional<fs::path> find(const fs::path& folder, std::string name) {
  if (name.empty()) return std::nullopt;
  if (is_file(folder / name)) return folder / name;
  std::replace(name.begin(), name.end(), '\\', '/');
  if (is_file(folder / name)) return folder / name;
  const fs::path beside = folder / fs::path(name).filename();
  return is_file(beside) ? std::optional(beside) : std::nullopt;
}

/// File names between blanks; a blank behind a backslash belongs to the name.
std::vector<std::string> names_of(std::string_view text) {
  std::vector<std::string> names(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escaped_blank = text[i] == '\\' && i + 1 < text.size() && text[i + 1] == ' ';
    if (escaped_blank) ++i;
    const bool blank = !escaped_blank && (text[i] == ' ' || text[i] == '\t');
    if (!blank) {
      names.back() += text[i];
    } else if (!names.back().empty()) {
      names.emplace_back();
    }
  }
  if (names.back().empty()) names.pop_back();
  return names;
}

/// Where no file of a line is there: a model may have been renamed together with its MTL.
fs::path file_in_place_of(const fs::path& model, const MtlReference& reference, const std::vector<std::string>& missing,
                          std::vector<std::string>& notices) {
  fs::path namesake = fs::path(model).replace_extension(".mtl");
  if (missing.empty() || !is_file(namesake))
    throw InputError(
        model.string(), reference.line,
        missing.empty() ? "mtllib names no file" : fmt::format("there is no MTL file {}", list_names(missing)),
        "put it beside the model, or delete this line to go by the study and by orientation alone");
  notices.push_back(fmt::format("{}:{}: there is no MTL file {}; {} was read instead.", model.string(), reference.line,
                                list_names(missing), in_quotes(namesake.filename().string())));
  return namesake;
}

std::vector<fs::path> files_of(const fs::path& model, const MtlReference& reference,
                               std::vector<std::string>& notices) {
  const fs::path folder = model.parent_path();
  if (const auto whole = find(folder, reference.names)) return {*whole};
  std::vector<fs::path> found;
  std::vector<std::string> missing;
  for (const std::string& name : names_of(reference.names)) {
    const auto file = find(folder, name);
    file ? found.push_back(*file) : missing.push_back(in_quotes(name));
  }
  if (found.empty()) return {file_in_place_of(model, reference, missing, notices)};
  if (!missing.empty())
    notices.push_back(fmt::format("{}:{}: there is no MTL file {}; the others of that line were read.", model.string(),
                                  reference.line, list_names(missing)));
  return found;
}

}  // namespace

MtlLibrary read_mtl_library(const fs::path& model, const std::vector<MtlReference>& references) {
  MtlLibrary library;
  for (const MtlReference& reference : references) {
    for (const fs::path& file : files_of(model, reference, library.notices)) {
      const bool known = std::find(library.files.begin(), library.files.end(), file) != library.files.end();
      if (!known) library.files.push_back(file);
    }
  }
  std::unordered_map<std::string, std::size_t> by_name;
  for (const fs::path& file : library.files) {
    for (SourceMaterial& material : read_mtl(file)) {
      const auto [at, is_new] = by_name.emplace(material.name, library.materials.size());
      if (is_new) {
        library.materials.push_back(std::move(material));
      } else {
        library.materials[at->second] = std::move(material);
      }
    }
  }
  return library;
}

}  // namespace clerestory::io
