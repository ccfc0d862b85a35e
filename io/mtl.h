// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace clerestory::io {

/// A material of an MTL file, or of a model that names one without defining it.
struct MtlMaterial {
  std::string name;
  std::string file;        ///< where it is defined; empty where no MTL defines it
  std::uint64_t line = 0;  ///< of its newmtl
  /// Kd, linear, per band red, green, blue; nothing where it is not given or given as a spectral curve.
  std::optional<std::array<double, 3>> diffuse;
  /// 1 opaque, 0 clear: d, or 1 - Tr where only that is given.
  std::optional<double> opacity;
  bool textured = false;  ///< has a map_Kd, so that Kd may say nothing of the colour
  bool shines = false;    ///< has a Ke over zero
};

/// Reads the materials of an MTL file, in its order; of two with one name the later one counts.
/// Throws InputError with file and line for numbers that are none, and for colours below zero.
/// Source: Wavefront, Object Files, appendix B (MTL), 1995.
std::vector<MtlMaterial> read_mtl(const std::filesystem::path& path);

}  // namespace clerestory::io
