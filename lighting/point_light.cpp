// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/point_light.h"

#include <algorithm>
#include <cmath>

namespace clerestory::lighting {

using mesh::Point;
using mesh::Vector;

double point_illuminance(const PointSource& source, const Point& at, const Vector& normal) {
  const Vector d = source.at - at;
  const double distance2 = dot(d, d);
  const double cosine = dot(d, normal);
  if (cosine <= 0.0 || distance2 <= 0.0) return 0.0;
  const double distance = std::sqrt(distance2);
  const double towards = source.lambertian ? std::max(0.0, -dot(d, source.aim) / distance) : 1.0;
  return source.intensity_cd * towards * cosine / (distance2 * distance);
}

}  // namespace clerestory::lighting
