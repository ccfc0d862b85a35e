// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/seen_parts.h"

#include <algorithm>
#include <cmath>

namespace clerestory::mesh {

namespace {

constexpr std::size_t kMostPieces = 128;
/// Pieces compared with blockers: a louvre needs some hundreds, and in a crowd rays are quicker.
constexpr std::size_t kMostTrials = 800;
/// What reaches over a plane by less than this is on it [m]: rounding, and surfaces that touch.
constexpr double kTouch = 1e-9;

/// Points with dot(p - origin, normal) >= 0, the normal of unit length.
struct HalfSpace {
  Point origin;
  Vector normal;
};

/// What one piece becomes at a plane.
struct Halves {
  ConvexPiece inside;
  ConvexPiece outside;
};

bool add(ConvexPiece& piece, const Point& p) {
  if (piece.count == ConvexPiece::kMostCorners) return false;
  piece.corners[piece.count++] = p;
  return true;
}

/// Cuts a piece in two; nothing where one would have too many corners.
std::optional<Halves> cut(const ConvexPiece& piece, const HalfSpace& half) {
  std::array<double, ConvexPiece::kMostCorners> height{};
  for (std::size_t i = 0; i < piece.count; ++i) {
    const double h = dot(piece.corners[i] - half.origin, half.normal);
    height[i] = std::abs(h) < kTouch ? 0.0 : h;
  }
  Halves halves;
  bool fits = true;
  for (std::size_t i = 0; i < piece.count; ++i) {
    const std::size_t next = (i + 1) % piece.count;
    const Point& p = piece.corners[i];
    if (height[i] >= 0.0) fits = fits && add(halves.inside, p);
    if (height[i] <= 0.0) fits = fits && add(halves.outside, p);
    if (height[i] * height[next] < 0.0) {
      const Point q = p + height[i] / (height[i] - height[next]) * (piece.corners[next] - p);
      fits = fits && add(halves.inside, q) && add(halves.outside, q);
    }
  }
  if (!fits) return std::nullopt;
  const auto reaches = [&](double sign) {
    return std::any_of(height.begin(), height.begin() + static_cast<std::ptrdiff_t>(piece.count),
                       [sign](double h) { return sign * h > 0.0; });
  };
  // A piece that only touches the plane from one side has nothing on the other.
  if (!reaches(1.0)) halves.inside.count = 0;
  if (!reaches(-1.0)) halves.outside.count = 0;
  return halves;
}

/// What a blocker hides from a point: behind its plane, between the planes through the point and its edges. Empty: nothing.
void shadow_of(const Point& from, std::span<const Point> blocker, std::vector<HalfSpace>& shadow) {
  shadow.clear();
  Vector normal;
  for (std::size_t i = 1; i + 1 < blocker.size(); ++i)
    normal = normal + cross(blocker[i] - blocker[0], blocker[i + 1] - blocker[0]);
  normal = normalized(normal);
  const double height = dot(blocker[0] - from, normal);
  if (std::abs(height) < kTouch) return;
  const double turn = height > 0.0 ? 1.0 : -1.0;
  shadow.push_back({blocker[0], turn * normal});
  for (std::size_t i = 0; i < blocker.size(); ++i) {
    const Vector across = cross(blocker[i] - from, blocker[(i + 1) % blocker.size()] - from);
    // The point lies in line with an edge of no extent, as seen from there.
    if (norm(across) > 0.0) shadow.push_back({from, normalized(turn * across)});
  }
}

/// Whether a piece lies beyond one of a shadow's planes wholly.
bool is_beside(const ConvexPiece& piece, std::span<const HalfSpace> shadow) {
  const auto corners = std::span(piece.corners).first(piece.count);
  return std::any_of(shadow.begin(), shadow.end(), [&](const HalfSpace& half) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Point& p) { return dot(p - half.origin, half.normal) < kTouch; });
  });
}

/// Takes a shadow from each piece; false where they become too many.
bool subtract(std::vector<ConvexPiece>& pieces, std::span<const HalfSpace> shadow) {
  std::vector<ConvexPiece> left;
  left.reserve(2 * pieces.size());
  for (const ConvexPiece& piece : pieces) {
    if (is_beside(piece, shadow)) {
      left.push_back(piece);
      continue;
    }
    const std::size_t before = left.size();
    ConvexPiece rest = piece;
    for (const HalfSpace& half : shadow) {
      const auto halves = cut(rest, half);
      if (!halves) return false;
      if (halves->outside.count > 2) left.push_back(halves->outside);
      rest = halves->inside;
      if (rest.count < 3) break;
    }
    if (rest.count < 3) {
      // Past a corner of the shadow: nothing is hidden.
      left.resize(before);
      left.push_back(piece);
    }
    if (left.size() > kMostPieces) return false;
  }
  pieces = std::move(left);
  return true;
}

}  // namespace

std::span<const OutlineEdge> ConvexPiece::outline(std::array<OutlineEdge, kMostCorners>& scratch) const {
  for (std::size_t i = 0; i < count; ++i) scratch[i] = {corners[i], corners[(i + 1) % count]};
  return std::span(scratch).first(count);
}

std::optional<std::vector<ConvexPiece>> seen_parts(const Point& from, std::span<const Point> polygon,
                                                   std::span<const std::span<const Point>> blockers) {
  ConvexPiece whole;
  for (const Point& p : polygon) whole.corners[whole.count++] = p;
  std::vector<ConvexPiece> pieces{whole};
  std::vector<HalfSpace> shadow;
  std::size_t trials = 0;
  for (const auto& blocker : blockers) {
    trials += pieces.size();
    if (trials > kMostTrials) return std::nullopt;
    shadow_of(from, blocker, shadow);
    if (!shadow.empty() && !subtract(pieces, shadow)) return std::nullopt;
    if (pieces.empty()) break;
  }
  return pieces;
}

}  // namespace clerestory::mesh
