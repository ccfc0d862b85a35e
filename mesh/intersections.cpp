// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/intersections.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "mesh/coplanar.h"
#include "mesh/edge_uses.h"
#include "mesh/face_drafts.h"
#include "mesh/face_loops.h"
#include "mesh/phase_part.h"
#include "mesh/polygon_pairs.h"

namespace clerestory::mesh {

namespace {

using Kind = PolygonPair::Kind;

/// Rounding of the area of a polygon over that area, far above what sums of doubles lose.
constexpr double kAreaRounding = 1e-9;
/// Length of open edges that a polygon may get by rounding [m].
constexpr double kOpenedLength = 1e-3;
/// Shares of the time, measured on two IFC houses (clean_benchmark): of the search for pairs, and of what comes before polygons are
/// cut. Where there are no pairs the search is all.
constexpr double kShareOfSearch = 0.45;
constexpr double kShareBeforeCutting = 0.85;

std::string_view kind_of(Kind kind) {
  switch (kind) {
    case Kind::kOverlap:
      return "overlapping polygons";
    case Kind::kCrossing:
      return "intersecting polygons";
    case Kind::kSelf:
      return "self-crossing polygons";
  }
  return {};
}

DefectPlace place_of(const Soup& soup, const PolygonPair& pair) {
  const auto& [from, to] = pair.where;
  return {soup.polygons[pair.first].source, midpoint(from, to), norm(to - from)};
}

/// Which of two surfaces stays where they lie on each other: the smaller one.
class Precedence {
 public:
  Precedence(const Soup& soup, double tolerance) : area_(soup.polygons.size(), 0.0) {
    for (const CoplanarGroup& group : group_coplanar(soup, {tolerance, 1e-3, true})) {
      double sum = 0.0;
      for (const std::uint32_t p : group.polygons) sum += area(soup.points, soup.polygons[p]);
      // To the mm², so that surfaces of the same size are of the same size.
      for (const std::uint32_t p : group.polygons) area_[p] = std::round(sum * 1e6);
    }
  }

  [[nodiscard]] bool stays(std::uint32_t p, std::uint32_t other) const {
    return std::pair(area_[p], p) < std::pair(area_[other], other);
  }

 private:
  std::vector<double> area_;  ///< of each polygon's surface [mm²]
};

/// A polygon that takes part, with what happens to it.
struct Involved {
  std::uint32_t polygon = 0;
  std::optional<PlanarRegion> region;  ///< before anything was cut
  std::vector<std::uint32_t> covers;   ///< those that stay where they lie on it (index of involved)
  bool crosses_itself = false;
  bool through_slits = false;  ///< lines that end inside it part it too
  std::vector<SoupPolygon> pieces;
  double covered_area = 0.0;  ///< [m²]
  bool cut = false;           ///< the pieces take its place
  bool failed = false;        ///< pieces do not make up the polygon
};

class Cutting {
 public:
  Cutting(Soup& soup, double tolerance, const std::vector<PolygonPair>& pairs)
      : soup_(soup), pairs_(pairs), drafts_(tolerance), index_(soup.polygons.size(), kNone) {
    for (const PolygonPair& pair : pairs_) {
      involve(pair.first);
      involve(pair.second);
      if (pair.kind == Kind::kSelf) involved_[index_[pair.first]].crosses_itself = true;
    }
    assign_covers(tolerance);
    for (const PolygonPair& pair : pairs_) add_lines(pair);
    split_at_meetings(drafts_);
  }

