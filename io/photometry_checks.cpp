// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/photometry_checks.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "mesh/error.h"

namespace clerestory::io {

using lighting::Photometry;

namespace {

constexpr double kFluxTolerance = 0.01;  // what makers' own summations differ by

void note_missing_angles(Photometry& p) {
  if (p.type != Photometry::Type::kC) return;
  const double first = p.vertical_deg.front();
  const double last = p.vertical_deg.back();
  if ((first != 0.0 && first != 90.0) || (last != 90.0 && last != 180.0))
    p.notes.push_back(
        fmt::format("Its vertical angles run from {:g} to {:g} degrees; it is dark beyond.", first, last));
}

/// The flux by another rule of summing: each zone between two angles has the mean of their intensities. By how much it differs from the integral tells
/// what any such sum can be worth.
double flux_by_zones(const lighting::PhotometricWeb& web) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const lighting::IntensityGrid& grid = web.grid();
  const std::size_t count = grid.polar_deg.size();
  double sum = 0.0;
  for (std::size_t plane = 0; plane < grid.azimuth_deg.size(); ++plane) {
    for (std::size_t k = 0; k + 1 < count; ++k) {
      const double mean = 0.5 * (grid.candela[plane * count + k] + grid.candela[plane * count + k + 1]);
      sum += mean * (std::cos(grid.polar_deg[k] * kDegree) - std::cos(grid.polar_deg[k + 1] * kDegree));
    }
  }
  return sum * 2.0 * std::numbers::pi / static_cast<double>(grid.azimuth_deg.size());
}

void note_flux(Photometry& p, const lighting::PhotometricWeb& web) {
  const double flux_lm = web.flux_lm();
  if (p.stated_flux_lm && *p.stated_flux_lm > 0.0) {
    const double difference = flux_lm / *p.stated_flux_lm - 1.0;
    if (std::abs(difference) <= kFluxTolerance) return;
    const bool narrow = std::abs(difference) <= 2.0 * std::abs(flux_by_zones(web) / flux_lm - 1.0);
    p.notes.push_back(fmt::format(
        "Its intensities add up to {:.0f} lm, {:+.1f} % against the {:.0f} lm that it states: {}. The "
        "intensities are what is computed with.",
        flux_lm, 100.0 * difference, *p.stated_flux_lm,
        narrow ? "its beam is narrow for the steps of its angles, so that rules of summing differ by as much"
               : "the figures in the file do not belong together"));
    return;
  }
  const double lamps = p.lamps.empty() ? 0.0 : p.lamps[p.fitted].flux_lm;
  if (!p.absolute && lamps > 0.0 && flux_lm > (1.0 + kFluxTolerance) * lamps)
    p.notes.push_back(
        fmt::format("Its intensities add up to {:.0f} lm, more than the {:.0f} lm of its lamps.", flux_lm, lamps));
}

}  // namespace

void check_photometry(Photometry& p, const std::string& file) {
  const lighting::PhotometricWeb web = lighting::web_of(p);
  if (!(web.flux_lm() > 0.0))
    throw InputError(file, 0, "the intensities of this luminaire add up to no light",
                     "take the maker's file again; this one may be a template");
  note_missing_angles(p);
  note_flux(p, web);
  if (!p.opening.has_area() && p.opening.size_m() == 0.0)
    p.notes.emplace_back("It states no luminous area: it is a point, however near.");
}

}  // namespace clerestory::io
