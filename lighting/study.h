// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lighting/channels.h"
#include "lighting/en12464_tasks.h"
#include "lighting/luminaire.h"
#include "lighting/material.h"
#include "lighting/sky.h"
#include "mesh/clean.h"
#include "mesh/geometry.h"
#include "mesh/model.h"
#include "mesh/rooms.h"

namespace clerestory::lighting {

/// How bright the sources of a group are, as a share of what they are given with.
struct Dimming {
  std::string group;
  double share = 1.0;
};

/// A grid of sensors, as asked for.
struct GridRequest {
  std::string name = "workplane";
  /// "rooms", or names of parts or materials (globs); empty when points are given.
  std::vector<std::string> surfaces;
  /// Given sensors: positions [m, model coordinates] and unit normals, in the order of the file.
  std::vector<mesh::Point> points;
  std::vector<mesh::Vector> normals;
  std::string points_file;  ///< where the points come from, for messages
  double height_m = 0.8;
  double spacing_m = 0.25;
  bool en12464_spacing = false;
  std::optional<double> margin_m;  ///< none: the smaller of 0.5 m and 15 % of the room's smaller width
  /// Whether each room gets a grid of its own with the name of the room, in place of one for all; surfaces are "rooms" then.
  bool by_room = false;
  /// What the sensors receive, where it is not the light on the surface: that from the side they look to (a unit vector), or the
  /// cylindrical illuminance about the surface's normal.
  std::optional<mesh::Vector> look;
  bool cylindrical = false;
  std::string direction = "surface";  ///< the same in the study's word
  bool modelling = false;             ///< whether the cylindrical illuminance is told beside the sensors' own
};

/// Someone whose glare is asked for.
struct Observer {
  std::string name;
  mesh::Point eye;    ///< [m, model coordinates]
  mesh::Vector look;  ///< of unit length
};

/// A visual task to be judged by EN 12464-1, in each room whose name fits.
struct TaskRequest {
  std::string name;
  TaskRequirements required;
  std::string rooms = "*";  ///< names, a glob
  /// Where the task is done, in plan [m, model coordinates]: two corners; none: all of the room.
  std::optional<mesh::Box> rectangle;
  double height_m = 0.75;     ///< of the task area above the floor
  double eye_height_m = 1.2;  ///< of the cylindrical illuminance and of the observers: 1.2 m seated, 1.6 m standing
};

/// The one number that the user asks for, and what tests may vary.
struct Accuracy {
  double target = 0.02;    ///< what it promises: docs/theory/accuracy.md
  std::uint64_t seed = 0;  ///< of the low-discrepancy points' scrambling
};

/// Parts of the solver that benchmarks switch off, to tell what each saves (benchmarks/solver_parts.py). Runs for users have all of them.
struct SolverParts {
  bool clusters = true;    ///< off: links begin with pairs of surfaces
  bool importance = true;  ///< off: all surfaces matter by their area
  bool proofs = true;      ///< off: no visibility is proven by shafts, all pairs are sampled
};

/// The mesh of the surfaces.
struct MeshRequest {
  bool discontinuities = true;           ///< lines of discontinuity are edges of what is shown
  std::size_t max_elements = 1'000'000;  ///< of the solution; triangles of the surfaces with such lines
};

/// A study in memory: what io reads, and what run() answers.
struct Study {
  enum class Kind { kIlluminance, kDaylight };

  Kind kind = Kind::kIlluminance;
  std::string name;                 ///< stem of the study or model file
  mesh::Model model;                ///< metres, z up, model coordinates
  std::vector<mesh::Space> spaces;  ///< what the model's file calls rooms, model coordinates
  std::vector<Material> materials;  ///< one a model material, in the model's order
  /// Of the bands in luminance, with a sum of 1. Empty: one band, or Radiance's three primaries where a material is coloured.
  std::vector<float> band_weights;
  mesh::CleanOptions clean;
  Sky sky;
  /// Where light is asked for at several moments: the sky of each, with its name in columns; `sky` is their mean_sky() then.
  std::vector<Sky> moments;
  std::vector<Luminaire> luminaires;  ///< model coordinates
  std::vector<GridRequest> grids;
  std::vector<Observer> observers;
  std::vector<TaskRequest> tasks;
  double north_deg = 0.0;  ///< from +y, counter-clockwise
  Accuracy accuracy;
  Columns columns = Columns::kMix;  ///< whose results are given apart
  std::vector<Dimming> dimming;     ///< of groups
  MeshRequest mesh;
  SolverParts parts;
  bool keep_solution = false;            ///< for sense()
  std::vector<std::string> assumptions;  ///< what was assumed on reading, one sentence each
};

}  // namespace clerestory::lighting
