// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/limit_tessellation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include <opensubdiv/bfr/tessellation.h>

namespace clerestory::mesh {

namespace {

namespace Bfr = OpenSubdiv::Bfr;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr int kMostPieces = 256;
/// Rounds of measuring and growing; curvature is sampled, so that the first round is right as a rule.
constexpr int kMostRounds = 40;
/// Growth of a round; deviations that hardly fall need a jolt.
constexpr double kLeastGrowth = 1.1;
/// Samples may have missed what is curved: where they find nothing it is taken to use up this share of the tolerance.
constexpr double kUnseenShare = 0.05;
constexpr int kSamples = 5;  // of curvature, along an edge and each way in a patch

using Coordinates = std::array<double, 2>;

int pieces_of(double wanted) { return std::clamp(static_cast<int>(std::ceil(wanted - 1e-9)), 1, kMostPieces); }

/// Pieces for n to deviate by the tolerance: the deviation falls with the square of their number, late where creases are half sharp.
int grown(int n, double deviation, double tolerance) {
  return std::clamp(pieces_of(n * std::sqrt(deviation / tolerance)), n + (n + 3) / 4, kMostPieces);
}

double distance_from_line(const Point& p, const Point& a, const Point& b) {
  const Vector along = normalized(b - a);
  const Vector d = p - a;
  return norm(d - dot(d, along) * along);
}

/// A curve that patches share: an edge of the cage, or in a face of irregular size the line from the middle of an edge to its centre.
struct Curve {
  std::uint32_t face = 0;  ///< that it is evaluated in
  std::uint32_t side = 0;  ///< the edge, of the face
  bool spoke = false;
  std::uint32_t edge = 0;  ///< of a spoke: the curve from whose middle it starts
  bool halved = false;     ///< two patches lie along it on one of its sides, so that it needs a point in the middle
  double tolerance = std::numeric_limits<double>::infinity();
  int pieces = 1;
  std::vector<std::uint32_t> line;  ///< points along it, both ends among them
};

/// A curve as a side of a patch, or one half of it.
struct PatchSide {
  std::uint32_t curve = 0;
  bool backward = false;
  int half = -1;  ///< 0 or 1 along the curve's own direction; -1: all of it
};

struct Patch {
  std::uint32_t face = 0;
  std::vector<PatchSide> sides;
  /// Pieces wanted inside in either direction, not rounded: what is straight one way stays whole when the other way grows.
  std::array<double, 2> wanted{1.0, 1.0};

  [[nodiscard]] int inner(std::size_t k) const { return pieces_of(wanted[k]); }
};

/// Second derivatives of a patch along its normal, the largest [m].
struct Bending {
  double uu = 0.0;
  double uv = 0.0;
  double vv = 0.0;
};

/// The fewest pieces in either direction from whose triangles a patch deviates by no more than the tolerance: by up to an eighth of
/// uu/nu² + 2 uv/(nu nv) + vv/nv² [Filip, Magedson, Markot 1986]. What is straight one way stays whole that way.
std::array<double, 2> fewest_pieces(const Bending& bending, double tolerance) {
  const double allowed = 8.0 * tolerance;
  std::array<double, 2> best{kMostPieces, kMostPieces};
  for (double v = 1.0; v <= kMostPieces; v += 1.0) {
    const double left = allowed - bending.vv / (v * v);
    if (left <= 0.0) continue;
    // The root of uu x² + 2 (uv/v) x = left, x = 1/nu.
    const double half = bending.uv / v;
    const double u = pieces_of((half + std::sqrt(half * half + bending.uu * left)) / left);
    if (u * v < best[0] * best[1]) best = {u, v};
  }
  return best;
}

class Tessellator {
 public:
  Tessellator(const ControlCage& cage, const LimitSurface& surface, std::span<const double> tolerance)
      : cage_(cage), surface_(surface), tolerance_(tolerance) {}

  LimitTessellation run() {
    find_curves();
    estimate();
    for (int round = 0; round < kMostRounds; ++round) {
      build();
      if (!grow()) break;
    }
    return std::move(result_);
  }

 private:
  void find_curves();
  void add_regular(std::uint32_t face);
  void add_irregular(std::uint32_t face);
  std::uint32_t cage_curve(std::uint32_t face, std::uint32_t side, bool halved);
  [[nodiscard]] bool runs_backward(std::uint32_t face, std::uint32_t side) const {
    return cage_.corner(face, side) > cage_.corner(face, side + 1);
  }
  [[nodiscard]] bool is_regular(std::uint32_t face) const { return surface_.patch_count(face) == 1; }

