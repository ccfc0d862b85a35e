// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model_file.h"
#include "io/obj.h"

namespace clerestory::io {

ModelFile read_model(const std::filesystem::path& path, const ModelFormat& format) { return read_obj(path, format); }

}  // namespace clerestory::io
