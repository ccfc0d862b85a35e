// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/map_labels.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "io/raster_text.h"

namespace clerestory::io {

namespace {

constexpr Rgb kInk{24, 24, 28};
constexpr Rgb kPaper{255, 255, 255};
constexpr double kLineWidth = 1.5;
constexpr double kHaloWidth = 3.6;
constexpr double kHaloOpacity = 0.45;
constexpr TextStyle kLineLabel{14, true};
constexpr TextStyle kValueLabel{13, false};
/// Lines shorter than this are noise [pixels].
constexpr double kShortestLine = 12.0;
/// A line carries a label at least so long, and one more for each such length [pixels].
constexpr double kLengthForLabel = 90.0;
constexpr double kLengthPerLabel = 700.0;
/// Least room that a printed value takes, so that the values of a dense grid stay legible [pixels].
constexpr double kValueWidth = 60.0;
constexpr double kValueHeight = 46.0;

constexpr double kLargestDot = 15.0;  // radius [pixels]

using Line = std::vector<Pixel>;

double step_length(const Line& line, std::size_t i) {
  return std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
}

double length(const Line& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += step_length(line, i);
  return sum;
}

Pixel point_at(const Line& line, double distance) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double step = step_length(line, i);
    if (step > 0.0 && distance <= step) {
      const double t = distance / step;
      return {std::lerp(line[i - 1].x, line[i].x, t), std::lerp(line[i - 1].y, line[i].y, t)};
    }
    distance -= step;
  }
  return line.back();
}

/// Everything that has one value on the map.
struct Level {
  double value = 0.0;
  std::vector<Line> lines;  ///< the longest first
  Mask mask;
};

Level make_level(const MapMesh& mesh, const MapLayout& layout, double value, const Mask& within) {
  Level level{value, {}, Mask(layout.width, layout.height)};
  for (const auto& line : isolines(mesh, value)) {
    Line pixels = layout.pixels(line);
    if (length(pixels) < kShortestLine) continue;
    level.mask.add_line(pixels, false, kLineWidth);
    level.lines.push_back(std::move(pixels));
  }
  level.mask.keep_inside(within);
  std::ranges::stable_sort(level.lines, std::greater{}, length);
  return level;
}

void draw_line_halo(Raster& raster, const Level& level, const MapLayout& layout, const Mask& within) {
  Mask halo(layout.width, layout.height);
  for (const Line& line : level.lines) halo.add_line(line, false, kHaloWidth);
  halo.keep_inside(within);
  raster.paint(halo, kPaper, kHaloOpacity);
}

bool covered(const Mask& mask, const PixelRect& box) {
  const auto inside = [&](double x, double y) {
    const int px = static_cast<int>(x);
    const int py = static_cast<int>(y);
    return px >= 0 && py >= 0 && px < mask.width() && py < mask.height() && mask.at(px, py) > 0.5F;
  };
  return inside(box.x, box.y) && inside(box.right(), box.y) && inside(box.x, box.bottom()) &&
         inside(box.right(), box.bottom());
}

struct LineLabel {
  TextImage text;
  Occupied::Owner owner;  ///< of the lines of this value
};

/// Labels along one line, each at the first free place to either side of the middle of its stretch.
void label_line(Raster& raster, Occupied& occupied, const Occupied& lines, const Line& line, const LineLabel& label,
                const Mask& within) {
  const double whole = length(line);
  if (whole < kLengthForLabel) return;
  const int count = 1 + static_cast<int>(whole / kLengthPerLabel);
  const double stretch = whole / count;
  for (int k = 0; k < count; ++k) {
    for (const double place : {0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74, 0.18, 0.82}) {
      const Pixel at = point_at(line, (k + place) * stretch);
      const PixelRect box = text_box(label.text, at, {Align::kMiddle, Align::kMiddle});
      if (!occupied.free(box.grown(14.0)) || !lines.free(box.grown(2.0), label.owner)) continue;
      if (!covered(within, box.grown(3.0))) continue;
      draw_halo(raster, label.text, box, kPaper, 3.0);
      draw_text(raster, label.text, box, kInk);
      occupied.take(box.grown(4.0));
      break;
    }
  }
}

/// The distance of sensors [m]: the side of a cell, or what it were if they were spread evenly over each panel.
double spacing_of(const MapPlan& plan) {
  if (!plan.cells.empty()) {
    const auto& cell = plan.cells.front();
    return std::hypot(cell[1].x - cell[0].x, cell[1].y - cell[0].y);
  }
  double area = 0.0;
  double longest = 0.0;
  for (const MapPanel& panel : plan.panels) {
    area += panel.box.width() * panel.box.height();
    longest += std::max(panel.box.width(), panel.box.height());
  }
  const auto count = static_cast<double>(plan.positions.size());
  return area > 0.0 ? std::sqrt(area / count) : longest / count;
}

