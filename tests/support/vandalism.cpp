// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/vandalism.h"

#include <algorithm>
#include <random>
#include <vector>

namespace clerestory::support {

namespace {

using mesh::Model;
using mesh::Point;
using Loops = std::vector<std::vector<std::uint32_t>>;

class Vandal {
 public:
  Vandal(const Model& model, const Damage& damage, std::uint32_t seed) : model_(model), damage_(damage), random_(seed) {
    result_.vertices = model.vertices;
    result_.material_names = model.material_names;
    result_.part_names = model.part_names;
  }

  Model run() {
    std::vector<std::size_t> copied;
    for (std::size_t p = 0; p < model_.polygon_count(); ++p) {
      add(p, damaged(p));
      if (happens(damage_.duplicated)) copied.push_back(p);
    }
    for (const std::size_t p : copied) {
      Loops loops = loops_of(p);
      for (auto& loop : loops) std::rotate(loop.begin(), loop.begin() + 1, loop.end());
      add(p, loops);
    }
    std::uniform_real_distribution<double> noise(-damage_.jitter_m, damage_.jitter_m);
    for (Point& p : result_.vertices) p = p + mesh::Vector{noise(random_), noise(random_), noise(random_)};
    return std::move(result_);
  }

 private:
  bool happens(double share) { return std::uniform_real_distribution<double>(0.0, 1.0)(random_) < share; }

  [[nodiscard]] Loops loops_of(std::size_t p) const {
    Loops loops;
    for (std::size_t l = 0; l < model_.loop_count(p); ++l) {
      loops.emplace_back(model_.loop(p, l).begin(), model_.loop(p, l).end());
    }
    return loops;
  }

  Loops damaged(std::size_t p) {
    Loops loops = loops_of(p);
    if (happens(damage_.flipped)) {
      for (auto& loop : loops) std::reverse(loop.begin(), loop.end());
    }
    if (happens(damage_.split)) {
      std::vector<std::uint32_t>& loop = loops[0];
      const std::size_t side = std::uniform_int_distribution<std::size_t>(0, loop.size() - 1)(random_);
      const Point& a = model_.vertices[loop[side]];
      const Point& b = model_.vertices[loop[(side + 1) % loop.size()]];
      loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(side) + 1, vertex(mesh::midpoint(a, b)));
    }
    for (auto& loop : loops) {
      for (std::uint32_t& corner : loop) {
        if (happens(damage_.unwelded)) corner = vertex(result_.vertices[corner]);
      }
    }
    return loops;
  }

  std::uint32_t vertex(Point p) {
    result_.vertices.push_back(p);
    return static_cast<std::uint32_t>(result_.vertices.size() - 1);
  }

  void add(std::size_t p, const Loops& loops) {
    result_.begin_polygon(model_.polygon_material[p], model_.polygon_part[p]);
    for (const auto& loop : loops) result_.add_loop(loop);
  }

  const Model& model_;
  const Damage& damage_;
  std::mt19937 random_;
  Model result_;
};

}  // namespace

Model vandalised(const Model& model, const Damage& damage, std::uint32_t seed) {
  return Vandal(model, damage, seed).run();
}

}  // namespace clerestory::support
