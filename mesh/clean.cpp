// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/clean.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "mesh/defects.h"
#include "mesh/error.h"
#include "mesh/nonplanar.h"
#include "mesh/panes.h"
#include "mesh/placement.h"
#include "mesh/polygon_defects.h"
#include "mesh/soup.h"
#include "mesh/t_junctions.h"
#include "mesh/weld.h"

namespace clerestory::mesh {

namespace {

/// Rounds of steps that can undo each other's work at the border of the tolerance; the second round finds nothing as a rule.
constexpr int kMaxRounds = 4;
/// Corners moved by welding and by vertices set into edges stay within twice the tolerance of their plane.
constexpr double kPlanarityOverWeld = 2.0;

double total_area(const Soup& soup) {
  double sum = 0.0;
  for (const SoupPolygon& polygon : soup.polygons) sum += area(soup.points, polygon);
  return sum;
}

/// Before any repair; holes that are reached by bridges are none of the area.
double area_as_given(Soup soup) {
  share_vertices(soup);
  drop_unusable(soup);
  return total_area(soup);
}

/// Panes as long as there are any: three stacks of sheets may leave two mid-surfaces that are one pane.
bool reduce_all_panes(Soup& soup, const CleanOptions& options, const Model& model, std::vector<std::string>& notices) {
  bool changed = false;
  if (std::find(options.sheet_materials.begin(), options.sheet_materials.end(), true) ==
      options.sheet_materials.end()) {
    return changed;
  }
  for (int round = 0; round < kMaxRounds && reduce_panes(soup, options, model.material_names, notices); ++round) {
    changed = true;
  }
  return changed;
}

void repair(Soup& soup, const CleanOptions& options, const Model& model, DefectList& defects,
            std::vector<std::string>& notices) {
  const double tolerance = options.weld_tolerance_m;
  weld(soup, tolerance, defects);
  drop_degenerate(soup, tolerance, defects);
  if (reduce_all_panes(soup, options, model, notices)) {
    DefectList own_making;
    weld(soup, tolerance, own_making);
  }
  for (int round = 0; round < kMaxRounds; ++round) {
    bool changed = split_t_junctions(soup, tolerance, defects);
    changed |= drop_degenerate(soup, tolerance, defects);
    changed |= triangulate_nonplanar(soup, kPlanarityOverWeld * tolerance, defects);
    if (!changed) break;
  }
  drop_duplicates(soup, model.material_names, defects);
}

/// What is needed to go on even without repair: polygons that have no plane are dropped, and panes are reduced, since that is what
/// their material asks for and not a repair. Vertices at the same place are shared, which moves nothing, so that panes are found.
void prepare(Soup& soup, const CleanOptions& options, const Model& model, std::vector<std::string>& notices) {
  share_vertices(soup);
  drop_unusable(soup);
  reduce_all_panes(soup, options, model, notices);
}

void throw_if_empty(const Soup& soup) {
  if (!soup.polygons.empty()) return;
  throw InputError({}, 0, "the model has no polygon with an area",
                   "check that the file holds faces and not only lines or points, and that its units are right");
}

}  // namespace

CleanSurface clean(const Model& model, const CleanOptions& options) {
  assert(std::all_of(model.vertices.begin(), model.vertices.end(), [](const Point& p) { return is_finite(p); }));
  using Repair = CleanOptions::Repair;
  CleanSurface surface;
  CleanReport& report = surface.report;
  Soup soup = to_soup(model);
  report.area_before_m2 = area_as_given(soup);
  if (options.repair == Repair::kAuto) {
    leave_out_far_parts(soup, options.far_away_m, model.part_names, report.notices);
  }
  surface.origin = recentre(soup);

  DefectList defects;
  if (options.repair == Repair::kReport) {
    Soup trial = soup;
    std::vector<std::string> ignored;
    repair(trial, options, model, defects, ignored);
  }
  if (options.repair == Repair::kAuto) {
    repair(soup, options, model, defects, report.notices);
    // What was dropped may have stood out.
    surface.origin = surface.origin + recentre(soup);
  } else {
    prepare(soup, options, model, report.notices);
  }
  throw_if_empty(soup);

  report.defects = std::move(defects).take(surface.origin);
  if (options.repair == Repair::kReport) {
    for (Defect& defect : report.defects) defect.mended = 0;
  }
  report.area_after_m2 = total_area(soup);
  surface.polygons = to_model(soup, model, surface.source);
  return surface;
}

}  // namespace clerestory::mesh
