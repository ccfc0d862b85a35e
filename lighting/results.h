// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lighting/energy_balance.h"
#include "lighting/stored_solution.h"
#include "lighting/study.h"
#include "mesh/clean.h"
#include "mesh/discontinuity_selection.h"
#include "mesh/faces.h"
#include "mesh/geometry.h"
#include "mesh/rooms.h"

namespace clerestory::lighting {

/// Sensors of a grid. Arrays are parallel; model coordinates [m].
struct Sensors {
  std::vector<mesh::Point> positions;
  std::vector<mesh::Vector> normals;
  /// The cell of each sensor: a quadrilateral in the sensor plane; empty for a list of points without order.
  std::vector<std::array<mesh::Point, 4>> cells;
  /// Outlines of the rooms (or surfaces) that the grid covers, closed loops in the sensor plane; empty where unknown.
  std::vector<std::vector<mesh::Point>> outlines;
  std::size_t left_out = 0;  ///< sensors inside solids
  /// The number of each sensor, from 0: for given points the place in their file, where those left out keep theirs.
  std::vector<std::uint32_t> ids;
  /// Whether they are upright cylinders, whose axes the normals are, and their light is the cylindrical illuminance.
  bool cylinders = false;

  [[nodiscard]] std::size_t count() const { return positions.size(); }
};

/// Figures of one grid.
struct GridMetrics {
  double mean_lux = 0.0;
  double median_lux = 0.0;
  double minimum_lux = 0.0;
  double maximum_lux = 0.0;
  double uniformity = 0.0;          ///< minimum / mean
  double accuracy_reached = 0.0;    ///< RMS of error / max(E, 5 % of the mean)
  double share_within_twice = 1.0;  ///< of sensors whose error is at most twice the target
  bool accuracy_met = false;
  double mean_cylindrical_lux = 0.0;  ///< where it is asked for
  double mean_modelling = 0.0;        ///< of cylindrical by own illuminance, where there is light
  bool has_daylight_factor = false;
  double mean_df_percent = 0.0;
  double median_df_percent = 0.0;
  double minimum_df_percent = 0.0;
  double share_above_2_percent = 0.0;  ///< of the area (sensors) with a daylight factor of at least 2 % [0 … 1]
  double share_above_5_percent = 0.0;
};

/// Light of one source group at the sensors of a grid [lux].
struct GroupColumn {
  std::string name;
  std::vector<float> illuminance_lux;
  std::vector<float> error_lux;  ///< standard uncertainty, k = 1
};

struct GridResult {
  std::string name;
  std::string
      moment;  ///< where there are several: each has a result of its own, one behind another, of the same sensors
  Sensors sensors;
  std::vector<float> illuminance_lux;
  std::vector<float> error_lux;                ///< standard uncertainty, k = 1
  std::vector<float> daylight_factor_percent;  ///< empty unless a daylight study
  std::string direction = "surface";           ///< which light the sensors receive, in the study's word
  /// Cylindrical illuminance in the same places and its error; empty where not asked for.
  std::vector<float> cylindrical_lux;
  std::vector<float> cylindrical_error_lux;
  std::vector<GroupColumn> groups;  ///< where they are asked for; they add up to illuminance_lux
  /// Where in the plane of the sensors the sky just goes out of sight by an opening [m, model coordinates].
  std::vector<std::array<mesh::Point, 2>> no_sky;
  GridMetrics metrics;
};

/// What an observer sees of the luminaires.
struct ObserverResult {
  Observer observer;
  std::string moment;               ///< where there are several: each has a result of its own, one behind another
  std::optional<std::size_t> room;  ///< among the rooms of the results
  double ugr = 0.0;                 ///< minus infinity where nothing glares
  double ugr_error = 0.0;           ///< standard uncertainty (k = 1), by that of the background
  double background_cd_m2 = 0.0;
  double indirect_lux = 0.0;     ///< vertical at the eye
  std::size_t glaring = 0;       ///< luminaires and surfaces that shine towards the eye, before the observer
  std::size_t small = 0;         ///< of them, those under 0.0003 sr
  std::size_t large = 0;         ///< and those over 0.1 sr: CIE 117 is not made for either
  std::size_t without_area = 0;  ///< luminaires without a luminous area, left out
};

/// What a task asks for and has.
struct Criterion {
  enum class Verdict { kPass, kFail, kUndecided };

