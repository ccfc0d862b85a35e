// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "io/model_file.h"
#include "mesh/model.h"

namespace clerestory::io {

/// The material and the part of polygons that stand before any name.
inline constexpr const char* kUnnamed = "default";

/// Ids of names in the order of their first use.
template <class Id>
class Names {
 public:
  Id id(const std::string& name) {
    const auto [at, is_new] = ids_.emplace(name, Id(names_.size()));
    if (is_new) names_.push_back(name);
    return at->second;
  }
  [[nodiscard]] std::vector<std::string> take() { return std::move(names_); }

 private:
  std::unordered_map<std::string, Id> ids_;
  std::vector<std::string> names_;
};

/// What a file says of its own unit.
struct ToldUnit {
  LengthUnit unit = LengthUnit::kMetre;
  std::string where;  ///< in words: "as line 1 of the model says", "as glTF prescribes"
};

/// Collects a model as a reader finds it, in the file's unit and axes. Every reader ends with finish(), so that all make the same checks
/// and choose units alike.
class ModelBuilder {
 public:
  /// @param file  as the user named it, for messages
  explicit ModelBuilder(std::string file) : file_(std::move(file)) {}

  /// A point in the file's unit. Throws InputError for coordinates that are not finite or lie beyond any building, and where the
  /// model has more vertices than 32 bits count.
  std::uint32_t vertex(const mesh::Point& p, std::uint64_t line = 0);
  mesh::MaterialId material(const std::string& name) { return materials_.id(name); }
  mesh::PartId part(const std::string& name) { return parts_.id(name); }
  /// A polygon of one loop [at least 3 vertices]. Corners may name vertices that follow later.
  void polygon(std::span<const std::uint32_t> corners, mesh::MaterialId material, mesh::PartId part,
               std::uint64_t line = 0);
  /// One more loop of the latest polygon: a hole.
  void hole(std::span<const std::uint32_t> corners);

  /// Subdivision tags, by the numbers of vertices and polygons so far.
  mesh::SubdivisionTags& tags() { return model_.tags; }

  [[nodiscard]] std::size_t vertex_count() const { return model_.vertices.size(); }
  [[nodiscard]] std::size_t polygon_count() const { return model_.polygon_count(); }

  /// Checks the corners, drops vertices that no polygon uses (they would widen the box that a unit is guessed from), brings all to
  /// metres with z up; fills model, unit, notices, and a material of each name. The unit: the format's, else the told one, else guessed.
  /// Throws InputError for a corner that does not exist, and for a model without polygons.
  void finish(ModelFile& result, const ModelFormat& format, const std::optional<ToldUnit>& told,
              UpAxis usual_up = UpAxis::kZ);

 private:
  void check_room(std::size_t corners, std::uint64_t line) const;
  void check_corners() const;
  void drop_unused_vertices();
  void renumber_tags(std::span<const std::uint32_t> new_index);
  void choose_unit(ModelFile& result, const ModelFormat& format, const std::optional<ToldUnit>& told) const;

  std::string file_;
  mesh::Model model_;
  Names<mesh::MaterialId> materials_;
  Names<mesh::PartId> parts_;
};

/// Puts what a file tells of its materials where the model uses them; the others' names go to unused_materials.
void attach_materials(std::vector<SourceMaterial> told, ModelFile& result);

}  // namespace clerestory::io
