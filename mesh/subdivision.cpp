// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/subdivision.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "mesh/curvature.h"
#include "mesh/error.h"
#include "mesh/limit_tessellation.h"

namespace clerestory::mesh {

namespace {

/// The radius below which the solver splits no element [m], lighting/linker.cpp.
constexpr double kSmallestElement = 0.015;
constexpr double kFinestChord = 1e-4;  // metres
constexpr double kShareOfPart = 1.0 / 500.0;
/// OpenSubdiv's tables grow with the square of the edges at a vertex.
constexpr std::size_t kMostEdges = 1024;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return (std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b);
}

std::uint32_t line_of(const Model& model, std::size_t polygon) {
  return polygon < model.polygon_line.size() ? model.polygon_line[polygon] : 0;
}

[[noreturn]] void fail(const Model& model, std::uint32_t polygon, const std::string& what, const std::string& hint) {
  throw InputError(
      {}, line_of(model, polygon),
      fmt::format("part '{}' is a control cage, and {}", model.part_names[model.polygon_part[polygon].index()], what),
      hint);
}

/// Makes a cage of the marked polygons.
class Gathering {
 public:
  Gathering(const Model& model, std::span<const std::uint8_t> marked, std::vector<std::uint32_t>& source)
      : model_(model), marked_(marked), source_(source), owner_(model.vertices.size()) {
    std::iota(owner_.begin(), owner_.end(), 0U);
  }

  ControlCage run(SubdivisionScheme scheme, const SubdivisionRules& rules) {
    cage_.scheme = scheme;
    cage_.rules = rules;
    unite_places();
    index_.assign(model_.vertices.size(), kNone);
    for (std::uint32_t p = 0; p < model_.polygon_count(); ++p) {
      if (marked_[p] != 0) add_face(p);
    }
    check_valences();
    add_tags();
    return std::move(cage_);
  }

 private:
  std::uint32_t find(std::uint32_t v) {
    while (owner_[v] != v) v = owner_[v] = owner_[owner_[v]];
    return v;
  }

  /// Vertices of a part at one place are one.
  void unite_places() {
    std::map<std::tuple<std::uint32_t, double, double, double>, std::uint32_t> known;
    for (std::uint32_t p = 0; p < model_.polygon_count(); ++p) {
      if (marked_[p] == 0) continue;
      for (const std::uint32_t v : model_.loop(p)) {
        const Point& at = model_.vertices[v];
        const auto [entry, fresh] = known.try_emplace({model_.polygon_part[p].value, at.x, at.y, at.z}, v);
        if (!fresh) owner_[find(v)] = find(entry->second);
      }
    }
  }

  std::uint32_t point_of(std::uint32_t vertex) {
    std::uint32_t& index = index_[find(vertex)];
    if (index == kNone) {
      index = static_cast<std::uint32_t>(cage_.points.size());
      cage_.points.push_back(model_.vertices[vertex]);
    }
    return index;
  }

  void add_face(std::uint32_t polygon) {
    if (model_.loop_count(polygon) > 1)
      fail(model_, polygon, "this polygon of it has a hole", "cut the polygon into such without holes");
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t v : model_.loop(polygon)) {
      const std::uint32_t owner = find(v);
      if (corners.empty() || corners.back() != owner) corners.push_back(owner);
    }
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    // A face that has shrunk to a line shapes nothing.
    if (corners.size() < 3) return;
    check(polygon, corners);
    for (const std::uint32_t v : corners) cage_.corners.push_back(point_of(v));
    cage_.face_starts.push_back(static_cast<std::uint32_t>(cage_.corners.size()));
    source_.push_back(polygon);
  }

