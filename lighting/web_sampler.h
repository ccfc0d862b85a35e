// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lighting/photometric_web.h"
#include "mesh/geometry.h"

namespace clerestory::lighting {

/// A direction in the luminaire's own axes, and the share of the flux that it stands for, times the number of directions.
struct WebSample {
  mesh::Vector direction;
  double weight = 0.0;
};

/// Directions in which a luminaire shines, about as often as it sends flux there: a cell between angles of the web by its flux, and a direction in it
/// even by solid angle. The mean of the weights is 1.
class WebSampler {
 public:
  /// @param web  kept by reference; of some flux
  explicit WebSampler(const PhotometricWeb& web);

  /// The direction that belongs to (a, b) in the unit square.
  [[nodiscard]] WebSample sample(double a, double b) const;

 private:
  struct Cell {
    double azimuth = 0.0;  ///< where it begins, and its width [radians]
    double width = 0.0;
    double low = 0.0;  ///< cosines of its polar angles
    double high = 0.0;
  };

  const PhotometricWeb& web_;
  std::vector<Cell> cells_;
  std::vector<double> flux_before_;  ///< [cells + 1] about [lm]
};

}  // namespace clerestory::lighting
