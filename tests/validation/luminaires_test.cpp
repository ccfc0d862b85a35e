// SPDX-License-Identifier: GPL-3.0-or-later
// A room with six luminaires of a real file, against a sum point by point that shares no code with the program: the file is read line by line, its
// intensities are interpolated here, and panels nearer than five times their size are cut into small pieces.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include "io/study_file.h"
#include "tests/support/places.h"
#include "tests/support/scratch_folder.h"
#include "tests/validation/studies.h"

namespace clerestory::test {
namespace {

constexpr double kLengthM = 0.386;  // of the luminous area, along C90–C270
constexpr double kWidthM = 0.256;
constexpr double kMaintenance = 0.8;

std::filesystem::path photometry() { return shared_data_dir() / "photometry-ugr-tables" / "sample_02.ldt"; }

/// Planes C0 … C90 every 15°, angles every 5°.
class RawIntensities {
 public:
  RawIntensities() {
    std::ifstream in(photometry());
    std::vector<double> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(std::atof(line.c_str()));
    // 42 lines before the angles (one lamp set), 24 planes, 37 angles; 4997 lm.
    for (std::size_t k = 42 + 24 + 37; k < lines.size(); ++k) candela_.push_back(lines[k] * 4.997);
  }
  [[nodiscard]] std::size_t count() const { return candela_.size(); }
  [[nodiscard]] double at(double c_deg, double gamma_deg) const {
    const double c = c_deg / 15.0;
    const double g = gamma_deg / 5.0;
    const auto i = static_cast<std::size_t>(std::min(5.0, std::floor(c)));
    const auto k = static_cast<std::size_t>(std::min(35.0, std::floor(g)));
    const double u = c - static_cast<double>(i);
    const double v = g - static_cast<double>(k);
    return (1 - u) * ((1 - v) * candela_[37 * i + k] + v * candela_[37 * i + k + 1]) +
           u * ((1 - v) * candela_[37 * i + 37 + k] + v * candela_[37 * i + 38 + k]);
  }

 private:
  std::vector<double> candela_;
};

double by_hand(const RawIntensities& raw, const mesh::Point& sensor) {
  double lux = 0.0;
  for (int luminaire = 0; luminaire < 6; ++luminaire) {
    const double x0 = 1.25 + 2.5 * (luminaire % 2);
    const double y0 = 1.3 + 2.7 * (luminaire / 2);
    const double distance = std::hypot(sensor.x - x0, sensor.y - y0, 2.8 - sensor.z);
    const int pieces = distance < 5.0 * std::hypot(kWidthM, kLengthM) ? 12 : 1;
    for (int piece = 0; piece < pieces * pieces; ++piece) {
      const double x = x0 + kWidthM * ((piece % pieces + 0.5) / pieces - 0.5);
      const double y = y0 + kLengthM * ((piece / pieces + 0.5) / pieces - 0.5);
      const double dx = std::abs(sensor.x - x);
      const double dy = std::abs(sensor.y - y);
      const double dz = 2.8 - sensor.z;
      const double level = std::hypot(dx, dy);
      const double r = std::hypot(level, dz);
      const double cd =
          raw.at(std::atan2(dy, dx) * 180 / std::numbers::pi, std::atan2(level, dz) * 180 / std::numbers::pi);
      lux += kMaintenance * cd / (pieces * pieces) * dz / (r * r * r);
    }
  }
  return lux;
}

TEST(Luminaires, SixInABlackRoomGiveTheSumOfTheirLight) {
  CLERESTORY_NEEDS_SHARED_DATA("photometry-ugr-tables");
  const ScratchFolder scratch;
  write_text(scratch.path() / "room.obj",
             "o room\nv 0 0 0\nv 5 0 0\nv 5 8 0\nv 0 8 0\nv 0 0 2.8\nv 5 0 2.8\nv 5 8 2.8\nv 0 8 2.8\nusemtl black\n"
             "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
  std::string points;
  std::vector<mesh::Point> sensors;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 7; ++j) {
      sensors.push_back({0.6 + 1.2 * i, 0.7 + 1.1 * j, j % 2 == 0 ? 0.8 : 1.7});
      const mesh::Point& p = sensors.back();
      points += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + " 0 0 1\n";
    }
  }
  write_text(scratch.path() / "desk.pts", points);
  write_text(scratch.path() / "room.toml",
             "[model]\nfile = 'room.obj'\nunits = 'm'\n[materials.black]\nreflectance = 0.0\n[sky]\ntype = 'none'\n"
             "[[luminaires]]\nphotometry = '" +
                 photometry().string() +
                 "'\nat = [1.25, 1.3, 2.8]\narray = { count = [2, 3], spacing = [2.5, 2.7] }\n"
                 "[[grids]]\nname = 'desk'\npoints = 'desk.pts'\n");
  const lighting::Results results = answer(io::read_study(scratch.path() / "room.toml", {}).study);
  const RawIntensities raw;
  ASSERT_EQ(raw.count(), 7U * 37U);
  double worst = 0.0;
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    const double expected = by_hand(raw, sensors[k]);
    const double value = results.grids.at(0).illuminance_lux.at(k);
    EXPECT_NEAR(value, expected, 1e-3 * expected) << k;
    worst = std::max(worst, std::abs(value / expected - 1.0));
  }
  std::cout << "[ FIGURES  ] six luminaires: largest difference " << 100 * worst << " %\n";
}

}  // namespace
}  // namespace clerestory::test