  void check(std::uint32_t polygon, const std::vector<std::uint32_t>& corners) const {
    if (cage_.scheme == SubdivisionScheme::kLoop && corners.size() != 3)
      fail(model_, polygon, fmt::format("Loop's scheme takes triangles, this polygon has {} corners", corners.size()),
           "give subdivision = \"catmull-clark\", or cut the cage into triangles");
    if (corners.size() > kMostEdges)
      fail(model_, polygon, fmt::format("this polygon of it has {} corners", corners.size()),
           fmt::format("cut it into polygons of at most {}", kMostEdges));
    if (std::set(corners.begin(), corners.end()).size() != corners.size())
      fail(model_, polygon, "this polygon of it comes back to a vertex", "cut the polygon there");
  }

  void check_valences() const {
    std::vector<std::uint32_t> faces(cage_.points.size(), 0);
    for (std::size_t f = 0; f < cage_.face_count(); ++f) {
      for (std::size_t k = 0; k < cage_.face_size(f); ++k) {
        if (++faces[cage_.corner(f, k)] > kMostEdges)
          fail(model_, source_[f], fmt::format("more than {} polygons meet at a vertex of this one", kMostEdges),
               "thin the cage out: its surface is smooth without");
      }
    }
  }

  void add_tags() {
    std::set<std::uint64_t> edges;
    for (std::size_t f = 0; f < cage_.face_count(); ++f) {
      for (std::size_t k = 0; k < cage_.face_size(f); ++k)
        edges.insert(edge_key(cage_.corner(f, k), cage_.corner(f, k + 1)));
    }
    for (const SubdivisionTags::Crease& crease : model_.tags.creases) {
      const std::array<std::uint32_t, 2> edge{index_[find(crease.edge[0])], index_[find(crease.edge[1])]};
      if (edges.contains(edge_key(edge[0], edge[1]))) cage_.creases.push_back({edge, crease.sharpness});
    }
    for (const SubdivisionTags::Corner& corner : model_.tags.corners) {
      const std::uint32_t vertex = index_[find(corner.vertex)];
      if (vertex != kNone) cage_.sharp_points.push_back({vertex, corner.sharpness});
    }
    std::set<std::uint32_t> holes(model_.tags.holes.begin(), model_.tags.holes.end());
    for (std::uint32_t f = 0; f < cage_.face_count(); ++f) {
      if (holes.contains(source_[f])) cage_.holes.push_back(f);
    }
  }

  const Model& model_;
  std::span<const std::uint8_t> marked_;
  std::vector<std::uint32_t>& source_;
  std::vector<std::uint32_t> owner_;
  std::vector<std::uint32_t> index_;
  ControlCage cage_;
};

SubdivisionRules rules_of(const Model& model, PartId part) {
  for (const SubdivisionTags::PartRules& told : model.tags.rules) {
    if (told.part == part) return told.rules;
  }
  return {};
}

/// Parts that make one cage.
struct CageGroup {
  SubdivisionScheme scheme = SubdivisionScheme::kCatmullClark;
  SubdivisionRules rules;
  std::vector<std::uint8_t> has_part;
};

std::vector<CageGroup> groups_of(const Model& model, std::span<const std::optional<CurvedPart>> parts) {
  std::vector<CageGroup> groups;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (!parts[p]) continue;
    const SubdivisionRules rules = rules_of(model, PartId(p));
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const CageGroup& g) { return g.scheme == parts[p]->scheme && g.rules == rules; });
    if (group == groups.end()) {
      groups.push_back({parts[p]->scheme, rules, std::vector<std::uint8_t>(parts.size(), 0)});
      group = std::prev(groups.end());
    }
    group->has_part[p] = 1;
  }
  return groups;
}

/// Replaces cages by their tessellations.
class Subdivision {
 public:
  Subdivision(const Model& model, std::span<const std::optional<CurvedPart>> parts)
      : model_(model), parts_(parts), tolerance_(parts.size(), 0.0), pieces_of_(model.polygon_count()) {}

  Model run(SubdivisionReport& report) {
    choose_tolerances();
    start_report(report);
    for (const CageGroup& group : groups_of(model_, parts_)) subdivide(group, report);
    Model result = assemble();
    result.curvature = std::move(curvature_);
    return result;
  }