  /// On a curve, t from its first to its last end.
  [[nodiscard]] Point on_curve(const Curve& curve, double t) const;
  void estimate();
  void estimate(Curve& curve) const;
  void estimate(std::uint32_t patch);
  void align();

  void build();
  void place_curve(Curve& curve);
  std::uint32_t end_point(const Curve& curve, bool last);
  void add_pieces(std::uint32_t patch);
  [[nodiscard]] std::vector<std::uint32_t> points_along(const PatchSide& side) const;
  [[nodiscard]] double deviation(const LimitTessellation::Piece& piece) const;

  bool grow();
  bool grow_curve(Curve& curve) const;

  const ControlCage& cage_;
  const LimitSurface& surface_;
  std::span<const double> tolerance_;
  std::vector<Curve> curves_;
  std::vector<Patch> patches_;
  std::unordered_map<std::uint64_t, std::uint32_t> curve_of_edge_;
  std::vector<std::uint32_t> point_of_vertex_;
  std::vector<std::uint32_t> point_of_centre_;
  LimitTessellation result_;
  std::vector<std::uint32_t> piece_patch_;
  std::vector<std::uint8_t> piece_at_side_;
};

// --- which curves there are

std::uint32_t Tessellator::cage_curve(std::uint32_t face, std::uint32_t side, bool halved) {
  const std::uint32_t a = cage_.corner(face, side);
  const std::uint32_t b = cage_.corner(face, side + 1);
  const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b);
  const auto [entry, fresh] = curve_of_edge_.try_emplace(key, static_cast<std::uint32_t>(curves_.size()));
  if (fresh) {
    Curve curve;
    curve.face = face;
    curve.side = side;
    curves_.push_back(std::move(curve));
  }
  Curve& curve = curves_[entry->second];
  curve.halved = curve.halved || halved;
  curve.tolerance = std::min(curve.tolerance, tolerance_[face]);
  return entry->second;
}

void Tessellator::add_regular(std::uint32_t face) {
  Patch patch{face, {}, {1.0, 1.0}};
  for (std::uint32_t k = 0; k < cage_.face_size(face); ++k)
    patch.sides.push_back({cage_curve(face, k, false), runs_backward(face, k), -1});
  patches_.push_back(std::move(patch));
}

void Tessellator::add_irregular(std::uint32_t face) {
  const auto n = static_cast<std::uint32_t>(cage_.face_size(face));
  std::vector<std::uint32_t> edges;
  for (std::uint32_t k = 0; k < n; ++k) edges.push_back(cage_curve(face, k, true));
  const auto first_spoke = static_cast<std::uint32_t>(curves_.size());
  for (std::uint32_t k = 0; k < n; ++k) {
    Curve spoke;
    spoke.face = face;
    spoke.side = k;
    spoke.spoke = true;
    spoke.edge = edges[k];
    spoke.tolerance = tolerance_[face];
    curves_.push_back(std::move(spoke));
  }
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t before = (k + n - 1) % n;
    const bool out_backward = runs_backward(face, k);
    const bool in_backward = runs_backward(face, before);
    patches_.push_back({face,
                        {{edges[k], out_backward, out_backward ? 1 : 0},
                         {first_spoke + k, false, -1},
                         {first_spoke + before, true, -1},
                         {edges[before], in_backward, in_backward ? 0 : 1}},
                        {1.0, 1.0}});
  }
}

void Tessellator::find_curves() {
  for (std::uint32_t f = 0; f < cage_.face_count(); ++f) {
    if (surface_.patch_count(f) == 0) continue;
    if (is_regular(f)) {
      add_regular(f);
    } else {
      add_irregular(f);
    }
  }
}

// --- how many pieces

