// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "lighting/luminous_opening.h"
#include "lighting/photometric_web.h"

namespace clerestory::lighting {

/// A room of the table, as multiples of the height of the luminaires above the eye.
struct UgrRoom {
  double across = 0.0;  ///< the line of sight
  double along = 0.0;
};

/// Reflectances of the table's columns.
struct UgrFinish {
  double ceiling = 0.0;
  double walls = 0.0;
  double floor = 0.0;
};

inline constexpr std::array<UgrRoom, 19> kUgrRooms{{{2, 2},
                                                    {2, 3},
                                                    {2, 4},
                                                    {2, 6},
                                                    {2, 8},
                                                    {2, 12},
                                                    {4, 2},
                                                    {4, 3},
                                                    {4, 4},
                                                    {4, 6},
                                                    {4, 8},
                                                    {4, 12},
                                                    {8, 4},
                                                    {8, 6},
                                                    {8, 8},
                                                    {8, 12},
                                                    {12, 4},
                                                    {12, 6},
                                                    {12, 8}}};
inline constexpr std::array<UgrFinish, 5> kUgrFinishes{
    {{0.7, 0.5, 0.2}, {0.7, 0.3, 0.2}, {0.5, 0.5, 0.2}, {0.5, 0.3, 0.2}, {0.3, 0.3, 0.2}}};

/// UGR of the standard rooms: [rooms][finishes, the luminaires seen across their length (C0), then along it (C90)].
using UgrTable = std::array<std::array<double, 2 * kUgrFinishes.size()>, kUgrRooms.size()>;

/// The table of a luminaire by the tabular method: luminaires 2 m above the eye, half a metre apart (a quarter of that height), the observer
/// at the middle of a wall. The background is the indirect light of walls, ceiling and floor as three diffuse surfaces whose exchange is computed,
/// where CIE 190 has tables of it. Needs an opening that has an area.
/// @param along_y  whether the luminaire's length lies along C90 (EULUMDAT) or along C0 (IES)
/// Source: CIE 117:1995; CIE 190:2010.
UgrTable ugr_table(const PhotometricWeb& web, const LuminousOpening& opening, bool along_y);

/// The share of the luminaires' own flux that comes straight to the walls, and what then is on the walls by reflections alone, as parts of
/// the flux: CIE 190's factors for a luminaire in a room. For tests and reports.
struct UgrBackground {
  double to_floor = 0.0;
  double to_walls = 0.0;
  double to_ceiling = 0.0;
  /// What the walls receive indirectly of light that comes straight to floor, walls, ceiling.
  std::array<double, 3> transfer{};

  /// Indirect flux on the walls as a share of the flux of all luminaires.
  [[nodiscard]] double on_walls() const {
    return to_floor * transfer[0] + to_walls * transfer[1] + to_ceiling * transfer[2];
  }
};
UgrBackground ugr_background(const PhotometricWeb& web, const UgrRoom& room, const UgrFinish& finish);

}  // namespace clerestory::lighting
