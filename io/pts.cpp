// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/pts.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

constexpr double kFarthest = 1e7;  // [m] no sensor lies farther out; squares of more lose the small ones

std::array<double, 6> read_numbers(const LineReader& reader) {
  const auto words = split_words(reader.line());
  if (words.size() != 6)
    throw InputError(reader.file(), reader.number(),
                     fmt::format("a sensor has 6 numbers, this line has {}", words.size()), "write x y z nx ny nz");
  std::array<double, 6> numbers{};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto value = parse_number(words[i]);
    if (!value)
      throw InputError(reader.file(), reader.number(), fmt::format("{} is no finite number", in_quotes(words[i])),
                       "write x y z nx ny nz");
    if (std::abs(*value) > kFarthest)
      throw InputError(reader.file(), reader.number(), fmt::format("{} lies beyond any building", in_quotes(words[i])),
                       "give metres in the model's coordinates");
    numbers[i] = *value;
  }
  return numbers;
}

}  // namespace

SensorPoints read_pts(const std::filesystem::path& path) {
  LineReader reader(path, "sensor file");
  SensorPoints sensors;
  while (reader.next()) {
    const std::string_view line = trim(reader.line());
    if (line.empty() || line.front() == '#') continue;
    const auto [x, y, z, nx, ny, nz] = read_numbers(reader);
    const mesh::Vector normal{nx, ny, nz};
    if (!(mesh::norm(normal) > 1e-12))
      throw InputError(reader.file(), reader.number(), "the normal of this sensor is zero",
                       "give the direction that it faces, 0 0 1 for upwards");
    sensors.points.push_back({x, y, z});
    sensors.normals.push_back(mesh::normalized(normal));
  }
  if (sensors.points.empty())
    throw InputError(reader.file(), 0, "there is no sensor in this file", "write x y z nx ny nz on each line");
  return sensors;
}

}  // namespace clerestory::io