  /// @return whether anything changed
  bool run(const std::vector<std::string>& material_names, DefectList& defects, PhasePart& progress) {
    for (std::size_t i = 0; i < involved_.size(); ++i) {
      progress.advance(i, involved_.size());
      cut(i);
    }
    cut_through_slits();
    tell(material_names, defects);
    return put_pieces();
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  void involve(std::uint32_t polygon) {
    if (index_[polygon] != kNone) return;
    index_[polygon] = static_cast<std::uint32_t>(involved_.size());
    const SoupPolygon& p = soup_.polygons[polygon];
    Involved involved;
    involved.polygon = polygon;
    involved.region = region_of(soup_, p);
    FaceDraft draft{involved.region->plane, p.material, p.back_material, p.part, {}, {}};
    for_each_edge(p, [&](std::uint32_t a, std::uint32_t b) {
      const std::uint32_t from = draft_vertex(a);
      const std::uint32_t to = draft_vertex(b);
      if (from != to) draft.boundary.push_back({from, to});
    });
    drafts_.faces.push_back(std::move(draft));
    involved_.push_back(std::move(involved));
  }

  std::uint32_t draft_vertex(std::uint32_t vertex) {
    const auto [place, fresh] = draft_of_.try_emplace(vertex, kNone);
    if (fresh) {
      place->second = drafts_.vertices.add(soup_.points[vertex]);
      if (place->second == vertex_of_.size()) vertex_of_.push_back(vertex);
    }
    return place->second;
  }

  /// The soup's vertex for one of the drafts, appended where it is new.
  std::uint32_t soup_vertex(std::uint32_t draft) {
    if (draft >= vertex_of_.size()) vertex_of_.resize(drafts_.vertices.points().size(), kNone);
    if (vertex_of_[draft] == kNone) {
      vertex_of_[draft] = static_cast<std::uint32_t>(soup_.points.size());
      soup_.points.push_back(drafts_.vertices[draft]);
    }
    return vertex_of_[draft];
  }

  void assign_covers(double tolerance) {
    const auto is_overlap = [](const PolygonPair& pair) { return pair.kind == Kind::kOverlap; };
    if (std::none_of(pairs_.begin(), pairs_.end(), is_overlap)) return;
    const Precedence precedence(soup_, tolerance);
    for (const PolygonPair& pair : pairs_) {
      if (!is_overlap(pair)) continue;
      const bool first = precedence.stays(pair.first, pair.second);
      const std::uint32_t stays = first ? pair.first : pair.second;
      involved_[index_[first ? pair.second : pair.first]].covers.push_back(index_[stays]);
      soup_.polygons[stays].covering = true;
    }
  }

  void add_lines(const PolygonPair& pair) {
    if (pair.kind == Kind::kSelf) return;
    const std::uint32_t f = index_[pair.first];
    const std::uint32_t g = index_[pair.second];
    const PlanarRegion& of_f = *involved_[f].region;
    const PlanarRegion& of_g = *involved_[g].region;
    if (pair.kind == Kind::kCrossing) {
      for (const Ends& line : crossing_stretches(of_f, of_g, drafts_.tolerance)) {
        add_line(f, line);
        add_line(g, line);
      }
      return;
    }
    for (const Ends& edge : of_g.edges) {
      for (const Ends& line : stretches_inside(of_f, edge, drafts_.tolerance)) add_line(f, line);
    }
    for (const Ends& edge : of_f.edges) {
      for (const Ends& line : stretches_inside(of_g, edge, drafts_.tolerance)) add_line(g, line);
    }
  }

  void add_line(std::uint32_t face, const Ends& line) {
    const std::uint32_t from = drafts_.add_end(line[0]);
    const std::uint32_t to = drafts_.add_end(line[1]);
    if (from != to) drafts_.faces[face].lines.push_back(edge_between(from, to));
  }

  /// Triangles of a polygon by what its lines part it into.
  std::vector<std::vector<Triangle>> parts_of(std::size_t i) {
    std::vector<Triangle> triangles;
    triangulate_face(drafts_, drafts_.faces[i], triangles);
    std::uint32_t count = 0;
    for (const Triangle& t : triangles) count = std::max(count, t.region + 1);
    std::vector<std::vector<Triangle>> parts(count);
    for (const Triangle& t : triangles) parts[t.region].push_back(t);
    return parts;
  }

  double area_of(const Triangle& t) const {
    const auto& v = drafts_.vertices;
    return 0.5 * norm(cross(v[t.vertices[1]] - v[t.vertices[0]], v[t.vertices[2]] - v[t.vertices[0]]));
  }

  /// Whether a polygon that stays lies where this part does. The part does not reach over any side of it, so that one point tells.
  bool is_covered(const Involved& own, const std::vector<Triangle>& part) const {
    const Triangle& largest = *std::max_element(
        part.begin(), part.end(), [&](const Triangle& a, const Triangle& b) { return area_of(a) < area_of(b); });
    const auto& v = drafts_.vertices;
    const Point& a = v[largest.vertices[0]];
    const Point centre = a + (1.0 / 3.0) * ((v[largest.vertices[1]] - a) + (v[largest.vertices[2]] - a));
    return std::any_of(own.covers.begin(), own.covers.end(), [&](std::uint32_t c) {
      const PlanarRegion& cover = *involved_[c].region;
      return cover.outline.winding(cover.plane.project(centre)) != 0;
    });
  }

  void cut(std::size_t i) {
    Involved& own = involved_[i];
    own.pieces.clear();
    own.covered_area = 0.0;
    double sum = 0.0;
    for (const std::vector<Triangle>& part : parts_of(i)) {
      double part_area = 0.0;
      for (const Triangle& t : part) part_area += area_of(t);
      sum += part_area;
      const bool covered = is_covered(own, part);
      if (covered) own.covered_area += part_area;
      add_pieces(own, part, covered);
    }
    own.cut = own.covered_area > 0.0 || own.pieces.size() != 1 || own.crosses_itself;
    own.failed = own.cut && !makes_up(own, sum);
    own.cut = own.cut && !own.failed;
  }

  /// Whether an area is that of a polygon, but for vertices moved by the tolerance.
  [[nodiscard]] bool makes_up(const Involved& own, double sum) const {
    const double wanted = area(soup_.points, soup_.polygons[own.polygon]);
    double perimeter = 0.0;
    for_each_edge(soup_.polygons[own.polygon],
                  [&](std::uint32_t a, std::uint32_t b) { perimeter += norm(soup_.points[b] - soup_.points[a]); });
    const double allowed = kAreaRounding * wanted + drafts_.tolerance * perimeter;
    // Of a polygon that crosses itself, lobes count against each other in its area, or twice.
    return own.crosses_itself ? sum >= 0.5 * wanted : std::abs(sum - wanted) <= allowed;
  }

  void add_pieces(Involved& own, const std::vector<Triangle>& part, bool covered) {
    SoupPolygon piece = soup_.polygons[own.polygon];
    piece.checked = false;
    piece.covered = covered;
    if (own.through_slits && has_slit(part)) {
      for (const Triangle& t : part) {
        piece.loops = {{soup_vertex(t.vertices[0]), soup_vertex(t.vertices[1]), soup_vertex(t.vertices[2])}};
        own.pieces.push_back(piece);
      }
      return;
    }
    piece.loops = boundary_loops(part);
    for (std::vector<std::uint32_t>& loop : piece.loops) {
      for (std::uint32_t& vertex : loop) vertex = soup_vertex(vertex);
    }
    // The outer loop is the one of the largest area.
    const auto outer = std::max_element(piece.loops.begin(), piece.loops.end(), [&](const auto& a, const auto& b) {
      return norm(newell(soup_.points, a)) < norm(newell(soup_.points, b));
    });
    std::iter_swap(piece.loops.begin(), outer);
    own.pieces.push_back(std::move(piece));
  }

  /// Whether a line has the part on both of its sides.
  static bool has_slit(const std::vector<Triangle>& part) {
    std::unordered_map<Edge, int, EdgeHash> sides;
    for (const Triangle& t : part) {
      for (std::size_t k = 0; k < 3; ++k) {
        if ((t.constrained >> k & 1U) == 0) continue;
        if (++sides[edge_between(t.vertices[k], t.vertices[(k + 1) % 3])] == 2) return true;
      }
    }
    return false;
  }

  /// Crossings that divide neither polygon, since they end inside both: one of the two is cut into triangles along them.
  void cut_through_slits() {
    for (const PolygonPair& pair : pairs_) {
      if (pair.kind != Kind::kCrossing) continue;
      Involved& f = involved_[index_[pair.first]];
      const Involved& g = involved_[index_[pair.second]];
      if (f.cut || g.cut || f.failed || g.failed) continue;
      f.through_slits = true;
      cut(index_[pair.first]);
    }
  }

  void tell(const std::vector<std::string>& material_names, DefectList& defects) const {
    for (const PolygonPair& pair : pairs_) {
      const Involved& f = involved_[index_[pair.first]];
      const Involved& g = involved_[index_[pair.second]];
      const DefectPlace place = place_of(soup_, pair);
      const bool first_goes = std::find(f.covers.begin(), f.covers.end(), index_[pair.second]) != f.covers.end();
      const bool mended = pair.kind == Kind::kOverlap ? !(first_goes ? f : g).failed : f.cut || g.cut;
      if (!mended) {
        defects.leave(kind_of(pair.kind), place, "its pieces would not have its area");
      } else if (pair.kind == Kind::kOverlap) {
        defects.add(kind_of(pair.kind), place, choice(first_goes ? g : f, first_goes ? f : g, material_names));
      } else {
        defects.add(kind_of(pair.kind), place);
      }
    }
  }

  /// Which material is seen from now on, where that was the question.
  [[nodiscard]] std::string choice(const Involved& stays, const Involved& goes,
                                   const std::vector<std::string>& material_names) const {
    const MaterialId kept = soup_.polygons[stays.polygon].material;
    const MaterialId cut_away = soup_.polygons[goes.polygon].material;
    if (kept == cut_away) return {};
    return material_names[kept.index()] + " kept, " + material_names[cut_away.index()] + " cut away";
  }

  bool put_pieces() {
    for (SoupPolygon& polygon : soup_.polygons) polygon.checked = true;
    std::vector<SoupPolygon> result;
    bool changed = false;
    for (std::uint32_t p = 0; p < soup_.polygons.size(); ++p) {
      if (index_[p] == kNone || !involved_[index_[p]].cut) {
        result.push_back(std::move(soup_.polygons[p]));
        continue;
      }
      changed = true;
      for (SoupPolygon& piece : involved_[index_[p]].pieces) result.push_back(std::move(piece));
    }
    soup_.polygons = std::move(result);
    return changed;
  }

  Soup& soup_;
  const std::vector<PolygonPair>& pairs_;
  FaceDrafts drafts_;
  std::vector<std::uint32_t> index_;  ///< polygon → involved
  std::vector<Involved> involved_;
  std::unordered_map<std::uint32_t, std::uint32_t> draft_of_;  ///< vertex of the soup → of the drafts
  std::vector<std::uint32_t> vertex_of_;                       ///< vertex of the drafts → of the soup
};

void leave(const Soup& soup, const PolygonPair& pair, std::string_view reason, DefectList& defects) {
  defects.leave(kind_of(pair.kind), place_of(soup, pair), reason);
}

bool are_solid(const Soup& soup, const PolygonPair& pair) {
  return soup.polygons[pair.first].outward != 0 && soup.polygons[pair.second].outward != 0;
}

/// Sets aside where two solids lie face to face. Where their faces look the same way one of them is seen twice.
void set_contacts_aside(const Soup& soup, std::vector<PolygonPair>& pairs, SolidMeetings& meetings) {
  const auto outside = [&](std::uint32_t p) {
    return static_cast<double>(soup.polygons[p].outward) * newell(soup.points, soup.polygons[p].loops[0]);
  };
  meetings.contacts += std::erase_if(pairs, [&](const PolygonPair& pair) {
    return pair.kind == Kind::kOverlap && are_solid(soup, pair) && dot(outside(pair.first), outside(pair.second)) < 0.0;
  });
}

/// Sets aside the pairs that are to be left alone.
void leave_pairs(const Soup& soup, const std::unordered_set<std::uint32_t>& left_alone, std::vector<PolygonPair>& pairs,
                 DefectList& defects, SolidMeetings& meetings) {
  std::erase_if(pairs, [&](const PolygonPair& pair) {
    const std::uint32_t source = soup.polygons[pair.first].source;
    if (!left_alone.contains(source) && !left_alone.contains(soup.polygons[pair.second].source)) return false;
    if (pair.kind == Kind::kCrossing && are_solid(soup, pair))
      ++meetings.crossings;
    else
      leave(soup, pair, "cutting there would open what is closed", defects);
    return true;
  });
}

std::unordered_map<std::uint32_t, double> open_length_by_source(const Soup& soup) {
  std::unordered_map<std::uint32_t, double> length;
  const std::vector<EdgeUse> uses = sorted_edge_uses(soup);
  for_each_edge_group(uses, [&](std::size_t first, std::size_t last) {
    std::size_t open = last;
    std::size_t left = 0;
    for (std::size_t u = first; u < last; ++u) {
      if (soup.polygons[uses[u].polygon].covered && last - first > 1) continue;
      open = u;
      ++left;
    }
    if (left != 1) return;
    const SoupPolygon& polygon = soup.polygons[uses[open].polygon];
    if (last - first > 1 && polygon.covering) return;
    length[polygon.source] += norm(soup.points[uses[first].edge[1]] - soup.points[uses[first].edge[0]]);
  });
  return length;
}

}  // namespace

bool resolve_intersections(Soup& soup, double tolerance, const std::vector<std::string>& material_names,
                           const std::unordered_set<std::uint32_t>& left_alone, DefectList& defects,
                           SolidMeetings& meetings, Progress& progress) {
  PhasePart searching(progress, 0.0, kShareOfSearch);
  std::vector<PolygonPair> pairs = find_polygon_pairs(soup, tolerance, &searching);
  set_contacts_aside(soup, pairs, meetings);
  leave_pairs(soup, left_alone, pairs, defects, meetings);
  if (pairs.empty()) {
    for (SoupPolygon& polygon : soup.polygons) polygon.checked = true;
    return false;
  }
  PhasePart cutting(progress, kShareBeforeCutting, 1.0);
  return Cutting(soup, tolerance, pairs).run(material_names, defects, cutting);
}

void leave_intersections(const Soup& soup, double tolerance, std::string_view reason, DefectList& defects,
                         SolidMeetings& meetings) {
  std::vector<PolygonPair> pairs = find_polygon_pairs(soup, tolerance);
  set_contacts_aside(soup, pairs, meetings);
  for (const PolygonPair& pair : pairs) {
    if (pair.kind == Kind::kCrossing && are_solid(soup, pair))
      ++meetings.crossings;
    else
      leave(soup, pair, reason, defects);
  }
}

std::unordered_set<std::uint32_t> opened_sources(const Soup& before, const Soup& after) {
  const std::unordered_map<std::uint32_t, double> was_open = open_length_by_source(before);
  std::unordered_set<std::uint32_t> opened;
  for (const auto& [source, length] : open_length_by_source(after)) {
    const auto was = was_open.find(source);
    if (length > (was == was_open.end() ? 0.0 : was->second) + kOpenedLength) opened.insert(source);
  }
  return opened;
}

std::unordered_set<std::uint32_t> sources_beside(const Soup& soup, const std::unordered_set<std::uint32_t>& sources) {
  std::unordered_set<std::uint32_t> result = sources;
  const std::vector<EdgeUse> uses = sorted_edge_uses(soup);
  const auto source_of = [&](std::size_t use) { return soup.polygons[uses[use].polygon].source; };
  for_each_edge_group(uses, [&](std::size_t first, std::size_t last) {
    bool beside = false;
    for (std::size_t u = first; u < last; ++u) beside = beside || sources.contains(source_of(u));
    for (std::size_t u = first; beside && u < last; ++u) result.insert(source_of(u));
  });
  return result;
}

void drop_covered(Soup& soup) {
  std::erase_if(soup.polygons, [](const SoupPolygon& polygon) { return polygon.covered; });
  for (SoupPolygon& polygon : soup.polygons) polygon.covering = false;
}

}  // namespace clerestory::mesh