Point Tessellator::on_curve(const Curve& curve, double t) const {
  const std::uint32_t first = surface_.first_patch(curve.face);
  if (curve.spoke) return surface_.derivatives(first + curve.side, 1.0, t).at;
  const auto face_size = static_cast<std::uint32_t>(cage_.face_size(curve.face));
  const double along = runs_backward(curve.face, curve.side) ? 1.0 - t : t;
  if (!is_regular(curve.face)) {
    if (along <= 0.5) return surface_.derivatives(first + curve.side, 2.0 * along, 0.0).at;
    return surface_.derivatives(first + (curve.side + 1) % face_size, 0.0, 2.0 - 2.0 * along).at;
  }
  constexpr std::array<Coordinates, 5> kSquare{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};
  constexpr std::array<Coordinates, 4> kTriangle{{{0, 0}, {1, 0}, {0, 1}, {0, 0}}};
  const Coordinates& a = surface_.has_triangles() ? kTriangle[curve.side] : kSquare[curve.side];
  const Coordinates& b = surface_.has_triangles() ? kTriangle[curve.side + 1] : kSquare[curve.side + 1];
  return surface_.derivatives(first, a[0] + along * (b[0] - a[0]), a[1] + along * (b[1] - a[1])).at;
}

void Tessellator::estimate(Curve& curve) const {
  // Second differences across the curve's direction.
  constexpr int kSpans = 2 * kSamples;
  std::array<Point, kSpans + 1> p;
  for (int i = 0; i <= kSpans; ++i) p[static_cast<std::size_t>(i)] = on_curve(curve, static_cast<double>(i) / kSpans);
  double most = 0.0;
  for (std::size_t i = 1; i < kSpans; ++i)
    most = std::max(most, 2.0 * distance_from_line(p[i], p[i - 1], p[i + 1]) * kSpans * kSpans);
  curve.pieces = pieces_of(std::sqrt(most / (8.0 * curve.tolerance)));
  if (curve.halved) curve.pieces = std::min(kMostPieces, 2 * ((curve.pieces + 1) / 2));
}

void Tessellator::estimate(std::uint32_t patch) {
  Bending most;
  double across = 0.0;  // along the third edge of a triangle
  for (int i = 0; i < kSamples; ++i) {
    for (int j = 0; j < kSamples; ++j) {
      Coordinates at{(i + 0.5) / kSamples, (j + 0.5) / kSamples};
      if (surface_.has_triangles() && at[0] + at[1] > 1.0) at = {1.0 - at[0], 1.0 - at[1]};
      const LimitSurface::Derivatives d = surface_.derivatives(patch, at[0], at[1]);
      const Vector normal = normalized(cross(d.du, d.dv));
      most.uu = std::max(most.uu, std::abs(dot(d.duu, normal)));
      most.uv = std::max(most.uv, std::abs(dot(d.duv, normal)));
      most.vv = std::max(most.vv, std::abs(dot(d.dvv, normal)));
      across = std::max(across, std::abs(dot(d.duu - 2.0 * d.duv + d.dvv, normal)));
    }
  }
  const double tolerance = tolerance_[patches_[patch].face];
  const double unseen = kUnseenShare * 8.0 * tolerance;
  most.uu = std::max(most.uu, unseen);
  most.vv = std::max(most.vv, unseen);
  if (surface_.has_triangles()) {
    // In the middle of a triangle whose edges bend alike.
    patches_[patch].wanted.fill(std::sqrt(std::max({most.uu, most.vv, across}) / (6.0 * tolerance)));
  } else {
    patches_[patch].wanted = fewest_pieces(most, tolerance);
  }
}

void Tessellator::estimate() {
  for (Curve& curve : curves_) estimate(curve);
  for (std::uint32_t p = 0; p < patches_.size(); ++p) estimate(p);
  align();
}

/// Edges are as dense as the coarser of the patches that they join, so that rows of pieces go through.
void Tessellator::align() {
  std::vector<int> least(curves_.size(), kMostPieces);
  for (const Patch& patch : patches_) {
    for (std::size_t k = 0; k < patch.sides.size(); ++k) {
      const int wanted = patch.inner(k % 2) * (patch.sides[k].half >= 0 ? 2 : 1);
      least[patch.sides[k].curve] = std::min(least[patch.sides[k].curve], wanted);
    }
  }
  for (std::size_t c = 0; c < curves_.size(); ++c) {
    const int wanted = curves_[c].halved ? 2 * ((least[c] + 1) / 2) : least[c];
    curves_[c].pieces = std::max(curves_[c].pieces, wanted);
  }
}

// --- points and triangles

std::uint32_t Tessellator::end_point(const Curve& curve, bool last) {
  if (curve.spoke && !last) return curves_[curve.edge].line[curves_[curve.edge].line.size() / 2];
  if (curve.spoke) {
    std::uint32_t& known = point_of_centre_[curve.face];
    if (known != kNone) return known;
    known = static_cast<std::uint32_t>(result_.points.size());
  }
  if (!curve.spoke) {
    const bool backward = runs_backward(curve.face, curve.side);
    std::uint32_t& known = point_of_vertex_[cage_.corner(curve.face, curve.side + (last != backward ? 1 : 0))];
    if (known != kNone) return known;
    known = static_cast<std::uint32_t>(result_.points.size());
  }
  result_.points.push_back(on_curve(curve, last ? 1.0 : 0.0));
  return static_cast<std::uint32_t>(result_.points.size() - 1);
}

