// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ply_writer.h"

#include <fmt/format.h>

#include <bit>
#include <iterator>

#include "io/whole_file.h"
#include "mesh/model_triangles.h"

namespace clerestory::io {

namespace {

static_assert(std::endian::native == std::endian::little, "the header says so");

template <class Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

std::string header_of(const mesh::Model& model) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment metres, z up\n";
  const auto out = std::back_inserter(text);
  const auto names = [&](const char* kind, const std::vector<std::string>& list) {
    for (std::size_t id = 0; id < list.size(); ++id)
      fmt::format_to(out, "comment {} {} {}\n", kind, id, one_line(list[id]));
  };
  names("part", model.part_names);
  names("material", model.material_names);
  fmt::format_to(out,
                 "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
                 "element face {}\nproperty list uint uint vertex_indices\nproperty uint part\nproperty uint material\n"
                 "end_header\n",
                 model.vertices.size(), model.polygon_count());
  return text;
}

}  // namespace

std::vector<std::filesystem::path> write_ply(const std::filesystem::path& file, const WrittenModel& written) {
  const mesh::Model model = cut_at_holes(written.model);
  std::string bytes = header_of(model);
  for (const mesh::Point& p : model.vertices)
    for (const double x : {p.x, p.y, p.z}) append(bytes, x);
  for (std::size_t polygon = 0; polygon < model.polygon_count(); ++polygon) {
    const auto loop = model.loop(polygon);
    append(bytes, static_cast<std::uint32_t>(loop.size()));
    for (const std::uint32_t corner : loop) append(bytes, corner);
    append(bytes, model.polygon_part[polygon].value);
    append(bytes, model.polygon_material[polygon].value);
  }
  write_whole_file(file, bytes);
  return {file};
}

}  // namespace clerestory::io
