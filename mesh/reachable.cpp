// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reachable.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <limits>
#include <utility>

#include "mesh/hash.h"
#include "mesh/phase_part.h"
#include "mesh/regions.h"
#include "mesh/side_shells.h"

namespace clerestory::mesh {

namespace {

/// Rays that a region's side sends out at first, while it is not reached, and once more when they are not decisive. Of sides of closed shells
/// inside of which there is no sign of light, few are enough.
constexpr std::uint32_t kFirstRays = 4;
constexpr std::uint32_t kFewRays = 16;
constexpr std::uint32_t kRays = 64;
constexpr std::uint32_t kMoreRays = 256;
/// Sides that bound a space of which other sides are reached lie behind a slit, perhaps: they are asked on, up to so many rays a side, and
/// rays of them all: where there are many of these sides, each sends fewer.
constexpr std::uint32_t kMostRays = 4096;
constexpr std::size_t kMostRaysOfAll = std::size_t{1} << 19U;
/// A shell encloses a space from this share of the volume of the box around it on; what has no thickness encloses nothing but rounding.
constexpr double kLeastEnclosed = 1e-6;
/// So many exchanged rays make a side reached: 3 % of kRays, and never one alone.
constexpr std::uint32_t kNeeded = 2;
/// Rays of all point sources together, and of each at least.
constexpr std::uint32_t kSourceRays = 1U << 16U;
constexpr std::uint32_t kLeastSourceRays = 512;
/// Sheets of glass and openings that one ray is followed through.
constexpr int kMostSheets = 32;
/// A region narrower than this many offsets cannot be told from the line where two solids touch: nothing is passed on by it.
constexpr double kThinOffsets = 10.0;

/// Sides of regions, 2 a region, front first.
using Node = std::uint32_t;
constexpr Node kNobody = std::numeric_limits<Node>::max();

/// What one ray told: it left the `from` side, touched the nodes [first, last), and may have left the model.
struct Path {
  Node from = kNobody;  // kNobody: from a point source
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  bool escapes = false;
  bool counted = false;
};

class Search {
 public:
  Search(const Faces& faces, const Rays& rays)
      : faces_(faces),
        rays_(rays),
        regions_(number_regions(faces)),
        reached_(2 * regions_.count(), 0),
        evidence_(2 * regions_.count(), 0) {
    thin_.reserve(regions_.count());
    for (const double width : regions_.width_m) thin_.push_back(width < kThinOffsets * rays.offset_m());
  }

  [[nodiscard]] const Regions& regions() const { return regions_; }
  [[nodiscard]] const std::vector<std::uint8_t>& reached() const { return reached_; }
  [[nodiscard]] std::size_t side_of(Node node) const { return FaceSide{regions_.face[node / 2], side(node)}.index(); }

  void seed(Node node) { reach(node); }

  void cast_from_points(std::span<const Point> points) {
    if (points.empty()) return;
    const auto each = std::max(kLeastSourceRays, kSourceRays / static_cast<std::uint32_t>(points.size()));
    for (std::size_t p = 0; p < points.size(); ++p) {
      for (std::uint32_t i = 0; i < each; ++i) {
        follow(kNobody, {points[p], sphere_direction(spread(i, 0, p), spread(i, 1, p))});
      }
    }
  }

  /// Sends rays from the given nodes and follows what they tell to its end.
  void search(const std::vector<Node>& nodes, Progress& progress) {
    const std::vector<Node> shells = side_shells(faces_, regions_);
    cast_stage(nodes, 0, kFirstRays, progress);
    cast_stage(not_reached(nodes), kFirstRays, kFewRays, progress);
    cast_stage(outside_of_solids(not_reached(nodes), shells), kFewRays, kRays, progress);
    for (std::vector<Node> doubtful = undecided(nodes); !doubtful.empty(); doubtful = undecided(nodes)) {
      NoProgress untold;
      PhasePart few(untold, 0.0, 1.0);
      cast(doubtful, kRays, kMoreRays, few);
      settle();
    }
    search_behind_slits(nodes, shells);
  }

