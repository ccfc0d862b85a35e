// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/faces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

#include "mesh/coplanar.h"
#include "mesh/curvature.h"
#include "mesh/face_drafts.h"
#include "mesh/face_loops.h"
#include "mesh/near_contacts.h"
#include "mesh/phase_part.h"
#include "mesh/polygon_defects.h"
#include "mesh/soup.h"
#include "mesh/straight_vertices.h"

namespace clerestory::mesh {

namespace {

/// Shares of the time up to the drafts and up to their contacts, measured on a city block.
constexpr double kShareOfDrafts = 0.2;
constexpr double kShareOfContacts = 0.6;

/// The soup with its vertices put into the index. Nothing moves where the surface was cleaned with a weld tolerance of at least the
/// plane tolerance; where it was not, this is what makes faces share vertices at all.
void share_vertices_of(Soup& soup, VertexIndex& vertices) {
  std::vector<std::uint32_t> index(soup.points.size());
  for (std::size_t i = 0; i < index.size(); ++i) index[i] = vertices.add(soup.points[i]);
  for (SoupPolygon& polygon : soup.polygons) {
    for (std::vector<std::uint32_t>& loop : polygon.loops) {
      for (std::uint32_t& corner : loop) corner = index[corner];
    }
  }
  soup.points.assign(vertices.points().begin(), vertices.points().end());
}

/// The plane of a group: its normal from all polygons together, through the mean of their corners along it.
PlaneCoordinates plane_of_group(const Soup& soup, const CoplanarGroup& group) {
  Vector sum;
  for (const std::uint32_t p : group.polygons) {
    for (const std::vector<std::uint32_t>& loop : soup.polygons[p].loops) sum = sum + newell(soup.points, loop);
  }
  // A bow-tie's parts cancel; its largest corner knows better.
  const bool cancels = dot(normalized(sum), group.plane.normal) < 0.5;
  const Vector normal = cancels ? group.plane.normal : normalized(sum);
  const Point& first = soup.points[soup.polygons[group.polygons[0]].loops[0][0]];
  double offset = 0.0;
  double corners = 0.0;
  for (const std::uint32_t p : group.polygons) {
    for_each_edge(soup.polygons[p], [&](std::uint32_t corner, std::uint32_t) {
      offset += dot(soup.points[corner] - first, normal);
      corners += 1.0;
    });
  }
  return {first + (offset / corners) * normal, frame_around(normal)};
}

/// Edges of the group's polygons, without those that two of them walk in opposite directions.
std::vector<DirectedEdge> boundary_of_group(const Soup& soup, const CoplanarGroup& group) {
  std::unordered_map<Edge, int, EdgeHash> net;
  const auto for_each = [&](const auto& visit) {
    for (const std::uint32_t p : group.polygons) {
      for_each_edge(soup.polygons[p], [&](std::uint32_t a, std::uint32_t b) {
        if (a != b) visit(a, b);
      });
    }
  };
  for_each([&](std::uint32_t a, std::uint32_t b) { net[edge_between(a, b)] += a < b ? 1 : -1; });
  std::vector<DirectedEdge> boundary;
  for_each([&](std::uint32_t a, std::uint32_t b) {
    int& left = net[edge_between(a, b)];
    if (left == 0 || (left > 0) != (a < b)) return;
    left += left > 0 ? -1 : 1;
    boundary.push_back({a, b});
  });
  return boundary;
}

/// A facet of a curved part belongs to a face whose plane its corners are this near to [m]: gaps that were closed moved them by up to
/// 1 mm. Panes, which were moved to the middle of their glass, are none of their surface any more.
constexpr double kStillFacet = 1.5e-3;
/// Facets that deviate by less than this from their limit surface are flat [m]: half the plane tolerance.
constexpr double kFlatFacet = 1e-5;

/// The facets that a group of polygons is made of; none where all are flat.
std::vector<std::uint32_t> facets_of(const CleanSurface& surface, const Soup& soup, const CoplanarGroup& group) {
  const Curvature* curvature = surface.polygons.curvature.get();
  std::vector<std::uint32_t> facets;
  if (curvature == nullptr) return facets;
  bool curved = false;
  for (const std::uint32_t p : group.polygons) {
    const std::uint32_t facet = curvature->facet_of[surface.source[soup.polygons[p].source]];
    if (facet == Curvature::kFlat) return {};
    const Curvature::Facet& own = curvature->facets[facet];
    for (const Point& corner : own.corners) {
      if (std::abs(group.plane.distance(corner - surface.origin)) > kStillFacet) return {};
    }
    curved = curved || own.deviation_m > kFlatFacet;
    facets.push_back(facet);
  }
  std::sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  return curved ? facets : std::vector<std::uint32_t>();
}

/// @param facets  receives those of each face
FaceDrafts draft_faces(const CleanSurface& surface, const FaceOptions& options,
                       std::vector<std::vector<std::uint32_t>>& facets) {
  FaceDrafts drafts(options.plane_tolerance_m);
  Soup soup = to_soup(surface.polygons);
  // Sides are those of the source: what the clean-up turned is turned back.
  for (std::size_t p = 0; p < surface.flipped.size(); ++p) {
    if (surface.flipped[p] != 0) flip(soup.polygons[p]);
    soup.polygons[p].back_material = surface.back_material[p];
  }
  share_vertices_of(soup, drafts.vertices);
  drop_unusable(soup);
  for (const CoplanarGroup& group :
       group_coplanar(soup, {options.plane_tolerance_m, options.angle_tolerance_rad, true})) {
    const SoupPolygon& first = soup.polygons[group.polygons[0]];
    facets.push_back(facets_of(surface, soup, group));
    drafts.faces.push_back({plane_of_group(soup, group),
                            first.material,
                            first.back_material,
                            first.part,
                            boundary_of_group(soup, group),
                            {}});
  }
  std::vector<std::uint8_t> curved;
  for (const std::vector<std::uint32_t>& own : facets) curved.push_back(own.empty() ? 0 : 1);
  drop_straight_vertices(drafts, curved);
  return drafts;
}

/// Keeps the vertices that triangles use.
void compact(std::span<const Point> points, Triangulation& shape) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> index(points.size(), kUnused);
  for (const Triangle& t : shape.triangles) {
    for (const std::uint32_t v : t.vertices) index[v] = 0;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (index[i] == kUnused) continue;
    index[i] = static_cast<std::uint32_t>(shape.vertices.size());
    shape.vertices.push_back(points[i]);
  }
  for (Triangle& t : shape.triangles) {
    for (std::uint32_t& v : t.vertices) v = index[v];
  }
}

}  // namespace

