// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/photometry_file.h"

#include "io/eulumdat.h"
#include "io/ies.h"
#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHead = 65536;  // bytes, in which the keywords of any IES file end

std::string ending(const fs::path& path) { return lower(path.extension().string()); }

/// A file whose name ends as neither format's does is of IES if it has its keyword.
bool is_ies(const fs::path& path) {
  if (ending(path) == ".ies") return true;
  if (is_photometry_file(path)) return false;
  return lower(read_head(path, kHead)).find("tilt=") != std::string::npos;
}

}  // namespace

bool is_photometry_file(const fs::path& path) {
  const std::string end = ending(path);
  return end == ".ies" || end == ".ldt" || end == ".eul";
}

lighting::Photometry read_photometry(const fs::path& path, std::size_t lamp_set) {
  require_file(path, "photometric file");
  if (!is_ies(path)) return read_eulumdat(path, lamp_set);
  if (lamp_set > 0) throw InputError(path.string(), 0, "an IES file has one lamp set", "remove lamp_set");
  return read_ies(path);
}

}  // namespace clerestory::io
