// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/shadow_regions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/discontinuity_lines.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::mesh {
namespace {

/// A lamp of 1.2 m × 0.6 m at 3 m over a floor, with a plate of 1 m × 0.8 m half way: an umbra of ±(0.4, 0.5) m, a penumbra to
/// ±(1.6, 1.1) m.
TEST(ShadowRegions, UmbraPenumbraAndLightLieWhereTheyAreConstructed) {
  Model model;
  support::add_quad(model, {-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}, {"floor", "floor"});
  support::add_quad(model, {-0.5, -0.4, 1.5}, {0.5, -0.4, 1.5}, {0.5, 0.4, 1.5}, {-0.5, 0.4, 1.5}, {"plate", "plate"});
  const Faces faces = build_faces(clean(model, {}));
  ShadowSource lamp;
  lamp.normal = {0, 0, -1};
  lamp.outline = {{{-0.6, -0.3, 3}, {0.6, -0.3, 3}, {0.6, 0.3, 3}, {-0.6, 0.3, 3}}};
  for (Point& p : lamp.outline[0]) p = p - faces.origin;

  std::vector<FaceLine> lines;
  for (const DiscontinuityLine& l : DiscontinuityFinder(faces).find(lamp, 0).lines) lines.push_back({l.face, l.ends});
  MeshOptions options;
  options.lines = lines;
  const Triangulation mesh = mesh_faces(faces, options);
  const Rays rays(faces);
  const std::vector<ShadowSource> sources{lamp};
  const std::vector<Shade> shades = shade_patches(faces, mesh, rays, sources);
  ASSERT_EQ(shades.size(), 2 * mesh.triangles.size());

  const FaceId floor = support::faces_of(faces, "floor").at(0);
  double umbra = 0.0;
  double penumbra = 0.0;
  for (std::uint32_t t = mesh.starts[floor.index()]; t < mesh.starts[floor.index() + 1]; ++t) {
    EXPECT_EQ(shades[2 * t + 1], Shade::kNone);
    const double area = support::area_of(mesh, std::span(mesh.triangles).subspan(t, 1));
    if (shades[2 * t] == Shade::kUmbra) umbra += area;
    if (shades[2 * t] == Shade::kPenumbra) penumbra += area;
  }
  EXPECT_NEAR(umbra, 0.8 * 1.0, 1e-6);
  EXPECT_NEAR(penumbra, 3.2 * 2.2 - 0.8, 1e-6);
}

}  // namespace
}  // namespace clerestory::mesh
