// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cassert>
#include <cmath>

#include "lighting/dark_share.h"
#include "lighting/grids.h"

namespace clerestory::lighting {

namespace {

/// This share of the sensors must be within twice the target.
constexpr double kShareWithinTwice = 0.95;

double mean_of(const std::vector<float>& values) {
  double sum = 0.0;
  for (const float v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double median_of(std::vector<float> values) {
  const std::size_t half = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(half), values.end());
  const double upper = values[half];
  if (values.size() % 2 != 0) return upper;
  return 0.5 * (upper + *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(half)));
}

double share_of_at_least(const std::vector<float>& values, float limit) {
  const auto count = std::ranges::count_if(values, [&](float v) { return v >= limit; });
  return static_cast<double>(count) / static_cast<double>(values.size());
}

/// Error of a sensor in its share of the value. A grid without light that has errors all the same is off by the whole.
double relative_error(double error, double value, double mean) {
  if (error == 0.0) return 0.0;
  const double against = std::max(value, kDarkShare * mean);
  return against > 0.0 ? error / against : 1.0;
}

/// How good values are; a grid is as good as the worst of its columns.
void judge_accuracy(const std::vector<float>& values, const std::vector<float>& errors, double target,
                    GridMetrics& metrics) {
  double squares = 0.0;
  std::size_t within = 0;
  const double mean = mean_of(values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double relative = relative_error(errors[i], values[i], mean);
    squares += relative * relative;
    if (relative <= 2.0 * target) ++within;
  }
  const auto count = static_cast<double>(values.size());
  metrics.accuracy_reached = std::max(metrics.accuracy_reached, std::sqrt(squares / count));
  metrics.share_within_twice = std::min(metrics.share_within_twice, static_cast<double>(within) / count);
  metrics.accuracy_met = metrics.accuracy_reached <= target && metrics.share_within_twice >= kShareWithinTwice;
}

void add_cylindrical(const GridResult& grid, double target, GridMetrics& metrics) {
  metrics.mean_cylindrical_lux = mean_of(grid.cylindrical_lux);
  double sum = 0.0;
  std::size_t lit = 0;
  for (std::size_t i = 0; i < grid.cylindrical_lux.size(); ++i) {
    if (grid.illuminance_lux[i] <= 0.0F) continue;
    sum += grid.cylindrical_lux[i] / grid.illuminance_lux[i];
    ++lit;
  }
  metrics.mean_modelling = lit > 0 ? sum / static_cast<double>(lit) : 0.0;
  judge_accuracy(grid.cylindrical_lux, grid.cylindrical_error_lux, target, metrics);
}

void add_daylight_factors(const std::vector<float>& factors, GridMetrics& metrics) {
  metrics.has_daylight_factor = true;
  metrics.mean_df_percent = mean_of(factors);
  metrics.median_df_percent = median_of(factors);
  metrics.minimum_df_percent = *std::ranges::min_element(factors);
  metrics.share_above_2_percent = share_of_at_least(factors, 2.0F);
  metrics.share_above_5_percent = share_of_at_least(factors, 5.0F);
}

}  // namespace

GridMetrics grid_metrics(const GridResult& grid, double accuracy_target) {
  GridMetrics metrics;
  const auto& values = grid.illuminance_lux;
  assert(grid.error_lux.size() == values.size());
  if (values.empty()) {
    metrics.accuracy_met = true;
    return metrics;
  }
  metrics.mean_lux = mean_of(values);
  metrics.median_lux = median_of(values);
  const auto [low, high] = std::ranges::minmax(values);
  metrics.minimum_lux = low;
  metrics.maximum_lux = high;
  metrics.uniformity = metrics.mean_lux > 0.0 ? metrics.minimum_lux / metrics.mean_lux : 0.0;
  judge_accuracy(values, grid.error_lux, accuracy_target, metrics);
  if (!grid.cylindrical_lux.empty()) add_cylindrical(grid, accuracy_target, metrics);
  if (!grid.daylight_factor_percent.empty()) add_daylight_factors(grid.daylight_factor_percent, metrics);
  return metrics;
}

}  // namespace clerestory::lighting