void Tessellator::place_curve(Curve& curve) {
  curve.line.clear();
  curve.line.push_back(end_point(curve, false));
  for (int i = 1; i < curve.pieces; ++i) {
    curve.line.push_back(static_cast<std::uint32_t>(result_.points.size()));
    result_.points.push_back(on_curve(curve, static_cast<double>(i) / curve.pieces));
  }
  curve.line.push_back(end_point(curve, true));
}

std::vector<std::uint32_t> Tessellator::points_along(const PatchSide& side) const {
  const std::vector<std::uint32_t>& line = curves_[side.curve].line;
  auto begin = line.begin();
  auto end = line.end();
  const auto middle = static_cast<std::ptrdiff_t>(line.size() / 2);
  if (side.half == 0) end = begin + middle + 1;
  if (side.half == 1) begin += middle;
  std::vector<std::uint32_t> points(begin, end);
  if (side.backward) std::reverse(points.begin(), points.end());
  return points;
}

/// Which side of a patch a point of its boundary is on, and how far along [0 ... 1].
std::pair<std::size_t, double> place_on_boundary(const Coordinates& at, bool triangle) {
  constexpr double kSlack = 1e-9;
  if (at[1] < kSlack) return {0, at[0]};
  if (triangle)
    return at[0] < kSlack ? std::pair<std::size_t, double>{2, 1.0 - at[1]} : std::pair{std::size_t{1}, at[1]};
  if (at[0] > 1.0 - kSlack) return {1, at[1]};
  return at[1] > 1.0 - kSlack ? std::pair<std::size_t, double>{2, 1.0 - at[0]} : std::pair{std::size_t{3}, 1.0 - at[1]};
}

/// Pieces inside of a patch one way: as many as its edges have that way where these are not much denser, so that rows go through.
int inner_pieces(const Patch& patch, const std::vector<int>& sides, std::size_t k) {
  const int own = patch.inner(k);
  int densest = sides[k];
  if (patch.sides.size() == 4) densest = std::max(densest, sides[k + 2]);
  return densest <= 2 * own ? std::max(own, densest) : own;
}

void Tessellator::add_pieces(std::uint32_t patch) {
  const Patch& own = patches_[patch];
  const bool triangle = surface_.has_triangles();
  std::vector<std::vector<std::uint32_t>> sides;
  std::vector<int> rates;
  for (const PatchSide& side : own.sides) {
    sides.push_back(points_along(side));
    rates.push_back(static_cast<int>(sides.back().size()) - 1);
  }
  rates.push_back(inner_pieces(own, rates, 0));
  if (!triangle) rates.push_back(inner_pieces(own, rates, 1));
  const Bfr::Parameterization domain(triangle ? OpenSubdiv::Sdc::SCHEME_LOOP : OpenSubdiv::Sdc::SCHEME_CATMARK,
                                     triangle ? 3 : 4);
  const Bfr::Tessellation pattern(domain, static_cast<int>(rates.size()), rates.data());
  std::vector<Coordinates> at(static_cast<std::size_t>(pattern.GetNumCoords()));
  pattern.GetCoords(at.data()->data());
  std::vector<std::uint32_t> index;
  const auto boundary = static_cast<std::size_t>(pattern.GetNumBoundaryCoords());
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (i < boundary) {
      const auto [side, along] = place_on_boundary(at[i], triangle);
      index.push_back(sides[side][static_cast<std::size_t>(std::lround(along * rates[side]))]);
    } else {
      index.push_back(static_cast<std::uint32_t>(result_.points.size()));
      result_.points.push_back(surface_.derivatives(patch, at[i][0], at[i][1]).at);
    }
  }
  std::vector<std::array<int, 3>> facets(static_cast<std::size_t>(pattern.GetNumFacets()));
  pattern.GetFacets(facets.data()->data());
  for (const auto& corners : facets) {
    LimitTessellation::Piece piece;
    bool at_side = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = static_cast<std::size_t>(corners[k]);
      piece.corners[k] = index[corner];
      piece.on_surface.at[k] = at[corner];
      at_side = at_side || corner < boundary;
    }
    piece.on_surface.patch = patch;
    piece.face = own.face;
    piece.deviation_m = deviation(piece);
    result_.pieces.push_back(piece);
    piece_patch_.push_back(patch);
    piece_at_side_.push_back(at_side ? 1 : 0);
  }
}

