// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/collada.h"
#include "io/dxf.h"
#include "io/gltf.h"
#include "io/ifc.h"
#include "io/obj.h"
#include "io/off.h"
#include "io/ply.h"
#include "io/radiance.h"
#include "io/radiance_scene.h"
#include "io/sdf.h"
#include "io/stl.h"
#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

/// A format: how a file of it is recognised, and who reads it.
struct Reader {
  std::string_view name;
  std::string_view extensions;  ///< lower case, each between blanks
  /// Whether the first bytes of a file can only be of this format; none where content does not tell.
  bool (*recognises)(std::string_view head);
  ModelFile (*read)(const std::filesystem::path& path, const ModelFormat& format);
};

constexpr std::array kReaders{
    Reader{"OBJ", " .obj ", nullptr, &read_obj},
    Reader{"STL", " .stl ", &is_text_stl, &read_stl},
    Reader{"PLY", " .ply ", &is_ply, &read_ply},
    Reader{"OFF", " .off ", &is_off, &read_off},
    Reader{"DXF", " .dxf ", &is_dxf, &read_dxf},
    Reader{"Radiance", " .rad ", &looks_like_radiance, &read_radiance},
    Reader{"glTF", " .gltf .glb ", &is_glb, &read_gltf},
    Reader{"COLLADA", " .dae ", &is_collada, &read_collada},
    Reader{"SDF", " .sdf .world ", &is_sdf, &read_sdf},
    Reader{"IFC", " .ifc ", &is_ifc, &read_ifc},
};

const Reader* reader_by_extension(const std::filesystem::path& path) {
  const std::string word = fmt::format(" {} ", lower(path.extension().string()));
  for (const Reader& reader : kReaders)
    if (reader.extensions.find(word) != std::string_view::npos) return &reader;
  return nullptr;
}

const Reader* reader_by_content(std::string_view head) {
  for (const Reader& reader : kReaders)
    if (reader.recognises != nullptr && reader.recognises(head)) return &reader;
  return nullptr;
}

bool is_photometry_or_weather(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 4> kExtensions{".ies", ".ldt", ".epw", ".wea"};
  return std::find(kExtensions.begin(), kExtensions.end(), lower(path.extension().string())) != kExtensions.end();
}

}  // namespace

ModelFile read_model(const std::filesystem::path& path, const ModelFormat& format) {
  require_file(path, "model");
  const Reader* reader = reader_by_content(read_head(path, 4096));
  if (reader == nullptr) reader = reader_by_extension(path);
  if (reader == nullptr && is_photometry_or_weather(path))
    throw InputError(path.string(), 0, "a photometric or weather file is no model",
                     "name a model, and this file in a study; clerestory inspect tells what is in a photometric one");
  if (reader == nullptr)
    throw InputError(path.string(), 0, fmt::format("{} is no model", in_quotes(path.filename().string())),
                     fmt::format("export it as one of {}", fmt::join(model_format_words(), ", ")));
  ModelFile file = reader->read(path, format);
  if (file.format.empty()) file.format = reader->name;
  return file;
}

std::vector<std::string> model_format_words() {
  std::vector<std::string> words;
  for (const Reader& reader : kReaders) words.push_back(fmt::format("{} ({})", reader.name, trim(reader.extensions)));
  return words;
}

}  // namespace clerestory::io
