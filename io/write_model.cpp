// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "io/gltf_writer.h"
#include "io/obj_writer.h"
#include "io/ply_writer.h"
#include "io/vtp_writer.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

struct Writer {
  std::string_view extension;
  std::string_view beside;  ///< extension of a second file; empty: none
  std::vector<std::filesystem::path> (*write)(const std::filesystem::path& file, const WrittenModel& written);
};

constexpr std::array kWriters{Writer{".obj", ".mtl", &write_obj}, Writer{".ply", "", &write_ply},
                              Writer{".gltf", ".bin", &write_gltf}, Writer{".glb", "", &write_gltf},
                              Writer{".vtp", "", &write_vtp}};

const Writer& writer_of(const std::filesystem::path& file) {
  const std::string extension = lower(file.extension().string());
  std::vector<std::string_view> known;
  for (const Writer& writer : kWriters) {
    if (writer.extension == extension) return writer;
    known.push_back(writer.extension);
  }
  throw InputError(file.string(), 0, fmt::format("no model is written as {}", in_quotes(extension)),
                   fmt::format("choose one of {}", fmt::join(known, ", ")));
}

}  // namespace

std::vector<std::filesystem::path> write_model(const std::filesystem::path& file, const WrittenModel& written) {
  return writer_of(file).write(file, written);
}

std::vector<std::filesystem::path> model_files(const std::filesystem::path& file) {
  const std::string_view beside = writer_of(file).beside;
  if (beside.empty()) return {file};
  return {file, std::filesystem::path(file).replace_extension(beside)};
}

std::vector<std::size_t> polygons_by_part(const mesh::Model& model) {
  std::vector<std::size_t> order(model.polygon_count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(model.polygon_part[a], model.polygon_material[a]) <
           std::pair(model.polygon_part[b], model.polygon_material[b]);
  });
  return order;
}

std::string one_line(const std::string& name) {
  std::string text = name;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
  return text;
}

}  // namespace clerestory::io
