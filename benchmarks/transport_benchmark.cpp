// SPDX-License-Identifier: GPL-3.0-or-later
// Kernels of the transport, one thread: form factors, decisions of the link oracle, light gathered at sensors. The room has a table under a
// lamp, so that links of partial visibility are among them.
#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <vector>

#include "lighting/form_factor.h"
#include "lighting/gather.h"
#include "lighting/linker.h"
#include "lighting/run.h"
#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace {

using clerestory::mesh::ElementId;
using clerestory::mesh::OutlineEdge;
using clerestory::mesh::Point;
using clerestory::mesh::Vector;
using namespace clerestory::lighting;

constexpr double kAccuracy = 0.02;
constexpr std::uint64_t kSeed = 1;

const test::Solved& room() {
  static const test::Solved solved = [] {
    set_threads(1);
    clerestory::mesh::Model model = clerestory::support::box_room(4, 4, 3);
    clerestory::support::add_table(model, {1.2, 1.6, 0.0});
    clerestory::support::add_quad(model, {1.5, 1.5, 2.5}, {1.5, 2.5, 2.5}, {2.5, 2.5, 2.5}, {2.5, 1.5, 2.5},
                                  {"lamp", "lamp"});
    Study study = test::study_of(std::move(model), 0.5, {1, 1, 0.01});
    test::shine(test::material(study, "lamp"), 1000.0);
    study.accuracy.target = kAccuracy;
    return test::Solved(study);
  }();
  return solved;
}

void point_to_triangle(benchmark::State& state) {
  const auto& tree = room().solution.tree();
  const std::vector<ElementId> elements = room().solution.elements();
  std::array<OutlineEdge, 3> scratch;
  std::size_t i = 0;
  for (auto _ : state) {
    const ElementId from = elements[i % elements.size()];
    const ElementId at = elements[(i * 7919 + 13) % elements.size()];
    ++i;
    benchmark::DoNotOptimize(
        point_form_factor(tree.centroid(from), tree.normal(from), tree.outline(at, scratch), tree.normal(at)));
  }
  state.SetItemsProcessed(state.iterations());
}

void triangle_to_triangle(benchmark::State& state) {
  const auto& tree = room().solution.tree();
  const ElementId floor = room().root("floor");
  const ElementId ceiling = room().root("ceiling");
  std::array<OutlineEdge, 3> scratch_floor;
  std::array<OutlineEdge, 3> scratch_ceiling;
  for (auto _ : state) {
    benchmark::DoNotOptimize(exchange_area(tree.outline(floor, scratch_floor), tree.outline(ceiling, scratch_ceiling)));
  }
  state.SetItemsProcessed(state.iterations());
}

void link_decisions(benchmark::State& state) {
  const test::Solved& solved = room();
  const ChannelDeviations no_channels;
  const Linker linker(solved.solution, solved.transport.clusters, no_channels, solved.importance,
                      SolveOptions{}.link_share * kAccuracy * solved.importance.mean_lux(), kSeed);
  const Arrivals& arrivals = solved.transport.arrivals;
  std::vector<LinkCandidate> pairs;
  for (std::size_t k = 0; k < arrivals.receivers(); ++k) {
    for (const Arrival& a : arrivals.at(k))
      pairs.push_back({arrivals.receiver(k), a.source(),
                       a.is_proven() ? clerestory::mesh::Visibility::kVisible : clerestory::mesh::Visibility::kPartial,
                       a.is_mutual()});
  }
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(linker.decide(pairs[i++ * 7919 % pairs.size()]));
  }
  state.SetItemsProcessed(state.iterations());
}

void sensors(benchmark::State& state) {
  const test::Solved& solved = room();
  std::vector<Point> points;
  std::vector<Vector> normals;
  for (int i = 0; i < 64; ++i) {
    points.push_back(solved.local({0.25 + 0.5 * (i % 8), 0.25 + 0.5 * (i / 8), 0.8}));
    normals.push_back({0, 0, 1});
  }
  clerestory::NoProgress nobody;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        gather(solved.solution, solved.transport.errors, {points, normals}, kAccuracy, kSeed, nobody));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
}

BENCHMARK(point_to_triangle)->Name("form_factor/point_to_triangle");
BENCHMARK(triangle_to_triangle)->Name("form_factor/triangle_to_triangle");
BENCHMARK(link_decisions)->Name("link_refinement/decide");
BENCHMARK(sensors)->Name("gather/sensors")->Unit(benchmark::kMillisecond);

}  // namespace
