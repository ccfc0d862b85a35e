// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of discontinuity of 20 lamps in a hall with 167 boxes (2,004 edges) in it.
#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "mesh/discontinuity_lines.h"

namespace {

using clerestory::mesh::Faces;
using clerestory::mesh::Model;
using clerestory::mesh::Point;
using clerestory::mesh::ShadowSource;
using clerestory::mesh::Vector;

constexpr int kBoxes = 167;
constexpr int kLamps = 20;
constexpr Vector kHall{20.0, 16.0, 4.0};  // metres

void add_box(Model& model, const Point& low, const Vector& size) {
  const auto first = static_cast<std::uint32_t>(model.vertices.size());
  for (std::uint32_t i = 0; i < 8; ++i) {
    model.vertices.push_back(
        low + Vector{(i & 1U) != 0 ? size.x : 0.0, (i & 2U) != 0 ? size.y : 0.0, (i & 4U) != 0 ? size.z : 0.0});
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (std::array<std::uint32_t, 4> side : kSides) {
    for (std::uint32_t& corner : side) corner += first;
    model.begin_polygon(clerestory::mesh::MaterialId(std::size_t{0}), clerestory::mesh::PartId(std::size_t{0}));
    model.add_loop(side);
  }
}

Faces hall() {
  Model model;
  model.material_names = {"grey"};
  model.part_names = {"hall"};
  add_box(model, {-0.5 * kHall.x, -0.5 * kHall.y, -0.5 * kHall.z}, kHall);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < kBoxes; ++i) {
    const Vector size{0.2 + share(random), 0.2 + share(random), 0.2 + 1.5 * share(random)};
    const Point low{(share(random) - 0.5) * (kHall.x - 1.5), (share(random) - 0.5) * (kHall.y - 1.5),
                    -0.5 * kHall.z + 0.7 * share(random)};
    add_box(model, low, size);
  }
  return build_faces(clean(model, {}));
}

std::vector<ShadowSource> lamps() {
  std::vector<ShadowSource> sources;
  for (int i = 0; i < kLamps; ++i) {
    const double x = kHall.x * ((i % 5 + 0.5) / 5.0 - 0.5);
    const double y = kHall.y * ((i / 5 + 0.5) / 4.0 - 0.5);
    const double z = 0.5 * kHall.z - 0.1;
    ShadowSource lamp;
    lamp.normal = {0, 0, -1};
    lamp.outline = {{{x - 0.6, y - 0.15, z}, {x + 0.6, y - 0.15, z}, {x + 0.6, y + 0.15, z}, {x - 0.6, y + 0.15, z}}};
    sources.push_back(lamp);
  }
  return sources;
}

void find_lines(benchmark::State& state) {
  const Faces faces = hall();
  const std::vector<ShadowSource> sources = lamps();
  std::size_t lines = 0;
  std::size_t surfaces = 0;
  for (auto _ : state) {
    const clerestory::mesh::DiscontinuityFinder finder(faces);
    lines = 0;
    surfaces = 0;
    for (std::uint32_t i = 0; i < sources.size(); ++i) {
      const clerestory::mesh::FoundLines found = finder.find(sources[i], i);
      lines += found.lines.size();
      surfaces += found.critical_surfaces;
    }
  }
  state.counters["lines"] = static_cast<double>(lines);
  state.counters["surfaces"] = static_cast<double>(surfaces);
}
BENCHMARK(find_lines)->Unit(benchmark::kMillisecond);

}  // namespace