 private:
  static Side side(Node node) { return node % 2 == 0 ? Side::kFront : Side::kBack; }

  void cast(const std::vector<Node>& nodes, std::uint32_t first, std::uint32_t count, PhasePart& progress);
  /// The rays [first, end) of kRays a node, and what follows from them.
  void cast_stage(const std::vector<Node>& nodes, std::uint32_t first, std::uint32_t end, Progress& progress) {
    PhasePart part(progress, static_cast<double>(first) / kRays, static_cast<double>(end) / kRays);
    cast(nodes, first, end - first, part);
    settle();
  }
  [[nodiscard]] std::vector<Node> not_reached(const std::vector<Node>& nodes) const {
    std::vector<Node> found;
    std::ranges::copy_if(nodes, std::back_inserter(found), [&](Node n) { return reached_[n] == 0; });
    return found;
  }
  void follow(Node from, Ray ray);
  void settle();
  void index_touches();
  void credit(Node node) {
    if (reached_[node] == 0 && ++evidence_[node] >= kNeeded) reach(node);
  }
  void reach(Node node) {
    if (std::exchange(reached_[node], std::uint8_t{1}) == 0) fresh_.push_back(node);
  }
  /// Rays from sides that are not reached though they share a shell with some that are, twice as many from round to round.
  void search_behind_slits(const std::vector<Node>& nodes, const std::vector<Node>& shells) {
    std::size_t left = kMostRaysOfAll;
    for (std::uint32_t sent = kRays + kMoreRays; sent < kMostRays;) {
      const std::vector<Node> open = beside_reached(nodes, shells);
      if (open.empty()) return;
      const auto more =
          static_cast<std::uint32_t>(std::min<std::size_t>(std::min(sent, kMostRays - sent), left / open.size()));
      if (more == 0) return;
      left -= open.size() * more;
      NoProgress untold;
      PhasePart few(untold, 0.0, 1.0);
      cast(open, sent, more, few);
      settle();
      sent += more;
    }
  }
  [[nodiscard]] std::vector<Node> beside_reached(const std::vector<Node>& nodes,
                                                 const std::vector<Node>& shells) const {
    std::vector<std::uint8_t> has_reached(shells.size(), 0);
    for (Node n = 0; n < reached_.size(); ++n) has_reached[shells[n]] |= reached_[n];
    std::vector<Node> found;
    std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(found),
                 [&](Node n) { return reached_[n] == 0 && has_reached[shells[n]] != 0 && !thin_[n / 2]; });
    return found;
  }
  /// Those but for the sides of closed opaque shells, seen from inside, of which no ray has told of light.
  [[nodiscard]] std::vector<Node> outside_of_solids(const std::vector<Node>& nodes,
                                                    const std::vector<Node>& shells) const;
  void count_for_sender(Path& path) {
    if (path.from != kNobody && !std::exchange(path.counted, true)) credit(path.from);
  }
  /// Nodes with one witness, which have not been asked again yet.
  std::vector<Node> undecided(const std::vector<Node>& nodes) {
    asked_again_.resize(reached_.size(), 0);
    std::vector<Node> found;
    for (const Node n : nodes) {
      if (reached_[n] != 0 || evidence_[n] == 0 || asked_again_[n] != 0) continue;
      asked_again_[n] = 1;
      found.push_back(n);
    }
    return found;
  }

