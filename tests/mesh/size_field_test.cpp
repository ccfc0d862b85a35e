// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/size_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

TEST(SizeField, GivesTheSizeOfTheTriangleAtAPoint) {
  const Faces faces = build_faces(clean(support::box_room(4, 3, 2), {}));
  const Triangulation mesh = mesh_faces(faces, {.max_size_m = 0.7});
  std::vector<double> sizes;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) sizes.push_back(1.0 + static_cast<double>(i));
  const SizeField field(faces, mesh, sizes);
  for (std::size_t f = 0; f < faces.count(); ++f) {
    for (std::size_t i = 0; i < mesh.of(FaceId(f)).size(); ++i) {
      const auto& v = mesh.of(FaceId(f))[i].vertices;
      const Point& a = mesh.vertices[v[0]];
      const Point middle = a + (mesh.vertices[v[1]] - a + (mesh.vertices[v[2]] - a)) / 3.0;
      EXPECT_EQ(field.at(FaceId(f), middle), sizes[mesh.starts[f] + i]);
    }
  }
}

TEST(SizeField, IsWithoutBoundWhereNoTriangleIs) {
  const Faces faces = build_faces(clean(support::box_room(4, 3, 2), {}));
  Triangulation none;
  none.starts.assign(faces.count() + 1, 0);
  EXPECT_TRUE(std::isinf(SizeField(faces, none, {}).at(FaceId(std::size_t{0}), faces.faces[0].origin)));
}

}  // namespace
}  // namespace clerestory::mesh
