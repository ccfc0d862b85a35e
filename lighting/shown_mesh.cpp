// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/shown_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "lighting/mesh_grading.h"
#include "mesh/element_tree.h"
#include "mesh/phase_part.h"
#include "mesh/size_field.h"
#include "mesh/slits.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::FaceId;
using mesh::FaceSide;
using mesh::Point;
using mesh::Vector;

namespace {

/// Elements are not asked to be smaller than this, and lines shorter than it are left out [m].
constexpr double kFinestM = 0.1;
/// Longest edge where the solution's elements are the only bound [m].
constexpr double kNoBoundM = 1e9;
/// Lines nearer to each other are one [m]: that far a shadow's edge may lie off its place, and slivers between nearly parallel lines cost
/// more elements than they are worth.
constexpr double kLineDistanceM = 0.01;
/// What finding lines and lighting what they bound may cost follows what the solution has cost where it matters: lines, critical surfaces
/// and points of the mesh, by element of the solution there.
constexpr double kLinesPerElement = 0.05;
constexpr double kSurfacesPerElement = 1.0;
constexpr double kPointsPerElement = 0.75;
/// Surfaces without lines that are narrower than this are shown by the elements of the solution [m].
constexpr double kStripM = 0.02;
/// Sources whose lines are looked for, the strongest.
constexpr std::size_t kMostSources = 12;
/// Small scenes may have so many lines, surfaces and points all the same.
constexpr std::size_t kFewLines = 100;
constexpr std::size_t kFewSurfaces = 5000;
/// A surface whose lines would make more triangles each has fewer of them: where details or crossings crowd.
constexpr double kTrianglesPerLine = 100.0;
constexpr std::size_t kFewPoints = 4500;
/// Triangles of surfaces without lines, where the solution is small: else two a point.
constexpr std::size_t kFewTriangles = 12000;
/// Meshes are judged so often by the light of lamps, and made anew where interpolation misses too much. As long as a mesh has less than three
/// quarters of its points, it is judged more often, and more closely: what edges' middles tell may be far from what many small shadows make.
constexpr int kGradings = 2;
constexpr int kGradingsOfSmall = 4;
/// Where surfaces without lines have taken the points already, there may be so many times more for grading.
constexpr double kGradedShare = 1.5;
/// Of the time, when lines are found, and when there is a mesh of them.
constexpr double kShareOfLines = 0.5;
constexpr double kShareOfFirstMesh = 0.8;

/// The element that holds a point of a side; invalid where it carries none.
ElementId element_at(const Solution& solution, FaceSide side, const Point& point) {
  if (solution.tree().roots_of(side).size() == 1) return solution.element_at(side, 0, point);
  const ElementId node = solution.tree().find(side, point);
  return node.valid() ? solution.element_at(node, point) : node;
}

double extent(const mesh::ElementTree& tree, ElementId e, const Vector& across) {
  std::array<Point, 4> corners;
  const std::size_t count = tree.hull(e, corners);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = dot(corners[i] - tree.centroid(e), across);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return high - low;
}

/// About the longest edge of the elements at a point of a face.
double size_at(const Solution& solution, const std::vector<std::uint8_t>& shown, FaceId face, const Point& point) {
  double size = std::numeric_limits<double>::infinity();
  for (const mesh::Side side : {mesh::Side::kFront, mesh::Side::kBack}) {
    if (shown[FaceSide{face, side}.index()] == 0) continue;
    const ElementId e = element_at(solution, {face, side}, point);
    if (e.valid()) size = std::min(size, std::numbers::sqrt3 * solution.tree().radius(e));
  }
  return std::max(size, kFinestM);
}

bool matters(const ShownOptions& options, FaceSide side) {
  return options.matters.empty() || options.matters[side.index()] != 0;
}

/// How many elements lie on surfaces that matter.
double elements_that_matter(const Solution& solution, const ShownOptions& options) {
  double count = 0.0;
  for (const ElementId e : solution.elements()) count += matters(options, solution.tree().face_side(e)) ? 1.0 : 0.0;
  return count;
}

LineOptions line_options(const Solution& solution, const ShownOptions& asked, double elements) {
  LineOptions options;
  options.tolerance = asked.accuracy;
  options.most_sources = kMostSources;
  options.most_lines = std::max(kFewLines, static_cast<std::size_t>(kLinesPerElement * elements));
  options.most_critical_surfaces = std::max(kFewSurfaces, static_cast<std::size_t>(kSurfacesPerElement * elements));
  options.surroundings = [&solution, dark = asked.dark_lux](const mesh::DiscontinuityLine& line,
                                                            const Vector& across) -> LineSurroundings {
    if (norm(line.ends[1] - line.ends[0]) < kFinestM) return {};
    const Point middle = midpoint(line.ends[0], line.ends[1]);
    const ElementId e = element_at(solution, {line.face, line.side}, middle);
    if (!e.valid()) return {};
    return {extent(solution.tree(), e, across), std::max(solution.illuminance_at(e, middle), dark)};
  };
  return options;
}

/// The feet of slits on sides that are shown.
std::vector<mesh::FaceLine> feet_on(std::span<const mesh::Slit> slits, std::span<const std::uint8_t> shown) {
  std::vector<mesh::FaceLine> lines;
  for (const mesh::Slit& slit : slits) {
    if (shown[FaceSide{slit.foot.face, slit.side}.index()] != 0) lines.push_back(slit.foot);
  }
  return lines;
}

/// Meshes the faces of the lines found, and others that are shown.
/// @param finer  sizes besides those of the solution; may be null
void mesh_shown(const Solution& solution, std::span<const std::uint8_t> others, const mesh::SizeField* finer,
                ShownMesh& result) {
  const Scene& scene = solution.scene();
  result.shown.assign(2 * scene.faces.count(), 0);
  std::copy(others.begin(), others.end(), result.shown.begin());
  result.jump.assign(scene.faces.count(), 0);
  for (const mesh::DiscontinuityLine& line : result.found.lines) {
    result.shown[FaceSide{line.face, line.side}.index()] = 1;
    if (line.order == 0) result.jump[line.face.index()] = 1;
  }
  // The feet of slits, where light and dark lie side by side, are lines of the solver's mesh too.
  std::vector<mesh::FaceLine> lines = feet_on(scene.slits, result.shown);
  for (const mesh::DiscontinuityLine& line : result.found.lines) lines.push_back({line.face, line.ends});
  std::vector<std::uint8_t> wanted(scene.faces.count(), 0);
  for (std::size_t s = 0; s < result.shown.size(); ++s) wanted[mesh::face_side(s).face.index()] |= result.shown[s];
  mesh::MeshOptions options;
  options.max_size_m = kNoBoundM;
  options.line_distance_m = kLineDistanceM;
  options.wanted = wanted;
  options.lines = lines;
  options.size_at = [&](FaceId face, const Point& p) {
    const double size = size_at(solution, result.shown, face, p);
    return finer == nullptr ? size : std::min(size, finer->at(face, p));
  };
  result.mesh = mesh::mesh_faces(scene.faces, options, &result.report);
}

double perimeter(const mesh::Faces& faces, FaceId face) {
  double sum = 0.0;
  for (const auto& loop : faces.faces[face.index()].loops) {
    for (std::size_t i = 0; i < loop.size(); ++i)
      sum += norm(faces.shape.vertices[loop[(i + 1) % loop.size()]] - faces.shape.vertices[loop[i]]);
  }
  return sum;
}

/// Whether a face is a strip, for which triangles with good angles would be as many as they are small.
bool is_strip(const mesh::Faces& faces, FaceId face) {
  return faces.faces[face.index()].area_m2 < 0.5 * kStripM * perimeter(faces, face);
}

/// About the fewest triangles with good angles that a face takes: of a rectangle, two for each square of its width.
std::size_t well_shaped_triangles(const mesh::Faces& faces, FaceId face) {
  const double around = perimeter(faces, face);
  return static_cast<std::size_t>(std::max(2.0, 0.5 * around * around / faces.faces[face.index()].area_m2 - 6.0));
}

/// A side on which an element is less sure than it was asked to be.
struct UnsureSide {
  std::size_t side = 0;
  bool matters = true;
  double weight_m2 = 0.0;     ///< area, times the squared relative error of what is there
  std::size_t triangles = 0;  ///< about so many in its mesh
};

/// The sides on which elements are less sure than they were asked to be. Points of curved parts lie on their limit surface, which a mesh of
/// one facet does not know.
std::vector<UnsureSide> unsure_sides(const Solution& solution, const SolutionErrors& errors,
                                     const ShownOptions& options) {
  const Scene& scene = solution.scene();
  std::vector<UnsureSide> sides(2 * scene.faces.count());
  for (const ElementId e : solution.elements()) {
    const FaceSide side = solution.tree().face_side(e);
    if (!scene.faces.faces[side.face.index()].facets.empty()) continue;
    const double level = std::max(solution.illuminance_at(e, solution.tree().centroid(e)), options.dark_lux);
    const double error = errors.point_error(solution, e) / level;
    UnsureSide& found = sides[side.index()];
    if (error > options.accuracy) found.weight_m2 += error * error * solution.tree().area(e);
    found.triangles += solution.tree().is_triangle(e) ? 1 : solution.tree().start_triangle_count(e);
  }
  for (std::size_t s = 0; s < sides.size(); ++s) {
    sides[s].side = s;
    sides[s].matters = matters(options, mesh::face_side(s));
  }
  std::erase_if(sides, [&](const UnsureSide& s) {
    return s.weight_m2 <= 0.0 || is_strip(scene.faces, mesh::face_side(s.side).face);
  });
  for (UnsureSide& s : sides)
    s.triangles = std::max(s.triangles, well_shaped_triangles(scene.faces, mesh::face_side(s.side).face));
  return sides;
}

/// Those of them that matter first, then those that are worth most for their triangles, of which there may be so many [sides].
std::vector<std::uint8_t> unsure(const Solution& solution, const SolutionErrors& errors, const ShownOptions& options,
                                 std::size_t most_triangles) {
  std::vector<UnsureSide> sides = unsure_sides(solution, errors, options);
  std::stable_sort(sides.begin(), sides.end(), [](const UnsureSide& a, const UnsureSide& b) {
    if (a.matters != b.matters) return a.matters;
    return a.weight_m2 * static_cast<double>(b.triangles) > b.weight_m2 * static_cast<double>(a.triangles);
  });
  std::vector<std::uint8_t> found(2 * solution.scene().faces.count(), 0);
  std::size_t triangles = 0;
  for (const UnsureSide& side : sides) {
    triangles += side.triangles;
    if (triangles > most_triangles) break;
    found[side.side] = 1;
  }
  return found;
}

/// Lines of each face that are worth their triangles: all, or so many that these become few, as if their numbers grew alike.
std::vector<std::size_t> worth_it(const ShownMesh& shown) {
  std::vector<std::size_t> count(shown.jump.size(), 0);
  for (const mesh::DiscontinuityLine& line : shown.found.lines) ++count[line.face.index()];
  for (std::size_t f = 0; f < count.size(); ++f) {
    const auto triangles = static_cast<double>(shown.mesh.of(FaceId(f)).size());
    const auto lines = static_cast<double>(count[f]);
    if (triangles > kTrianglesPerLine * lines)
      count[f] = static_cast<std::size_t>(lines * kTrianglesPerLine * lines / triangles);
  }
  return count;
}

/// Keeps the weightiest lines: so many of each face, and so many in all.
void keep(std::vector<std::size_t> of_face, std::size_t in_all, SceneLines& found) {
  std::vector<mesh::DiscontinuityLine> kept;
  for (const mesh::DiscontinuityLine& line : found.lines) {
    std::size_t& left = of_face[line.face.index()];
    if (left > 0 && kept.size() < in_all) {
      --left;
      kept.push_back(line);
    } else {
      ++found.selection.over_cap;
      --found.selection.kept_count[line.order];
    }
  }
  found.lines = std::move(kept);
}

/// Leaves out the lightest lines until the mesh has no more points than it may.
void mesh_within(std::size_t most_points, const Solution& solution, ShownMesh& result, Progress& progress) {
  mesh_shown(solution, {}, nullptr, result);
  for (;;) {
    const std::vector<std::size_t> of_face = worth_it(result);
    const std::size_t worth = std::accumulate(of_face.begin(), of_face.end(), std::size_t{0});
    const std::size_t lines = result.found.lines.size();
    if (worth == lines && result.mesh.vertices.size() <= most_points) return;
    // Faces that cost too much go first; then all give.
    const double share = static_cast<double>(most_points) / static_cast<double>(result.mesh.vertices.size());
    keep(of_face, worth < lines ? lines : static_cast<std::size_t>(0.9 * share * static_cast<double>(lines)),
         result.found);
    progress.advance(kShareOfLines);
    mesh_shown(solution, {}, nullptr, result);
  }
}

/// Makes elements smaller where the light of lamps is curved, until interpolation keeps to the accuracy or the mesh has the points that it may.
void grade(std::size_t most_points, const Solution& solution, const LocalPass& local, const ShownOptions& options,
           ShownMesh& result, Progress& progress) {
  if (!local.has_lamps()) return;
  const std::vector<std::uint8_t> shown = result.shown;
  const auto is_small = [&] { return 4 * result.mesh.vertices.size() < 3 * most_points; };
  for (int i = 0; i < kGradings || (i < kGradingsOfSmall && is_small()); ++i) {
    // A triangulation has half as many points as triangles.
    const GradingOptions grading{options.accuracy, options.dark_lux, 2 * most_points, is_small()};
    GradedSizes sizes = graded_sizes(solution, local, result.mesh, shown, result.jump, grading);
    if (sizes.kept) return;
    const mesh::Triangulation judged = std::move(result.mesh);
    for (;;) {
      progress.advance(kShareOfFirstMesh);
      const mesh::SizeField field(solution.scene().faces, judged, sizes.longest_m);
      mesh_shown(solution, shown, &field, result);
      if (result.mesh.vertices.size() <= most_points) break;
      const double excess = static_cast<double>(result.mesh.vertices.size()) / static_cast<double>(most_points);
      for (double& size : sizes.longest_m) size *= 1.05 * std::sqrt(excess);
    }
  }
}

}  // namespace

