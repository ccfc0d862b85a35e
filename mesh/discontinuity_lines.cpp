// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/discontinuity_lines.h"

#include <limits>

#include "mesh/critical_surfaces.h"
#include "mesh/critical_trace.h"
#include "mesh/seen_edges.h"
#include "mesh/silhouettes.h"
#include "mesh/uncovering.h"

namespace clerestory::mesh {

namespace {

/// How far the source is from the occluder, along the middle of a traced piece's lines.
double source_distance(const Wedge& wedge, const TracedPiece& piece) {
  if (wedge.parallel || wedge.sky_behind) return std::numeric_limits<double>::infinity();
  const Point touch = midpoint(piece.near[0], piece.near[1]);
  if (wedge.kind == Wedge::Kind::kVertexEdge) return norm(touch - wedge.pivot);
  return norm(midpoint(wedge.edge[0], wedge.edge[1]) - touch);
}

DiscontinuityLine line_of(const Wedge& wedge, const TracedPiece& piece, std::uint32_t source, const Faces& faces) {
  DiscontinuityLine line;
  line.face = piece.face;
  line.side = piece.side;
  line.ends = piece.far;
  line.order = wedge.order;
  line.no_sky = wedge.no_sky;
  line.source = source;
  line.occluder = wedge.occluder;
  line.source_distance_m = source_distance(wedge, piece);
  line.receiver_distance_m = norm(midpoint(piece.far[0], piece.far[1]) - midpoint(piece.near[0], piece.near[1]));
  const Sight sight{midpoint(piece.far[0], piece.far[1]), midpoint(piece.near[0], piece.near[1]),
                    line.source_distance_m};
  line.uncovering = uncovering(wedge, sight, faces.faces[piece.face.index()].frame.w);
  return line;
}

}  // namespace

struct DiscontinuityFinder::Data {
  Data(const Faces& of, const DiscontinuityOptions& asked)
      : faces(of), options(asked), occluders(of, asked.passable), tracer(of, asked.passable, occluders) {}

  [[nodiscard]] bool wanted(FaceSide side) const {
    return options.receives.empty() || options.receives[side.index()] != 0;
  }

  const Faces& faces;
  DiscontinuityOptions options;
  Occluders occluders;
  WedgeTracer tracer;
};

DiscontinuityFinder::DiscontinuityFinder(const Faces& faces, const DiscontinuityOptions& options)
    : data_(std::make_unique<Data>(faces, options)) {}
DiscontinuityFinder::~DiscontinuityFinder() = default;
DiscontinuityFinder::DiscontinuityFinder(DiscontinuityFinder&&) noexcept = default;
DiscontinuityFinder& DiscontinuityFinder::operator=(DiscontinuityFinder&&) noexcept = default;

FoundLines DiscontinuityFinder::find(const ShadowSource& source, std::uint32_t number,
                                     std::size_t most_critical_surfaces) const {
  FoundLines found;
  std::vector<TracedPiece> pieces;
  const auto follow = [&](const Wedge& wedge) {
    ++found.critical_surfaces;
    pieces.clear();
    data_->tracer.trace(wedge, pieces);
    for (const TracedPiece& p : pieces) {
      if (!data_->wanted({p.face, p.side})) continue;
      found.lines.push_back(line_of(wedge, p, number, data_->faces));
      if (wedge.no_sky) found.no_sky.push_back({p.near[0], p.near[1], p.far[1], p.far[0]});
    }
  };
  std::optional<SeenEdges> seen;
  if (data_->options.rays != nullptr) seen = seen_edges(data_->occluders, source, *data_->options.rays);
  const WedgeLimit limit{most_critical_surfaces, seen ? &*seen : nullptr};
  found.stopped = !for_each_wedge(data_->occluders, source, limit, follow);
  return found;
}

std::optional<std::array<Point, 2>> cut_by_plane(const NoSkySurface& surface, const Point& origin,
                                                 const Vector& normal) {
  std::array<Point, 2> ends;
  std::size_t count = 0;
  for (std::size_t k = 0; k < surface.size() && count < 2; ++k) {
    const Point& p = surface[k];
    const Point& q = surface[(k + 1) % surface.size()];
    const double hp = dot(p - origin, normal);
    const double hq = dot(q - origin, normal);
    if ((hp > 0.0) != (hq > 0.0)) ends[count++] = p + (hp / (hp - hq)) * (q - p);
  }
  if (count < 2) return std::nullopt;
  return ends;
}

}  // namespace clerestory::mesh