  std::string what;  ///< "maintained mean of the task area" …
  std::string unit;  ///< "lx", or empty
  double required = 0.0;
  bool at_most = false;  ///< required is the most, else the least
  double found = 0.0;
  double error = 0.0;  ///< standard uncertainty (k = 1)
  Verdict verdict = Verdict::kUndecided;
};

/// A task in a room, judged.
struct TaskResult {
  std::string name;
  std::string moment;  ///< where there are several: each has a result of its own, one behind another
  std::string task;    ///< that is done, with its reference in the standard
  std::string room;
  std::vector<std::string> grids;
  std::vector<std::string> observers;
  std::vector<Criterion> criteria;
  double power_w_m2_per_100_lux =
      0.0;  ///< of the room, by the mean of the task area; 0 where none is stated or the sky shines too
  std::vector<std::string> remarks;  ///< one sentence each
  Criterion::Verdict verdict = Criterion::Verdict::kUndecided;
};

/// Luminaires of one kind and group.
struct LuminaireUse {
  std::string name;
  std::string group;
  std::size_t count = 0;
  double flux_lm = 0.0;  ///< of all of them, maintained and dimmed
  double power_w = 0.0;  ///< of all of them undimmed; 0 where the file does not state it
};

/// The installed power of a room.
struct RoomPower {
  std::string room;
  std::size_t number = 0;  ///< of the room
  std::size_t luminaires = 0;
  double power_w = 0.0;
  double per_area_w_m2 = 0.0;
};

/// What a material receives and sends, of all its sides that take part.
struct MaterialLight {
  std::string name;
  double area_m2 = 0.0;
  double illuminance_lux = 0.0;  ///< mean by area
  double luminance_cd_m2 = 0.0;
};

/// Light on the surfaces at one of several moments; arrays as those of SurfaceResult.
struct SurfaceLight {
  std::string moment;
  std::vector<float> point_illuminance_lux;
  std::vector<float> illuminance_lux;
  std::vector<float> error_lux;
  std::vector<float> radiosity_lm_m2;
  std::vector<float> luminance_cd_m2;
};

/// The solution on the surfaces, as triangles with their own three points each where light is discontinuous. Points of curved parts lie on
/// the limit surface, and are shared across its smooth edges.
/// Front cells are wound as the file's polygons, back cells the other way. Model coordinates [m].
struct SurfaceResult {
  std::vector<mesh::Point> points;
  std::vector<float> point_illuminance_lux;
  std::vector<mesh::Vector>
      point_normals;  ///< unit length, of the cells' side; of curved parts those of the limit surface
  std::vector<std::array<std::uint32_t, 3>> cells;
  std::vector<std::uint8_t> side;
  std::vector<float> illuminance_lux;
  std::vector<float> error_lux;
  std::vector<float> radiosity_lm_m2;
  std::vector<float> luminance_cd_m2;
  std::vector<float> reflectance;
  std::vector<std::int32_t> level;
  std::vector<std::int32_t> part;
  std::vector<std::int32_t> material;
  std::vector<std::int32_t> room;  ///< -1 where none is known
  std::vector<std::string> part_names;
  std::vector<std::string> material_names;
  std::vector<std::string> room_names;
  std::vector<SurfaceLight> moments;  ///< where there are several; the arrays of light above are empty then
};

/// What has ended a run's refinement in the place of its accuracy, and where.
struct Stop {
  enum class By { kTime, kMemory, kUser, kElements };

  By by = By::kTime;
  std::string phase;
};

struct PhaseTime {
  std::string name;
  double cpu_s = 0.0;
  double wall_s = 0.0;
  std::uint64_t rays = 0;
  double ray_s = 0.0;  ///< of the CPU time, in the ray tracer, about
};

/// The lines of discontinuity that are edges of a mesh; model coordinates [m]. Arrays by line.
struct ElementLines {
  std::vector<std::array<mesh::Point, 2>> ends;
  std::vector<std::uint8_t> order;
  std::vector<std::uint8_t> no_sky;
  std::vector<std::uint8_t> side;
  std::vector<std::int32_t> source;    ///< index into source_names
  std::vector<std::int32_t> occluder;  ///< part
  std::vector<std::int32_t> part;      ///< on which it lies
  std::vector<std::string> source_names;
  std::vector<std::string> part_names;
};

/// Lines of discontinuity in the mesh of what is shown.
struct ShadowLines {
  ElementLines lines;
  mesh::LineSelection selection;
  mesh::MeshReport mesh;  ///< of the faces with lines
};

/// Everything that a run found. What io writes.
struct Results {
  std::vector<GridResult> grids;
  std::vector<ObserverResult> observers;
  std::vector<TaskResult> tasks;
  std::vector<LuminaireUse> luminaires;
  std::vector<RoomPower> room_power;  ///< of rooms with luminaires
  std::vector<MaterialLight> material_light;
  SurfaceResult surfaces;
  std::optional<ShadowLines> shadow_lines;  ///< where they were asked for
  std::vector<mesh::Room> rooms;            ///< boxes and openings in model coordinates
  EnergyBalance energy;
  std::optional<StoredSolution> solution;  ///< where it is to be kept
  mesh::CleanReport clean;
  struct Counts {
    std::size_t parts = 0, polygons = 0, faces = 0, elements = 0, links = 0, link_bytes = 0, rays = 0, openings = 0,
                iterations = 0;
  } counts;
  struct MaterialUse {
    std::string name, became, why;
  };
  std::vector<MaterialUse> materials;
  std::vector<PhaseTime> phases;
  double horizontal_illuminance_lux = 0.0;  ///< unobstructed, of the sky in use
  double accuracy_target = 0.0;
  double accuracy_reached = 0.0;  ///< the worst grid's
  bool converged = true;        ///< false where the solution was stopped early: its errors tell what that may have cost
  bool accuracy_met = false;    ///< by every grid, and converged
  std::optional<Stop> stopped;  ///< by a limit or by the user; none where it went on until the accuracy was reached
  std::vector<std::string> assumptions;  ///< one sentence each
  std::vector<std::string> notices;  ///< what the user should know: "no opening and no lamp: every value is zero" …
};

}  // namespace clerestory::lighting
