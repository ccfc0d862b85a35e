// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lighting/results.h"
#include "tests/support/validation_scenes.h"

namespace clerestory::test {

/// How a result lies to its reference, over all sensors of a grid (docs/theory/accuracy.md).
struct Comparison {
  std::size_t count = 0;
  double bias = 0.0;  ///< of the mean, relative
  double rms = 0.0;   ///< of the relative difference
  double p95 = 0.0;   ///< 95 % of the relative differences are at most this large
  double largest = 0.0;
  double covered = 0.0;  ///< share with |z| <= 2, z = difference over the combined standard error
  double rms_z = 0.0;
  double mean_difference = 0.0;        ///< [lx]
  double mean_difference_error = 0.0;  ///< standard error of it, the values independent [lx]
};

/// Compares values with a reference; all spans have one length.
Comparison compare(std::span<const double> values, std::span<const double> errors, std::span<const double> reference,
                   std::span<const double> reference_errors);
Comparison compare(const lighting::GridResult& grid, const Reference& reference);

/// Prints a comparison.
void print(const std::string& what, const Comparison& comparison);

/// Expects the stated errors to be honest: at least 95 % of |z| <= 2, RMS(z) in 0.5 … 1.2.
void expect_honest(const std::string& what, const Comparison& comparison);

}  // namespace clerestory::test
