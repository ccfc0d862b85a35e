// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/cages.h"

#include <initializer_list>
#include <optional>
#include <vector>

#include "mesh/subdivision.h"

namespace clerestory::support {

namespace {

mesh::Model model_of(std::vector<mesh::Point> vertices,
                     std::initializer_list<std::initializer_list<std::uint32_t>> faces) {
  mesh::Model model;
  model.vertices = std::move(vertices);
  model.material_names = {"cage"};
  model.part_names = {"cage"};
  std::uint32_t line = 0;
  for (const auto& face : faces) {
    model.begin_polygon(mesh::MaterialId(0U), mesh::PartId(0U), ++line);
    model.add_loop(std::vector<std::uint32_t>(face));
  }
  return model;
}

std::vector<mesh::Point> cube_corners() {
  return {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
}

}  // namespace

mesh::Model cube_cage() {
  return model_of(cube_corners(), {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

mesh::Model irregular_cage() {
  std::vector<mesh::Point> points = cube_corners();
  points.push_back({0, -1, 1});
  points.push_back({-1, 0, 1});
  return model_of(
      points, {{0, 3, 2, 1}, {4, 8, 9}, {8, 5, 6, 7, 9}, {0, 1, 5, 8, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 9, 7}});
}

mesh::Model octahedron_cage() {
  return model_of({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                  {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}});
}

mesh::ControlCage whole_cage(const mesh::Model& model, mesh::SubdivisionScheme scheme,
                             const mesh::SubdivisionRules& rules) {
  std::vector<std::uint32_t> source;
  return mesh::gather_cage(model, std::vector<std::uint8_t>(model.polygon_count(), 1), scheme, rules, source);
}

mesh::Model curved(const mesh::Model& model, double chord_tolerance_m, mesh::SubdivisionScheme scheme) {
  const std::vector<std::optional<mesh::CurvedPart>> parts(model.part_names.size(),
                                                           mesh::CurvedPart{scheme, chord_tolerance_m});
  return mesh::subdivide(model, parts);
}

}  // namespace clerestory::support