Faces build_faces(const CleanSurface& surface, const FaceOptions& options, Progress* progress) {
  NoProgress unwatched;
  PhasePart watcher(progress != nullptr ? *progress : unwatched, 0.0, 1.0);
  std::vector<std::vector<std::uint32_t>> facets;
  FaceDrafts drafts = draft_faces(surface, options, facets);
  close_near_contacts(drafts, {surface.contact_gap_m, surface.passable_materials});
  facets.resize(drafts.faces.size());
  watcher.advance(kShareOfDrafts);
  imprint_contacts(drafts);
  PhasePart triangulating(watcher, kShareOfContacts, 1.0);
  Faces result;
  result.origin = surface.origin;
  result.material_names = surface.polygons.material_names;
  result.part_names = surface.polygons.part_names;
  result.curvature = surface.polygons.curvature;
  for (std::size_t d = 0; d < drafts.faces.size(); ++d) {
    triangulating.advance(d, drafts.faces.size());
    const FaceDraft& draft = drafts.faces[d];
    const std::size_t before = result.shape.triangles.size();
    const double area = triangulate_face(drafts, draft, result.shape.triangles);
    if (result.shape.triangles.size() == before) continue;
    result.shape.starts.push_back(static_cast<std::uint32_t>(result.shape.triangles.size()));
    result.faces.push_back({draft.plane.origin,
                            draft.plane.frame,
                            area,
                            draft.material,
                            draft.back_material,
                            draft.part,
                            {},
                            std::move(facets[d])});
    result.contact_count += draft.lines.size();
  }
  compact(drafts.vertices.points(), result.shape);
  for (std::size_t f = 0; f < result.count(); ++f) result.faces[f].loops = boundary_loops(result.shape.of(FaceId(f)));
  return result;
}

std::optional<LimitPoint> Faces::limit(FaceId face, const Point& point) const {
  const std::vector<std::uint32_t>& facets = faces[face.index()].facets;
  if (facets.empty()) return std::nullopt;
  const Point at = point + origin;
  const std::uint32_t facet = facets.size() == 1 ? facets[0] : curvature->nearest(facets, at);
  LimitPoint found = curvature->limit(facet, at);
  found.at = found.at - origin;
  return found;
}

}  // namespace clerestory::mesh
