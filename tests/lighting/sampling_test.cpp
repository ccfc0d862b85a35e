// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sampling.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace clerestory::lighting {
namespace {

TEST(Sobol, CoordinatesLieInTheUnitInterval) {
  const SobolPoints points(3);
  for (std::uint32_t i = 0; i < 4096; ++i) {
    for (std::size_t d = 0; d < 4; ++d) {
      EXPECT_GE(points.at(i, d), 0.0);
      EXPECT_LT(points.at(i, d), 1.0);
    }
  }
}

TEST(Sobol, EveryDimensionIsStratifiedOverAnyAlignedPowerOfTwo) {
  for (const std::uint64_t seed : {0ULL, 1ULL, 0x123456789ABCDEFULL}) {
    const SobolPoints points(seed);
    for (const std::uint32_t count : {2U, 16U, 256U}) {
      for (const std::uint32_t block : {0U, 1U, 5U}) {
        for (std::size_t d = 0; d < 4; ++d) {
          std::set<std::uint32_t> strata;
          for (std::uint32_t i = 0; i < count; ++i) {
            strata.insert(static_cast<std::uint32_t>(points.at(block * count + i, d) * count));
          }
          EXPECT_EQ(strata.size(), count) << "seed " << seed << ", block " << block << ", dimension " << d;
        }
      }
    }
  }
}

/// How many cells of an x × y grid hold one of the first points.
std::size_t cells_met(const SobolPoints& points, std::uint32_t count, std::size_t first, std::size_t second,
                      std::uint32_t x, std::uint32_t y) {
  std::set<std::uint32_t> cells;
  for (std::uint32_t i = 0; i < count; ++i) {
    cells.insert(static_cast<std::uint32_t>(points.at(i, first) * x) * y +
                 static_cast<std::uint32_t>(points.at(i, second) * y));
  }
  return cells.size();
}

TEST(Sobol, FirstTwoDimensionsHaveOnePointInEveryElementaryInterval) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const SobolPoints points(seed);
    for (std::uint32_t x = 1; x <= 256; x *= 2) EXPECT_EQ(cells_met(points, 256, 0, 1, x, 256 / x), 256U) << x;
  }
}

TEST(Sobol, OtherPairsLeaveNoCellOfAQuarterOfTheirNumberEmpty) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const SobolPoints points(seed);
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < a; ++b) EXPECT_EQ(cells_met(points, 1024, a, b, 16, 16), 256U) << a << ", " << b;
    }
  }
}

TEST(Sobol, APointHasItsCoordinates) {
  const SobolPoints points(5);
  for (const std::uint32_t i : {0U, 1U, 77U, 4095U, 0xFFFFFFFFU}) {
    const auto four = points.point<4>(i);
    const auto two = points.point<2>(i);
    for (std::size_t d = 0; d < 4; ++d) EXPECT_EQ(four[d], points.at(i, d));
    for (std::size_t d = 0; d < 2; ++d) EXPECT_EQ(two[d], points.at(i, d));
  }
}

TEST(Sobol, PointsAreThoseOfTheDirectionNumbers) {
  // Scrambled and shuffled, the points of a block are those of the sequence itself but for permutations in its strata: what no scrambling
  // changes is how many leading digits two points share.
  const auto plain = [](std::uint32_t index, std::size_t dimension) {
    std::uint32_t x = 0;
    for (std::uint32_t bit = 0; bit < 32; ++bit) {
      if (((index >> bit) & 1U) != 0) x ^= kSobolDirections[dimension - 1][bit];
    }
    return x;
  };
  const auto shared = [](std::uint32_t a, std::uint32_t b) { return std::countl_zero(a ^ b); };
  const SobolPoints points(11);
  constexpr std::uint32_t kCount = 64;
  for (std::size_t d = 1; d < 4; ++d) {
    std::map<int, int> expected;
    std::map<int, int> found;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      for (std::uint32_t k = 0; k < i; ++k) {
        const auto digits = [&](std::uint32_t of) { return static_cast<std::uint32_t>(points.at(of, d) * 0x1p32); };
        ++expected[shared(plain(i, d), plain(k, d))];
        ++found[shared(digits(i), digits(k))];
      }
    }
    EXPECT_EQ(found, expected) << d;
  }
}

