// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/glare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <utility>
#include <vector>

#include "tests/support/places.h"

namespace clerestory::lighting {
namespace {

using mesh::Vector;

/// A picture with its sources of glare, and its background by the angle of the view from its middle [degrees to the left].
struct Picture {
  View view;
  std::vector<GlareSource> sources;
  std::vector<std::pair<double, double>> indirect_lux;
};

Picture read_picture(const std::filesystem::path& file) {
  Picture picture;
  picture.view.direction = normalized(Vector{-0.703298, 0.706112, 0});
  std::ifstream in(file);
  enum class In { kHead, kSources, kIndirect } where = In::kHead;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("BEGIN glare")) where = In::kSources;
    if (line.starts_with("BEGIN indirect")) where = In::kIndirect;
    if (line.starts_with("END")) where = In::kHead;
    std::istringstream words(line);
    GlareSource source;
    if (where == In::kSources && words >> source.direction.x >> source.direction.y >> source.direction.z >>
                                     source.solid_angle_sr >> source.luminance_cd_m2) {
      source.direction = normalized(source.direction);
      picture.sources.push_back(source);
    }
    words = std::istringstream(line);
    double angle = 0.0;
    double lux = 0.0;
    if (where == In::kIndirect && words >> angle >> lux) picture.indirect_lux.emplace_back(angle, lux);
  }
  return picture;
}

Vector turned(const Vector& v, double degrees) {
  const double a = degrees * std::numbers::pi / 180.0;
  return {std::cos(a) * v.x - std::sin(a) * v.y, std::sin(a) * v.x + std::cos(a) * v.y, v.z};
}

TEST(UnifiedGlareRating, IsThatOfRadianceInNineteenDirections) {
  CLERESTORY_NEEDS_SHARED_DATA("radiance-tests/util/glaresrc.txt");
  const auto folder = test::shared_data_dir() / "radiance-tests" / "util";
  const Picture picture = read_picture(folder / "glaresrc.txt");
  ASSERT_EQ(picture.sources.size(), 30U);
  ASSERT_EQ(picture.indirect_lux.size(), 19U);
  std::ifstream reference(folder / "ref" / "ugr.txt");
  int compared = 0;
  for (std::string line; std::getline(reference, line);) {
    std::istringstream words(line);
    double angle = 0.0;
    double ugr = 0.0;
    if (!(words >> angle >> ugr)) continue;
    for (const auto& [at, lux] : picture.indirect_lux) {
      if (at != angle) continue;
      View view = picture.view;
      view.direction = turned(view.direction, angle);
      EXPECT_NEAR(unified_glare_rating(view, picture.sources, lux / std::numbers::pi), ugr, 1e-4) << angle;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 19);
}

TEST(PositionIndex, IsOneAheadAndGrowsSoonerUpwardsThanSideways) {
  const View view{.eye = {}, .direction = {0, 1, 0}};
  EXPECT_EQ(position_index(view, {0, 1, 0}), 1.0);
  const double up = position_index(view, normalized(Vector{0, 1, 0.5}));
  const double sideways = position_index(view, normalized(Vector{0.5, 1, 0}));
  EXPECT_NEAR(up, 2.86, 0.04 * 2.86);        // CIE 117, table 4.1: H/R = 0.5, T/R = 0, to which it was fitted
  EXPECT_NEAR(sideways, 1.43, 0.04 * 1.43);  // H/R = 0, T/R = 0.5
  EXPECT_NEAR(position_index(view, normalized(Vector{-0.5, 1, 0})), sideways, 1e-12);
}

TEST(UnifiedGlareRating, NothingAheadIsNoGlare) {
  const View view{.eye = {}, .direction = {0, 1, 0}};
  const GlareSource behind{.direction = {0, -1, 0}, .luminance_cd_m2 = 1e4, .solid_angle_sr = 0.01};
  EXPECT_EQ(unified_glare_rating(view, std::span(&behind, 1), 30.0), -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace clerestory::lighting
