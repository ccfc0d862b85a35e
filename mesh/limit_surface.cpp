// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/limit_surface.h"

#include <cassert>
#include <limits>
#include <mutex>

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/far/error.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

namespace clerestory::mesh {

namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

/// Steps of refinement after which Bfr replaces the surface round an irregular vertex by a Gregory patch. Its error falls by half to
/// two thirds with each step; at 8 it is below 1e-7 of a face's size (tests/mesh/limit_surface_test.cpp).
constexpr int kIrregularLevels = 8;
/// OpenSubdiv's sharpness for ever, Sdc::Crease::SHARPNESS_INFINITE.
constexpr int kSharpLevels = 10;
/// How far into its patch a normal is taken where the surface has none, at a pole.
constexpr double kIntoPatch = 1e-4;

Sdc::Options options_of(const SubdivisionRules& rules) {
  Sdc::Options options;
  using Boundary = SubdivisionRules::Boundary;
  switch (rules.boundary) {
    case Boundary::kNone:
      options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_NONE);
      break;
    case Boundary::kEdgeOnly:
      options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
      break;
    case Boundary::kEdgeAndCorner:
      options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
      break;
  }
  options.SetCreasingMethod(rules.chaikin_creases ? Sdc::Options::CREASE_CHAIKIN : Sdc::Options::CREASE_UNIFORM);
  options.SetTriangleSubdivision(rules.smooth_triangles ? Sdc::Options::TRI_SUB_SMOOTH : Sdc::Options::TRI_SUB_CATMARK);
  return options;
}

Sdc::SchemeType scheme_of(SubdivisionScheme scheme) {
  return scheme == SubdivisionScheme::kLoop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
}

/// OpenSubdiv prints by default; what it has to say is asked for instead.
void silence() {
  static std::once_flag once;
  std::call_once(once, [] {
    Far::SetErrorCallback([](Far::ErrorType, const char*) {});
    Far::SetWarningCallback([](const char*) {});
  });
}

/// The cage's arrays in OpenSubdiv's types.
struct DescriptorArrays {
  explicit DescriptorArrays(const ControlCage& cage);

  [[nodiscard]] Far::TopologyDescriptor descriptor(std::size_t points) const;

  std::vector<int> sizes, corners, crease_edges, sharp_points, holes;
  std::vector<float> crease_weights, point_weights;
};

DescriptorArrays::DescriptorArrays(const ControlCage& cage) {
  for (std::size_t f = 0; f < cage.face_count(); ++f) sizes.push_back(static_cast<int>(cage.face_size(f)));
  corners.assign(cage.corners.begin(), cage.corners.end());
  for (const auto& crease : cage.creases) {
    for (const std::uint32_t v : crease.edge) crease_edges.push_back(static_cast<int>(v));
    crease_weights.push_back(crease.sharpness);
  }
  for (const auto& sharp : cage.sharp_points) {
    sharp_points.push_back(static_cast<int>(sharp.vertex));
    point_weights.push_back(sharp.sharpness);
  }
  holes.assign(cage.holes.begin(), cage.holes.end());
}

Far::TopologyDescriptor DescriptorArrays::descriptor(std::size_t points) const {
  Far::TopologyDescriptor d;
  d.numVertices = static_cast<int>(points);
  d.numFaces = static_cast<int>(sizes.size());
  d.numVertsPerFace = sizes.data();
  d.vertIndicesPerFace = corners.data();
  d.numCreases = static_cast<int>(crease_weights.size());
  d.creaseVertexIndexPairs = crease_edges.data();
  d.creaseWeights = crease_weights.data();
  d.numCorners = static_cast<int>(point_weights.size());
  d.cornerVertexIndices = sharp_points.data();
  d.cornerWeights = point_weights.data();
  d.numHoles = static_cast<int>(holes.size());
  d.holeIndices = holes.data();
  return d;
}

std::unique_ptr<Far::TopologyRefiner> refiner_of(const ControlCage& cage) {
  silence();
  const DescriptorArrays arrays(cage);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  const Factory::Options options(scheme_of(cage.scheme), options_of(cage.rules));
  std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(arrays.descriptor(cage.points.size()), options));
  assert(refiner != nullptr);
  return refiner;
}

Vector vector_of(const std::array<double, 3>& x) { return {x[0], x[1], x[2]}; }

}  // namespace

struct LimitSurface::Impl {
  struct Face {
    Bfr::Surface<double> surface;
    std::vector<double> points;  ///< patch points, from the centre
  };
  struct Patch {
    std::uint32_t face = 0;
    std::int32_t quarter = -1;  ///< of a face of irregular size
  };

  void add_face(const Bfr::RefinerSurfaceFactory<>& factory, int face, const std::vector<double>& mesh_points);
  void find_non_manifold(const Far::TopologyRefiner& refiner);

  Point centre;  ///< coordinates are taken from it: OpenSubdiv's tables are partly in single precision
  bool triangles = false;
  std::vector<Face> faces;
  std::vector<Patch> patches;
  std::vector<std::uint32_t> first_patch{0};
  std::vector<std::uint32_t> bad_edges;
  std::vector<std::uint32_t> bad_vertices;
};

