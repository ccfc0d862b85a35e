// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/run.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "lighting/all_sensors.h"
#include "lighting/channel_solver.h"
#include "lighting/direct_light.h"
#include "lighting/discontinuities.h"
#include "lighting/energy.h"
#include "lighting/gather.h"
#include "lighting/group_gather.h"
#include "lighting/importance.h"
#include "lighting/installed.h"
#include "lighting/limited_progress.h"
#include "lighting/observers.h"
#include "lighting/parallel.h"
#include "lighting/phase_clock.h"
#include "lighting/radiosity.h"
#include "lighting/relighting.h"
#include "lighting/resolve.h"
#include "lighting/scene.h"
#include "lighting/sensor_probe.h"
#include "lighting/sensor_walks.h"
#include "lighting/shower.h"
#include "lighting/surface_values.h"
#include "lighting/task_results.h"
#include "mesh/element_tree.h"
#include "mesh/hash.h"
#include "mesh/phase_part.h"
#include "mesh/slits.h"

namespace clerestory::lighting {

namespace {

/// Error at the sensors that one node's direct light may cause, as a share of the accuracy: many such errors, of either sign, add up.
/// Measured on the validation scenes.
constexpr double kDirectShare = 0.002;
/// What the table, the map and the picture of a grid take to be written, measured [CPU s].
constexpr double kWritingOfGridS = 0.25;
/// Longest edge of the elements that the solver starts from [m]; it splits them on.
constexpr double kStartSizeM = 1e9;

/// Of the elements that may be made, those that direct light may take: light that is reflected needs some too.
constexpr double kElementsOfDirectLight = 0.5;

/// Lines across which light itself jumps that the elements do not cross: so many at most.
constexpr std::size_t kMostJumps = 2000;

/// Of the time of their phases, measured on the validation scenes.
constexpr double kShareOfJumps = 0.3;
constexpr double kShareOfStartMesh = 0.8;
/// Faces that send less of the light than this share of the accuracy are hardly ever refined.
constexpr double kTrifle = 3e-3;
constexpr double kShareOfShownMesh = 0.5;

void to_model(Sensors& sensors, const mesh::Vector& origin) {
  for (mesh::Point& p : sensors.positions) p = p + origin;
  for (auto& cell : sensors.cells) {
    for (mesh::Point& p : cell) p = p + origin;
  }
  for (auto& outline : sensors.outlines) {
    for (mesh::Point& p : outline) p = p + origin;
  }
}

/// The cylindrical illuminance where a grid's sensors stand.
void evaluate_cylinders(const Study& study, const Solution& solution, const SolutionErrors& errors, GridResult& grid,
                        std::uint64_t seed, Progress& progress) {
  const std::vector<mesh::Vector> axes(grid.sensors.count(), mesh::Vector{0.0, 0.0, 1.0});
  const Gathered gathered =
      gather(solution, errors, {grid.sensors.positions, axes, true}, study.accuracy.target, mesh::mix(seed), progress);
  grid.cylindrical_lux = gathered.illuminance_lux;
  grid.cylindrical_error_lux = gathered.error_lux;
}

/// @param groups  none where groups are not told apart
void evaluate(const Study& study, const Solution& solution, const SolutionErrors& errors,
              const std::optional<GroupRadiosity>& groups, GridResult& grid, std::uint64_t seed, Progress& progress) {
  const SensorSet sensors{grid.sensors.positions, grid.sensors.normals, grid.sensors.cylinders};
  const Gathered gathered = gather(solution, errors, sensors, study.accuracy.target, seed, progress);
  grid.illuminance_lux = gathered.illuminance_lux;
  grid.error_lux = gathered.error_lux;
  if (groups) grid.groups = gather_groups(solution, *groups, gathered, sensors, seed);
  if (!grid.cylindrical_lux.empty()) evaluate_cylinders(study, solution, errors, grid, seed, progress);
  const double outside = study.sky.diffuse_illuminance_lux();
  if (study.kind == Study::Kind::kDaylight && outside > 0.0) {
    for (const float e : grid.illuminance_lux) {
      grid.daylight_factor_percent.push_back(static_cast<float>(100.0 * e / outside));
    }
  }
  to_model(grid.sensors, solution.scene().faces.origin);
  grid.metrics = grid_metrics(grid, study.accuracy.target);
}

/// Each grid has its share of the phase by its sensors.
void evaluate_all(const Study& study, const Solution& solution, const SolutionErrors& errors,
                  const std::optional<GroupRadiosity>& groups, std::vector<GridResult>& grids, std::uint64_t seed,
                  Progress& progress) {
  double all = 0.0;
  for (const GridResult& grid : grids) all += static_cast<double>(grid.sensors.count());
  double before = 0.0;
  for (std::size_t g = 0; g < grids.size(); ++g) {
    const double end = before + static_cast<double>(grids[g].sensors.count());
    PhasePart part(progress, before / all, end / all);
    evaluate(study, solution, errors, groups, grids[g], mesh::hash(seed, g), part);
    before = end;
  }
}

/// What was found moment by moment: all of the first grid, then of the next.
template <class Found>
std::vector<Found> by_subject(std::vector<std::vector<Found>> by_moment) {
  std::vector<Found> in_order;
  for (std::size_t i = 0; !by_moment.empty() && i < by_moment.front().size(); ++i) {
    for (std::vector<Found>& found : by_moment) in_order.push_back(std::move(found[i]));
  }
  return in_order;
}

/// What observers see, and how tasks are judged by it and by the grids.
void evaluate_tasks(const Study& study, const Solution& solution, const SolutionErrors& errors,
                    const AllSensors& sensors, std::uint64_t seed, Results& results, Progress& progress) {
  if (!sensors.observers.empty()) {
    PhasePart end(progress, 1.0, 1.0);
    results.observers = observe(solution, errors, sensors.observers, study.accuracy.target, mesh::mix(seed), end);
  }
  results.tasks = judge_tasks(study, solution.scene(), sensors.tasks, results);
}

/// The surfaces, with the lines of discontinuity in their mesh where these are asked for and limits allow.
void show_surfaces(const Study& study, const Solution& solution, const Transport& transport,
                   std::span<const NodeDirect> nodes, const Importance& importance, Results& results,
                   Progress& progress) {
  const Arrivals& arrivals = transport.arrivals;
  const SolutionErrors& errors = transport.errors;
  PhasePart meshing(progress, 0.0, kShareOfShownMesh);
  Shower shower(study, solution, arrivals, errors, nodes, importance, meshing);
  try {
    PhasePart lighting(progress, kShareOfShownMesh, 1.0);
    results.surfaces = shower.light(solution, arrivals, errors, lighting);
  } catch (const LimitedProgress::ShowingIsOver&) {
    shower.give_up();
    results.surfaces = surface_values(solution, errors);
  }
  tell_of_lines(shower, solution.scene(), results);
}

/// Lines that the elements do not cross: the feet of slits, and those across which light jumps.
std::vector<mesh::FaceLine> start_lines(const Scene& scene, Progress& progress) {
  std::vector<mesh::FaceLine> lines = mesh::feet_of(scene.slits);
  LineOptions jumps;
  PhasePart finding(progress, 0.0, kShareOfJumps);
  jumps.progress = &finding;
  jumps.jumps_only = true;
  jumps.most_lines = kMostJumps;
  for (const mesh::DiscontinuityLine& line : find_discontinuities(scene, jumps).lines)
    lines.push_back({line.face, line.ends});
  return lines;
}

/// Non-zero for faces from which more than a trifle of the light is likely to come to the sensors, for what walks have met behind black
/// surfaces, which is there to be looked at, and without walks for all. Elements will be small there, and should have good angles. All others,
/// in a large model nearly all, get as few start triangles as they can.
std::vector<std::uint8_t> faces_that_matter(const Scene& scene, const std::vector<SensorWalk>& walks, double accuracy) {
  std::vector<double> share(scene.faces.count(), 0.0);
  std::vector<std::uint8_t> faces(scene.faces.count(), walks.empty() ? 1 : 0);
  double all = 0.0;
  for (const SensorWalk& walk : walks) {
    for (const SensorWalk::End& end : walk.ends) {
      share[end.side.face.index()] += static_cast<double>(end.weight);
      all += static_cast<double>(end.weight);
      if (end.weight <= 0.0F) faces[end.side.face.index()] = 1;
    }
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (share[f] > kTrifle * accuracy * all) faces[f] = 1;
  }
  return faces;
}

/// No light yet, and a few elements a region of a face side: contacts and the lines are their edges.
Solution unsolved(const Scene& scene, const StartMesh& with, Progress& progress) {
  mesh::MeshOptions options;
  options.max_size_m = kStartSizeM;
  options.lines = with.lines;
  options.refined = with.refined;
  const mesh::Triangulation start = mesh::mesh_faces(scene.faces, options);
  progress.advance(kShareOfStartMesh);
  Solution solution(scene, mesh::ElementTree(scene.faces, start, scene.has_elements));
  progress.advance(1.0);
  return solution;
}

/// As many elements as there may be after direct light.
std::size_t for_direct_light(const Solution& solution, std::size_t most) {
  const auto left = static_cast<double>(most - std::min(most, solution.element_count()));
  return solution.element_count() + static_cast<std::size_t>(kElementsOfDirectLight * left);
}

void conclude(const Study& study, const Scene& scene, const LimitedProgress& progress, Results& results) {
  results.rooms = rooms_in_model(scene);
  results.luminaires = luminaire_uses(scene);
  results.room_power = room_powers(scene);
  if (results.surfaces.moments.empty()) results.material_light = material_lights(results.surfaces);
  results.clean = scene.clean_report;
  results.materials = scene.materials;
  results.assumptions = scene.assumptions;
  results.notices.insert(results.notices.begin(), scene.notices.begin(), scene.notices.end());
  results.counts.parts = scene.faces.part_names.size();
  results.counts.polygons = study.model.polygon_count();
  results.counts.faces = scene.faces.count();
  results.counts.openings = scene.openings.size();
  results.counts.rays = scene.rays->use().rays;
  results.horizontal_illuminance_lux = study.sky.diffuse_illuminance_lux();
  results.accuracy_target = study.accuracy.target;
  results.stopped = progress.stopped();
  if (results.stopped && results.stopped->by == Stop::By::kElements)
    results.notices.push_back("refinement ended with " + std::to_string(results.counts.elements) +
                              " elements: mesh.max_elements allows no more");
  results.converged = progress.converged();
  if (const auto note = imbalance_note(results.energy, study.accuracy.target); note && results.converged)
    results.notices.push_back(*note);
  results.accuracy_met = results.converged;
  for (const GridResult& grid : results.grids) {
    results.accuracy_reached = std::max(results.accuracy_reached, grid.metrics.accuracy_reached);
    results.accuracy_met = results.accuracy_met && grid.metrics.accuracy_met;
    if (grid.metrics.maximum_lux == 0.0)
      results.notices.push_back("grid '" + grid.name + "'" + (grid.moment.empty() ? "" : " at " + grid.moment) +
                                ": no light reaches it, every value is zero; where light should " +
                                "come in, name a glazing material or mark an opening");
  }
}

GroupRadiosity solve_groups(const Solution& solution, const Transport& transport) {
  return solve_channels(solution, ChannelSystem(solution, transport.arrivals, transport.clusters), transport.groups);
}

/// What did not converge is of no use to others.
void keep(const Solution& solution, const Transport& transport, const KnownLight& light, double accuracy,
          Results& results) {
  if (!results.converged) {
    results.notices.emplace_back("the solution is not kept: it did not converge");
    return;
  }
  results.solution = store(solution, transport, light, accuracy);
  results.solution->energy = results.energy;
}

/// Suns of several moments in one are to be cast by themselves.
KnownLight light_of(const Scene& scene, const Transport& transport) {
  KnownLight light{scene.groups.all(), transport.groups, {}};
  if (!scene.sky.parts.empty()) return light;
  for (const SunDirect& sun : transport.suns) light.errors.push_back({sun.node, scene.groups.of_sun(), sun.errors});
  return light;
}

/// What several moments give, one after the other on the links of one solution.
class Moments {
 public:
  /// @param scene  of the relit solution; left with the sky of the moment that was lit last
  /// @param kept   whether the light of patches of the sky is known, and may be needed
  Moments(const Study& study, Scene& scene, const AllSensors& sensors, const Solution& solution, Relighting& relighting,
          bool kept)
      : study_(study), scene_(scene), sensors_(sensors), solution_(solution), relighting_(relighting), kept_(kept) {}