double Tessellator::deviation(const LimitTessellation::Piece& piece) const {
  const Point& a = result_.points[piece.corners[0]];
  const Vector normal = normalized(cross(result_.points[piece.corners[1]] - a, result_.points[piece.corners[2]] - a));
  const auto& at = piece.on_surface.at;
  constexpr std::array<std::array<double, 3>, 4> kPlaces{
      {{0.5, 0.5, 0.0}, {0.0, 0.5, 0.5}, {0.5, 0.0, 0.5}, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}}};
  double most = 0.0;
  for (const auto& w : kPlaces) {
    const Point p = surface_
                        .derivatives(piece.on_surface.patch, w[0] * at[0][0] + w[1] * at[1][0] + w[2] * at[2][0],
                                     w[0] * at[0][1] + w[1] * at[1][1] + w[2] * at[2][1])
                        .at;
    most = std::max(most, std::abs(dot(p - a, normal)));
  }
  return most;
}

void Tessellator::build() {
  result_ = {};
  piece_patch_.clear();
  piece_at_side_.clear();
  point_of_vertex_.assign(cage_.points.size(), kNone);
  point_of_centre_.assign(cage_.face_count(), kNone);
  // Spokes start on edges.
  for (Curve& curve : curves_) {
    if (!curve.spoke) place_curve(curve);
  }
  for (Curve& curve : curves_) {
    if (curve.spoke) place_curve(curve);
  }
  for (std::uint32_t p = 0; p < patches_.size(); ++p) add_pieces(p);
}

// --- where it does not do

bool Tessellator::grow_curve(Curve& curve) const {
  double most = 0.0;
  for (int i = 0; i < curve.pieces; ++i) {
    const Point& a = result_.points[curve.line[static_cast<std::size_t>(i)]];
    const Point& b = result_.points[curve.line[static_cast<std::size_t>(i) + 1]];
    most = std::max(most, distance_from_line(on_curve(curve, (i + 0.5) / curve.pieces), a, b));
  }
  if (most <= curve.tolerance || curve.pieces >= kMostPieces) return false;
  curve.pieces = grown(curve.pieces, most, curve.tolerance);
  if (curve.halved) curve.pieces = std::min(kMostPieces, 2 * ((curve.pieces + 1) / 2));
  return true;
}

bool Tessellator::grow() {
  bool changed = false;
  for (Curve& curve : curves_) changed |= grow_curve(curve);
  std::vector<double> worst(patches_.size(), 0.0);
  std::vector<double> worst_at_side(patches_.size(), 0.0);
  for (std::size_t i = 0; i < result_.pieces.size(); ++i) {
    const std::uint32_t p = piece_patch_[i];
    worst[p] = std::max(worst[p], result_.pieces[i].deviation_m);
    if (piece_at_side_[i] != 0) worst_at_side[p] = std::max(worst_at_side[p], result_.pieces[i].deviation_m);
  }
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const double tolerance = tolerance_[patches_[p].face];
    if (worst[p] <= tolerance) continue;
    for (double& n : patches_[p].wanted) {
      if (n >= kMostPieces) continue;
      n *= std::max(kLeastGrowth, std::sqrt(worst[p] / tolerance));
      changed = true;
    }
    // Triangles between a coarse edge and a dense inside span what the edge alone does not.
    if (worst_at_side[p] <= tolerance) continue;
    for (std::size_t k = 0; k < patches_[p].sides.size(); ++k) {
      const PatchSide& side = patches_[p].sides[k];
      Curve& curve = curves_[side.curve];
      const int along = curve.pieces / (side.half >= 0 ? 2 : 1);
      const int more = curve.pieces + 2 * ((curve.pieces + 7) / 8);
      if (along < patches_[p].inner(k % 2) && more <= kMostPieces) curve.pieces = more;
    }
  }
  align();
  return changed;
}

}  // namespace

LimitTessellation tessellate(const ControlCage& cage, const LimitSurface& surface,
                             std::span<const double> tolerance_m) {
  return Tessellator(cage, surface, tolerance_m).run();
}

}  // namespace clerestory::mesh
