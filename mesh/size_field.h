// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "mesh/faces.h"
#include "mesh/geometry.h"
#include "mesh/ids.h"

namespace clerestory::mesh {

/// Sizes by place: those of the triangles of a mesh, from which another is made.
class SizeField {
 public:
  /// Faces and mesh are kept by reference.
  /// @param sizes  [triangles of the mesh]
  SizeField(const Faces& faces, const Triangulation& mesh, std::vector<double> sizes);
  ~SizeField();
  SizeField(SizeField&&) noexcept;
  SizeField& operator=(SizeField&&) noexcept;

  /// The size of the triangle that holds a point in the plane of a face; infinite where none does. Safe to call from many threads.
  [[nodiscard]] double at(FaceId face, const Point& point) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace clerestory::mesh