  /// Measures all suns.
  void cast_suns() {
    for (const Sky& moment : study_.moments) {
      if (moment.sun.shines()) relighting_.cast(moment.sun, "sun_" + moment.moment);
    }
  }

  /// Each grid at each moment, in the place of the grids as they were placed; observers and tasks likewise.
  void gather(Results& results, std::uint64_t seed, Progress& progress) {
    std::vector<std::vector<GridResult>> grids;
    std::vector<std::vector<ObserverResult>> observers;
    std::vector<std::vector<TaskResult>> tasks;
    for (std::size_t m = 0; m < study_.moments.size(); ++m) {
      PhasePart part(progress, share(m), share(m + 1));
      const Transport& transport = light(m, part);
      results.counts.iterations += transport.iterations;
      std::optional<GroupRadiosity> groups;
      if (scene_.groups.has_columns()) groups = solve_groups(solution_, transport);
      Results own;
      own.grids = results.grids;
      evaluate_all(study_, solution_, transport.errors, groups, own.grids, seed, part);
      evaluate_tasks(study_, solution_, transport.errors, sensors_, seed, own, part);
      name(study_.moments[m].moment, own);
      grids.push_back(std::move(own.grids));
      observers.push_back(std::move(own.observers));
      tasks.push_back(std::move(own.tasks));
    }
    results.grids = by_subject(std::move(grids));
    results.observers = by_subject(std::move(observers));
    results.tasks = by_subject(std::move(tasks));
  }

