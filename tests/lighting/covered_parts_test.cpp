// SPDX-License-Identifier: GPL-3.0-or-later
// Where parts stand on a face, hang from it or lean against it, no element lies on both sides of the contact, and what is covered
// receives nothing: the whole way from the model to the surfaces that are shown.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <ostream>
#include <utility>

#include "lighting/run.h"
#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;

constexpr double kOff_m = 2e-4;   ///< by which a part stops short of what it stands on
constexpr double kHair_m = 1e-5;  ///< within which places are taken for the edge of what is covered
constexpr int kPlaces = 12;       ///< along each edge of an element

struct Turn {
  double degrees = 0.0;
  Vector axis{0, 0, 1};

  [[nodiscard]] double angle_rad() const { return degrees * std::numbers::pi / 180.0; }
  /// The model's place of a place in the room, and the way back, about a unit axis [Rodrigues 1840].
  [[nodiscard]] Point place(const Point& p) const { return turned(p, angle_rad()); }
  [[nodiscard]] Point unplaced(const Point& p) const { return turned(p, -angle_rad()); }

 private:
  [[nodiscard]] Point turned(const Point& p, double by_rad) const {
    const Vector v = p - Point{};
    const double c = std::cos(by_rad);
    return Point{} + (c * v + std::sin(by_rad) * cross(axis, v) + ((1.0 - c) * dot(axis, v)) * axis);
  }
};

constexpr std::array<Turn, 2> kTurns{{{}, {.degrees = 17.3, .axis = {0.48, -0.6, 0.64}}}};

/// A box in a room of 4 m × 4 m × 3 m that touches one of its faces.
struct Part {
  const char* name;
  Point low;
  Point high;
  Vector off;           ///< normal of the face that it touches, into the room
  double face_area_m2;  ///< of that face
  double covered_m2;
  bool is_closed = true;  ///< else without the side that touches the face, as CAD tools leave it

  /// How far a place of the face is inside of what is covered [m]; below zero outside.
  [[nodiscard]] double depth(const Point& p) const {
    const auto along = [](double n, double x, double from, double to) {
      return n != 0.0 ? 1.0 : std::min(x - from, to - x);
    };
    return std::min(
        {along(off.x, p.x, low.x, high.x), along(off.y, p.y, low.y, high.y), along(off.z, p.z, low.z, high.z)});
  }
  /// Whether a place lies in the face that the part touches.
  [[nodiscard]] bool touches(const Point& p) const {
    const Point& corner = off.x + off.y + off.z > 0.0 ? low : high;
    return std::abs(dot(p - corner, off)) < 1e-6;
  }
};
void PrintTo(const Part& part, std::ostream* out) { *out << part.name; }

/// The room with the part so far from its face, and a lamp.
Study room_with(const Part& part, double off_m, const Turn& turn) {
  mesh::Model box;
  support::add_box(box, part.low + off_m * part.off, part.high + off_m * part.off, {"wood", "thing"});
  mesh::Model model = support::box_room(4, 4, 3);
  for (std::size_t p = 0; p < box.polygon_count(); ++p) {
    std::vector<Point> loop;
    for (const std::uint32_t c : box.loop(p)) loop.push_back(box.vertices[c]);
    const auto lies_there = [&](const Point& q) { return part.touches(q + -off_m * part.off); };
    if (part.is_closed || !std::all_of(loop.begin(), loop.end(), lies_there))
      support::add_polygon(model, loop, {"wood", "thing"});
  }
  support::add_quad(model, {2.5, 2.5, 2.8}, {2.5, 3.5, 2.8}, {3.5, 3.5, 2.8}, {3.5, 2.5, 2.8}, {"lamp", "lamp"});
  Study study =
      test::study_of(support::rotated(std::move(model), turn.axis, turn.angle_rad()), 0.5, turn.place({3, 1, 0.8}));
  test::shine(test::material(study, "lamp"), 1000.0);
  study.accuracy.target = 0.1;
  return study;
}