  const Faces& faces_;
  const Rays& rays_;
  Regions regions_;
  std::vector<bool> thin_;
  std::vector<std::uint8_t> reached_;
  std::vector<std::uint32_t> evidence_;
  std::vector<std::uint8_t> asked_again_;
  std::vector<Node> fresh_;  // reached, and their rays not yet looked at
  std::vector<Path> paths_;
  std::vector<Node> touched_;
  std::vector<std::uint32_t> touch_starts_, touch_paths_;  // node → paths that touched it
  std::vector<std::uint32_t> sent_starts_, sent_paths_;    // node → paths that it sent
};

void Search::cast(const std::vector<Node>& nodes, std::uint32_t first, std::uint32_t count, PhasePart& progress) {
  std::size_t done = 0;
  for (const Node node : nodes) {
    progress.advance(done++, nodes.size());
    const std::size_t region = node / 2;
    if (regions_.area_m2[region] <= 0.0) continue;
    const RegionPoints points(faces_, regions_, region);
    const Vector normal = side_normal(faces_, regions_.face[region], side(node));
    const Frame frame = frame_around(normal);
    const std::uint64_t seed = hash(0xC0517E, node);
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Vector direction = cosine_direction(frame, spread(i, 3, seed), spread(i, 4, seed));
      follow(node, {points.at(i) + rays_.offset_m() * normal, direction});
    }
  }
}

std::vector<Node> Search::outside_of_solids(const std::vector<Node>& nodes, const std::vector<Node>& shells) const {
  struct Shell {
    double enclosed_m3 = 0.0;  ///< the volume that its sides look into; negative where they look out
    Box box;
    bool lit = false;
  };
  std::vector<Shell> of(shells.size());  // by their smallest members
  for (Node n = 0; n < shells.size(); ++n) {
    const FaceId face = regions_.face[n / 2];
    const Passage& passage = rays_.passage(face);
    Shell& shell = of[shells[n]];
    if (reached_[n] != 0 || evidence_[n] != 0 || passage.curve != Passage::kOpaque || passage.opening) shell.lit = true;
    const Point& origin = faces_.faces[face.index()].origin;
    const Vector normal = side_normal(faces_, face, side(n));
    shell.enclosed_m3 -= dot(origin - Point{}, normal) * regions_.area_m2[n / 2] / 3.0;
    for (const std::uint32_t t : regions_.of(n / 2)) {
      for (const Point& p : corners(faces_, t)) shell.box.add(p);
    }
  }
  const auto is_dark = [&](Node n) {
    const Shell& shell = of[shells[n]];
    const Vector size = shell.box.size();
    return !shell.lit && shell.enclosed_m3 > kLeastEnclosed * size.x * size.y * size.z;
  };
  std::vector<Node> found;
  std::ranges::copy_if(nodes, std::back_inserter(found), [&](Node n) { return !is_dark(n); });
  return found;
}

void Search::follow(Node from, Ray ray) {
  Path path{.from = from, .first = static_cast<std::uint32_t>(touched_.size())};
  for (int sheets = 0; sheets < kMostSheets; ++sheets) {
    const Hit hit = rays_.first_hit(ray);
    if (!hit.face.valid()) {
      path.escapes = true;
      break;
    }
    const Node entered = 2 * regions_.of_triangle[hit.triangle] + static_cast<Node>(hit.side);
    touched_.push_back(entered);
    const Passage& passage = rays_.passage(hit.face);
    if (passage.curve == Passage::kOpaque && !passage.opening) break;
    touched_.push_back(entered ^ 1U);
    const Vector beyond = side_normal(faces_, hit.face, other(hit.side));
    ray.origin = ray.origin + hit.distance * ray.direction + rays_.offset_m() * beyond;
  }
  path.last = static_cast<std::uint32_t>(touched_.size());
  paths_.push_back(path);
}

void Search::index_touches() {
  touch_starts_.assign(reached_.size() + 1, 0);
  sent_starts_.assign(reached_.size() + 1, 0);
  for (const Path& p : paths_) {
    if (p.from != kNobody) ++sent_starts_[p.from + 1];
    for (std::uint32_t i = p.first; i < p.last; ++i) ++touch_starts_[touched_[i] + 1];
  }
  for (std::size_t n = 0; n < reached_.size(); ++n) {
    touch_starts_[n + 1] += touch_starts_[n];
    sent_starts_[n + 1] += sent_starts_[n];
  }
  touch_paths_.resize(touch_starts_.back());
  sent_paths_.resize(sent_starts_.back());
  std::vector<std::uint32_t> next_touch(touch_starts_.begin(), touch_starts_.end() - 1);
  std::vector<std::uint32_t> next_sent(sent_starts_.begin(), sent_starts_.end() - 1);
  for (std::uint32_t p = 0; p < paths_.size(); ++p) {
    if (paths_[p].from != kNobody) sent_paths_[next_sent[paths_[p].from]++] = p;
    for (std::uint32_t i = paths_[p].first; i < paths_[p].last; ++i) touch_paths_[next_touch[touched_[i]]++] = p;
  }
}

