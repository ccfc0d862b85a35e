// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/polar_diagram.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "io/raster_text.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

constexpr int kWidth = 800;
constexpr int kHeight = 880;
constexpr Pixel kCentre{400.0, 450.0};
constexpr double kRadius = 340.0;  ///< of the outermost ring
constexpr Rgb kWhite{255, 255, 255};
constexpr Rgb kInk{30, 30, 30};
constexpr Rgb kGrid{205, 205, 205};
constexpr Rgb kAlong{200, 60, 20};   ///< C0–C180
constexpr Rgb kAcross{20, 90, 180};  ///< C90–C270
constexpr TextStyle kSmall{.size_px = 14};
constexpr TextStyle kHead{.size_px = 18, .bold = true};
constexpr Align kMiddle = Align::kMiddle;

/// By angle from straight down, to the right.
Pixel place(double gamma_deg, double radius) {
  const double gamma = gamma_deg * std::numbers::pi / 180.0;
  return {kCentre.x + radius * std::sin(gamma), kCentre.y + radius * std::cos(gamma)};
}

void stroke(Raster& raster, const std::vector<Pixel>& line, bool closed, double width, Rgb colour) {
  Mask mask(raster.width(), raster.height());
  mask.add_line(line, closed, width);
  raster.paint(mask, colour);
}

/// A round number of candelas between rings, of which there are three to six.
double ring_step(double peak_cd) {
  const double power = std::pow(10.0, std::floor(std::log10(peak_cd / 3.0)));
  for (const double mantissa : {5.0, 2.0, 1.0}) {
    if (3.0 * mantissa * power <= peak_cd) return mantissa * power;
  }
  return power;
}

void draw_grid(Raster& raster, double step_cd, int rings) {
  for (int ring = 1; ring <= rings; ++ring) {
    std::vector<Pixel> circle;
    for (int k = 0; k < 180; ++k) circle.push_back(place(2.0 * k, kRadius * ring / rings));
    stroke(raster, circle, true, 1.0, kGrid);
  }
  for (int gamma = 0; gamma < 360; gamma += 30) {
    const std::vector<Pixel> ray{place(gamma, 0.0), place(gamma, kRadius)};
    stroke(raster, ray, false, 1.0, kGrid);
    const int shown = gamma <= 180 ? gamma : 360 - gamma;
    draw_text(raster, fmt::format("{}°", shown), kSmall, place(gamma, kRadius + 24.0), {kMiddle, kMiddle}, kInk);
  }
  for (int ring = 1; ring <= rings; ++ring)
    draw_text(raster, fmt::format("{:g}", step_cd * ring), kSmall, place(75.0, kRadius * ring / rings - 16.0),
              {kMiddle, kMiddle}, kInk);
}

void draw_curve(Raster& raster, const lighting::PhotometricWeb& web, double c_deg, double most_cd, Rgb colour) {
  std::vector<Pixel> curve;
  for (int k = -180; k < 180; ++k) {
    const double cd = web.intensity_cd(k >= 0 ? c_deg : c_deg + 180.0, std::abs(k));
    curve.push_back(place(k, kRadius * cd / most_cd));
  }
  stroke(raster, curve, true, 2.5, colour);
}

void draw_legend(Raster& raster, double x, const std::string& text, Rgb colour) {
  const std::vector<Pixel> line{{x, 850.0}, {x + 40.0, 850.0}};
  stroke(raster, line, false, 2.5, colour);
  draw_text(raster, text, kSmall, {x + 50.0, 850.0}, {Align::kStart, kMiddle}, kInk);
}

}  // namespace

Raster polar_diagram(const lighting::PhotometricWeb& web, const std::string& title) {
  Raster raster(kWidth, kHeight, kWhite);
  const double step = ring_step(web.peak_cd());
  const int rings = static_cast<int>(std::ceil(web.peak_cd() / step - 1e-9));
  draw_grid(raster, step, rings);
  draw_curve(raster, web, 90.0, step * rings, kAcross);
  draw_curve(raster, web, 0.0, step * rings, kAlong);
  draw_text(raster, printable(title), kHead, {kCentre.x, 32.0}, {kMiddle, kMiddle}, kInk);
  draw_text(raster, fmt::format("Luminous intensity [cd], {:.0f} lm", web.flux_lm()), kSmall, {kCentre.x, 58.0},
            {kMiddle, kMiddle}, kInk);
  draw_legend(raster, 200.0, "C180 – C0", kAlong);
  draw_legend(raster, 460.0, "C270 – C90", kAcross);
  return raster;
}

}  // namespace clerestory::io
