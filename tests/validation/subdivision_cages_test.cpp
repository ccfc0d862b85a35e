// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include "io/obj.h"
#include "mesh/curvature.h"
#include "mesh/error.h"
#include "mesh/limit_surface.h"
#include "mesh/subdivision.h"
#include "tests/support/places.h"
#include "tests/support/scratch_folder.h"

// The collected control cages: their limit surfaces against OpenSubdiv's other implementation, Far, which refines the cage and applies
// the limit masks; and what the program makes of each.
namespace clerestory {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using mesh::Point;

/// Far's primitive variables: a point, or a tangent.
struct FarPoint {
  double x = 0.0, y = 0.0, z = 0.0;
  void Clear(void* = nullptr) { x = y = z = 0.0; }
  void AddWithWeight(const FarPoint& p, double w) {
    x += w * p.x;
    y += w * p.y;
    z += w * p.z;
  }
};

/// One of its faces names a vertex twice.
bool is_refused(const std::filesystem::path& file) { return file.stem() == "catmark_nonman_edges"; }

/// All cages that are not refused.
std::vector<std::filesystem::path> cages() {
  std::vector<std::filesystem::path> files;
  const auto folder = test::shared_data_dir() / "subdivision-cages";
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".obj" && !is_refused(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

mesh::SubdivisionScheme scheme_of(const std::filesystem::path& file) {
  return file.stem().string().starts_with("loop") ? mesh::SubdivisionScheme::kLoop
                                                  : mesh::SubdivisionScheme::kCatmullClark;
}

mesh::SubdivisionRules rules_of(const mesh::Model& model) {
  return model.tags.rules.empty() ? mesh::SubdivisionRules() : model.tags.rules.front().rules;
}

mesh::ControlCage cage_of(const mesh::Model& model, mesh::SubdivisionScheme scheme) {
  std::vector<std::uint32_t> source;
  return mesh::gather_cage(model, std::vector<std::uint8_t>(model.polygon_count(), 1), scheme, rules_of(model), source);
}

Sdc::Options far_options(const mesh::SubdivisionRules& rules) {
  Sdc::Options options;
  const std::array boundary{Sdc::Options::VTX_BOUNDARY_NONE, Sdc::Options::VTX_BOUNDARY_EDGE_ONLY,
                            Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER};
  options.SetVtxBoundaryInterpolation(boundary[static_cast<std::size_t>(rules.boundary)]);
  if (rules.chaikin_creases) options.SetCreasingMethod(Sdc::Options::CREASE_CHAIKIN);
  if (rules.smooth_triangles) options.SetTriangleSubdivision(Sdc::Options::TRI_SUB_SMOOTH);
  return options;
}

std::unique_ptr<Far::TopologyRefiner> far_refiner(const mesh::ControlCage& cage) {
  std::vector<int> sizes, creases, corners, holes;
  std::vector<float> crease_weights, corner_weights;
  for (std::size_t f = 0; f < cage.face_count(); ++f) sizes.push_back(static_cast<int>(cage.face_size(f)));
  const std::vector<int> indices(cage.corners.begin(), cage.corners.end());
  for (const auto& crease : cage.creases) {
    for (const auto v : crease.edge) creases.push_back(static_cast<int>(v));
    crease_weights.push_back(crease.sharpness);
  }
  for (const auto& corner : cage.sharp_points) {
    corners.push_back(static_cast<int>(corner.vertex));
    corner_weights.push_back(corner.sharpness);
  }
  for (const auto f : cage.holes) holes.push_back(static_cast<int>(f));
  Far::TopologyDescriptor d;
  d.numVertices = static_cast<int>(cage.points.size());
  d.numFaces = static_cast<int>(sizes.size());
  d.numVertsPerFace = sizes.data();
  d.vertIndicesPerFace = indices.data();
  d.numCreases = static_cast<int>(crease_weights.size());
  d.creaseVertexIndexPairs = creases.data();
  d.creaseWeights = crease_weights.data();
  d.numCorners = static_cast<int>(corner_weights.size());
  d.cornerVertexIndices = corners.data();
  d.cornerWeights = corner_weights.data();
  d.numHoles = static_cast<int>(holes.size());
  d.holeIndices = holes.data();
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  const auto scheme = cage.scheme == mesh::SubdivisionScheme::kLoop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
  return std::unique_ptr<Far::TopologyRefiner>(Factory::Create(d, Factory::Options(scheme, far_options(cage.rules))));
}

using Coordinates = std::array<double, 2>;

/// Limit points by Far on a uniformly refined cage, with the places of the refined faces' corners. Far's limit masks know no sharpness that
/// still wanes, and take the end of a crease for smooth: such points are passed over.
class FarLimits {
 public:
  FarLimits(const mesh::ControlCage& cage, int level)
      : cage_(cage), level_(level), loop_(cage.scheme == mesh::SubdivisionScheme::kLoop), refiner_(far_refiner(cage)) {
    Far::TopologyRefiner::UniformOptions uniform(level);
    uniform.fullTopologyInLastLevel = true;
    refiner_->RefineUniform(uniform);
    const Far::PrimvarRefinerReal<double> primvars(*refiner_);
    std::vector<FarPoint> points;
    for (const Point& p : cage.points) points.push_back({p.x, p.y, p.z});
    for (int l = 1; l <= level; ++l) {
      std::vector<FarPoint> finer(static_cast<std::size_t>(refiner_->GetLevel(l).GetNumVertices()));
      primvars.Interpolate(l, points, finer);
      points = std::move(finer);
    }
    limits_.resize(points.size());
    primvars.Limit(points, limits_);
  }

  /// Calls visit(face of the cage, patch within it, u, v, limit point) for each corner of each refined face.
  template <class Visit>
  void for_each(const Visit& visit) const {
    const std::vector<Coordinates> whole = loop_ ? std::vector<Coordinates>{{0, 0}, {1, 0}, {0, 1}}
                                                 : std::vector<Coordinates>{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int f = 0; f < static_cast<int>(cage_.face_count()); ++f) {
      const auto children = refiner_->GetLevel(0).GetFaceChildFaces(f);
      if (loop_ || children.size() == 4) {
        descend(0, f, {f, 0}, whole, visit);
        continue;
      }
      // The children of an irregular face begin at its corners.
      for (int k = 0; k < children.size(); ++k) descend(1, children[k], {f, k}, whole, visit);
    }
  }

 private:
  struct Origin {
    int face = 0;
    int patch = 0;
  };

  template <class Visit>
  void descend(int level, int face, const Origin& origin, const std::vector<Coordinates>& at,
               const Visit& visit) const {
    if (level == level_) {
      const auto corners = refiner_->GetLevel(level).GetFaceVertices(face);
      for (int k = 0; k < corners.size(); ++k) {
        const FarPoint& p = limits_[static_cast<std::size_t>(corners[k])];
        const Coordinates& c = at[static_cast<std::size_t>(k)];
        if (is_settled(corners[k])) visit(origin.face, origin.patch, c[0], c[1], Point{p.x, p.y, p.z});
      }
      return;
    }
    const auto children = refiner_->GetLevel(level).GetFaceChildFaces(face);
    const auto parts = loop_ ? parts_of_triangle(at) : parts_of_square(at);
    for (int k = 0; k < children.size(); ++k)
      descend(level + 1, children[k], origin, parts[static_cast<std::size_t>(k)], visit);
  }

  static Coordinates middle(const Coordinates& a, const Coordinates& b) {
    return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
  }
  static std::vector<std::vector<Coordinates>> parts_of_triangle(const std::vector<Coordinates>& c) {
    const Coordinates ab = middle(c[0], c[1]);
    const Coordinates bc = middle(c[1], c[2]);
    const Coordinates ca = middle(c[2], c[0]);
    return {{c[0], ab, ca}, {ab, c[1], bc}, {ca, bc, c[2]}, {bc, ca, ab}};
  }
  static std::vector<std::vector<Coordinates>> parts_of_square(const std::vector<Coordinates>& c) {
    const std::array<Coordinates, 4> m{middle(c[0], c[1]), middle(c[1], c[2]), middle(c[2], c[3]), middle(c[3], c[0])};
    const Coordinates centre = middle(c[0], c[2]);
    return {
        {c[0], m[0], centre, m[3]}, {m[0], c[1], m[1], centre}, {centre, m[1], c[2], m[2]}, {m[3], centre, m[2], c[3]}};
  }

  [[nodiscard]] bool is_settled(int vertex) const {
    const Far::TopologyLevel& last = refiner_->GetLevel(level_);
    const auto wanes = [](float sharpness) { return sharpness > 0.0F && sharpness < 10.0F; };
    if (wanes(last.GetVertexSharpness(vertex))) return false;
    const auto edges = last.GetVertexEdges(vertex);
    int sharp = 0;
    for (int k = 0; k < edges.size(); ++k) {
      if (wanes(last.GetEdgeSharpness(edges[k]))) return false;
      if (last.GetEdgeSharpness(edges[k]) >= 10.0F) ++sharp;
    }
    return sharp != 1;
  }

  const mesh::ControlCage& cage_;
  int level_;
  bool loop_;
  std::unique_ptr<Far::TopologyRefiner> refiner_;
  std::vector<FarPoint> limits_;
};

/// The model of a file; of one whose MTL is not at hand, without it.
mesh::Model read_cage(const std::filesystem::path& file) {
  if (file.stem() != "loop_saddle_edgecorner") return io::read_obj(file).model;
  const test::ScratchFolder scratch;
  std::string text = test::read_text(file);
  text.replace(text.find("mtllib"), 1, "#");
  test::write_text(scratch.path() / "cage.obj", text);
  return io::read_obj(scratch.path() / "cage.obj").model;
}

double size_of(const mesh::ControlCage& cage) {
  mesh::Box box;
  for (const Point& p : cage.points) box.add(p);
  return box.diagonal();
}

class SubdivisionCages : public testing::TestWithParam<std::filesystem::path> {};
INSTANTIATE_TEST_SUITE_P(Collected, SubdivisionCages, testing::ValuesIn(cages()),
                         [](const auto& cage) { return cage.param.stem().string(); });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SubdivisionCages);

TEST_P(SubdivisionCages, LimitPointsAgreeWithFar) {
  const mesh::ControlCage cage = cage_of(read_cage(GetParam()), scheme_of(GetParam()));
  const mesh::LimitSurface surface(cage);
  double worst = 0.0;
  std::size_t count = 0;
  FarLimits(cage, 3).for_each([&](int face, int patch, double u, double v, const Point& expected) {
    if (surface.patch_count(static_cast<std::size_t>(face)) == 0) return;
    const auto first = surface.first_patch(static_cast<std::size_t>(face));
    const mesh::LimitPoint own = surface.at(first + static_cast<std::uint32_t>(patch), u, v);
    worst = std::max(worst, norm(own.at - expected));
    EXPECT_NEAR(norm(own.normal), 1.0, 1e-9);
    ++count;
  });
  EXPECT_GT(count, 0U);
  EXPECT_LT(worst, 1e-6 * size_of(cage));
}

TEST_P(SubdivisionCages, AreTessellatedWithinTheTolerance) {
  const mesh::Model model = read_cage(GetParam());
  const std::vector<std::optional<mesh::CurvedPart>> parts(model.part_names.size(),
                                                           mesh::CurvedPart{scheme_of(GetParam()), {}});
  mesh::SubdivisionReport report;
  const mesh::Model curved = mesh::subdivide(model, parts, &report);
  EXPECT_GT(curved.polygon_count(), 0U);
  EXPECT_EQ(curved.polygon_count(), curved.curvature->facets.size());
  for (const auto& part : report.parts) EXPECT_LE(part.deviation_m, part.chord_tolerance_m);
  const bool torn = GetParam().stem() == "catmark_nonman_verts" || GetParam().stem() == "catmark_fan";
  EXPECT_EQ(report.notices.size(), torn ? 1U : 0U);
  EXPECT_THAT(report.notices, testing::Each(testing::HasSubstr("no manifold")));
}

TEST(SubdivisionCage, ThatNamesAVertexTwiceIsRefusedWithItsLine) {
  CLERESTORY_NEEDS_SHARED_DATA("subdivision-cages");
  const mesh::Model model = io::read_obj(test::shared_data_dir() / "subdivision-cages/catmark_nonman_edges.obj").model;
  try {
    mesh::subdivide(model, std::vector<std::optional<mesh::CurvedPart>>(model.part_names.size(), mesh::CurvedPart{}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.line(), 308U);
    EXPECT_THAT(error.problem(), testing::HasSubstr("comes back to a vertex"));
  }
}

}  // namespace
}  // namespace clerestory
