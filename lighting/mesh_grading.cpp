// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/mesh_grading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "lighting/parallel.h"
#include "lighting/points_by_element.h"
#include "mesh/contact_sectors.h"
#include "mesh/element_tree.h"

namespace clerestory::lighting {

using mesh::FaceId;
using mesh::FaceSide;
using mesh::Point;
using mesh::Vector;

namespace {

/// How far inside of a cell light is asked for [m], and at most which share of the way to its middle.
constexpr double kOffEdges = 1e-4;
constexpr double kOffEdgesShare = 0.1;
/// Lamps that could give less than this share of the tolerance are left out: their shadows do not show.
constexpr double kSmallLamp = 0.25;
/// Inside of a triangle the error of a quadratic function is up to so much larger than on its edges: in the middle of an equilateral one.
constexpr double kInside = 4.0 / 3.0;
/// Triangles are asked to be a little smaller than the estimate says: derivatives are not quite the same all over one.
constexpr double kSafety = 0.9;
/// Sizes change no faster than this between meshes, as one triangle says little about places in it; and they fall to no less than the finest [m].
constexpr double kGrowth = 2.0;
constexpr double kShrink = 0.4;
constexpr double kFinestM = 0.01;
/// Area of the triangles of a mesh whose edges are to be no longer than 1: as counted in meshes of squares by Delaunay refinement.
constexpr double kUnitTriangle = 0.2;
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// A corner, or the middle of an edge or of a triangle, where light is asked for.
struct Probe {
  FaceSide side;
  std::uint32_t region = 0;
  Point at;
  double lux = 0.0;
  bool known = false;
};

/// The probes of one triangle on one side: corners, then middles of the edges that follow them, and its own middle if it is looked at.
struct Judged {
  std::size_t triangle = 0;
  std::array<std::size_t, 6> probes{};
  std::optional<std::size_t> middle;
};

class Judge {
 public:
  Judge(const Solution& solution, const LocalPass& local, const mesh::Triangulation& mesh,
        const GradingOptions& options)
      : solution_(solution), local_(local), mesh_(mesh), options_(options), sectors_(solution.scene().faces) {}

  void add_side(FaceSide side, bool jumps) {
    const std::size_t first = mesh_.starts[side.face.index()];
    for (std::size_t i = 0; i < mesh_.of(side.face).size(); ++i) add(side, first + i, jumps);
  }

  void light() {
    std::vector<mesh::ElementId> elements(probes_.size());
    parallel_for(
        probes_.size(),
        [&](std::size_t i) { elements[i] = solution_.element_at(probes_[i].side, probes_[i].region, probes_[i].at); },
        64);
    const PointsByElement places(elements);
    parallel_for(places.groups(), [&](std::size_t g) {
      const LocalPass::Lamps lamps = local_.lamps_of(places.element(g));
      for (const std::uint32_t i : places.points(g)) light(probes_[i], places.element(g), lamps);
    });
  }

  /// The longest edge of each triangle with which interpolation keeps to the tolerance [m].
  [[nodiscard]] GradedSizes sizes() const {
    GradedSizes result{std::vector<double>(mesh_.triangles.size(), kUnbounded), true};
    for (const Judged& judged : judged_) {
      double& size = result.longest_m[judged.triangle];
      const std::array<Point, 3> c = corners(judged.triangle);
      const double allowed = options_.tolerance * std::max(options_.darkest_lux, light_at(judged));
      double longest = 0.0;
      const auto bound = [&](double missed, double length) {
        result.kept = result.kept && missed <= allowed;
        if (missed > 0.0) size = std::min(size, std::max(kFinestM, kSafety * length * std::sqrt(allowed / missed)));
      };
      for (std::size_t k = 0; k < 3; ++k) {
        const double length = norm(c[(k + 1) % 3] - c[k]);
        longest = std::max(longest, length);
        bound(kInside * second_difference(judged, k), length);
      }
      bound(missed_inside(judged), longest);
      size = std::clamp(size, kShrink * longest, kGrowth * longest);
    }
    return result;
  }

  [[nodiscard]] std::array<Point, 3> corners(std::size_t triangle) const {
    const auto& v = mesh_.triangles[triangle].vertices;
    return {mesh_.vertices[v[0]], mesh_.vertices[v[1]], mesh_.vertices[v[2]]};
  }

