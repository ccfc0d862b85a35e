// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/seen_edges.h"

#include <algorithm>
#include <array>

namespace clerestory::mesh {

namespace {

/// How far beside an edge a ray passes it [m].
constexpr double kBeside = 2e-3;
/// Points of a polygon's outline are taken inside of it by this share of their distance from its middle.
constexpr double kInside = 0.02;
constexpr std::array kPlaces{1.0 / 12.0, 0.5, 11.0 / 12.0};  ///< on an edge

/// Of the sun, whose light is narrow where it comes through a window: so many places on an edge, evenly spread.
constexpr int kPlacesOfSun = 64;

/// Points that stand for a source; of a polygon in its plane.
std::vector<Point> points_of(const ShadowSource& source) {
  if (source.kind != ShadowSource::Kind::kPolygon) return {source.at};
  const std::vector<Point>& loop = source.outline[0];
  Vector sum;
  for (const Point& p : loop) sum = sum + (p - loop[0]) / static_cast<double>(loop.size());
  const Point middle = loop[0] + sum;
  std::vector<Point> points{middle};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    for (const Point& p : {loop[i], midpoint(loop[i], loop[(i + 1) % loop.size()])}) {
      points.push_back(p + kInside * (middle - p));
    }
  }
  return points;
}

class EdgeLook {
 public:
  EdgeLook(const Occluders& occluders, const ShadowSource& source, const Rays& rays)
      : occluders_(occluders), source_(source), rays_(rays), points_(points_of(source)) {}

  /// Whether the source shines past an edge, or would do so if it shone backwards.
  [[nodiscard]] bool lights(const OccluderEdge& e, bool backwards = false) {
    segments_.clear();
    for_each_pair(e, [&](const Point& from, const Point& place) {
      const bool far = source_.kind == ShadowSource::Kind::kDirection;
      const Vector line = far ? -source_.towards : place - from;
      const double front = source_.kind == ShadowSource::Kind::kPolygon ? dot(line, source_.normal) : 0.0;
      if ((backwards ? front > 0.0 : front < 0.0) && !source_.two_sided) return;
      const auto free = occluders_.free_side(e, line);
      if (!free) return;
      const Point beside = place + kBeside * *free;
      if (far) {
        // From outdoors: a segment that leaves through an opening ends there.
        segments_.push_back({beside + reach() * source_.towards, beside});
      } else {
        segments_.push_back({from + lift(front) * source_.normal, beside});
      }
    });
    return any_passes();
  }

  /// Whether the edge ends the sky that is seen from the opening.
  [[nodiscard]] bool ends_sky(const OccluderEdge& e) {
    segments_.clear();
    for_each_pair(e, [&](const Point& from, const Point& place) {
      const Vector line = place - from;
      if (dot(line, source_.normal) >= 0.0 || line.z <= 0.0) return;
      const auto free = occluders_.free_side(e, line);
      if (!free) return;
      const Point start = from - rays_.offset_m() * source_.normal;
      const Vector towards = normalized(place + kBeside * *free - start);
      segments_.push_back({start, start + reach() * towards});
    });
    return any_passes();
  }

 private:
  template <class Visit>
  void for_each_pair(const OccluderEdge& e, const Visit& visit) const {
    const auto [a, b] = occluders_.ends(e);
    if (source_.kind == ShadowSource::Kind::kDirection) {
      for (int i = 0; i < kPlacesOfSun; ++i) visit(points_[0], a + ((i + 0.5) / kPlacesOfSun) * (b - a));
      return;
    }
    for (const double t : kPlaces) {
      for (const Point& from : points_) visit(from, a + t * (b - a));
    }
  }

  [[nodiscard]] double reach() const { return 2.0 * rays_.bounds().diagonal(); }
  [[nodiscard]] double lift(double front) const {
    if (source_.kind != ShadowSource::Kind::kPolygon) return 0.0;
    return front < 0.0 ? -rays_.offset_m() : rays_.offset_m();
  }

  [[nodiscard]] bool any_passes() {
    passed_.resize(segments_.size());
    rays_.transmittance(segments_, passed_);
    return std::any_of(passed_.begin(), passed_.end(), [](float t) { return t > 0.0F; });
  }

  const Occluders& occluders_;
  const ShadowSource& source_;
  const Rays& rays_;
  std::vector<Point> points_;
  std::vector<Segment> segments_;
  std::vector<float> passed_;
};

}  // namespace

SeenEdges seen_edges(const Occluders& occluders, const ShadowSource& source, const Rays& rays) {
  EdgeLook look(occluders, source, rays);
  SeenEdges seen;
  for (const OccluderEdge& e : occluders.edges()) {
    seen.lit.push_back(look.lights(e) ? 1 : 0);
    seen.around.push_back(source.sky && (seen.lit.back() != 0 || look.lights(e, true)) ? 1 : 0);
    seen.outdoors.push_back(source.sky && look.ends_sky(e) ? 1 : 0);
  }
  return seen;
}

}  // namespace clerestory::mesh
