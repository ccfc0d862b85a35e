// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/lit_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lighting/discontinuities.h"
#include "tests/lighting/stages.h"
#include "tests/support/blocked_lamp.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;

constexpr std::uint64_t kSeed = 12345;
constexpr mesh::Vector kUp{0, 0, 1};

/// A lamp of 1.2 m × 0.6 m at 3 m over a black floor of 4 m × 3 m, and a plate half-way between where it is asked for.
support::BlockedLamp lamp(bool with_plate) {
  support::BlockedLamp scene{.lamp = {{-0.6, -0.3, 3}, {-0.6, 0.3, 3}, {0.6, 0.3, 3}, {0.6, -0.3, 3}},
                             .exitance_lm_m2 = 1000.0,
                             .blockers = {}};
  if (with_plate) scene.blockers = {{{-0.5, -0.4, 1.5}, {0.5, -0.4, 1.5}, {0.5, 0.4, 1.5}, {-0.5, 0.4, 1.5}}};
  return scene;
}

Study study_of(const support::BlockedLamp& scene) {
  mesh::Model model;
  support::add_quad(model, {-2, -1.5, 0}, {2, -1.5, 0}, {2, 1.5, 0}, {-2, 1.5, 0}, {"floor", "floor"});
  support::add_polygon(model, scene.lamp, {"lamp", "lamp"});
  for (const auto& blocker : scene.blockers) support::add_polygon(model, blocker, {"blocker", "blocker"});
  Study study = test::study_of(std::move(model), 0.0, {1.5, 1.2, 0.1});
  test::shine(test::material(study, "lamp"), scene.exitance_lm_m2);
  return study;
}

/// Errors of a lit mesh of the floor [share of the peak, root of the mean square by area].
struct Errors {
  double points = 0.0;  ///< of linear interpolation between the points
  double cells = 0.0;   ///< of the mean over a cell
};

class LitFloor : public test::Stage {
 public:
  explicit LitFloor(bool with_plate)
      : Stage(study_of(lamp(with_plate))),
        lamp_(lamp(with_plate)),
        importance_(solution, walks(kSeed)),
        direct_(light_directly(solution, importance_, 1e-4, kSeed, nobody_)),
        transport_(solve(solution, importance_, direct_, {.accuracy = 0.02, .seed = kSeed}, nobody_)),
        local_(solution, transport_.arrivals, transport_.errors, direct_.nodes, 0.02, 1.0),
        peak_(exact(Point{with_plate ? 1.2 : 0.0, 0.0, 0.0} - scene.faces.origin)) {}

  /// With elements of a size, and the lines of discontinuity in them if asked for.
  [[nodiscard]] Errors errors(double size_m, bool with_lines) const {
    NoProgress nobody;
    const LitMesh lit = light_mesh(solution, shown(size_m, with_lines), local_, nobody);
    Errors sum;
    double area = 0.0;
    for (const LitMesh::Cell& cell : lit.cells) {
      const Squares squares = of_cell(lit, cell);
      sum.points += cell.area * squares.points;
      sum.cells += cell.area * squares.mean;
      area += cell.area;
    }
    return {std::sqrt(sum.points / area) / peak_, std::sqrt(sum.cells / area) / peak_};
  }

 private:
  struct Squares {
    double points = 0.0;
    double mean = 0.0;
  };

  [[nodiscard]] double exact(const Point& local) const {
    return exact_illuminance(lamp_, local + scene.faces.origin, kUp);
  }

  [[nodiscard]] ShownMesh shown(double size_m, bool with_lines) const {
    const mesh::FaceSide floor = solution.tree().face_side(root("floor"));
    std::vector<mesh::FaceLine> lines;
    LineOptions every;
    every.tolerance = 1e-6;
    for (const mesh::DiscontinuityLine& line : find_discontinuities(scene, every).lines) {
      if (with_lines && line.face == floor.face) lines.push_back({line.face, line.ends});
    }
    ShownMesh result;
    result.mesh = mesh::mesh_faces(scene.faces, {.max_size_m = size_m, .lines = lines});
    result.shown.assign(2 * scene.faces.count(), 0);
    result.shown[floor.index()] = 1;
    result.jump.assign(scene.faces.count(), 0);
    return result;
  }

  /// Mean squares over the middles of the parts of a cell that is cut evenly.
  [[nodiscard]] Squares of_cell(const LitMesh& lit, const LitMesh::Cell& cell) const {
    constexpr int kCuts = 4;
    Squares squares;
    double mean = 0.0;
    const auto add = [&](double s, double t) {
      const std::array<double, 3> weights{1.0 - s - t, s, t};
      const Point& a = lit.points[cell.points[0]];
      double value = 0.0;
      for (std::size_t k = 0; k < 3; ++k) value += weights[k] * lit.lux[cell.points[k]];
      const Point at = a + s * (lit.points[cell.points[1]] - a) + t * (lit.points[cell.points[2]] - a);
      const double error = value - exact(at);
      squares.points += error * error / (kCuts * kCuts);
      mean += error / (kCuts * kCuts);
    };
    for (int i = 0; i < kCuts; ++i) {
      for (int j = 0; i + j < kCuts; ++j) {
        add((i + 1.0 / 3.0) / kCuts, (j + 1.0 / 3.0) / kCuts);
        if (i + j + 1 < kCuts) add((i + 2.0 / 3.0) / kCuts, (j + 2.0 / 3.0) / kCuts);
      }
    }
    squares.mean = mean * mean;
    return squares;
  }

  support::BlockedLamp lamp_;
  NoProgress nobody_;
  Importance importance_;
  DirectLight direct_;
  Transport transport_;
  LocalPass local_;
  double peak_;
};

/// The order of convergence from h = 0.4 m over h/2 and h/4 to h/8: the least and the largest of the three.
struct Orders {
  double least = 1e9;
  double largest = -1e9;
};

/// Of points and of cells together.
Orders orders(const LitFloor& floor, bool with_lines) {
  Orders found;
  Errors before = floor.errors(0.4, with_lines);
  for (const double size_m : {0.2, 0.1, 0.05}) {
    const Errors now = floor.errors(size_m, with_lines);
    for (const double order : {std::log2(before.points / now.points), std::log2(before.cells / now.cells)}) {
      found.least = std::min(found.least, order);
      found.largest = std::max(found.largest, order);
    }
    before = now;
  }
  return found;
}

TEST(LitMesh, ConvergesToSecondOrderWhereNothingIsHidden) { EXPECT_GT(orders(LitFloor(false), false).least, 1.85); }

TEST(LitMesh, ConvergesToSecondOrderInShadowsWithLines) { EXPECT_GT(orders(LitFloor(true), true).least, 1.85); }

// Across a kink the error is of first order, on a share of the area that is of first order: its root mean square is of order 1.5.
TEST(LitMesh, ConvergesToLowerOrderInShadowsWithoutLines) { EXPECT_LT(orders(LitFloor(true), false).largest, 1.7); }

}  // namespace
}  // namespace clerestory::lighting
