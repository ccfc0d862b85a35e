// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/model.h"

namespace clerestory::mesh {

/// How the clean-up works.
struct CleanOptions {
  enum class Repair { kAuto, kReport, kOff };

  Repair repair = Repair::kAuto;
  /// Vertices closer than this become one, vertices closer than 0.85 of this to an edge become corners of it [m].
  /// 0.02 mm: twenty times under the gap of 0.1 to 1 mm that models leave on purpose, and well over the rounding of
  /// files that print six decimals.
  double weld_tolerance_m = 2e-5;
  /// Thin sheets: by material, whether its thin solids and double sheets are one pane, to be replaced by its
  /// mid-surface (glazing: the transmittance of the whole unit applies once). Empty: none.
  std::vector<bool> sheet_materials;
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
  /// The first few, with polygon (index into the model) and place [m, model coordinates].
  struct Place {
    std::uint32_t polygon = 0;
    Point at;
    std::string note;
  };
  std::vector<Place> places;
};

struct CleanReport {
  std::vector<Defect> defects;       ///< only kinds that were found, in the order of the pipeline
  std::vector<std::string> notices;  ///< one sentence each: panes reduced, parts left out …
  double area_before_m2 = 0.0;
  double area_after_m2 = 0.0;
};

/// Welded polygons without degenerate or duplicate ones; vertices on edges are corners of those edges, so that polygons that
/// touch along a line share its vertices.
struct CleanSurface {
  Model polygons;                     ///< local coordinates: place in the model minus origin
  Vector origin;                      ///< model coordinates = local coordinates + origin [m]
  std::vector<std::uint32_t> source;  ///< polygon → polygon of the model that it comes from
  CleanReport report;
};

/// Cleans a model. Idempotent: a clean surface comes back unchanged, with an empty list of defects.
/// Throws InputError when nothing is left.
CleanSurface clean(const Model& model, const CleanOptions& options);

}  // namespace clerestory::mesh
