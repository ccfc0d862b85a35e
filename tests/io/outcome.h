// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "io/model_file.h"
#include "tests/io/refusal.h"

namespace clerestory::test {

/// "12 faces, 24 vertices, 1 parts, 1 materials", or the refusal without the file's folder.
template <class Reader>
std::string outcome_of(const std::filesystem::path& file, const Reader& read) {
  io::ModelFile read_file;
  const std::string refusal = refusal_of([&] { read_file = read(file); });
  if (refusal != "accepted") return refusal.substr(file.parent_path().string().size() + 1);
  const mesh::Model& model = read_file.model;
  return fmt::format("{} faces, {} vertices, {} parts, {} materials", model.polygon_count(), model.vertices.size(),
                     model.part_names.size(), model.material_names.size());
}

}  // namespace clerestory::test
