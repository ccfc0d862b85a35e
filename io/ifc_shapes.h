// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/ifc_building.h"
#include "io/ifc_entities.h"

class IfcBooleanResult;
class IfcConnectedFaceSet;
class IfcExtrudedAreaSolid;
class IfcFace;
class IfcHalfSpaceSolid;
class IfcLoop;
class IfcMappedItem;
class IfcPolygonalFaceSet;
class IfcProduct;
class IfcRepresentation;
class IfcRepresentationItem;
class IfcTriangulatedFaceSet;
class RepresentationConverter;

// Private to the files of the IFC reader that may name the parser's types.
namespace clerestory::io {

class IfcStyles;

/// Bodies out of representations. Faces, extrusions and boolean trees are evaluated here; curves, profiles and rarer solids by the
/// library, whose own booleans and faces with holes lose geometry without a word.
class IfcShapes {
 public:
  IfcShapes(const std::shared_ptr<BuildingModel>& model, IfcStyles& styles, double metres_per_unit);
  ~IfcShapes();

  /// The bodies of a product, in its own coordinates [m]; none where it has none.
  std::vector<IfcItem> items_of(const IfcProduct& product);
  /// What could not be converted, by kind of entity.
  [[nodiscard]] const std::map<std::string, std::size_t>& lost() const { return lost_; }
  /// What the library says is wrong, with how often.
  [[nodiscard]] const std::map<std::string, std::size_t>& messages() const { return messages_; }
  void add_message(const std::string& text) { ++messages_[text]; }

 private:
  void add_items(const IfcRepresentation& representation, const mesh::Affine& at, std::optional<std::size_t> style,
                 int depth, std::vector<IfcItem>& items);
  void add_mapped(const IfcMappedItem& item, const mesh::Affine& at, std::optional<std::size_t> style, int depth,
                  std::vector<IfcItem>& items);

  /// Surface models hold bodies beside each other: frame and glass of a window, say.
  std::vector<mesh::Solid> bodies_of(const std::shared_ptr<IfcRepresentationItem>& item, int depth);
  mesh::Solid body_of(const std::shared_ptr<IfcRepresentationItem>& item, int depth);
  std::optional<mesh::Solid> own_body_of(const std::shared_ptr<IfcRepresentationItem>& item, int depth);
  mesh::Solid library_body_of(const std::shared_ptr<IfcRepresentationItem>& item);
  mesh::Solid extrusion(const std::shared_ptr<IfcExtrudedAreaSolid>& solid);
  void add_faces(mesh::Solid& body, const std::shared_ptr<IfcConnectedFaceSet>& faces);
  void add_face(mesh::Solid& body, const std::shared_ptr<IfcFace>& face);
  std::vector<mesh::Point> loop_points(const std::shared_ptr<IfcLoop>& loop);
  mesh::Solid tessellation(const IfcTriangulatedFaceSet& faces) const;
  mesh::Solid tessellation(const IfcPolygonalFaceSet& faces) const;

  // In ifc_booleans.cpp.
  mesh::Solid boolean(const IfcBooleanResult& result, int depth);
  mesh::Solid half_space(const IfcHalfSpaceSolid& half, const mesh::Solid& around);
  mesh::Solid bounded_half_space(const std::vector<mesh::Point>& boundary, const mesh::Affine& at,
                                 const mesh::Affine& plane, const mesh::Vector& into, const mesh::Solid& around);

  void lose(const char* kind) { ++lost_[kind]; }

  double metres_per_unit_;
  IfcStyles& styles_;
  std::unique_ptr<RepresentationConverter> library_;
  std::map<std::string, std::size_t> lost_;
  std::map<std::string, std::size_t> messages_;
};

}  // namespace clerestory::io
