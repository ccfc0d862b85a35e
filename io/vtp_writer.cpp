// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/vtp_writer.h"

#include "io/vtk_files.h"
#include "mesh/model_triangles.h"

namespace clerestory::io {

std::vector<std::filesystem::path> write_vtp(const std::filesystem::path& file, const WrittenModel& written) {
  write_model_vtp(file, cut_at_holes(written.model));
  return {file};
}

}  // namespace clerestory::io
