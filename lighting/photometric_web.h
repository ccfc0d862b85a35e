// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "mesh/geometry.h"

namespace clerestory::lighting {

/// Luminous intensities on a grid of planes through a pole, as goniophotometers measure them.
struct IntensityGrid {
  std::vector<double>
      polar_deg;  ///< from the pole, ascending within 0 … 180; beyond the last and before the first there is no light
  std::vector<double>
      azimuth_deg;  ///< of the planes, ascending: within 0 … 360 where they close the circle, -180 … 180 else
  std::vector<double> candela;  ///< [planes × polar angles]
  bool closed = true;           ///< the planes go round; else there is no light before the first and beyond the last
};

/// Luminous intensity over the sphere, the same form for every type and symmetry of photometry. Between the directions of its grid it is linear
/// in both angles. The flux is the exact integral of just that function, so that what is sent out is what flux_lm() says: no plane or angle
/// put in between, no turn and no mirroring changes it.
///
/// Directions are in the luminaire's own axes: x along C0, y along C90, z against γ = 0.
class PhotometricWeb {
 public:
  /// The pole and the half-planes of azimuth 0 and 90.
  struct Poles {
    mesh::Vector pole{0.0, 0.0, -1.0};
    mesh::Vector zero{1.0, 0.0, 0.0};
    mesh::Vector quarter{0.0, 1.0, 0.0};
  };

  /// Type C: the pole is γ = 0, the azimuth is C.
  explicit PhotometricWeb(IntensityGrid grid) : PhotometricWeb(std::move(grid), Poles{}) {}
  PhotometricWeb(IntensityGrid grid, const Poles& poles);

  /// Towards a direction of unit length [cd].
  [[nodiscard]] double intensity_cd(const mesh::Vector& direction) const;
  /// The same by the angles of type C [degrees].
  [[nodiscard]] double intensity_cd(double c_deg, double gamma_deg) const;
  /// Of the whole sphere [lm].
  [[nodiscard]] double flux_lm() const { return flux_lm_; }
  [[nodiscard]] double peak_cd() const { return peak_cd_; }

  /// Turned about γ = 0, by quarters from C0 to C90. Four of them give the same bits.
  [[nodiscard]] PhotometricWeb turned(int quarters) const;
  /// Mirrored at the plane C0–C180. Two of them give the same bits.
  [[nodiscard]] PhotometricWeb mirrored() const;

  [[nodiscard]] const IntensityGrid& grid() const { return grid_; }
  [[nodiscard]] const Poles& poles() const { return poles_; }

 private:
  [[nodiscard]] double in_plane(std::size_t plane, double polar_deg) const;

  IntensityGrid grid_;
  Poles poles_;
  double flux_lm_ = 0.0;
  double peak_cd_ = 0.0;
};

/// The direction of unit length at the angles of type C, in a luminaire's own axes.
mesh::Vector direction_at(double c_deg, double gamma_deg);

}  // namespace clerestory::lighting
