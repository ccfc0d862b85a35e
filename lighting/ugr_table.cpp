// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/ugr_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "lighting/glare.h"

namespace clerestory::lighting {

using mesh::Vector;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kHeightM = 2.0;          // of the luminaires above the eye
constexpr double kSpacing = 0.25;         // of the luminaires, as a share of it
constexpr double kSteepestView = 1.9;     // up over ahead: where the tables of the position index end
constexpr double kWidestView = 3.0;       // sideways over ahead, beyond which a luminaire does not count
constexpr double kLowestGammaDeg = 85.0;  // nor beyond this angle

/// Parallel rectangles, one above the other at distance 1.
/// Source: Howell, catalogue of configuration factors, C-11.
double facing_factor(double x, double y) {
  const double x1 = std::sqrt(1.0 + x * x);
  const double y1 = std::sqrt(1.0 + y * y);
  return 2.0 / (kPi * x * y) *
         (std::log(x1 * y1 / std::sqrt(1.0 + x * x + y * y)) + x * y1 * std::atan(x / y1) + y * x1 * std::atan(y / x1) -
          x * std::atan(x) - y * std::atan(y));
}

/// Shares of the luminaires' flux that come straight to the floor, to the walls and to the ceiling. The luminaires lie evenly over the
/// ceiling, in either orientation: of light that falls at an angle, the part that lands on the floor is that in which the ceiling, moved along
/// with it, still covers the floor.
struct DirectShares {
  double floor = 0.0;
  double down = 0.0;
  double up = 0.0;
};

DirectShares direct_shares(const PhotometricWeb& web, const UgrRoom& room) {
  constexpr int kGammas = 180;
  constexpr int kPlanes = 72;
  DirectShares shares;
  for (int i = 0; i < kGammas; ++i) {
    const double gamma = (i + 0.5) * kPi / kGammas;
    const double reach = gamma < 0.5 * kPi ? std::tan(gamma) : 0.0;
    double on_floor = 0.0;
    double all = 0.0;
    for (int k = 0; k < kPlanes; ++k) {
      const double c = (k + 0.5) * 2.0 * kPi / kPlanes;
      const double cd = web.intensity_cd(c * 180.0 / kPi, gamma * 180.0 / kPi);
      const auto kept = [&](double x, double y) {
        return std::max(0.0, 1.0 - reach * std::abs(std::cos(c)) / x) *
               std::max(0.0, 1.0 - reach * std::abs(std::sin(c)) / y);
      };
      on_floor += 0.5 * cd * (kept(room.across, room.along) + kept(room.along, room.across));
      all += cd;
    }
    const double weight = std::sin(gamma) * (kPi / kGammas) * (2.0 * kPi / kPlanes) / web.flux_lm();
    (gamma < 0.5 * kPi ? shares.down : shares.up) += weight * all;
    if (gamma < 0.5 * kPi) shares.floor += weight * on_floor;
  }
  return shares;
}

/// Exchange of floor, walls and ceiling; sizes in heights.
struct Exchange {
  double floor_area;
  double wall_area;
  double floor_to_ceiling;

  explicit Exchange(const UgrRoom& room)
      : floor_area(room.across * room.along),
        wall_area(2.0 * (room.across + room.along)),
        floor_to_ceiling(facing_factor(room.across, room.along)) {}

  /// The flux on the walls by reflections, of a unit of flux that first comes to one of the three: the solution of B = ρ(E₀ + F B) by
  /// Gauss elimination, less the first arrival.
  [[nodiscard]] double on_walls(const UgrFinish& finish, std::size_t first) const {
    const double to_walls = 1.0 - floor_to_ceiling;
    const double back = to_walls * floor_area / wall_area;
    // Flux fractions from row to column: floor, walls, ceiling.
    const double passed[3][3] = {
        {0.0, to_walls, floor_to_ceiling}, {back, 1.0 - 2.0 * back, back}, {floor_to_ceiling, to_walls, 0.0}};
    const double reflectance[3] = {finish.floor, finish.walls, finish.ceiling};
    std::array<double, 3> arrived{};
    arrived[first] = 1.0;
    std::array<double, 3> wave = arrived;
    // Each bounce keeps 0.7 at most: 200 of them leave 1e-31.
    for (int bounce = 0; bounce < 200; ++bounce) {
      std::array<double, 3> next{};
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) next[j] += wave[i] * reflectance[i] * passed[i][j];
      }
      wave = next;
      for (std::size_t j = 0; j < 3; ++j) arrived[j] += wave[j];
    }
    return arrived[1] - (first == 1 ? 1.0 : 0.0);
  }
};

/// The sum of L²ω/p² over the luminaires of a room.
double glare_sum(const PhotometricWeb& web, const LuminousOpening& opening, const UgrRoom& room, bool turned) {
  const View view{.eye = {}, .direction = {0.0, 1.0, 0.0}};
  const auto columns = static_cast<int>(std::lround(room.across / kSpacing));
  const auto rows = static_cast<int>(std::lround(room.along / kSpacing));
  double sum = 0.0;
  for (int i = 0; i < columns; ++i) {
    const double aside = (i + 0.5 - 0.5 * columns) * kSpacing * kHeightM;
    for (int j = 0; j < rows; ++j) {
      const double ahead = (j + 0.5) * kSpacing * kHeightM;
      const Vector to{aside, ahead, kHeightM};
      const double distance = norm(to);
      if (std::abs(aside) > kWidestView * ahead || kHeightM > kSteepestView * ahead) continue;
      if (kHeightM / distance < std::cos(kLowestGammaDeg * kPi / 180.0)) continue;
      // From the luminaire to the eye, in its own axes: unturned its C0 looks at the eye, turned its C90 does.
      const Vector back = -to / distance;
      const Vector own = turned ? Vector{back.x, -back.y, back.z} : Vector{-back.y, -back.x, back.z};
      const double area = opening.projected_area_m2(own);
      if (area <= 0.0) continue;
      const double cd = web.intensity_cd(own);
      const double p = position_index(view, to / distance);
      sum += cd * cd / (area * distance * distance * p * p);
    }
  }
  return sum;
}

}  // namespace

UgrBackground ugr_background(const PhotometricWeb& web, const UgrRoom& room, const UgrFinish& finish) {
  const DirectShares direct = direct_shares(web, room);
  UgrBackground background{.to_floor = direct.floor, .to_walls = direct.down - direct.floor, .to_ceiling = direct.up};
  const Exchange exchange(room);
  for (std::size_t k = 0; k < 3; ++k) background.transfer[k] = exchange.on_walls(finish, k);
  return background;
}

UgrTable ugr_table(const PhotometricWeb& web, const LuminousOpening& opening, bool along_y) {
  UgrTable table{};
  for (std::size_t r = 0; r < kUgrRooms.size(); ++r) {
    const UgrRoom& room = kUgrRooms[r];
    const double count = room.across * room.along / (kSpacing * kSpacing);
    const double wall_area_m2 = 2.0 * kHeightM * kHeightM * (room.across + room.along);
    for (std::size_t f = 0; f < kUgrFinishes.size(); ++f) {
      const double share = ugr_background(web, room, kUgrFinishes[f]).on_walls();
      const double background = count * web.flux_lm() * share / (kPi * wall_area_m2);
      for (const bool lengthwise : {false, true}) {
        const double sum = glare_sum(web, opening, room, lengthwise == along_y);
        table[r][f + (lengthwise ? kUgrFinishes.size() : 0)] = 8.0 * std::log10(0.25 * sum / background);
      }
    }
  }
  return table;
}

}  // namespace clerestory::lighting