  /// The surfaces at each moment.
  void show(Shower& shower, Results& results, Progress& progress) {
    SurfaceResult& all = results.surfaces;
    for (std::size_t m = 0; m < study_.moments.size(); ++m) {
      PhasePart part(progress, share(m), share(m + 1));
      const Transport& transport = light(m, part);
      SurfaceResult own = shower.light(solution_, transport.arrivals, transport.errors, part);
      all.moments.push_back({study_.moments[m].moment, std::move(own.point_illuminance_lux),
                             std::move(own.illuminance_lux), std::move(own.error_lux), std::move(own.radiosity_lm_m2),
                             std::move(own.luminance_cd_m2)});
      if (m > 0) continue;
      own.moments = std::move(all.moments);
      all = std::move(own);
      for (auto* light : {&all.point_illuminance_lux, &all.illuminance_lux, &all.error_lux, &all.radiosity_lm_m2,
                          &all.luminance_cd_m2})
        light->clear();
    }
  }

 private:
  static void name(const std::string& moment, Results& own) {
    for (GridResult& grid : own.grids) grid.moment = moment;
    for (ObserverResult& observer : own.observers) observer.moment = moment;
    for (TaskResult& task : own.tasks) task.moment = moment;
  }

  [[nodiscard]] double share(std::size_t moments) const {
    return static_cast<double>(moments) / static_cast<double>(study_.moments.size());
  }

