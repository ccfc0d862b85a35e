// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/clean.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "mesh/defects.h"
#include "mesh/edge_uses.h"
#include "mesh/error.h"
#include "mesh/gaps.h"
#include "mesh/intersections.h"
#include "mesh/nonplanar.h"
#include "mesh/orientation.h"
#include "mesh/panes.h"
#include "mesh/phase_part.h"
#include "mesh/placement.h"
#include "mesh/polygon_defects.h"
#include "mesh/soup.h"
#include "mesh/specks.h"
#include "mesh/t_junctions.h"
#include "mesh/weld.h"

namespace clerestory::mesh {

namespace {

/// Rounds of steps that can undo each other's work at the border of the tolerance; the second round finds nothing as a rule.
constexpr int kMaxRounds = 4;
/// Rounds of cutting, and times that one is tried with more left alone where it opened something; few are needed as a rule.
constexpr int kMaxAttempts = 8;
/// Corners moved by welding and by vertices set into edges stay within twice the tolerance of their plane.
constexpr double kPlanarityOverWeld = 2.0;

// Shares of a phase's time, measured by clean_benchmark on two IFC houses (26 486 and 23 216 polygons) and city blocks of 100 000
// and 1 000 000 triangles; where they differ, between them. A phase that finds nothing to mend ends before it is told as done.
constexpr double kShareOfWelding = 0.1;    ///< 0.04 to 0.19, panes being the rest; up to 0.88 where there is no glass
constexpr double kShareBeforePanes = 0.2;  ///< 0.08 to 0.31; 1 where there is no glass
constexpr double kShareOfSplits = 0.6;  ///< of T-junctions: 0.42 to 0.46 in houses (two rounds), 0.64 to 0.72 in blocks
constexpr double kShareOfWidth = 0.02;  ///< of gaps: 0.01
constexpr double kShareOfClosing = 0.25;     ///< of a round, from the times of closing, welding and splitting
constexpr double kShareOfCutting = 0.7;      ///< of a round of cutting in a house: 0.67
constexpr double kShareOfLaterRounds = 0.5;  ///< of each, to those before it; in houses 0.37 to 0.49
constexpr double kShareOfSpecks = 0.07;      ///< of shells: 0.05 to 0.08
constexpr double kShareBeforeEdges = 0.6;    ///< of shells: 0.55 to 0.66

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

void tell(const SolidMeetings& meetings, CleanReport& report) {
  report.contacts = meetings.contacts;
  report.uncut_crossings = meetings.crossings;
  if (meetings.contacts > 0)
    report.notices.push_back(
        fmt::format("{} pairs of polygons of closed solids lie face to face; these contacts are no defects, and are "
                    "imprinted on the faces",
                    meetings.contacts));
  if (meetings.crossings > 0)
    report.notices.push_back(
        fmt::format("{} pairs of polygons of closed solids poke through each other and were not cut, to keep the "
                    "solids closed; the lines where they do are imprinted on the faces",
                    meetings.crossings));
}

void tell_two_sided(const Soup& soup, CleanReport& report) {
  report.two_sided = static_cast<std::size_t>(
      std::ranges::count_if(soup.polygons, [](const SoupPolygon& polygon) { return polygon.back_material.valid(); }));
  if (report.two_sided > 0)
    report.notices.push_back(fmt::format(
        "{} polygons lay back to back with another one of another material; each such pair is one polygon with a "
        "material on either side, and no defect",
        report.two_sided));
}

/// The steps of the clean-up on one soup, told to who watches.
class Repair {
 public:
  Repair(Soup& soup, const CleanOptions& options, const Model& model, Progress& progress)
      : soup_(soup), options_(options), model_(model), progress_(progress), tolerance_(options.weld_tolerance_m) {}

