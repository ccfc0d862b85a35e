// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesh/model.h"
#include "mesh/progress.h"

namespace clerestory::mesh {

/// How the clean-up works.
struct CleanOptions {
  enum class Repair { kAuto, kReport, kOff };

  Repair repair = Repair::kAuto;
  /// Vertices closer than this become one, vertices closer than 0.85 of this to an edge become corners of it [m].
  /// 0.02 mm: twenty times under the gap of 0.1 to 1 mm that models leave on purpose, and well over the rounding of
  /// files that print six decimals.
  double weld_tolerance_m = 2e-5;
  /// Corners at open edges this near to another surface are drawn to it [m]; 0: none. Not given: 1 mm beside long sides, elsewhere the
  /// precision of the model's own coordinates (mesh/gaps.h).
  std::optional<double> gap_m;
  /// Thin sheets: by material, whether its thin solids and double sheets are one pane, to be replaced by its
  /// mid-surface (glazing: the transmittance of the whole unit applies once). Empty: none.
  std::vector<bool> sheet_materials;
  /// By material, whether light passes it (glazing, air): such polygons have one material on both sides. Empty: none.
  std::vector<bool> passable_materials;
  /// Two parallel sheets at most this far apart are one pane [m].
  double pane_thickness_m = 0.1;
  /// A part whose box lies farther than this from the largest connected group is left out [m].
  double far_away_m = 10'000.0;
};

/// One kind of defect, with what was found and what was mended.
struct Defect {
  std::string kind;  ///< "duplicate vertices", "T-junctions", "degenerate polygons", …
  std::size_t found = 0;
  std::size_t mended = 0;
  /// One such defect. Of very many (100 000), the first.
  struct Place {
    std::uint32_t polygon = 0;  ///< index into the model
    Point at;                   ///< [m, model coordinates]
    std::string note;           ///< what was done where there was a choice; of what was left, why
    double size_m = 0.0;        ///< how bad: the width of a gap, the shift of a vertex, the square root of an area
    bool mended = true;
  };
  std::vector<Place> places;
};

struct CleanReport {
  std::vector<Defect> defects;       ///< only kinds that were found, in the order of the pipeline
  std::vector<std::string> notices;  ///< one sentence each: panes reduced, parts left out …
  double area_before_m2 = 0.0;
  double area_after_m2 = 0.0;
  double gap_m = 0.0;  ///< up to which gaps were closed
  /// Pairs of polygons of closed solids that lie face to face: no defect, one stands on the other.
  std::size_t contacts = 0;
  std::size_t uncut_crossings = 0;  ///< pairs of polygons of closed solids that cutting would have opened
  /// Polygons that have another material on the back, after the clean-up: in the file two polygons back to back. No defect.
  std::size_t two_sided = 0;
  std::size_t open_edges = 0;     ///< after the clean-up: edges at which one polygon ends and no other begins
  double open_length_m = 0.0;     ///< of those edges
  std::size_t closed_shells = 0;  ///< after the clean-up: connected polygons without an open edge
};

/// Welded polygons without degenerate or duplicate ones; vertices on edges are corners of those edges, so that polygons that
/// touch along a line share its vertices. No two polygons lie on each other or cross, but where closed solids lie face to face, and
/// where the report tells them as left. Connected polygons look the same way, closed shells outward.
struct CleanSurface {
  Model polygons;                     ///< local coordinates: place in the model minus origin
  Vector origin;                      ///< model coordinates = local coordinates + origin [m]
  std::vector<std::uint32_t> source;  ///< polygon → polygon of the model that it comes from
  /// Polygon → 1 where it is wound the other way round than its source. The sides of a face are those of the source: its front is
  /// the side from which the file's winding is counter-clockwise, whatever the clean-up turned.
  std::vector<std::uint8_t> flipped;
  /// Polygon → the material on the back of its source, where that is another than on the front: two polygons lay there back to back.
  /// Not valid for all others.
  std::vector<MaterialId> back_material;
  /// What stands so near before a face was meant to touch it: build_faces() closes the contact, since corners of solids were not moved [m].
  double contact_gap_m = 0.0;
  std::vector<bool> passable_materials;  ///< as CleanOptions::passable_materials
  CleanReport report;
};

/// Cleans a model. Idempotent: a clean surface comes back unchanged, and its list of defects holds only what cannot be mended.
/// Never worse: a repair that would lose area or open a shell is taken back, and the defect told as left.
/// Throws InputError when nothing is left.
/// @param progress  hears of the steps as phases; may be null
CleanSurface clean(const Model& model, const CleanOptions& options, Progress* progress = nullptr);

}  // namespace clerestory::mesh
