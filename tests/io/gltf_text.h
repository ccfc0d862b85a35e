// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clerestory::test {

inline std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (at + k < bytes.size() ? static_cast<unsigned char>(bytes[at + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += at + k <= bytes.size() ? kDigits[group >> (18U - 6U * k) & 63U] : '=';
  }
  return text;
}

/// A glTF with one triangle, (0,0,0) (1,0,0) (0,1,0), as mesh 0 of material 0.
/// @param nodes  its node list, as JSON; node 0 is the scene's root
/// @param material  JSON of the one material
inline std::string gltf_of_triangle(const std::string& nodes = R"([{"mesh": 0, "name": "desk"}])",
                                    const std::string& material = R"({"name": "oak"})",
                                    std::span<const float> corners = std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}) {
  const std::string bytes(reinterpret_cast<const char*>(corners.data()), corners.size_bytes());
  return R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_transmission"], "scene": 0, "scenes": [{"nodes": [0]}], "nodes": )" +
         nodes + R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}], "materials": [)" +
         material +
         R"(], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
             "min": [-1e9, -1e9, -1e9], "max": [1e9, 1e9, 1e9]}],
         "bufferViews": [{"buffer": 0, "byteLength": 36}],
         "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)" +
         base64(bytes) + "\"}]}\n";
}

}  // namespace clerestory::test
