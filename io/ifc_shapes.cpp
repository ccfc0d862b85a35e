// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ifc_shapes.h"

#include <IfcAdvancedBrep.h>
#include <IfcCsgSolid.h>
#include <IfcExtrudedAreaSolidTapered.h>
#include <IfcFaceOuterBound.h>
#include <IfcFacetedBrepWithVoids.h>
#include <IfcIndexedPolygonalFaceWithVoids.h>
#include <IfcPolyLoop.h>
#include <IfcPolygonalFaceSet.h>
#include <IfcPositiveInteger.h>
#include <IfcTriangulatedFaceSet.h>
#include <ifcpp/geometry/Carve/RepresentationConverter.h>

#include "io/ifc_styles.h"

namespace clerestory::io {

namespace {

/// Deeper nests of maps and booleans are circles.
constexpr int kDeepest = 200;
/// A circle's chords stay this near to it [m]; more than 64 of them serve no light.
constexpr double kChord = 0.002;

int chords_of_circle(double radius) {
  if (!(radius > kChord)) return 12;
  const double angle = 2.0 * std::acos(1.0 - kChord / radius);
  return 4 * std::clamp(static_cast<int>(std::ceil(2.0 * M_PI / angle / 4.0)), 3, 16);
}

bool is_body(const IfcRepresentation& representation) {
  const std::string name = text_of(representation.m_RepresentationIdentifier);
  return name.empty() || name == "Body" || name == "Facetation";
}

mesh::Point point(const vec3& p) { return {p.x, p.y, p.z}; }

mesh::Solid solid_of(carve::mesh::MeshSet<3>& set) {
  mesh::Solid solid;
  for (auto* part : set.meshes) {
    for (auto* face : part->faces) {
      std::vector<carve::mesh::Vertex<3>*> corners;
      face->getVertices(corners);
      std::vector<mesh::Point> loop;
      for (const auto* corner : corners) loop.push_back(point(corner->v));
      mesh::add_face(solid, {&loop, 1});
    }
  }
  return solid;
}

std::vector<mesh::Point> corners_of(const IfcCartesianPointList3D& list, double metres_per_unit) {
  std::vector<mesh::Point> points;
  for (const auto& row : list.m_CoordList) {
    const auto at = [&](std::size_t axis) { return axis < row.size() ? metres_per_unit * value_of(row[axis]) : 0.0; };
    points.push_back({at(0), at(1), at(2)});
  }
  return points;
}

/// The loop of indices counted from 1; indices that do not exist are passed over.
template <class Indices>
std::vector<mesh::Point> indexed_loop(const std::vector<mesh::Point>& points, const Indices& indices) {
  std::vector<mesh::Point> loop;
  for (const auto& index : indices)
    if (index && index->m_value >= 1 && static_cast<std::size_t>(index->m_value) <= points.size())
      loop.push_back(points[static_cast<std::size_t>(index->m_value) - 1]);
  return loop;
}

}  // namespace

IfcShapes::IfcShapes(const std::shared_ptr<BuildingModel>& model, IfcStyles& styles, double metres_per_unit)
    : metres_per_unit_(metres_per_unit), styles_(styles) {
  auto settings = std::make_shared<GeometrySettings>();
  settings->setNumVerticesPerCircleGivenRadius(&chords_of_circle);
  settings->setHandleStyledItems(false);
  settings->setHandleLayerAssignments(false);
  carve::setEpsilon(1.5e-5 * metres_per_unit);
  library_ = std::make_unique<RepresentationConverter>(settings, model->getUnitConverter());
  // NOLINTNEXTLINE(performance-unnecessary-value-param): the library's signature
  library_->setMessageCallBack(this, [](void* shapes, std::shared_ptr<StatusCallback::Message> message) {
    const auto type = message->m_message_type;
    if (type == StatusCallback::MESSAGE_TYPE_WARNING || type == StatusCallback::MESSAGE_TYPE_ERROR)
      static_cast<IfcShapes*>(shapes)->add_message(utf8(message->m_message_text));
  });
}

IfcShapes::~IfcShapes() = default;

std::vector<IfcItem> IfcShapes::items_of(const IfcProduct& product) {
  std::vector<IfcItem> items;
  if (!product.m_Representation) return items;
  for (const auto& representation : product.m_Representation->m_Representations)
    if (representation && is_body(*representation)) add_items(*representation, {}, std::nullopt, 0, items);
  return items;
}

void IfcShapes::add_items(const IfcRepresentation& representation, const mesh::Affine& at,
                          std::optional<std::size_t> style, int depth, std::vector<IfcItem>& items) {
  if (depth > kDeepest) return lose("representations nested in a circle");
  for (const auto& item : representation.m_Items) {
    if (!item) continue;
    const auto own_style = styles_.style_of(*item);
    if (const auto mapped = as<IfcMappedItem>(item)) {
      add_mapped(*mapped, at, own_style ? own_style : style, depth, items);
      continue;
    }
    for (mesh::Solid& part : bodies_of(item, depth)) {
      mesh::Solid body = mesh::outward(mesh::snapped(mesh::transformed(std::move(part), at)));
      if (!body.empty()) items.push_back({std::move(body), style ? style : own_style});
    }
  }
}

void IfcShapes::add_mapped(const IfcMappedItem& item, const mesh::Affine& at, std::optional<std::size_t> style,
                           int depth, std::vector<IfcItem>& items) {
  if (!item.m_MappingSource || !item.m_MappingSource->m_MappedRepresentation) return lose("IfcMappedItem");
  const mesh::Affine target = transformation_of(item.m_MappingTarget, metres_per_unit_);
  const mesh::Affine origin = placement_of(item.m_MappingSource->m_MappingOrigin, metres_per_unit_);
  add_items(*item.m_MappingSource->m_MappedRepresentation, at * target * origin, style, depth + 1, items);
}

std::vector<mesh::Solid> IfcShapes::bodies_of(const std::shared_ptr<IfcRepresentationItem>& item, int depth) {
  std::vector<mesh::Solid> bodies;
  if (const auto model = as<IfcFaceBasedSurfaceModel>(item)) {
    for (const auto& faces : model->m_FbsmFaces) add_faces(bodies.emplace_back(), faces);
  } else if (const auto shells = as<IfcShellBasedSurfaceModel>(item)) {
    for (const auto& shell : shells->m_SbsmBoundary) add_faces(bodies.emplace_back(), as<IfcConnectedFaceSet>(shell));
  } else {
    bodies.push_back(body_of(item, depth));
  }
  return bodies;
}

mesh::Solid IfcShapes::body_of(const std::shared_ptr<IfcRepresentationItem>& item, int depth) {
  if (depth > kDeepest) {
    lose("bodies nested in a circle");
    return {};
  }
  try {
    if (auto own = own_body_of(item, depth)) return std::move(*own);
    mesh::Solid body = library_body_of(item);
    if (body.empty()) lose(item->className());
    return body;
  } catch (const carve::exception&) {  // has no what()
    lose(item->className());
  } catch (const BuildingException&) {
    lose(item->className());
  }
  return {};
}

/// Nothing for an entity that is the library's.
std::optional<mesh::Solid> IfcShapes::own_body_of(const std::shared_ptr<IfcRepresentationItem>& item, int depth) {
  mesh::Solid body;
  if (const auto extruded = as<IfcExtrudedAreaSolid>(item)) {
    if (as<IfcExtrudedAreaSolidTapered>(item)) lose("the taper of IfcExtrudedAreaSolidTapered");
    return extrusion(extruded);
  }
  if (const auto result = as<IfcBooleanResult>(item)) return boolean(*result, depth + 1);
  if (const auto tree = as<IfcCsgSolid>(item))
    return body_of(as<IfcRepresentationItem>(tree->m_TreeRootExpression), depth + 1);
  if (as<IfcAdvancedBrep>(item)) return std::nullopt;
  if (const auto brep = as<IfcManifoldSolidBrep>(item)) {
    add_faces(body, brep->m_Outer);
    if (const auto hollow = as<IfcFacetedBrepWithVoids>(item))
      for (const auto& hole : hollow->m_Voids) add_faces(body, hole);
  } else if (as<IfcFaceBasedSurfaceModel>(item) || as<IfcShellBasedSurfaceModel>(item)) {
    for (const mesh::Solid& part : bodies_of(item, depth)) mesh::append(body, part);
  } else if (const auto set = as<IfcConnectedFaceSet>(item)) {
    add_faces(body, set);
  } else if (const auto triangles = as<IfcTriangulatedFaceSet>(item)) {
    return tessellation(*triangles);
  } else if (const auto polygons = as<IfcPolygonalFaceSet>(item)) {
    return tessellation(*polygons);
  } else {
    return std::nullopt;
  }
  return body;
}

mesh::Solid IfcShapes::library_body_of(const std::shared_ptr<IfcRepresentationItem>& item) {
  mesh::Solid body;
  const auto geometry = as<IfcGeometricRepresentationItem>(item);
  if (!geometry) return body;
  const auto data = std::make_shared<ItemShapeData>();
  library_->convertIfcGeometricRepresentationItem(geometry, data);
  for (const auto& sets : {data->m_meshsets, data->m_meshsets_open})
    for (const auto& set : sets)
      if (set) mesh::append(body, solid_of(*set));
  return body;
}

mesh::Solid IfcShapes::extrusion(const std::shared_ptr<IfcExtrudedAreaSolid>& solid) {
  const auto profile = library_->getProfileCache()->getProfileConverter(solid->m_SweptArea);
  if (!profile) {
    lose("IfcExtrudedAreaSolid");
    return {};
  }
  std::vector<std::vector<mesh::Point>> loops;
  for (const auto& path : profile->getCoordinates()) {
    loops.emplace_back();
    for (const auto& p : path) loops.back().push_back({p.x, p.y, 0.0});
  }
  const mesh::Vector along = mesh::normalized(direction_of(solid->m_ExtrudedDirection, {0.0, 0.0, 1.0}));
  const mesh::Solid body = mesh::prism(loops, value_of(solid->m_Depth) * metres_per_unit_ * along);
  if (body.empty()) lose("IfcExtrudedAreaSolid");
  return mesh::transformed(body, placement_of(solid->m_Position, metres_per_unit_));
}

void IfcShapes::add_faces(mesh::Solid& body, const std::shared_ptr<IfcConnectedFaceSet>& faces) {
  if (!faces) return;
  for (const auto& face : faces->m_CfsFaces)
    if (face) add_face(body, face);
}

void IfcShapes::add_face(mesh::Solid& body, const std::shared_ptr<IfcFace>& face) {
  std::vector<std::vector<mesh::Point>> loops;
  for (const auto& bound : face->m_Bounds) {
    if (!bound || !bound->m_Bound) continue;
    std::vector<mesh::Point> loop = loop_points(bound->m_Bound);
    if (!is_set(bound->m_Orientation)) std::reverse(loop.begin(), loop.end());
    if (loop.size() > 2) loops.push_back(std::move(loop));
  }
  mesh::add_face(body, loops);
}

std::vector<mesh::Point> IfcShapes::loop_points(const std::shared_ptr<IfcLoop>& loop) {
  std::vector<mesh::Point> points;
  if (const auto poly = as<IfcPolyLoop>(loop)) {
    for (const auto& corner : poly->m_Polygon) points.push_back(point_of(corner, metres_per_unit_));
  } else {
    std::vector<vec3> converted;
    library_->getCurveConverter()->convertIfcLoop(loop, converted);
    for (const vec3& p : converted) points.push_back(point(p));
  }
  while (points.size() > 1 && points.back() == points.front()) points.pop_back();
  return points;
}

mesh::Solid IfcShapes::tessellation(const IfcTriangulatedFaceSet& faces) const {
  mesh::Solid body;
  if (!faces.m_Coordinates) return body;
  const auto points = corners_of(*faces.m_Coordinates, metres_per_unit_);
  for (const auto& indices : faces.m_CoordIndex) {
    const auto loop = indexed_loop(points, indices);
    if (loop.size() == 3) mesh::add_face(body, {&loop, 1});
  }
  return body;
}

mesh::Solid IfcShapes::tessellation(const IfcPolygonalFaceSet& faces) const {
  mesh::Solid body;
  if (!faces.m_Coordinates) return body;
  const auto points = corners_of(*faces.m_Coordinates, metres_per_unit_);
  for (const auto& face : faces.m_Faces) {
    if (!face) continue;
    std::vector<std::vector<mesh::Point>> loops{indexed_loop(points, face->m_CoordIndex)};
    if (const auto holed = as<IfcIndexedPolygonalFaceWithVoids>(face))
      for (const auto& indices : holed->m_InnerCoordIndices) loops.push_back(indexed_loop(points, indices));
    mesh::add_face(body, loops);
  }
  return body;
}

}  // namespace clerestory::io