  const Transport& light(std::size_t m, const Progress& progress) {
    const Sky& sky = study_.moments[m];
    // A dark sky is a group too, so that there is one, and columns are alike at all moments.
    set_sky(scene_, sky,
            kept_ ? SourceGroups(study_.columns, true, true, sky.sun.shines(), study_.north_deg)
                  : SourceGroups::of_moment(study_.columns, true, sky.sun.shines()));
    return relighting_.light(progress);
  }

  const Study& study_;
  Scene& scene_;
  const AllSensors& sensors_;
  const Solution& solution_;
  Relighting& relighting_;
  bool kept_;
};

/// Surfaces at all moments, in the mesh that their mean asks for.
void show_surfaces(Moments& moments, Shower& shower, const Solution& solution, Results& results, Progress& progress) {
  try {
    moments.show(shower, results, progress);
  } catch (const LimitedProgress::ShowingIsOver&) {
    shower.give_up();
    results.surfaces = {};
    NoProgress unwatched;
    moments.show(shower, results, unwatched);
  }
  tell_of_lines(shower, solution.scene(), results);
}

/// A study that is solved.
struct Solved {
  Scene& scene;
  Solution& solution;
  const AllSensors& sensors;
  Transport transport;
  std::vector<NodeDirect> nodes;
  const Importance* importance = nullptr;  ///< null where a stored solution is sensed
  std::uint64_t seed = 0;
};

/// The phase of light at sensors, for one moment.
void gather_all(const Study& study, const Solved& solved, const SolutionErrors& errors,
                const std::optional<GroupRadiosity>& groups, PhaseClock& clock, LimitedProgress& progress,
                Results& results) {
  clock.begin("gathering", progress);
  progress.enter(LimitedProgress::Stage::kGathering);
  evaluate_all(study, solved.solution, errors, groups, results.grids, solved.seed, progress);
  evaluate_tasks(study, solved.solution, errors, solved.sensors, solved.seed, results, progress);
}

/// From the solution to the results.
void answer(const Study& study, const Solved& solved, PhaseClock& clock, LimitedProgress& progress, Results& results) {
  using Stage = LimitedProgress::Stage;
  const auto& [scene, solution, sensors, transport, nodes, importance, seed] = solved;
  std::optional<GroupRadiosity> groups;
  if (scene.groups.has_columns()) {
    clock.begin("channels", progress);
    groups = solve_groups(solution, transport);
  }
  gather_all(study, solved, transport.errors, groups, clock, progress, results);

  clock.begin("balancing", progress);
  progress.enter(Stage::kShowing);
  results.energy = energy_balance(solution, transport, seed);

  clock.begin("shadows", progress);
  show_surfaces(study, solution, transport, nodes, *importance, results, progress);
  conclude(study, scene, progress, results);
  if (study.keep_solution) keep(solution, transport, light_of(scene, transport), study.accuracy.target, results);
}

/// The same for several moments: the solution is of their mean, and lit anew for each. Its energy balance is that of the mean.
void answer_moments(const Study& study, Solved solved, PhaseClock& clock, LimitedProgress& progress, Results& results) {
  using Stage = LimitedProgress::Stage;
  auto& [scene, mean, sensors, transport, nodes, importance, seed] = solved;
  clock.begin("balancing", progress);
  results.energy = energy_balance(mean, transport, seed);

  clock.begin("suns", progress);
  progress.enter(Stage::kGathering);
  Solution lit = mean;
  const SolutionErrors errors = transport.errors;
  Relighting relighting(lit, transport, light_of(scene, transport), study.accuracy.target);
  Moments moments(study, scene, sensors, lit, relighting, study.keep_solution);
  moments.cast_suns();
  std::optional<StoredSolution> kept;
  if (study.keep_solution) {
    keep(mean, transport, relighting.known(), study.accuracy.target, results);
    kept.swap(results.solution);
  }
  transport = {};

  clock.begin("gathering", progress);
  moments.gather(results, seed, progress);

  clock.begin("shadows", progress);
  progress.enter(Stage::kShowing);
  scene.sky = study.sky;
  PhasePart meshing(progress, 0.0, kShareOfShownMesh);
  Shower shower(study, mean, relighting.arrivals(), errors, nodes, *importance, meshing);
  PhasePart lighting(progress, kShareOfShownMesh, 1.0);
  show_surfaces(moments, shower, lit, results, lighting);
  conclude(study, scene, progress, results);
  if (results.converged) results.solution = std::move(kept);
}

/// From a stored solution to the results, where all shines and reflects as it did.
void sense_as_stored(const Study& study, const StoredSolution& stored, Solved solved, PhaseClock& clock,
                     LimitedProgress& progress, Results& results) {
  const SolutionErrors errors = restore(stored, solved.solution);
  gather_all(study, solved, errors, std::nullopt, clock, progress, results);
}

/// The same by solving on the stored links.
void sense_anew(const Study& study, const StoredSolution& stored, Solved solved, PhaseClock& clock,
                LimitedProgress& progress, Results& results) {
  auto& [scene, solution, sensors, transport, nodes, importance, seed] = solved;
  clock.begin("solving", progress);
  Relighting relighting = relighting_of(stored, solution);
  if (!study.moments.empty()) {
    clock.begin("gathering", progress);
    progress.enter(LimitedProgress::Stage::kGathering);
    Moments(study, scene, sensors, solution, relighting, true).gather(results, seed, progress);
    return;
  }
  transport = relighting.light(progress);
  std::optional<GroupRadiosity> groups;
  if (scene.groups.has_columns()) groups = solve_groups(solution, transport);
  results.counts.iterations = transport.iterations;
  clock.begin("balancing", progress);
  results.energy = energy_balance(solution, transport, seed);
  gather_all(study, solved, transport.errors, groups, clock, progress, results);
}

/// Tells what errors of the solution make at some of the sensors; nothing where other questions will be asked of it: by other moments, or by
/// those who read what is stored.
std::function<double(const SolutionErrors&)> probe_of(const Study& study, const Solution& solution,
                                                      const AllSensors& sensors, std::uint64_t seed) {
  const Scene& scene = solution.scene();
  if (study.keep_solution || !study.moments.empty() || sensors.positions.empty()) return {};
  return [&solution, probe = SensorProbe(scene, sensors.positions, sensors.normals, sensors.grids, seed)](
             const SolutionErrors& errors) { return probe.discretisation(solution, errors); };
}

ThreadLimit& thread_limit() {
  static ThreadLimit limit;
  return limit;
}

}  // namespace

void set_threads(int threads) {
  thread_limit().reset();
  if (threads > 0) thread_limit() = limit_threads(static_cast<std::size_t>(threads));
}

Results run(const Study& study, Progress& watched, const Limits& limits) {
  using Stage = LimitedProgress::Stage;
  Results results;
  PhaseClock clock(results.phases);
  LimitedProgress progress(watched, limits);
  clock.begin("cleaning the model", progress);
  Scene scene = build_scene(study, &progress);
  clock.watch(*scene.rays);

  clock.begin("placing sensors", progress);
  const AllSensors sensors = place_all_sensors(study, scene, results, progress);

  progress.leave_time(kWritingOfGridS * static_cast<double>(results.grids.size()));
  clock.begin("meshing", progress);
  const std::uint64_t seed = mesh::mix(study.accuracy.seed);
  const std::vector<SensorWalk> walks = walk_from_sensors(scene, sensors.positions, sensors.normals, seed);
  const StartMesh start{start_lines(scene, progress), faces_that_matter(scene, walks, study.accuracy.target)};
  Solution solution = unsolved(scene, start, progress);

  clock.begin("direct light", progress);
  progress.enter(Stage::kDirectLight);
  Importance importance(solution, walks, sensors.grids);
  if (!study.parts.importance) importance.forget_sensors(solution.tree());
  const double target = study.accuracy.target;
  solution.limit_elements(for_direct_light(solution, study.mesh.max_elements));
  DirectLight direct = light_directly(solution, importance, kDirectShare * target, seed, progress);
  if (direct.out_of_elements) progress.out_of_elements();

  clock.begin("linking", progress);
  progress.enter(Stage::kLinking);
  solution.limit_elements(study.mesh.max_elements);
  Solved solved{scene, solution, sensors, {}, direct.nodes, &importance, seed};
  solved.transport = solve(solution, importance, std::move(direct),
                           {.accuracy = target,
                            .seed = seed,
                            .error_at_sensors = probe_of(study, solution, sensors, seed),
                            .clusters = study.parts.clusters,
                            .keep_link_errors = study.keep_solution || !study.moments.empty()},
                           progress);
  if (solved.transport.out_of_elements) progress.out_of_elements();
  results.counts.elements = solution.elements().size();
  results.counts.links = solved.transport.arrivals.count();
  results.counts.link_bytes = solved.transport.arrivals.bytes();
  results.counts.iterations = solved.transport.iterations;

  if (study.moments.empty())
    answer(study, solved, clock, progress, results);
  else
    answer_moments(study, std::move(solved), clock, progress, results);
  if (results.solution) store(start, *results.solution);
  clock.end();
  return results;
}

Results sense(const Study& asked, const StoredSolution& stored, Progress& watched, const Limits& limits) {
  Study study = asked;
  study.keep_solution = true;  // its light is told apart as it was stored
  Results results;
  PhaseClock clock(results.phases);
  LimitedProgress progress(watched, limits);
  clock.begin("cleaning the model", progress);
  Scene scene = build_scene(study, &progress);
  clock.watch(*scene.rays);

  clock.begin("placing sensors", progress);
  const AllSensors sensors = place_all_sensors(study, scene, results, progress);

  clock.begin("meshing", progress);
  Solution solution = unsolved(scene, start_of(stored, scene), progress);
  const std::uint64_t seed = mesh::mix(study.accuracy.seed);
  results.energy = stored.energy;
  results.counts.links = stored.links;
  const bool anew = needs_solving(stored, scene) || scene.groups.has_columns() || !study.moments.empty();
  if (anew)
    sense_anew(study, stored, {scene, solution, sensors, {}, {}, nullptr, seed}, clock, progress, results);
  else
    sense_as_stored(study, stored, {scene, solution, sensors, {}, {}, nullptr, seed}, clock, progress, results);
  results.counts.elements = solution.elements().size();
  conclude(study, scene, progress, results);
  clock.end();
  return results;
}

}  // namespace clerestory::lighting