/// What the elements of the touched face show.
struct Shown {
  std::size_t on_both_sides = 0;  ///< of the edge of what is covered
  double open_m2 = 0.0;
  float most_covered_lux = 0.0F;
};

Shown look_at(const SurfaceResult& surfaces, const Part& part, const Turn& turn) {
  Shown shown;
  for (std::size_t cell = 0; cell < surfaces.cells.size(); ++cell) {
    std::array<Point, 3> c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = turn.unplaced(surfaces.points[surfaces.cells[cell][k]]);
    const Vector doubled = cross(c[1] - c[0], c[2] - c[0]);
    if (!std::all_of(c.begin(), c.end(), [&](const Point& p) { return part.touches(p); })) continue;
    if (dot(doubled, part.off) <= 0.0) continue;
    bool in = false;
    bool out = false;
    for (int i = 0; i <= kPlaces; ++i) {
      for (int j = 0; i + j <= kPlaces; ++j) {
        const Point p = c[0] + (1.0 * i / kPlaces) * (c[1] - c[0]) + (1.0 * j / kPlaces) * (c[2] - c[0]);
        in = in || part.depth(p) > kHair_m;
        out = out || part.depth(p) < -kHair_m;
      }
    }
    if (in && out) ++shown.on_both_sides;
    if (in) shown.most_covered_lux = std::max(shown.most_covered_lux, surfaces.illuminance_lux[cell]);
    if (out) shown.open_m2 += 0.5 * norm(doubled);
  }
  return shown;
}

class CoveredParts : public testing::TestWithParam<Part> {
 protected:
  static Shown show(double off_m, const Turn& turn, bool discontinuities, double accuracy = 0.1) {
    Study study = room_with(GetParam(), off_m, turn);
    study.accuracy.target = accuracy;
    study.mesh.discontinuities = discontinuities;
    NoProgress nobody;
    return look_at(run(study, nobody).surfaces, GetParam(), turn);
  }
  static void expect_own_elements(const Shown& shown) {
    EXPECT_EQ(shown.on_both_sides, 0U);
    EXPECT_NEAR(shown.open_m2, GetParam().face_area_m2 - GetParam().covered_m2, 1e-6);
  }
};

class ClosedCoveredParts : public CoveredParts {};
class OpenCoveredParts : public CoveredParts {};

TEST_P(CoveredParts, ReceiveExactlyNothing) {
  for (const Turn& turn : kTurns) {
    for (const bool discontinuities : {false, true}) {
      SCOPED_TRACE(testing::Message() << turn.degrees << " degrees, lines " << discontinuities);
      const Shown shown = show(0.0, turn, discontinuities);
      expect_own_elements(shown);
      EXPECT_EQ(shown.most_covered_lux, 0.0F);
    }
  }
}

TEST_P(ClosedCoveredParts, OfSolidsThatStopShortOfTheFaceReceiveExactlyNothing) {
  for (const Turn& turn : kTurns) {
    for (const bool discontinuities : {false, true}) {
      SCOPED_TRACE(testing::Message() << turn.degrees << " degrees, lines " << discontinuities);
      const Shown shown = show(kOff_m, turn, discontinuities);
      expect_own_elements(shown);
      EXPECT_EQ(shown.most_covered_lux, 0.0F);
    }
  }
}

TEST_P(ClosedCoveredParts, ReceiveExactlyNothingUpToTheWidestGapAtAnyAccuracy) {
  for (const double off_m : {7e-5, 1e-3}) {  // what is nearer overlaps, and clean-up cuts the face
    for (const double accuracy : {0.08, 0.01}) {
      SCOPED_TRACE(testing::Message() << off_m << " m off, accuracy " << accuracy);
      const Shown shown = show(off_m, kTurns[1], false, accuracy);
      expect_own_elements(shown);
      EXPECT_EQ(shown.most_covered_lux, 0.0F);
    }
  }
}

TEST_P(OpenCoveredParts, OfSheetsThatStopShortOfTheFaceReceiveExactlyNothing) {
  for (const Turn& turn : kTurns) {
    SCOPED_TRACE(testing::Message() << turn.degrees << " degrees");
    const Shown shown = show(kOff_m, turn, true);
    expect_own_elements(shown);
    EXPECT_EQ(shown.most_covered_lux, 0.0F);
  }
}

