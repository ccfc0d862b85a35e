// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "mesh/faces.h"
#include "mesh/geometry.h"
#include "mesh/ids.h"

namespace clerestory::mesh {

/// Contacts that do not part a face wholly, such as the foot of a screen that stands on a floor: light jumps there, though the face goes on round
/// their ends. At a point of one, places on the two sides of it lie in different sectors.
class ContactSectors {
 public:
  explicit ContactSectors(const Faces& faces);
  ~ContactSectors();
  ContactSectors(ContactSectors&&) noexcept;
  ContactSectors& operator=(ContactSectors&&) noexcept;

  /// The sector, counted from 0, in which a place lies as seen from a point of the same face, near it: between which of the contacts and edges of
  /// the face that meet at the point. 0 at points of no such contact, at the free end of one, and on faces without any. Local coordinates [m].
  /// Safe to call from many threads.
  [[nodiscard]] std::uint32_t at(FaceId face, const Point& point, const Point& place) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace clerestory::mesh
