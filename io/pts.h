// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "mesh/geometry.h"

namespace clerestory::io {

/// Sensors as a file gives them.
struct SensorPoints {
  std::vector<mesh::Point> points;    ///< [m, model coordinates]
  std::vector<mesh::Vector> normals;  ///< of length 1
};

/// Reads sensors, "x y z nx ny nz" a line, metres and z up, as Radiance's rtrace takes them; empty lines and lines that begin
/// with # are passed over. Keeps the order.
/// Throws InputError with file and line for numbers that are none or infinite, too few or too many of them, a normal of
/// length zero, and a file without sensors.
SensorPoints read_pts(const std::filesystem::path& path);

}  // namespace clerestory::io
