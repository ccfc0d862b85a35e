// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/validation/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

namespace clerestory::test {

Comparison compare(std::span<const double> values, std::span<const double> errors, std::span<const double> reference,
                   std::span<const double> reference_errors) {
  Comparison c;
  c.count = values.size();
  EXPECT_EQ(reference.size(), c.count);
  EXPECT_EQ(errors.size(), c.count);
  EXPECT_EQ(reference_errors.size(), c.count);
  if (c.count == 0 || reference.size() != c.count) return c;
  const auto n = static_cast<double>(c.count);
  std::vector<double> relative;
  double reference_sum = 0.0;
  double variance = 0.0;
  for (std::size_t i = 0; i < c.count; ++i) {
    const double difference = values[i] - reference[i];
    const double own_variance = errors[i] * errors[i] + reference_errors[i] * reference_errors[i];
    const double z = difference / std::sqrt(std::max(own_variance, 1e-30));
    relative.push_back(std::abs(difference / reference[i]));
    c.mean_difference += difference / n;
    reference_sum += reference[i];
    variance += own_variance;
    c.rms += relative.back() * relative.back() / n;
    c.rms_z += z * z / n;
    c.covered += (std::abs(z) <= 2.0 ? 1.0 : 0.0) / n;
  }
  std::sort(relative.begin(), relative.end());
  c.bias = c.mean_difference * n / reference_sum;
  c.mean_difference_error = std::sqrt(variance) / n;
  c.rms = std::sqrt(c.rms);
  c.rms_z = std::sqrt(c.rms_z);
  c.p95 = relative[static_cast<std::size_t>(std::ceil(0.95 * n)) - 1];
  c.largest = relative.back();
  return c;
}

Comparison compare(const lighting::GridResult& grid, const Reference& reference) {
  const std::vector<double> values(grid.illuminance_lux.begin(), grid.illuminance_lux.end());
  const std::vector<double> errors(grid.error_lux.begin(), grid.error_lux.end());
  return compare(values, errors, reference.illuminance_lux, reference.standard_error_lux);
}

void print(const std::string& what, const Comparison& c) {
  std::printf(
      "[ FIGURES  ] %s: bias %+.2f %%, rms %.2f %%, p95 %.2f %%, max %.1f %%, |z|<=2 %.1f %%, rms(z) %.2f (%zu "
      "sensors)\n",
      what.c_str(), 100.0 * c.bias, 100.0 * c.rms, 100.0 * c.p95, 100.0 * c.largest, 100.0 * c.covered, c.rms_z,
      c.count);
}

void expect_honest(const std::string& what, const Comparison& c) {
  EXPECT_GE(c.covered, 0.95) << what;
  EXPECT_GE(c.rms_z, 0.5) << what;
  EXPECT_LE(c.rms_z, 1.2) << what;
}

}  // namespace clerestory::test