/// A pane in the middle of a wall's depth (y = 0.15 m), so far from the reveals of its opening all around.
Study wall_with_pane(double off_m, const Turn& turn) {
  mesh::Model model = support::wall_with_opening();
  support::add_quad(model, {1 + off_m, 0.15, 0.9 + off_m}, {3 - off_m, 0.15, 0.9 + off_m},
                    {3 - off_m, 0.15, 2.5 - off_m}, {1 + off_m, 0.15, 2.5 - off_m}, {"glass", "window"});
  Study study =
      test::study_of(support::rotated(std::move(model), turn.axis, turn.angle_rad()), 0.5, turn.place({2, 1, 1}));
  test::glaze(test::material(study, "glass"));
  study.sky.type = Sky::Type::kUniform;
  study.accuracy.target = 0.1;
  return study;
}

TEST(Pane, PartsItsRevealsIntoElementsOfEitherSide) {
  constexpr double kMiddle_m = 0.15;
  for (const Turn& turn : kTurns) {
    for (const double off_m : {0.0, kOff_m}) {
      SCOPED_TRACE(testing::Message() << turn.degrees << " degrees, " << off_m << " m off");
      NoProgress nobody;
      const SurfaceResult surfaces = run(wall_with_pane(off_m, turn), nobody).surfaces;
      std::array<double, 2> area_m2{};  // before and behind the pane
      for (const auto& cell : surfaces.cells) {
        std::array<Point, 3> c;
        for (std::size_t k = 0; k < 3; ++k) c[k] = turn.unplaced(surfaces.points[cell[k]]);
        const Vector doubled = cross(c[1] - c[0], c[2] - c[0]);
        const Point centre = c[0] + ((c[1] - c[0]) + (c[2] - c[0])) / 3.0;
        if (std::abs(normalized(doubled).y) > 0.01) continue;  // the wall's faces and the pane
        const bool behind = centre.y > kMiddle_m;
        for (const Point& p : c) EXPECT_GE(behind ? p.y - kMiddle_m : kMiddle_m - p.y, -kHair_m);
        area_m2.at(behind ? 1 : 0) += 0.5 * norm(doubled);
      }
      // Both sides: the wall has no ends, and light comes into it.
      for (const double half : area_m2) EXPECT_NEAR(half, 2.0 * kMiddle_m * 2.0 * (2.0 + 1.6), 1e-6);
    }
  }
}

constexpr Part kCabinet{"CabinetOnTheFloor", {1, 1, 0}, {1.8, 1.5, 1.2}, {0, 0, 1}, 16.0, 0.4};
constexpr Part kCupboard{"CupboardAtTheWall", {0, 1.5, 0.8}, {0.5, 2.5, 1.6}, {1, 0, 0}, 12.0, 0.8};
constexpr Part kLeg{"LegOfADesk", {2, 2, 0}, {2.05, 2.05, 0.7}, {0, 0, 1}, 16.0, 0.0025};
constexpr Part kPartition{"PartitionAtTheCeiling", {1.5, 1, 1}, {1.65, 3, 3}, {0, 0, -1}, 16.0, 0.3};

constexpr Part opened(Part part) {
  part.is_closed = false;
  return part;
}

std::string name_of(const testing::TestParamInfo<Part>& info) {
  return std::string(info.param.name) + (info.param.is_closed ? "" : "Open");
}

INSTANTIATE_TEST_SUITE_P(Contacts, CoveredParts, testing::Values(kCabinet, kCupboard, kLeg, kPartition, opened(kLeg)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Contacts, ClosedCoveredParts, testing::Values(kCabinet, kCupboard, kLeg, kPartition), name_of);
INSTANTIATE_TEST_SUITE_P(Contacts, OpenCoveredParts,
                         testing::Values(opened(kCabinet), opened(kCupboard), opened(kPartition)), name_of);

}  // namespace
}  // namespace clerestory::lighting