 private:
  [[nodiscard]] bool is_curved(std::size_t polygon) const {
    return parts_[model_.polygon_part[polygon].index()].has_value();
  }

  void choose_tolerances() {
    std::vector<Box> boxes(parts_.size());
    for (std::size_t p = 0; p < model_.polygon_count(); ++p) {
      for (const std::uint32_t v : model_.loop(p)) boxes[model_.polygon_part[p].index()].add(model_.vertices[v]);
    }
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (parts_[p]) tolerance_[p] = parts_[p]->chord_tolerance_m.value_or(default_chord_tolerance(boxes[p]));
    }
  }

  void start_report(SubdivisionReport& report) {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (!parts_[p]) continue;
      report_index_[p] = report.parts.size();
      report.parts.push_back({PartId(p), parts_[p]->scheme, tolerance_[p]});
    }
  }

  void subdivide(const CageGroup& group, SubdivisionReport& report) {
    std::vector<std::uint8_t> marked(model_.polygon_count(), 0);
    for (std::size_t p = 0; p < marked.size(); ++p) marked[p] = group.has_part[model_.polygon_part[p].index()];
    std::vector<std::uint32_t> source;
    const ControlCage cage = gather_cage(model_, marked, group.scheme, group.rules, source);
    if (cage.face_count() == 0) return;
    LimitSurface surface(cage);
    tell_non_manifold(surface, source, report);
    std::vector<double> tolerance;
    for (const std::uint32_t polygon : source) tolerance.push_back(tolerance_[model_.polygon_part[polygon].index()]);
    LimitTessellation mesh = tessellate(cage, surface, tolerance);
    if (mesh.pieces.empty())
      fail(model_, source.front(), "its boundary rule leaves no surface at all",
           "give `t interpolateboundary 1/0/0 1`, or close the cage");
    add_up(mesh, source, report);
    keep(std::move(mesh), source);
    curvature_->surfaces.push_back(std::move(surface));
  }

  void tell_non_manifold(const LimitSurface& surface, std::span<const std::uint32_t> source,
                         SubdivisionReport& report) const {
    const auto tell = [&](const std::vector<std::uint32_t>& faces, std::string_view what) {
      if (faces.empty()) return;
      const std::uint32_t polygon = source[faces.front()];
      report.notices.push_back(fmt::format(
          "The control cage of part '{}' is no manifold: {} {}, the first in line {}. They were made "
          "sharp.",
          model_.part_names[model_.polygon_part[polygon].index()], faces.size(), what, line_of(model_, polygon)));
    };
    tell(surface.non_manifold_edges(), "edges have more than two faces, or two that run the same way");
    tell(surface.non_manifold_vertices(), "vertices join faces that share no edge");
  }

  void add_up(const LimitTessellation& mesh, std::span<const std::uint32_t> source, SubdivisionReport& report) const {
    for (const std::uint32_t polygon : source)
      ++report.parts[report_index_.at(model_.polygon_part[polygon].index())].cage_faces;
    for (const LimitTessellation::Piece& piece : mesh.pieces) {
      auto& part = report.parts[report_index_.at(model_.polygon_part[source[piece.face]].index())];
      ++part.facets;
      part.deviation_m = std::max(part.deviation_m, piece.deviation_m);
    }
  }

  /// Notes the pieces by the polygon that they replace; corners count all points of all cages.
  void keep(LimitTessellation mesh, std::span<const std::uint32_t> source) {
    const auto first = static_cast<std::uint32_t>(points_.size());
    points_.insert(points_.end(), mesh.points.begin(), mesh.points.end());
    const auto surface = static_cast<std::uint32_t>(curvature_->surfaces.size());
    for (LimitTessellation::Piece& piece : mesh.pieces) {
      for (std::uint32_t& corner : piece.corners) corner += first;
      pieces_of_[source[piece.face]].push_back({surface, piece});
    }
  }

  Model assemble() {
    Model result;
    result.material_names = model_.material_names;
    result.part_names = model_.part_names;
    std::vector<std::uint32_t> index(model_.vertices.size(), kNone);
    std::vector<std::uint32_t> index_of_point(points_.size(), kNone);
    const auto number = [&](std::uint32_t& known, const Point& p) {
      if (known == kNone) {
        known = static_cast<std::uint32_t>(result.vertices.size());
        result.vertices.push_back(p);
      }
      return known;
    };
    std::vector<std::uint32_t> corners;
    for (std::size_t p = 0; p < model_.polygon_count(); ++p) {
      const auto begin = [&] {
        result.begin_polygon(model_.polygon_material[p], model_.polygon_part[p], line_of(model_, p));
      };
      for (const auto& [surface, piece] : pieces_of_[p]) {
        begin();
        corners.clear();
        for (const std::uint32_t c : piece.corners) corners.push_back(number(index_of_point[c], points_[c]));
        result.add_loop(corners);
        curvature_->facet_of.push_back(static_cast<std::uint32_t>(curvature_->facets.size()));
        curvature_->facets.push_back({surface,
                                      piece.on_surface,
                                      {points_[piece.corners[0]], points_[piece.corners[1]], points_[piece.corners[2]]},
                                      piece.deviation_m});
      }
      if (is_curved(p)) continue;
      begin();
      curvature_->facet_of.push_back(Curvature::kFlat);
      for (std::size_t l = 0; l < model_.loop_count(p); ++l) {
        corners.clear();
        for (const std::uint32_t v : model_.loop(p, l)) corners.push_back(number(index[v], model_.vertices[v]));
        result.add_loop(corners);
      }
    }
    return result;
  }

  const Model& model_;
  std::span<const std::optional<CurvedPart>> parts_;
  std::vector<double> tolerance_;  // [parts]
  std::map<std::size_t, std::size_t> report_index_;
  std::vector<Point> points_;
  std::vector<std::vector<std::pair<std::uint32_t, LimitTessellation::Piece>>> pieces_of_;  // [polygons]
  std::shared_ptr<Curvature> curvature_ = std::make_shared<Curvature>();
};

}  // namespace

