// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/discontinuities.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "lighting/form_factor.h"
#include "lighting/parallel.h"
#include "mesh/element_tree.h"

namespace clerestory::lighting {

using mesh::FaceSide;
using mesh::Point;
using mesh::ShadowSource;
using mesh::Vector;

namespace {

/// Edges that turn by less are one edge [rad].
constexpr double kStraight = 1e-6;
/// Critical surfaces of a source that are traced: some two CPU seconds in a house with furniture.
constexpr std::size_t kMostCriticalSurfaces = 20000;

/// The corners of a face's loops, without those between edges in line.
std::vector<std::vector<Point>> outline_of(const mesh::Faces& faces, mesh::FaceId face) {
  std::vector<std::vector<Point>> outline;
  for (const auto& loop : faces.faces[face.index()].loops) {
    std::vector<Point> corners;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point& before = faces.shape.vertices[loop[(i + loop.size() - 1) % loop.size()]];
      const Point& p = faces.shape.vertices[loop[i]];
      const Point& after = faces.shape.vertices[loop[(i + 1) % loop.size()]];
      if (norm(cross(normalized(p - before), normalized(after - p))) > kStraight) corners.push_back(p);
    }
    if (corners.size() > 2) outline.push_back(std::move(corners));
  }
  return outline;
}

/// A source with what is known of it.
struct Candidate {
  ShadowSource source;
  std::string name;
  double exitance = 0.0;
};

Candidate polygon(const Scene& scene, FaceSide side, double exitance) {
  const mesh::Face& face = scene.faces.faces[side.face.index()];
  Candidate candidate;
  candidate.source.outline = outline_of(scene.faces, side.face);
  candidate.source.normal = side.side == mesh::Side::kFront ? face.frame.w : -face.frame.w;
  candidate.source.power = exitance * face.area_m2;
  candidate.exitance = exitance;
  candidate.name = scene.faces.part_names[face.part.index()];
  return candidate;
}

std::vector<Candidate> all_sources(const Scene& scene) {
  std::vector<Candidate> found;
  for (const Opening& opening : scene.openings) {
    const std::int32_t glazing = scene.glazing_of[opening.face.index()];
    const double passed =
        glazing < 0 ? 1.0 : scene.glazings[static_cast<std::size_t>(glazing)].hemispherical_transmittance;
    found.push_back(polygon(scene, {opening.face, opening.inside}, passed * scene.sky.horizontal_illuminance_lux));
    found.back().source.sky = true;
  }
  for (std::size_t s = 0; s < 2 * scene.faces.count(); ++s) {
    const double own = luminance(scene.side_exitance(mesh::face_side(s)), scene.channel_weights);
    if (own > 0.0) found.push_back(polygon(scene, mesh::face_side(s), own));
  }
  for (const PointSource& point : scene.point_sources) {
    Candidate candidate;
    candidate.source.kind = ShadowSource::Kind::kPoint;
    candidate.source.at = point.at;
    candidate.source.power = (point.lambertian ? 1.0 : 4.0) * std::numbers::pi * point.intensity_cd;
    candidate.exitance = point.intensity_cd;
    candidate.name = "point source";
    found.push_back(std::move(candidate));
  }
  std::erase_if(found, [](const Candidate& c) {
    return c.source.kind == ShadowSource::Kind::kPolygon && c.source.outline.empty();
  });
  return found;
}

/// Illuminance of a place by a source without occluders.
double unoccluded(const ShadowSources& sources, std::size_t i, const Point& at, const Vector& normal) {
  const ShadowSource& source = sources.sources[i];
  if (source.kind == ShadowSource::Kind::kPoint) {
    const Vector to = source.at - at;
    const double squared = dot(to, to);
    return sources.exitance_lm_m2[i] * std::max(0.0, dot(to, normal)) / (squared * std::sqrt(squared));
  }
  std::vector<mesh::OutlineEdge> edges;
  for (const std::vector<Point>& loop : source.outline) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      edges.push_back({loop[k], loop[(k + 1) % loop.size()]});
    }
  }
  // Loops run about the front of their face, which may be the dark side: the factor then has the other sign.
  const double along = point_form_factor(at, normal, edges, source.normal);
  for (mesh::OutlineEdge& e : edges) std::swap(e.from, e.to);
  return sources.exitance_lm_m2[i] * std::max(along, point_form_factor(at, normal, edges, source.normal));
}