 private:
  void add(FaceSide side, std::size_t triangle, bool jumps) {
    const mesh::Triangle& t = mesh_.triangles[triangle];
    const std::array<Point, 3> c = corners(triangle);
    const Point middle = c[0] + (c[1] - c[0] + (c[2] - c[0])) / 3.0;
    Judged judged{triangle, {}, std::nullopt};
    for (std::size_t k = 0; k < 6; ++k) {
      const std::uint32_t a = t.vertices[k % 3];
      const std::uint32_t b = k < 3 ? a : t.vertices[(k + 1) % 3];
      const Point at = midpoint(mesh_.vertices[a], mesh_.vertices[b]);
      const std::array<std::uint32_t, 5> key{std::min(a, b), std::max(a, b), jumps ? t.patch + 1 : 0,
                                             static_cast<std::uint32_t>(side.side), sectors_.at(side.face, at, middle)};
      const auto [entry, fresh] = known_.try_emplace(key, probes_.size());
      if (fresh) probes_.push_back({side, t.region, inside_from(at, middle)});
      judged.probes[k] = entry->second;
    }
    if (options_.closely) {
      judged.middle = probes_.size();
      probes_.push_back({side, t.region, middle});
    }
    judged_.push_back(judged);
  }

  void light(Probe& probe, mesh::ElementId element, const LocalPass::Lamps& lamps) const {
    const double all_lux = std::max(options_.darkest_lux, solution_.illuminance_at(element, probe.at));
    const std::optional<double> lux =
        local_.by_lamps(element, probe.at, lamps, kSmallLamp * options_.tolerance * all_lux);
    probe.known = lux.has_value();
    probe.lux = lux.value_or(0.0);
  }

  [[nodiscard]] double second_difference(const Judged& judged, std::size_t edge) const {
    const Probe& a = probes_[judged.probes[edge]];
    const Probe& b = probes_[judged.probes[(edge + 1) % 3]];
    const Probe& middle = probes_[judged.probes[edge + 3]];
    if (!a.known || !b.known || !middle.known) return 0.0;
    return std::abs(middle.lux - 0.5 * (a.lux + b.lux));
  }

  /// What interpolation misses in the middle, where that is looked at.
  [[nodiscard]] double missed_inside(const Judged& judged) const {
    if (!judged.middle || !probes_[*judged.middle].known) return 0.0;
    double mean = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!probes_[judged.probes[k]].known) return 0.0;
      mean += probes_[judged.probes[k]].lux / 3.0;
    }
    return std::abs(probes_[*judged.middle].lux - mean);
  }

  /// The most light at a triangle: by lamps alone, or by all that the solution knows.
  [[nodiscard]] double light_at(const Judged& judged) const {
    double most = 0.0;
    for (const std::size_t i : judged.probes) most = std::max(most, probes_[i].lux);
    const Probe& first = probes_[judged.probes[0]];
    const mesh::ElementId element = solution_.element_at(first.side, first.region, first.at);
    return element.valid() ? std::max(most, solution_.illuminance_at(element, first.at)) : most;
  }

  const Solution& solution_;
  const LocalPass& local_;
  const mesh::Triangulation& mesh_;
  GradingOptions options_;
  std::vector<Probe> probes_;
  std::vector<Judged> judged_;
  mesh::ContactSectors sectors_;
  std::map<std::array<std::uint32_t, 5>, std::size_t> known_;
};

/// The number of triangles that a mesh of these sizes has, about.
double triangles_of(const std::vector<double>& sizes, const std::vector<double>& areas, double growth) {
  double count = 0.0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    count += std::max(1.0, areas[i] / (kUnitTriangle * growth * growth * sizes[i] * sizes[i]));
  }
  return count;
}

/// Lets all sizes grow alike until they ask for no more triangles than there may be.
void grow_to(std::size_t most, const std::vector<double>& areas, std::vector<double>& sizes) {
  const auto limit = std::max(static_cast<double>(most), 1.01 * static_cast<double>(sizes.size()));
  double growth = 1.0;
  while (triangles_of(sizes, areas, growth) > limit) growth *= 1.05;
  for (double& size : sizes) size *= growth;
}

}  // namespace

Point inside_from(const Point& edge, const Point& middle) {
  const Vector inwards = middle - edge;
  return edge + std::min(kOffEdges, kOffEdgesShare * norm(inwards)) * normalized(inwards);
}

GradedSizes graded_sizes(const Solution& solution, const LocalPass& local, const mesh::Triangulation& mesh,
                         std::span<const std::uint8_t> shown, std::span<const std::uint8_t> jumps,
                         const GradingOptions& options) {
  Judge judge(solution, local, mesh, options);
  for (std::size_t s = 0; s < shown.size(); ++s) {
    const FaceSide side = mesh::face_side(s);
    if (shown[s] != 0) judge.add_side(side, jumps[side.face.index()] != 0);
  }
  judge.light();
  GradedSizes result = judge.sizes();
  std::vector<double> areas;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array<Point, 3> c = judge.corners(t);
    areas.push_back(0.5 * norm(cross(c[1] - c[0], c[2] - c[0])));
  }
  grow_to(options.most, areas, result.longest_m);
  return result;
}

}  // namespace clerestory::lighting