double correlation(const SobolPoints& a, std::size_t da, const SobolPoints& b, std::size_t db) {
  constexpr std::uint32_t kCount = 4096;
  double sum = 0.0;
  for (std::uint32_t i = 0; i < kCount; ++i) sum += (a.at(i, da) - 0.5) * (b.at(i, db) - 0.5);
  return 12.0 * sum / kCount;
}

TEST(Sobol, SeedsGiveUncorrelatedPoints) {
  // The standard error of a correlation of 4096 independent pairs is 1/64.
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    EXPECT_LT(std::abs(correlation(SobolPoints(seed), 0, SobolPoints(seed + 1), 0)), 4.0 / 64.0);
    EXPECT_LT(std::abs(correlation(SobolPoints(seed), 2, SobolPoints(seed + 1), 2)), 4.0 / 64.0);
  }
}

TEST(Sobol, SeedsAreUnbiased) {
  // The mean over seeds of one and the same point is that of the uniform distribution.
  constexpr int kSeeds = 4096;
  for (std::size_t d = 0; d < 4; ++d) {
    double mean = 0.0;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) mean += SobolPoints(seed).at(5, d) / kSeeds;
    EXPECT_NEAR(mean, 0.5, 4.0 * std::sqrt(1.0 / 12.0 / kSeeds)) << d;
  }
}

TEST(Sobol, IntegratesASmoothFunctionFarBetterThanChance) {
  constexpr std::uint32_t kCount = 1024;
  double square = 0.0;
  for (std::uint64_t seed = 0; seed < 32; ++seed) {
    const SobolPoints points(seed);
    double sum = 0.0;
    for (std::uint32_t i = 0; i < kCount; ++i) sum += points.at(i, 0) * points.at(i, 1) / kCount;
    square += (sum - 0.25) * (sum - 0.25) / 32;
  }
  const double by_chance = std::sqrt((1.0 / 9.0 - 1.0 / 16.0) / kCount);
  EXPECT_LT(std::sqrt(square), 0.05 * by_chance);
}

TEST(CosineDirection, IsOfUnitLengthInTheHemisphere) {
  const mesh::Frame frame = mesh::frame_around(mesh::normalized({0.3, -0.5, -0.8}));
  const SobolPoints points(1);
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const mesh::Vector d = cosine_direction(frame, points.at(i, 0), points.at(i, 1));
    EXPECT_NEAR(norm(d), 1.0, 1e-12);
    EXPECT_GE(dot(d, frame.w), 0.0);
  }
}

TEST(CosineDirection, DensityIsTheCosineOverPi) {
  const mesh::Frame frame = mesh::frame_around(mesh::normalized({0.3, -0.5, 0.8}));
  constexpr int kSteps = 512;
  mesh::Vector mean;
  int above = 0;
  double uu = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const mesh::Vector d = cosine_direction(frame, (i + 0.5) / kSteps, (j + 0.5) / kSteps);
      mean = mean + d / (kSteps * kSteps);
      uu += dot(d, frame.u) * dot(d, frame.u) / (kSteps * kSteps);
      above += dot(d, frame.w) > 0.8 ? 1 : 0;
    }
  }
  EXPECT_NEAR(norm(mean - (2.0 / 3.0) * frame.w), 0.0, 1e-4) << "mean cosine 2/3";
  EXPECT_NEAR(uu, 0.25, 1e-4);
  EXPECT_NEAR(static_cast<double>(above) / (kSteps * kSteps), 1.0 - 0.8 * 0.8, 2e-3);
}

TEST(CosineDirection, CentreAndCornersOfTheSquareAreFine) {
  const mesh::Frame frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_NEAR(cosine_direction(frame, 0.5, 0.5).z, 1.0, 1e-15);
  for (const double a : {0.0, 1.0}) {
    for (const double b : {0.0, 1.0}) EXPECT_NEAR(norm(cosine_direction(frame, a, b)), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace clerestory::lighting