double area_of(const ShadowSource& source) {
  Vector doubled;
  for (const std::vector<Point>& loop : source.outline) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      doubled = doubled + cross(loop[k] - source.outline[0][0], loop[(k + 1) % loop.size()] - source.outline[0][0]);
    }
  }
  return 0.5 * norm(doubled);
}

/// The share of a source that comes out from behind the occluder per metre across the line [1/m]. Behind what stands outdoors moves the
/// sky, as seen through the opening.
double uncovering(const mesh::DiscontinuityLine& line, const ShadowSource& source) {
  const double width = std::sqrt(area_of(source));
  if (std::isinf(line.source_distance_m)) return 1.0 / width;
  return line.source_distance_m / (std::max(line.receiver_distance_m, 1e-9) * width);
}

/// What an interpolation across the line misses, as a share of the illuminance there.
double missed_share(const SceneLines& found, const Scene& scene, const mesh::DiscontinuityLine& line, double size) {
  const Point at = midpoint(line.ends[0], line.ends[1]);
  const Vector& front = scene.faces.faces[line.face.index()].frame.w;
  const Vector normal = line.side == mesh::Side::kFront ? front : -front;
  double total = 0.0;
  for (std::size_t i = 0; i < found.sources.sources.size(); ++i) total += unoccluded(found.sources, i, at, normal);
  const double own = unoccluded(found.sources, line.source, at, normal);
  if (total <= 0.0) return 0.0;
  if (line.order == 0) return own / total;
  const double share = uncovering(line, found.sources.sources[line.source]) * size;
  return own / total * std::min(1.0, line.order == 1 ? share : 0.5 * share * share);
}

void tell(SceneLines& found, std::size_t stopped) {
  if (found.sources.left_out > 0) {
    found.notices.push_back(fmt::format("shadow lines are those of the {} strongest sources; {} weaker ones have none",
                                        found.sources.sources.size(), found.sources.left_out));
  }
  if (stopped > 0) {
    found.notices.push_back(fmt::format(
        "{} sources have more critical surfaces than are traced: some of their shadow lines are missing", stopped));
  }
  if (found.selection.over_cap > 0) {
    found.notices.push_back(
        fmt::format("{} surfaces have more shadow lines than are kept: {} of the lightest are left out",
                    found.selection.cap_faces.size(), found.selection.over_cap));
  }
}

}  // namespace

ShadowSources shadow_sources(const Scene& scene, std::size_t most) {
  std::vector<Candidate> found = all_sources(scene);
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.source.power > b.source.power; });
  ShadowSources result;
  if (found.size() > most) {
    result.left_out = found.size() - most;
    found.resize(most);
  }
  for (Candidate& candidate : found) {
    result.sources.push_back(std::move(candidate.source));
    result.names.push_back(std::move(candidate.name));
    result.exitance_lm_m2.push_back(candidate.exitance);
  }
  return result;
}

SceneLines find_discontinuities(const Scene& scene, double tolerance, double element_size_m) {
  SceneLines result;
  result.sources = shadow_sources(scene);
  const mesh::DiscontinuityFinder finder(scene.faces, {.passable = scene.passable,
                                                       .receives = scene.has_elements,
                                                       .most_critical_surfaces = kMostCriticalSurfaces,
                                                       .rays = scene.rays.get()});
  std::vector<mesh::FoundLines> of_source(result.sources.sources.size());
  parallel_for(of_source.size(), [&](std::size_t i) {
    of_source[i] = finder.find(result.sources.sources[i], static_cast<std::uint32_t>(i));
  });
  std::vector<mesh::DiscontinuityLine> all;
  std::size_t stopped = 0;
  for (const mesh::FoundLines& found : of_source) {
    all.insert(all.end(), found.lines.begin(), found.lines.end());
    result.no_sky.insert(result.no_sky.end(), found.no_sky.begin(), found.no_sky.end());
    if (found.stopped) ++stopped;
  }
  std::vector<double> missed(all.size());
  parallel_for(
      all.size(), [&](std::size_t i) { missed[i] = missed_share(result, scene, all[i], element_size_m); }, 64);
  const mesh::DiscontinuityLine* const first = all.data();
  result.selection = mesh::select_lines(all, [&](const mesh::DiscontinuityLine& line) {
    return missed[static_cast<std::size_t>(&line - first)] / tolerance;
  });
  for (const std::uint32_t i : result.selection.kept) result.lines.push_back(all[i]);
  tell(result, stopped);
  return result;
}

}  // namespace clerestory::lighting