ShownMesh shown_mesh(const Solution& solution, const SolutionErrors& errors, const LocalPass& local,
                     const ShownOptions& options, Progress& progress) {
  const Scene& scene = solution.scene();
  ShownMesh result;
  PhasePart finding(progress, 0.0, kShareOfLines);
  const double elements = elements_that_matter(solution, options);
  LineOptions lines = line_options(solution, options, elements);
  lines.progress = &finding;
  result.found = find_discontinuities(scene, lines);
  // Points of curved parts lie on their limit surface, where a line in the plane of one facet says little.
  std::erase_if(result.found.lines, [&](const mesh::DiscontinuityLine& line) {
    return !scene.faces.faces[line.face.index()].facets.empty();
  });
  const auto by_elements = static_cast<std::size_t>(kPointsPerElement * elements);
  const std::size_t cap = options.most_elements / 2;
  const std::size_t most_points = std::min(std::max(kFewPoints, by_elements), cap);
  const std::size_t most_triangles = std::max(kFewTriangles, 2 * by_elements);
  mesh_within(most_points, solution, result, progress);
  progress.advance(kShareOfFirstMesh);
  mesh_shown(solution, unsure(solution, errors, options, most_triangles), nullptr, result);
  if (result.mesh.triangles.size() > options.most_elements) mesh_shown(solution, {}, nullptr, result);
  const std::size_t points = result.mesh.vertices.size();
  const auto more = static_cast<std::size_t>(kGradedShare * static_cast<double>(points));
  grade(std::max(points, std::min(std::max(most_points, more), cap)), solution, local, options, result, progress);
  return result;
}

}  // namespace clerestory::lighting
