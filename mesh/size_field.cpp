// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/size_field.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "mesh/box_tree.h"
#include "mesh/planar.h"

namespace clerestory::mesh {

namespace {

/// Points on an edge belong to both triangles [m²].
constexpr double kOnEdge = 1e-12;

}  // namespace

struct SizeField::Data {
  /// Of one face.
  struct Field {
    PlaneCoordinates plane;
    BoxTree tree;  ///< of its triangles in its plane
  };

  [[nodiscard]] std::array<Point2, 3> corners(const Field& field, const Triangle& t) const {
    const auto corner = [&](std::size_t k) { return field.plane.project(mesh.vertices[t.vertices[k]]); };
    return {corner(0), corner(1), corner(2)};
  }

  const Triangulation& mesh;
  std::vector<double> sizes;
  std::vector<Field> fields;  ///< [faces]
};

SizeField::SizeField(const Faces& faces, const Triangulation& mesh, std::vector<double> sizes)
    : data_(std::make_unique<Data>(Data{mesh, std::move(sizes), {}})) {
  for (std::size_t f = 0; f < faces.count(); ++f) {
    Data::Field& field = data_->fields.emplace_back();
    field.plane = {faces.faces[f].origin, faces.faces[f].frame};
    std::vector<Box> boxes;
    for (const Triangle& t : data_->mesh.of(FaceId(f))) {
      Box& box = boxes.emplace_back();
      for (const Point2& p : data_->corners(field, t)) box.add(Point{p.x, p.y, 0.0});
    }
    field.tree = BoxTree(boxes);
  }
}

SizeField::~SizeField() = default;
SizeField::SizeField(SizeField&&) noexcept = default;
SizeField& SizeField::operator=(SizeField&&) noexcept = default;

double SizeField::at(FaceId face, const Point& point) const {
  const Data::Field& field = data_->fields[face.index()];
  const Point2 p = field.plane.project(point);
  const Box here{{p.x, p.y, 0.0}, {p.x, p.y, 0.0}};
  double size = std::numeric_limits<double>::infinity();
  field.tree.visit([&](const Box& box) { return overlap(box, here); },
                   [&](std::uint32_t i) {
                     const std::uint32_t triangle = data_->mesh.starts[face.index()] + i;
                     const auto c = data_->corners(field, data_->mesh.triangles[triangle]);
                     if (doubled_area(c[0], c[1], p) >= -kOnEdge && doubled_area(c[1], c[2], p) >= -kOnEdge &&
                         doubled_area(c[2], c[0], p) >= -kOnEdge) {
                       size = std::min(size, data_->sizes[triangle]);
                     }
                   });
  return size;
}

}  // namespace clerestory::mesh