  /// @param report  receives notices and counts
  DefectList run(CleanReport& report) {
    progress_.phase("welding");
    weld(soup_, tolerance_, defects_);
    progress_.advance(kShareOfWelding);
    drop_degenerate(soup_, tolerance_, defects_);
    progress_.advance(kShareBeforePanes);
    if (reduce_all_panes(soup_, options_, model_, report.notices)) weld_again();
    progress_.phase("T-junctions");
    make_conforming(defects_, progress_);
    drop_duplicates(soup_, {model_.material_names, options_.passable_materials}, defects_);
    progress_.phase("gaps");
    close_all_gaps(report);
    progress_.phase("intersections");
    tell(resolve_all_intersections(), report);
    drop_duplicates(soup_, {model_.material_names, options_.passable_materials}, defects_);
    tell_two_sided(soup_, report);
    progress_.phase("shells");
    remove_specks(soup_, defects_);
    progress_.advance(kShareOfSpecks);
    report.closed_shells = orient_shells(soup_, defects_);
    progress_.advance(kShareBeforeEdges);
    const OpenEdges open = open_edges(soup_);
    report.open_edges = open.count;
    report.open_length_m = open.length_m;
    return std::move(defects_);
  }

 private:
  /// After steps that set vertices near others; what they bring about is no defect of the model.
  void weld_again() {
    DefectList own_making;
    weld(soup_, tolerance_, own_making);
  }

  /// Vertices on edges become corners of them, and polygons that welding or those corners bent become triangles.
  void make_conforming(DefectList& defects, Progress& progress) {
    for (int round = 0; round < kMaxRounds; ++round) {
      // Splitting comes to its end by itself; the other two make edges that have not been split.
      split_t_junctions(soup_, tolerance_, defects);
      progress.advance(kShareOfSplits);
      bool changed = drop_degenerate(soup_, tolerance_, defects);
      changed |= triangulate_nonplanar(soup_, kPlanarityOverWeld * tolerance_, defects);
      if (!changed) break;
    }
  }

  void close_all_gaps(CleanReport& report) {
    const GapWidth gap = options_.gap_m ? GapWidth{*options_.gap_m, *options_.gap_m} : gap_unasked(soup_, tolerance_);
    report.gap_m = gap.wide_m;
    progress_.advance(kShareOfWidth);
    for (int round = 0; round < kMaxRounds; ++round) {
      if (!close_gaps(soup_, gap, tolerance_, defects_)) break;
      weld_again();
      DefectList own_making;
      PhasePart conforming(progress_, kShareOfClosing, 1.0);
      make_conforming(own_making, conforming);
    }
  }

  /// Pieces of one round may still cross others where a polygon had to be left whole. What opens a polygon is taken back.
  SolidMeetings resolve_all_intersections() {
    mark_solids(soup_);
    std::unordered_set<std::uint32_t> left_alone;
    SolidMeetings meetings;
    for (int round = 0; round < kMaxAttempts; ++round) {
      DefectList found;
      SolidMeetings of_round;
      PhasePart part(progress_, 1.0 - std::pow(kShareOfLaterRounds, round),
                     1.0 - std::pow(kShareOfLaterRounds, round + 1));
      const bool changed = resolve_unless_opened(left_alone, found, of_round, part);
      defects_.append(std::move(found));
      // Later rounds see pieces of the contacts that the first one saw.
      if (round == 0) meetings.contacts = of_round.contacts;
      meetings.crossings += of_round.crossings;
      // What was cut may be a solid no more, or have become one.
      if (!changed && !mark_solids(soup_)) return meetings;
    }
    SolidMeetings of_pieces;
    leave_intersections(soup_, tolerance_, "is still there after several rounds of cutting", defects_, of_pieces);
    meetings.crossings += of_pieces.crossings;
    return meetings;
  }

