// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "io/study_file.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::test {

/// A folder with a model in metres, room.obj: part box with materials floor, wall, glass, and an empty room.mtl.
class StudyFolder {
 public:
  StudyFolder() {
    write_text(path() / "room.mtl", "# none\n");
    write_text(model(),
               "mtllib room.mtl\no box\nv 0 0 0\nv 6 0 0\nv 6 8 0\nv 0 8 0\nv 0 0 3\nv 6 0 3\n"
               "usemtl floor\nf 1 2 3 4\nusemtl wall\nf 1 2 6\nusemtl glass\nf 1 6 5\n");
  }

  [[nodiscard]] std::filesystem::path path() const { return scratch_.path(); }
  [[nodiscard]] std::filesystem::path model() const { return path() / "room.obj"; }

  /// Reads a study of that text beside the model.
  [[nodiscard]] io::StudyInput read(const std::string& text, const io::ReadOptions& options = {}) const {
    write_text(path() / "study.toml", text);
    return io::read_study(path() / "study.toml", options);
  }
  /// Reads a study of the model with those lines under [materials].
  [[nodiscard]] lighting::Study read_materials(const std::string& lines) const {
    return read("[model]\nfile = 'room.obj'\n[materials]\n" + lines).study;
  }

 private:
  ScratchFolder scratch_;
};

}  // namespace clerestory::test
