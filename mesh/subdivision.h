// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/limit_surface.h"
#include "mesh/model.h"

namespace clerestory::mesh {

/// That a part is a control cage.
struct CurvedPart {
  SubdivisionScheme scheme = SubdivisionScheme::kCatmullClark;
  std::optional<double> chord_tolerance_m;  ///< none: default_chord_tolerance()
};

/// What became of the cages of a model.
struct SubdivisionReport {
  struct Part {
    PartId part;
    SubdivisionScheme scheme = SubdivisionScheme::kCatmullClark;
    double chord_tolerance_m = 0.0;
    double deviation_m = 0.0;  ///< of the limit surface from its triangles, the largest found
    std::size_t cage_faces = 0;
    std::size_t facets = 0;
  };
  std::vector<Part> parts;           ///< that are curved, ascending
  std::vector<std::string> notices;  ///< one sentence each
};

/// How far the triangles of a part may lie from its limit surface [m]: a quarter of the smallest element that is split for the
/// light's sake, for small parts a five-hundredth of their size, at least 0.1 mm, which is well over the weld tolerance.
double default_chord_tolerance(const Box& part);

/// Parts that a file marks as cages: those that have rules, tagged edges or corners, or holes. [parts]
std::vector<bool> tagged_parts(const Model& model);

/// The polygons of the marked parts as one cage, for tests and for subdivide(). Polygons share a vertex where the file gives them
/// one, and within a part where theirs lie at the same place.
/// @param source  receives the polygon of each face
/// Throws as subdivide().
ControlCage gather_cage(const Model& model, std::span<const std::uint8_t> marked, SubdivisionScheme scheme,
                        const SubdivisionRules& rules, std::vector<std::uint32_t>& source);

/// Replaces the cages of a model by triangles on their limit surfaces, crack-free, within the chord tolerance; everything else stays. Parts
/// of one scheme and the same rules are one cage where they share vertices. The result's `curvature` tells which triangle stands
/// for which piece of a limit surface; its tags are gone.
/// Edges with more than two faces or with two that run the same way, and vertices where fans of faces meet, are made sharp, and told.
/// Throws InputError without a file, with the line: a polygon with a hole, one that names a vertex twice, one that is no triangle in
/// a Loop cage, a vertex or a face with more than 1024 edges; a cage that has no limit surface at all.
/// @param parts  [parts] nothing for those that stay as they are
Model subdivide(const Model& model, std::span<const std::optional<CurvedPart>> parts,
                SubdivisionReport* report = nullptr);

}  // namespace clerestory::mesh
