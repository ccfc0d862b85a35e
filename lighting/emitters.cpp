// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/emitters.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "lighting/form_factor.h"
#include "mesh/straight_corners.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;
using mesh::Visibility;

namespace {

/// The corners of an outline in turn, without those that lie on a straight edge; none where it is more than one loop.
std::vector<Point> corners_of(std::span<const mesh::OutlineEdge> outline) {
  std::vector<Point> loop;
  std::vector<std::uint8_t> taken(outline.size(), 0);
  Point at = outline.front().from;
  for (std::size_t n = 0; n < outline.size(); ++n) {
    std::size_t next = 0;
    while (next < outline.size() && (taken[next] != 0 || !(outline[next].from == at))) ++next;
    if (next == outline.size()) return {};
    taken[next] = 1;
    loop.push_back(at);
    at = outline[next].to;
  }
  return mesh::without_straight_corners(loop);
}

std::vector<mesh::ShaftEnd> pieces_of(const mesh::ElementTree& tree, ElementId root) {
  /// Outlines of more edges have more corners than a shaft's end can have, but for collinear ones.
  constexpr std::size_t kMostEdges = 64;
  const Vector& normal = tree.normal(root);
  const mesh::FaceId face = tree.face_side(root).face;
  std::array<mesh::OutlineEdge, 3> scratch;
  const auto outline = tree.outline(root, scratch);
  if (outline.size() <= kMostEdges) {
    const std::vector<Point> corners = corners_of(outline);
    mesh::ShaftEnd whole{.corners = {}, .count = corners.size(), .normal = normal, .face = face};
    if (corners.size() <= whole.corners.size() && mesh::is_convex(corners, normal)) {
      std::copy(corners.begin(), corners.end(), whole.corners.begin());
      return {whole};
    }
  }
  std::vector<mesh::ShaftEnd> pieces;
  for (const std::array<Point, 3>& t : tree.triangles(root))
    pieces.push_back({.corners = {t[0], t[1], t[2]}, .count = t.size(), .normal = normal, .face = face});
  return pieces;
}

}  // namespace

std::vector<Emitter> emitters(const Solution& solution) {
  std::vector<Emitter> found;
  const Scene& scene = solution.scene();
  for (const ElementId root : solution.tree().roots()) {
    const double exitance = luminance(scene.side_exitance(solution.tree().face_side(root)), scene.channel_weights);
    if (exitance > 0.0)
      found.push_back({root, exitance, mesh::shaft_end(solution.tree(), root), pieces_of(solution.tree(), root)});
  }
  return found;
}

double full_factor(const Solution& solution, const Emitter& emitter, const Point& at, const Receiver& receiver) {
  std::array<mesh::OutlineEdge, 3> scratch;
  return receiver.form_factor(at, solution.tree().outline(emitter.root, scratch), emitter.end.normal);
}

SeenFactor seen_factor(const Solution& solution, const Emitter& emitter, double full, const Point& at,
                       const Receiver& receiver) {
  if (full <= 0.0) return {};
  const mesh::Shafts& shafts = *solution.scene().shafts;
  if (emitter.pieces.size() > 1) {
    const Visibility whole = shafts.classify(mesh::point_end(at), emitter.end);
    if (whole == Visibility::kHidden) return {};
    if (whole == Visibility::kVisible) return {full, true};
  }
  SeenFactor sum;
  for (const mesh::ShaftEnd& piece : emitter.pieces) {
    const SeenFactor seen = seen_factor(shafts, at, receiver, piece);
    sum = {sum.factor + seen.factor, sum.exact && seen.exact};
  }
  return sum;
}

std::vector<EmitterInSight> in_sight(const Solution& solution, std::span<const Emitter> emitters,
                                     std::span<const std::uint32_t> asked, const mesh::ShaftEnd& from) {
  std::vector<EmitterInSight> found;
  for (const std::uint32_t i : asked) {
    const Emitter& emitter = emitters[i];
    const Visibility seen = solution.scene().shafts->classify(from, emitter.end);
    if (seen != Visibility::kHidden) found.push_back({&emitter, seen == Visibility::kVisible});
  }
  return found;
}

EmitterSample sample(const Solution& solution, const Emitter& emitter, const Point& at, const Receiver& receiver,
                     double a, double b) {
  const Point q = solution.tree().sample(emitter.root, a, b);
  const Vector to = q - at;
  const double distance2 = dot(to, to);
  const double kernel =
      std::max(0.0, receiver.kernel(to)) * std::max(0.0, -dot(to, emitter.end.normal)) / (distance2 * distance2);
  if (kernel <= 0.0) return {};
  const mesh::Segment segment{at, q + solution.scene().rays->offset_m() * emitter.end.normal};
  float passed = 0.0F;
  solution.scene().rays->transmittance({&segment, 1}, {&passed, 1});
  return {kernel, passed};
}

}  // namespace clerestory::lighting
