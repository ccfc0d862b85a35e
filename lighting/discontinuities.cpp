// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/discontinuities.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "lighting/form_factor.h"
#include "lighting/luminaire_view.h"
#include "lighting/parallel.h"
#include "mesh/element_tree.h"
#include "mesh/straight_corners.h"

namespace clerestory::lighting {

using mesh::FaceSide;
using mesh::Point;
using mesh::ShadowSource;
using mesh::Vector;

namespace {

/// Critical surfaces that are traced of any source, however weak.
constexpr std::size_t kLeastCriticalSurfaces = 200;
/// Of the time, what tracing takes.
constexpr double kShareOfTracing = 0.9;
/// Size of elements where no solution tells [m].
constexpr double kUnsolvedSizeM = 0.5;

/// The corners of a face's loops, without those between edges in line.
std::vector<std::vector<Point>> outline_of(const mesh::Faces& faces, mesh::FaceId face) {
  std::vector<std::vector<Point>> outline;
  for (const auto& loop : faces.faces[face.index()].loops) {
    std::vector<Point> all;
    for (const std::uint32_t v : loop) all.push_back(faces.shape.vertices[v]);
    std::vector<Point> corners = mesh::without_straight_corners(all);
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

/// A flat rectangular opening is as bright all over as its peak intensity tells; of other shapes it is the middle that casts shadows.
Candidate lamp(const Luminaire& luminaire) {
  Candidate candidate;
  candidate.source.power = luminaire.flux_lm();
  candidate.name = luminaire.name;
  if (const auto opening = whole_opening(luminaire)) {
    candidate.source.outline.emplace_back(opening->corners.begin(),
                                          opening->corners.begin() + static_cast<std::ptrdiff_t>(opening->count));
    candidate.source.normal = -luminaire.axes.w;
    candidate.exitance = std::numbers::pi * luminaire.peak_cd() / (luminaire.opening.x_m * luminaire.opening.y_m);
  } else {
    candidate.source.kind = ShadowSource::Kind::kPoint;
    candidate.source.at = luminaire.at;
    candidate.exitance = luminaire.peak_cd();
  }
  return candidate;
}

/// Its power is what it sends through the openings; where nothing marks these, what it sends on the whole scene.
Candidate sun_source(const Scene& scene, const Sun& sun) {
  Candidate candidate;
  candidate.source.kind = ShadowSource::Kind::kDirection;
  candidate.source.towards = sun.towards;
  candidate.exitance = sun.normal_illuminance_lux;
  candidate.name = "sun";
  double area_m2 = 0.0;
  for (const Opening& opening : scene.openings)
    area_m2 += opening.area_m2 * std::max(0.0, dot(opening.outward, sun.towards));
  const double size_m = scene.rays->bounds().diagonal();
  candidate.source.power = sun.normal_illuminance_lux * (area_m2 > 0.0 ? area_m2 : size_m * size_m);
  return candidate;
}

std::vector<Candidate> all_sources(const Scene& scene) {
  std::vector<Candidate> found;
  for (const Opening& opening : scene.openings) {
    const std::int32_t glazing = scene.glazing_of[opening.face.index()];
    const double passed =
        glazing < 0 ? 1.0 : scene.glazings[static_cast<std::size_t>(glazing)].hemispherical_transmittance;
    found.push_back(polygon(scene, {opening.face, opening.inside}, passed * scene.sky.diffuse_illuminance_lux()));
    found.back().source.sky = true;
  }
  for (std::size_t s = 0; s < 2 * scene.faces.count(); ++s) {
    const double own = luminance(scene.side_exitance(mesh::face_side(s)), scene.channel_weights);
    if (own > 0.0) found.push_back(polygon(scene, mesh::face_side(s), own));
  }
  for (const Luminaire& luminaire : scene.luminaires) found.push_back(lamp(luminaire));
  scene.sky.for_suns([&](const Sun& sun) {
    if (sun.shines()) found.push_back(sun_source(scene, sun));
  });
  std::erase_if(found, [](const Candidate& c) {
    return c.source.kind == ShadowSource::Kind::kPolygon && c.source.outline.empty();
  });
  return found;
}

/// Illuminance of a place by a source without occluders.
double unoccluded(const ShadowSources& sources, std::size_t i, const Point& at, const Vector& normal) {
  const ShadowSource& source = sources.sources[i];
  if (source.kind == ShadowSource::Kind::kDirection)
    return sources.exitance_lm_m2[i] * std::max(0.0, dot(source.towards, normal));
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

/// Of the source of a line, at its middle, without occluders [lux].
double by_source(const Scene& scene, const ShadowSources& sources, const mesh::DiscontinuityLine& line) {
  const Vector& front = scene.faces.faces[line.face.index()].frame.w;
  return unoccluded(sources, line.source, midpoint(line.ends[0], line.ends[1]),
                    line.side == mesh::Side::kFront ? front : -front);
}

/// Twice the area over the perimeter: half the side of a square, the width of a strip.
double width_of(const mesh::Faces& faces, mesh::FaceId id) {
  const mesh::Face& face = faces.faces[id.index()];
  double perimeter = 0.0;
  for (const auto& loop : face.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      perimeter += norm(faces.shape.vertices[loop[(i + 1) % loop.size()]] - faces.shape.vertices[loop[i]]);
    }
  }
  return perimeter > 0.0 ? 2.0 * face.area_m2 / perimeter : std::sqrt(face.area_m2);
}

/// The share of a line's source that a strip as wide as the occluder covers, seen from the line: a mullion hides little of a lamp.
double coverable(const Scene& scene, const ShadowSources& sources, const mesh::DiscontinuityLine& line) {
  if (line.order == 0 || std::isinf(line.source_distance_m)) return 1.0;
  const double source_width = std::sqrt(area_of(sources.sources[line.source]));
  const double shadow = width_of(scene.faces, line.occluder) * (line.source_distance_m + line.receiver_distance_m);
  return std::min(1.0, shadow / (std::max(line.receiver_distance_m, 1e-9) * source_width));
}

double extent_of(const mesh::Faces& faces, mesh::FaceId id, const Vector& across) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const auto& loop : faces.faces[id.index()].loops) {
    for (const std::uint32_t vertex : loop) {
      const double at = dot(faces.shape.vertices[vertex] - Point{}, across);
      low = std::min(low, at);
      high = std::max(high, at);
    }
  }
  return high - low;
}

/// What light and elements are like at a line where there is no solution.
LineSurroundings unsolved(const Scene& scene, const ShadowSources& sources, const mesh::DiscontinuityLine& line,
                          const Vector& across) {
  const Vector& front = scene.faces.faces[line.face.index()].frame.w;
  const Vector normal = line.side == mesh::Side::kFront ? front : -front;
  LineSurroundings result;
  result.element_size_m = std::min(kUnsolvedSizeM, extent_of(scene.faces, line.face, across));
  for (std::size_t i = 0; i < sources.sources.size(); ++i) {
    result.illuminance_lux += unoccluded(sources, i, midpoint(line.ends[0], line.ends[1]), normal);
  }
  return result;
}

/// What an interpolation over elements of a size misses at a line, as a share of the light there that is tolerated.
mesh::WeighedLine weigh(const Scene& scene, const ShadowSources& sources, const mesh::DiscontinuityLine& line,
                        const LineOptions& options) {
  const Vector& front = scene.faces.faces[line.face.index()].frame.w;
  mesh::WeighedLine weighed;
  weighed.across = cross(front, normalized(line.ends[1] - line.ends[0]));
  const LineSurroundings around = options.surroundings ? options.surroundings(line, weighed.across)
                                                       : unsolved(scene, sources, line, weighed.across);
  weighed.size_m = around.element_size_m;
  const double tolerated = around.illuminance_lux * options.tolerance;
  const double most = by_source(scene, sources, line) * coverable(scene, sources, line);
  const double jump = estimated_jump(scene, sources, line);
  weighed.missed = [order = line.order, most, jump, tolerated](double size) {
    if (tolerated <= 0.0) return 0.0;
    const double missed = order == 0 ? jump : order == 1 ? jump * size : 0.5 * jump * size * size;
    return std::min(most, missed) / tolerated;
  };
  return weighed;
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

ShadowSources shadow_sources(const Scene& scene, std::size_t most, bool without_extent) {
  std::vector<Candidate> found = all_sources(scene);
  if (without_extent)
    std::erase_if(found, [](const Candidate& c) { return c.source.kind == ShadowSource::Kind::kPolygon; });
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

double estimated_jump(const Scene& scene, const ShadowSources& sources, const mesh::DiscontinuityLine& line) {
  if (line.order == 0) return by_source(scene, sources, line);
  return sources.exitance_lm_m2[line.source] / std::numbers::pi * line.uncovering;
}

SceneLines find_discontinuities(const Scene& scene, const LineOptions& options) {
  SceneLines result;
  result.sources = shadow_sources(scene, options.most_sources, options.jumps_only);
  const std::vector<ShadowSource>& sources = result.sources.sources;
  double power = 0.0;
  for (const ShadowSource& source : sources) power += source.power;
  std::vector<mesh::FoundLines> of_source(sources.size());
  const mesh::DiscontinuityFinder finder(
      scene.faces, {.passable = scene.passable, .receives = scene.has_elements, .rays = scene.rays.get()});
  const auto should_finish = [&] { return options.progress != nullptr && options.progress->should_finish(); };
  parallel_for(of_source.size(), [&](std::size_t i) {
    if (should_finish()) return;
    const double share = static_cast<double>(options.most_critical_surfaces) * sources[i].power / power;
    of_source[i] = finder.find(sources[i], static_cast<std::uint32_t>(i),
                               std::max(kLeastCriticalSurfaces, static_cast<std::size_t>(share)));
  });
  if (options.progress != nullptr) options.progress->advance(kShareOfTracing);
  std::vector<mesh::DiscontinuityLine> all;
  std::size_t stopped = 0;
  for (const mesh::FoundLines& found : of_source) {
    all.insert(all.end(), found.lines.begin(), found.lines.end());
    result.no_sky.insert(result.no_sky.end(), found.no_sky.begin(), found.no_sky.end());
    if (found.stopped) ++stopped;
  }
  std::vector<mesh::WeighedLine> weighed(all.size());
  parallel_for(
      all.size(), [&](std::size_t i) { weighed[i] = weigh(scene, result.sources, all[i], options); }, 64);
  if (options.progress != nullptr) options.progress->advance(1.0);
  result.selection = mesh::select_lines(all, weighed, {.most = options.most_lines});
  for (const std::uint32_t i : result.selection.kept) result.lines.push_back(all[i]);
  tell(result, stopped);
  return result;
}

ElementLines element_lines(const Scene& scene, const SceneLines& found) {
  ElementLines lines;
  for (const mesh::DiscontinuityLine& line : found.lines) {
    lines.ends.push_back({line.ends[0] + scene.faces.origin, line.ends[1] + scene.faces.origin});
    lines.order.push_back(line.order);
    lines.no_sky.push_back(line.no_sky ? 1 : 0);
    lines.side.push_back(static_cast<std::uint8_t>(line.side));
    lines.source.push_back(static_cast<std::int32_t>(line.source));
    lines.occluder.push_back(static_cast<std::int32_t>(scene.faces.faces[line.occluder.index()].part.value));
    lines.part.push_back(static_cast<std::int32_t>(scene.faces.faces[line.face.index()].part.value));
  }
  lines.source_names = found.sources.names;
  lines.part_names = scene.faces.part_names;
  return lines;
}

}  // namespace clerestory::lighting
