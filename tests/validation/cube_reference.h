// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace clerestory::test {

/// CIE 171 case 5.8: a cube of 4 m, all sides of one reflectance, an isotropic source of 10 000 lm in its centre.
inline constexpr double kCubeSide_m = 4.0;
inline constexpr double kCubeFlux_lm = 10'000.0;

/// Direct illuminance [lx] at a point of a face, coordinates along the face from a corner [m].
double cube_direct(double x_m, double y_m);

/// Mean indirect illuminance [lx]: Φρ/(A(1−ρ)), exact.
double cube_mean_indirect(double reflectance);

/// Illuminance by a radiosity solution of its own: by symmetry all faces carry one distribution, which is solved for with closed-form
/// form factors on patches of 0.1 m and gathered by closed forms. Good to 0.05 %.
class CubeReference {
 public:
  explicit CubeReference(double reflectance);

  /// Illuminance [lx] at a point of a face [m].
  [[nodiscard]] double illuminance(double x_m, double y_m) const;

 private:
  double reflectance_;
  std::vector<double> illuminance_;  ///< of the patches of a face, row by row
};

}  // namespace clerestory::test