  /// @return whether anything changed
  bool resolve_unless_opened(std::unordered_set<std::uint32_t>& left_alone, DefectList& found, SolidMeetings& meetings,
                             Progress& progress) {
    const Soup before = soup_;
    for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
      found = {};
      meetings = {};
      PhasePart cutting(progress, 0.0, kShareOfCutting);
      if (!resolve_intersections(soup_, tolerance_, model_.material_names, left_alone, found, meetings, cutting))
        return false;
      weld_again();
      DefectList own_making;
      PhasePart conforming(progress, kShareOfCutting, 1.0);
      make_conforming(own_making, conforming);
      const std::unordered_set<std::uint32_t> opened = opened_sources(before, soup_);
      if (opened.empty()) {
        drop_covered(soup_);
        drop_duplicates(soup_, {model_.material_names, options_.passable_materials}, own_making);
        return true;
      }
      // What opens although it was left alone was opened by what is cut beside it.
      const bool known = std::ranges::all_of(opened, [&](std::uint32_t source) { return left_alone.contains(source); });
      left_alone.merge(known ? sources_beside(before, opened) : std::unordered_set(opened));
      soup_ = before;
    }
    found = {};
    meetings = {};
    leave_intersections(soup_, tolerance_, "cutting there would open what is closed", found, meetings);
    return false;
  }

  Soup& soup_;
  const CleanOptions& options_;
  const Model& model_;
  Progress& progress_;
  double tolerance_;
  DefectList defects_;
};

/// What is needed to go on even without repair: polygons that have no plane are dropped, and panes are reduced, since that is what
/// their material asks for and not a repair. Vertices at the same place are shared, which moves nothing, so that panes are found.
void prepare(Soup& soup, const CleanOptions& options, const Model& model, std::vector<std::string>& notices) {
  share_vertices(soup);
  drop_unusable(soup);
  reduce_all_panes(soup, options, model, notices);
}

/// Of a trial, what would have been mended is left.
void leave(Defect& defect) {
  defect.mended = 0;
  for (Defect::Place& place : defect.places) {
    if (place.mended) place.note = "the clean-up was asked to report, not to mend";
    place.mended = false;
  }
}

void throw_if_empty(const Soup& soup) {
  if (!soup.polygons.empty()) return;
  throw InputError({}, 0, "the model has no polygon with an area",
                   "check that the file holds faces and not only lines or points, and that its units are right");
}

}  // namespace

CleanSurface clean(const Model& model, const CleanOptions& options, Progress* progress) {
  assert(std::all_of(model.vertices.begin(), model.vertices.end(), [](const Point& p) { return is_finite(p); }));
  using Mode = CleanOptions::Repair;
  NoProgress unwatched;
  Progress& watcher = progress != nullptr ? *progress : unwatched;
  watcher.phase("placing");
  CleanSurface surface;
  CleanReport& report = surface.report;
  Soup soup = to_soup(model);
  report.area_before_m2 = area_as_given(soup);
  if (options.repair == Mode::kAuto) {
    leave_out_far_parts(soup, options.far_away_m, model.part_names, report.notices);
  }
  surface.origin = recentre(soup);

  DefectList defects;
  if (options.repair == Mode::kReport) {
    Soup trial = soup;
    CleanReport of_trial;
    defects = Repair(trial, options, model, watcher).run(of_trial);
    report.gap_m = of_trial.gap_m;
  }
  if (options.repair == Mode::kAuto) {
    defects = Repair(soup, options, model, watcher).run(report);
    // What was dropped may have stood out.
    surface.origin = surface.origin + recentre(soup);
    surface.contact_gap_m = report.gap_m;
  } else {
    prepare(soup, options, model, report.notices);
  }
  throw_if_empty(soup);

  report.defects = std::move(defects).take(surface.origin);
  if (options.repair == Mode::kReport) {
    for (Defect& defect : report.defects) leave(defect);
  }
  report.area_after_m2 = total_area(soup);
  surface.polygons = to_model(soup, model);
  surface.passable_materials = options.passable_materials;
  for (const SoupPolygon& polygon : soup.polygons) {
    surface.source.push_back(polygon.source);
    surface.flipped.push_back(polygon.flipped ? 1 : 0);
    surface.back_material.push_back(polygon.back_material);
  }
  return surface;
}

}  // namespace clerestory::mesh