/// Counts the evidence anew over all rays, and passes it on until nothing changes.
void Search::settle() {
  index_touches();
  std::fill(evidence_.begin(), evidence_.end(), 0);
  fresh_.clear();
  for (Node n = 0; n < reached_.size(); ++n) {
    if (reached_[n] != 0) fresh_.push_back(n);
  }
  for (Path& path : paths_) {
    path.counted = false;
    if (path.escapes) count_for_sender(path);
    if (path.from != kNobody) continue;
    for (std::uint32_t i = path.first; i < path.last; ++i) credit(touched_[i]);
  }
  while (!fresh_.empty()) {
    const Node node = fresh_.back();
    fresh_.pop_back();
    if (thin_[node / 2]) continue;
    for (std::uint32_t i = touch_starts_[node]; i < touch_starts_[node + 1]; ++i) {
      count_for_sender(paths_[touch_paths_[i]]);
    }
    for (std::uint32_t i = sent_starts_[node]; i < sent_starts_[node + 1]; ++i) {
      const Path& path = paths_[sent_paths_[i]];
      for (std::uint32_t k = path.first; k < path.last; ++k) credit(touched_[k]);
    }
  }
}

}  // namespace

std::vector<std::uint8_t> reachable_sides(const Faces& faces, const Rays& rays, std::span<const std::uint8_t> seeds,
                                          std::span<const Point> seed_points, Progress* progress) {
  assert(seeds.empty() || seeds.size() == 2 * faces.count());
  Search search(faces, rays);
  std::vector<Node> nodes(search.reached().size());
  for (Node n = 0; n < nodes.size(); ++n) {
    nodes[n] = n;
    if (!seeds.empty() && seeds[search.side_of(n)] != 0) search.seed(n);
  }
  search.cast_from_points(seed_points);
  NoProgress unwatched;
  search.search(nodes, progress != nullptr ? *progress : unwatched);

  std::vector<std::uint8_t> sides(2 * faces.count(), 0);
  for (Node n = 0; n < nodes.size(); ++n) sides[search.side_of(n)] |= search.reached()[n];
  return sides;
}

std::vector<std::uint8_t> reachable_triangles(const Faces& faces, const Rays& rays, std::span<const std::uint8_t> sides,
                                              Progress* progress) {
  assert(sides.size() == 2 * faces.count());
  Search search(faces, rays);
  const std::size_t count = search.reached().size();
  std::vector<std::uint32_t> regions_of(faces.count(), 0);
  for (const FaceId f : search.regions().face) ++regions_of[f.index()];
  std::vector<Node> open;  // sides of regions of which the side of the whole face does not tell
  for (Node n = 0; n < count; ++n) {
    if (sides[search.side_of(n)] == 0) continue;
    if (regions_of[search.regions().face[n / 2].index()] == 1)
      search.seed(n);
    else
      open.push_back(n);
  }
  NoProgress unwatched;
  search.search(open, progress != nullptr ? *progress : unwatched);

  // Where no region of a reachable side was found, each may be it.
  std::vector<std::uint8_t> found(2 * faces.count(), 0);
  for (Node n = 0; n < count; ++n) found[search.side_of(n)] |= search.reached()[n];
  std::vector<std::uint8_t> triangles(2 * faces.shape.triangles.size(), 0);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Node n = 2 * search.regions().of_triangle[i / 2] + static_cast<Node>(i % 2);
    const std::size_t side = search.side_of(n);
    triangles[i] = sides[side] != 0 && (search.reached()[n] != 0 || found[side] == 0);
  }
  return triangles;
}

}  // namespace clerestory::mesh