double default_chord_tolerance(const Box& part) {
  return std::clamp(kShareOfPart * part.diagonal(), kFinestChord, kSmallestElement / 4.0);
}

std::vector<bool> tagged_parts(const Model& model) {
  std::vector<bool> tagged(model.part_names.size(), false);
  const SubdivisionTags& tags = model.tags;
  if (tags.empty()) return tagged;
  for (const SubdivisionTags::PartRules& told : tags.rules) tagged[told.part.index()] = true;
  for (const std::uint32_t polygon : tags.holes) tagged[model.polygon_part[polygon].index()] = true;
  std::set<std::uint64_t> edges;
  std::set<std::uint32_t> vertices;
  for (const auto& crease : tags.creases) edges.insert(edge_key(crease.edge[0], crease.edge[1]));
  for (const auto& corner : tags.corners) vertices.insert(corner.vertex);
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    const auto loop = model.loop(p);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      if (edges.contains(edge_key(loop[k], loop[(k + 1) % loop.size()])) || vertices.contains(loop[k]))
        tagged[model.polygon_part[p].index()] = true;
    }
  }
  return tagged;
}

ControlCage gather_cage(const Model& model, std::span<const std::uint8_t> marked, SubdivisionScheme scheme,
                        const SubdivisionRules& rules, std::vector<std::uint32_t>& source) {
  return Gathering(model, marked, source).run(scheme, rules);
}

Model subdivide(const Model& model, std::span<const std::optional<CurvedPart>> parts, SubdivisionReport* report) {
  SubdivisionReport unread;
  return Subdivision(model, parts).run(report != nullptr ? *report : unread);
}

}  // namespace clerestory::mesh