void LimitSurface::Impl::add_face(const Bfr::RefinerSurfaceFactory<>& factory, int face,
                                  const std::vector<double>& mesh_points) {
  Face& own = faces.emplace_back();
  if (factory.InitVertexSurface(face, &own.surface)) {
    const Bfr::Surface<double>::PointDescriptor xyz(3);
    own.points.resize(3 * static_cast<std::size_t>(own.surface.GetNumPatchPoints()));
    own.surface.PreparePatchPoints(mesh_points.data(), xyz, own.points.data(), xyz);
    const auto parameters = own.surface.GetParameterization();
    const int parts = parameters.HasSubFaces() ? parameters.GetFaceSize() : 1;
    for (int k = 0; k < parts; ++k)
      patches.push_back({static_cast<std::uint32_t>(face), parameters.HasSubFaces() ? k : -1});
  }
  first_patch.push_back(static_cast<std::uint32_t>(patches.size()));
}

void LimitSurface::Impl::find_non_manifold(const Far::TopologyRefiner& refiner) {
  const Far::TopologyLevel& level = refiner.GetLevel(0);
  for (int e = 0; e < level.GetNumEdges(); ++e) {
    const auto around = level.GetEdgeFaces(e);
    if (level.IsEdgeNonManifold(e) && around.size() > 0) bad_edges.push_back(static_cast<std::uint32_t>(around[0]));
  }
  for (int v = 0; v < level.GetNumVertices(); ++v) {
    const auto around = level.GetVertexFaces(v);
    if (!level.IsVertexNonManifold(v) || around.size() == 0) continue;
    const auto edges = level.GetVertexEdges(v);
    bool at_edge = false;
    for (int k = 0; k < edges.size(); ++k) at_edge = at_edge || level.IsEdgeNonManifold(edges[k]);
    if (!at_edge) bad_vertices.push_back(static_cast<std::uint32_t>(around[0]));
  }
}

LimitSurface::LimitSurface(const ControlCage& cage) : impl_(std::make_unique<Impl>()) {
  const auto refiner = refiner_of(cage);
  Box box;
  for (const Point& p : cage.points) box.add(p);
  impl_->centre = box.centre();
  impl_->triangles = cage.scheme == SubdivisionScheme::kLoop;
  std::vector<double> points;
  for (const Point& p : cage.points) {
    const Vector d = p - impl_->centre;
    points.insert(points.end(), {d.x, d.y, d.z});
  }
  Bfr::SurfaceFactory::Options options;
  options.SetApproxLevelSmooth(kIrregularLevels);
  options.SetApproxLevelSharp(kSharpLevels);
  const Bfr::RefinerSurfaceFactory<> factory(*refiner, options);
  impl_->faces.reserve(cage.face_count());
  for (std::size_t f = 0; f < cage.face_count(); ++f) impl_->add_face(factory, static_cast<int>(f), points);
  impl_->find_non_manifold(*refiner);
}

LimitSurface::LimitSurface(LimitSurface&&) noexcept = default;
LimitSurface& LimitSurface::operator=(LimitSurface&&) noexcept = default;
LimitSurface::~LimitSurface() = default;

std::size_t LimitSurface::patch_count(std::size_t face) const {
  return impl_->first_patch[face + 1] - impl_->first_patch[face];
}
std::uint32_t LimitSurface::first_patch(std::size_t face) const { return impl_->first_patch[face]; }
bool LimitSurface::has_triangles() const { return impl_->triangles; }
const std::vector<std::uint32_t>& LimitSurface::non_manifold_edges() const { return impl_->bad_edges; }
const std::vector<std::uint32_t>& LimitSurface::non_manifold_vertices() const { return impl_->bad_vertices; }

LimitSurface::Derivatives LimitSurface::derivatives(std::uint32_t patch, double u, double v) const {
  const Impl::Patch& own = impl_->patches[patch];
  const Impl::Face& face = impl_->faces[own.face];
  std::array<double, 2> uv{u, v};
  double scale = 1.0;
  if (own.quarter >= 0) {
    const std::array<double, 2> in_quarter = uv;
    face.surface.GetParameterization().ConvertNormalizedSubFaceToCoord(own.quarter, in_quarter.data(), uv.data());
    scale = 0.5;
  }
  std::array<std::array<double, 3>, 6> d{};
  face.surface.Evaluate(uv.data(), face.points.data(), Bfr::Surface<double>::PointDescriptor(3), d[0].data(),
                        d[1].data(), d[2].data(), d[3].data(), d[4].data(), d[5].data());
  const double square = scale * scale;
  return {impl_->centre + vector_of(d[0]), scale * vector_of(d[1]),  scale * vector_of(d[2]),
          square * vector_of(d[3]),        square * vector_of(d[4]), square * vector_of(d[5])};
}

LimitPoint LimitSurface::at(std::uint32_t patch, double u, double v) const {
  const Derivatives d = derivatives(patch, u, v);
  const Vector normal = cross(d.du, d.dv);
  const double least = std::numeric_limits<double>::epsilon() * norm(d.du) * norm(d.dv);
  if (norm(normal) > least) return {d.at, normalized(normal)};
  const double middle = impl_->triangles ? 1.0 / 3.0 : 0.5;
  const Derivatives near = derivatives(patch, u + kIntoPatch * (middle - u), v + kIntoPatch * (middle - v));
  return {d.at, normalized(cross(near.du, near.dv))};
}

}  // namespace clerestory::mesh
