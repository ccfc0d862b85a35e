// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/gltf.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "io/assimp_model.h"
#include "io/child_process.h"
#include "io/text_file.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

constexpr std::uint64_t kLongestText = std::uint64_t{1} << 30;
constexpr std::uint64_t kLongestBinary = std::uint64_t{1} << 32;  // its header has 32 bits for the length

/// Alpha means nothing in the mode OPAQUE, and in MASK belongs to a texture.
std::optional<double> opacity_of(const aiMaterial& material) {
  aiString mode;
  float alpha = 1.0F;
  if (material.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) != aiReturn_SUCCESS || std::string_view(mode.C_Str()) != "BLEND" ||
      material.Get(AI_MATKEY_OPACITY, alpha) != aiReturn_SUCCESS)
    return std::nullopt;
  return std::clamp(static_cast<double>(alpha), 0.0, 1.0);
}

/// Tells where a text stops being JSON, which assimp does not: of such a file it only says that it knows no reader.
class JsonCheck : public nlohmann::json_sax<nlohmann::json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) override {
    error_at = position;
    return false;
  }

  std::optional<std::size_t> error_at;  ///< 1-based byte
};

void refuse_bad_json(const std::filesystem::path& path) {
  if (is_glb(read_head(path, 4))) return;
  const std::string text = read_text_file(path, "model", kLongestText);
  JsonCheck check;
  nlohmann::json::sax_parse(text, &check);
  if (!check.error_at) return;
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(*check.error_at, text.size()));
  throw InputError(path.string(), 1 + static_cast<std::uint64_t>(std::count(text.begin(), end, '\n')),
                   "the file stops being JSON here", "correct it or export it again; was the file cut off?");
}

const aiScene& read_scene(AssimpImport& import, const std::filesystem::path& path) {
  try {
    return import.read_file();
  } catch (const InputError&) {
    refuse_bad_json(path);
    throw;
  }
}

}  // namespace

bool is_glb(std::string_view head) { return head.starts_with("glTF"); }

ModelFile import_gltf(const std::filesystem::path& path, const ModelFormat& format) {
  require_file(path, "model");
  require_file_of_at_most(path, "model", is_glb(read_head(path, 4)) ? kLongestBinary : kLongestText);
  AssimpImport import(path, "gltf");
  SceneConvention convention;
  convention.told_by = "the base colour of the glTF";
  convention.unit = ToldUnit{LengthUnit::kMetre, "as glTF prescribes"};
  convention.up = UpAxis::kY;
  convention.opacity = &opacity_of;
  return model_of_scene(import, read_scene(import, path), path, format, convention);
}

ModelFile read_gltf(const std::filesystem::path& path, const ModelFormat& format) {
  return read_in_child(path, format, &import_gltf);
}

}  // namespace clerestory::io