/// Half a step less than the whole number of steps that is at least `least`, so that rounding to pixels cannot make the
/// distance of printed values change from one step to the next.
double between_steps(double least, double step) { return step > 1.0 ? (std::ceil(least / step) - 0.5) * step : least; }

double dot_radius(const MapPlan& plan, const MapLayout& layout) {
  const double spacing = spacing_of(plan) * layout.pixels_per_metre;
  return spacing > 0.0 ? std::clamp(0.42 * spacing, 1.5, kLargestDot) : kLargestDot;  // 0: all at one place
}

/// Renders each number once: a grid has few different ones.
class TextCache {
 public:
  explicit TextCache(TextStyle style) : style_(style) {}
  const TextImage& get(const std::string& text) {
    auto found = images_.find(text);
    if (found == images_.end()) found = images_.emplace(text, render_text(text, style_)).first;
    return found->second;
  }

 private:
  TextStyle style_;
  std::map<std::string, TextImage> images_;
};

Rgb ink_on(Rgb ground) { return lightness(ground) < 0.5 ? kPaper : kInk; }

}  // namespace

void draw_isolines(Raster& raster, Occupied& occupied, const MapMesh& mesh, const MapLayout& layout,
                   const MapScale& scale, const Mask& within) {
  std::vector<Level> levels;
  for (const double value : scale.isolines) levels.push_back(make_level(mesh, layout, value, within));
  for (const Level& level : levels) draw_line_halo(raster, level, layout, within);
  for (const Level& level : levels) raster.paint(level.mask, kInk, 0.9);
  Occupied lines(layout.width, layout.height);
  for (std::size_t i = 0; i < levels.size(); ++i) lines.take(levels[i].mask, static_cast<Occupied::Owner>(i + 1));
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const LineLabel label{render_text(knot_label(levels[i].value), kLineLabel), static_cast<Occupied::Owner>(i + 1)};
    for (const Line& line : levels[i].lines) label_line(raster, occupied, lines, line, label, within);
  }
  for (const Level& level : levels) occupied.take(level.mask);
}

void draw_values(Raster& raster, Occupied& occupied, const MapPlan& plan, const MapLayout& layout,
                 std::span<const float> values, const Mask& painted) {
  const bool beside = plan.cells.empty();  // a dot stands at the place itself
  const double aside = beside ? dot_radius(plan, layout) + 5.0 : 0.0;
  const double spacing = spacing_of(plan) * layout.pixels_per_metre;
  const double width = between_steps(kValueWidth, spacing);
  const double height = between_steps(kValueHeight, spacing);
  Occupied chosen(layout.width, layout.height);
  TextCache texts(kValueLabel);
  for (std::size_t i = 0; i < plan.positions.size(); ++i) {
    const Pixel at = layout.pixel(plan.positions[i]);
    // Where a value goes is chosen without regard to lines, so that a grid's values stand in rows and columns.
    const PixelRect cell{at.x - 0.5 * width, at.y - 0.5 * height, width, height};
    if (!chosen.free(cell)) continue;
    const TextImage& text = texts.get(map_number(static_cast<double>(values[i])));
    const PixelRect box =
        text_box(text, {at.x + aside, at.y}, {beside ? Align::kStart : Align::kMiddle, Align::kMiddle});
    if (!beside && !covered(painted, box.grown(1.0))) continue;
    chosen.take(cell);
    if (!occupied.free(box.grown(2.0))) continue;
    draw_text(raster, text, box, ink_on(raster.at(static_cast<int>(box.x), static_cast<int>(at.y))));
    occupied.take(box);
  }
}

void draw_dots(Raster& raster, Occupied& occupied, const MapPlan& plan, const MapLayout& layout,
               std::span<const float> values, const MapScale& scale) {
  const double radius = dot_radius(plan, layout);
  for (std::size_t i = 0; i < plan.positions.size(); ++i) {
    const Pixel at = layout.pixel(plan.positions[i]);
    const int reach = static_cast<int>(std::ceil(radius)) + 2;
    const int left = static_cast<int>(at.x) - reach;
    const int top = static_cast<int>(at.y) - reach;
    const Pixel centre{at.x - left, at.y - top};
    Mask rim(2 * reach + 1, 2 * reach + 1);
    Mask dot(2 * reach + 1, 2 * reach + 1);
    rim.add_disc(centre, radius);
    dot.add_disc(centre, radius - 1.0);
    for (int y = 0; y < rim.height(); ++y) {
      for (int x = 0; x < rim.width(); ++x) {
        raster.blend(left + x, top + y, kInk, 0.6 * static_cast<double>(rim.at(x, y)));
        raster.blend(left + x, top + y, map_colour(scale.position(static_cast<double>(values[i]))),
                     static_cast<double>(dot.at(x, y)));
      }
    }
    occupied.take({at.x - radius, at.y - radius, 2.0 * radius, 2.0 * radius});
  }
}

}  // namespace clerestory::io
