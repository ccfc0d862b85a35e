// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace clerestory::mesh {

/// A 32-bit index that cannot be mistaken for an index of another kind.
template <class Tag>
struct Id {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t value = kNone;

  constexpr Id() = default;
  constexpr explicit Id(std::uint32_t v) : value(v) {}
  constexpr explicit Id(std::size_t v) : value(static_cast<std::uint32_t>(v)) {}

  [[nodiscard]] constexpr bool valid() const { return value != kNone; }
  [[nodiscard]] constexpr std::size_t index() const { return value; }
  constexpr auto operator<=>(const Id&) const = default;
};

using PartId = Id<struct PartTag>;
using MaterialId = Id<struct MaterialTag>;
using FaceId = Id<struct FaceTag>;
/// A node of the element tree: a group of elements of one face side, an element, or a part of one.
using ElementId = Id<struct ElementTag>;

/// The two sides of a face: front is the side from which the file's winding is counter-clockwise.
enum class Side : std::uint8_t { kFront = 0, kBack = 1 };

[[nodiscard]] constexpr Side other(Side side) { return side == Side::kFront ? Side::kBack : Side::kFront; }

/// One side of one face; index() counts 2 a face, front first.
struct FaceSide {
  FaceId face;
  Side side = Side::kFront;

  [[nodiscard]] constexpr std::size_t index() const { return 2 * face.index() + static_cast<std::size_t>(side); }
  constexpr auto operator<=>(const FaceSide&) const = default;
};

[[nodiscard]] constexpr FaceSide face_side(std::size_t index) {
  return {FaceId(index / 2), index % 2 == 0 ? Side::kFront : Side::kBack};
}

}  // namespace clerestory::mesh
