// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/map_layout.h"

#include <algorithm>
#include <cmath>

namespace clerestory::io {

namespace {

constexpr double kMostWidth = 1400.0;
constexpr double kLeastWidth = 1160.0;  // what the figures of the footer need
constexpr double kMargin = 56.0;
constexpr double kTitleHeight = 104.0;
constexpr double kRightColumn = 168.0;  // legend and north arrow
constexpr double kGap = 52.0;           // between the map and the right column
constexpr double kMostMapHeight = 1240.0;
constexpr double kLeastContentHeight = 470.0;  // what legend and arrow need
constexpr double kScaleBarHeight = 74.0;
constexpr double kCaptionHeight = 30.0;
constexpr double kFooterHeight = 128.0;
/// A plan without any size of its own (one sensor) is drawn as this much of the world [m].
constexpr double kLeastSize = 1.0;

}  // namespace

std::vector<Pixel> MapLayout::pixels(std::span<const MapPoint> points) const {
  std::vector<Pixel> out;
  for (const MapPoint& p : points) out.push_back(pixel(p));
  return out;
}

MapLayout layout_map(const MapPlan& plan) {
  MapLayout layout;
  const double around = 2.0 * kMargin + kGap + kRightColumn;
  const double widest = kMostWidth - around;
  // Dots and values of a list of points reach beyond the outermost points.
  const double border = plan.outlines.empty() ? 0.04 * std::max(plan.box.width(), plan.box.height()) : 0.0;
  const double width_m = std::max(plan.box.width() + 2.0 * border, 1e-3 * kLeastSize);
  const double height_m = std::max(plan.box.height() + 2.0 * border, 1e-3 * kLeastSize);
  const double largest_m = std::max({width_m, height_m, kLeastSize});
  layout.pixels_per_metre = std::min({widest / width_m, kMostMapHeight / height_m, widest / largest_m});
  if (height_m > width_m) layout.pixels_per_metre = std::min(kMostMapHeight / height_m, widest / width_m);
  const double captions = plan.panels.size() > 1 ? kCaptionHeight : 0.0;
  const double map_width = width_m * layout.pixels_per_metre;
  const double map_height = height_m * layout.pixels_per_metre;
  const double content_height = std::max(map_height + captions, kLeastContentHeight);
  const double width = std::max(kLeastWidth, map_width + around);
  layout.width = static_cast<int>(std::lround(width));
  layout.title = {kMargin, 30.0};
  layout.map = {kMargin + 0.5 * (width - around - map_width),
                kTitleHeight + 16.0 + captions + 0.5 * (content_height - captions - map_height), map_width, map_height};
  layout.origin = {plan.box.low.x - 0.5 * (width_m - plan.box.width()),
                   plan.box.high.y + 0.5 * (height_m - plan.box.height())};
  const double column = width - kMargin - kRightColumn;
  layout.legend = {column, kTitleHeight + 62.0, 30.0, std::min(content_height - 210.0, 460.0)};
  layout.north = {column + 56.0, kTitleHeight + 16.0 + content_height - 56.0};
  layout.scale_bar = {kMargin, kTitleHeight + 16.0 + content_height + 26.0};
  layout.footer = {kMargin, layout.scale_bar.y + kScaleBarHeight - 10.0, width - 2.0 * kMargin, kFooterHeight};
  layout.height = static_cast<int>(std::lround(layout.footer.bottom() + 10.0));
  return layout;
}

Occupied::Occupied(int width, int height)
    : width_(width), height_(height), owners_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

bool Occupied::free(const PixelRect& rectangle, Owner except) const {
  const int left = static_cast<int>(std::floor(rectangle.x));
  const int top = static_cast<int>(std::floor(rectangle.y));
  const int right = static_cast<int>(std::ceil(rectangle.right()));
  const int bottom = static_cast<int>(std::ceil(rectangle.bottom()));
  if (left < 0 || top < 0 || right > width_ || bottom > height_) return false;
  for (int y = top; y < bottom; ++y) {
    const auto row = owners_.begin() + static_cast<std::ptrdiff_t>(y) * width_;
    if (std::any_of(row + left, row + right, [=](Owner o) { return o != kNobody && o != except; })) return false;
  }
  return true;
}

void Occupied::take(const PixelRect& rectangle) {
  const int left = std::max(0, static_cast<int>(std::floor(rectangle.x)));
  const int right = std::min(width_, static_cast<int>(std::ceil(rectangle.right())));
  const int bottom = std::min(height_, static_cast<int>(std::ceil(rectangle.bottom())));
  for (int y = std::max(0, static_cast<int>(std::floor(rectangle.y))); y < bottom; ++y) {
    const auto row = owners_.begin() + static_cast<std::ptrdiff_t>(y) * width_;
    if (left < right) std::fill(row + left, row + right, kSomebody);
  }
}

void Occupied::take(const Mask& mask, Owner owner) {
  for (int y = 0; y < height_; ++y) {
    auto here = owners_.begin() + static_cast<std::ptrdiff_t>(y) * width_;
    mask.in_row(y, [&](int x, float) { here[x] = here[x] == kNobody || here[x] == owner ? owner : kSomebody; });
  }
}

}  // namespace clerestory::io
