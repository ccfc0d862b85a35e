// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include "lighting/luminaire_mounting.h"
#include "lighting/openings.h"
#include "lighting/parallel.h"
#include "lighting/sampling.h"
#include "lighting/scene_hash.h"
#include "lighting/sun_light.h"
#include "mesh/error.h"
#include "mesh/hash.h"
#include "mesh/phase_part.h"
#include "mesh/reachable.h"

namespace clerestory::lighting {

using mesh::FaceId;
using mesh::FaceSide;
using mesh::Side;
using mesh::Vector;

namespace {

// Shares of the time of what comes up to the rooms, measured on two houses and a city block of 100 000 triangles: materials
// 1 to 39 %, most where they reflect by orientation; what light reaches 34 to 66 %; the same by triangles about 15 %.
constexpr double kShareOfMaterials = 0.1;
constexpr double kShareBeforeOpenings = 0.65;
constexpr double kShareBeforeRooms = 0.8;

/// Default reflectances by orientation, where a material says nothing [Rushmeier 1988, quoted by Cohen and Wallace 1993].
constexpr float kLooksUp = 0.2F;
constexpr float kLooksDown = 0.7F;
constexpr float kVertical = 0.5F;
constexpr float kOutdoors = 0.2F;
/// A side stands outdoors when it sees this share of its hemisphere as open sky.
constexpr double kOutdoorShare = 0.15;
/// A surface is level when its normal is within 45 degrees of the vertical.
const double kLevelCosine = std::sqrt(0.5);

constexpr std::uint32_t kProbes = 64;

/// What rays from one side of a face meet first.
struct Outlook {
  double sky_share = 0.0;      ///< of rays that meet nothing and go upwards
  double mean_distance = 0.0;  ///< to what they hit [m]; infinite when something escapes
};

Outlook outlook(const Scene& scene, FaceSide side) {
  const mesh::Frame& front = scene.faces.faces[side.face.index()].frame;
  const Vector normal = side.side == Side::kFront ? front.w : -front.w;
  const mesh::Frame frame = mesh::frame_around(normal);
  const auto triangles = scene.faces.shape.of(side.face);
  const auto& v = scene.faces.shape.vertices;
  const SobolPoints points(mesh::hash(side.index(), 17));
  Outlook seen;
  for (std::uint32_t i = 0; i < kProbes; ++i) {
    const mesh::Triangle& t = triangles[i % triangles.size()];
    const double a = std::sqrt(points.at(i, 0));
    const double b = points.at(i, 1);
    const mesh::Point& p = v[t.vertices[0]];
    const mesh::Point at = p + (a * (1.0 - b) * (v[t.vertices[1]] - p) + a * b * (v[t.vertices[2]] - p));
    const Vector d = cosine_direction(frame, points.at(i, 2), points.at(i, 3));
    const mesh::Hit hit = scene.rays->first_hit({at + scene.rays->offset_m() * normal, d});
    if (!hit.face.valid() && d.z > 0.0) seen.sky_share += 1.0 / kProbes;
    seen.mean_distance += hit.face.valid() ? hit.distance / kProbes : std::numeric_limits<double>::infinity();
  }
  return seen;
}

const Material& material_of(const Study& study, const Scene& scene, std::size_t face) {
  return study.materials[scene.faces.faces[face].material.index()];
}

/// Where two polygons lay back to back, each shows its own front.
const SideMaterial& material_of(const Study& study, const Scene& scene, FaceSide side) {
  const mesh::Face& face = scene.faces.faces[side.face.index()];
  const Material& material = study.materials[face.material_of(side.side).index()];
  return side.side == Side::kFront || face.back_material.valid() ? material.front : material.back;
}

bool is_coloured(const SideMaterial& side) {
  const auto& r = side.reflectance;
  return r && r->size() > 1 && std::any_of(r->begin(), r->end(), [&](float x) { return x != r->front(); });
}

void count_channels(const Study& study, Scene& scene) {
  const bool colour = std::any_of(study.materials.begin(), study.materials.end(),
                                  [](const Material& m) { return is_coloured(m.front) || is_coloured(m.back); });
  scene.channel_weights = luminance_weights(colour ? kPrimaries : 1);
  if (colour && !study.band_weights.empty()) scene.channel_weights = study.band_weights;
  scene.channels = scene.channel_weights.size();
}

void find_passable(const Study& study, Scene& scene) {
  const std::size_t count = scene.faces.count();
  scene.passable.assign(count, 0);
  scene.glazing_of.assign(count, -1);
  std::map<std::pair<double, int>, std::int32_t> known;
  for (std::size_t f = 0; f < count; ++f) {
    const Material& material = material_of(study, scene, f);
    if (!material.glazing && !material.opening) continue;
    scene.passable[f] = 1;
    if (!material.glazing) continue;
    const std::pair key{material.glazing->transmittance_normal, material.glazing->panes};
    const auto [entry, added] = known.try_emplace(key, static_cast<std::int32_t>(scene.glazings.size()));
    if (added) scene.glazings.push_back(glazing_curves(key.first, key.second));
    scene.glazing_of[f] = entry->second;
    scene.panes.emplace_back(f);
  }
}

float default_reflectance(const Scene& scene, FaceSide side) {
  if (outlook(scene, side).sky_share > kOutdoorShare) return kOutdoors;
  const double up = scene.faces.faces[side.face.index()].frame.w.z * (side.side == Side::kFront ? 1.0 : -1.0);
  if (up > kLevelCosine) return kLooksUp;
  return up < -kLevelCosine ? kLooksDown : kVertical;
}

void fill_reflectances(const Study& study, Scene& scene) {
  scene.reflectance.assign(2 * scene.faces.count() * scene.channels, 0.0F);
  parallel_for(2 * scene.faces.count(), [&](std::size_t s) {
    const FaceSide side = mesh::face_side(s);
    const std::size_t f = side.face.index();
    const Material& material = material_of(study, scene, f);
    const SideMaterial& mine = material_of(study, scene, side);
    for (std::size_t c = 0; c < scene.channels; ++c) {
      float& rho = scene.reflectance[s * scene.channels + c];
      if (material.glazing) {
        const auto& curves = scene.glazings[static_cast<std::size_t>(scene.glazing_of[f])];
        rho = static_cast<float>(curves.hemispherical_reflectance);
      } else if (material.opening) {
        rho = 0.0F;
      } else if (mine.reflectance) {
        rho = (*mine.reflectance)[mine.reflectance->size() == scene.channels ? c : 0];
      } else {
        rho = default_reflectance(scene, side);
      }
    }
  });
  for (const Material& material : study.materials) {
    for (const SideMaterial* side : {&material.front, &material.back}) {
      if (!side->reflectance) continue;
      if (side->reflectance->size() != 1 && side->reflectance->size() != scene.channels && is_coloured(*side))
        throw InputError(study.name, 0,
                         fmt::format("material '{}' has {} bands, and the study {}", material.name,
                                     side->reflectance->size(), scene.channels),
                         "give one number, or one for each band");
      for (const float rho : *side->reflectance) {
        if (rho >= 0.0F && rho < 1.0F) continue;
        throw InputError(study.name, 0, fmt::format("material '{}' has a reflectance of {}", material.name, rho),
                         "give a value from 0 to below 1");
      }
    }
  }
}

/// Sides of one material that share a vertex belong to one connected surface; gives a number a side.
std::vector<std::size_t> connected_surfaces(const Scene& scene) {
  std::vector<std::size_t> owner(2 * scene.faces.count());
  std::iota(owner.begin(), owner.end(), std::size_t{0});
  const auto find = [&](std::size_t s) {
    while (owner[s] != s) s = owner[s] = owner[owner[s]];
    return s;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> seen;  // (vertex, material) → side
  for (std::size_t s = 0; s < owner.size(); ++s) {
    const FaceSide side = mesh::face_side(s);
    const std::uint32_t material = scene.faces.faces[side.face.index()].material_of(side.side).value;
    for (const mesh::Triangle& t : scene.faces.shape.of(side.face)) {
      for (const std::uint32_t v : t.vertices) {
        const auto [entry, added] = seen.try_emplace({v, material}, s);
        if (!added) owner[find(s)] = find(entry->second);
      }
    }
  }
  for (std::size_t s = 0; s < owner.size(); ++s) owner[s] = find(s);
  return owner;
}

/// The area of each surface, of both sides of a face counted once [m²].
std::vector<double> areas_of(const Scene& scene, const std::vector<std::size_t>& surface) {
  std::vector<double> area(surface.size(), 0.0);
  for (std::size_t f = 0; f < scene.faces.count(); ++f) {
    const double own = scene.faces.faces[f].area_m2;
    area[surface[2 * f]] += own;
    if (surface[2 * f + 1] != surface[2 * f]) area[surface[2 * f + 1]] += own;
  }
  return area;
}

/// The front shines; where it looks into a solid and the back into the open, the back does.
Side shining_side(Scene& scene, FaceId face, Side asked, const std::string& name) {
  constexpr double kSolidDepth = 0.2;  // metres: lamp housings are flatter than the rooms that they light
  const double own = outlook(scene, {face, asked}).mean_distance;
  const double opposite = outlook(scene, {face, mesh::other(asked)}).mean_distance;
  if (own > kSolidDepth || opposite < 4.0 * own) return asked;
  const std::string text = fmt::format("a surface of '{}' shines on its back: its front looks into a solid", name);
  if (std::find(scene.notices.begin(), scene.notices.end(), text) == scene.notices.end()) scene.notices.push_back(text);
  return mesh::other(asked);
}

double dimming_of(const Study& study, const std::string& group) {
  for (const Dimming& dimming : study.dimming) {
    if (dimming.group == group) return dimming.share;
  }
  return 1.0;
}

/// The group that a shining side names; none where it does not shine.
std::optional<std::string> group_of(const Study& study, const Scene& scene, FaceSide side) {
  const auto& emission = material_of(study, scene, side).emission;
  if (!emission) return std::nullopt;
  if (!emission->group.empty()) return emission->group;
  return study.materials[scene.faces.faces[side.face.index()].material_of(side.side).index()].name;
}

/// Mean luminance of a part of the sky [cd/m²].
double mean_luminance(const Sky& sky, const SkyPatches& patches, std::size_t patch) {
  constexpr int kPlaces = 6;  // along either side
  double sum = 0.0;
  for (int i = 0; i < kPlaces; ++i) {
    for (int j = 0; j < kPlaces; ++j)
      sum += sky_luminance(sky, patches.direction(patch, (i + 0.5) / kPlaces, (j + 0.5) / kPlaces));
  }
  return sum / (kPlaces * kPlaces);
}

void measure_sky(Scene& scene) {
  SourceGroups& groups = scene.groups;
  if (scene.has_sky() && groups.has_patches()) {
    const SkyPatches& patches = groups.patches();
    for (std::uint32_t p = 0; p < patches.count(); ++p) groups.set_strength(p, mean_luminance(scene.sky, patches, p));
    groups.set_strength(static_cast<std::uint32_t>(patches.count()), sky_luminance(scene.sky, {0.0, 0.0, -1.0}));
  } else if (scene.has_sky()) {
    groups.set_source(0, source_of(scene.sky));
  }
  if (!scene.sky.sun.shines()) return;
  groups.set_strength(groups.of_sun(), scene.sky.sun.normal_illuminance_lux);
  groups.set_source(groups.of_sun(), source_of(scene.sky.sun));
}

/// Of the light of several moments in one. The suns are told apart later: until then they are as good as unknown.
void measure_moments(const Study& study, Scene& scene) {
  if (scene.groups.has_patches()) measure_sky(scene);
  for (std::size_t m = 0; m < study.moments.size(); ++m) {
    scene.groups.set_strength(scene.groups.of_sky_at(m), scene.sky.parts[m].share);
    scene.groups.set_source(scene.groups.of_sky_at(m), source_of(study.moments[m]));
    scene.groups.set_strength(scene.groups.of_sun_at(m), 0.0);
    scene.groups.set_source(scene.groups.of_sun_at(m), source_of(study.moments[m].sun));
  }
}

void find_groups_of_daylight(const Study& study, Scene& scene) {
  if (study.moments.empty()) {
    scene.groups =
        SourceGroups(study.columns, study.keep_solution, scene.has_sky(), scene.sky.sun.shines(), study.north_deg);
    measure_sky(scene);
    return;
  }
  if (study.columns == Columns::kSky145 || study.columns == Columns::kSky577)
    throw InputError(study.name, 0, "patches of the sky are told apart at one moment, and several are asked for",
                     "give results.columns = \"groups\", or one time");
  std::vector<std::string> names;
  for (const Sky& moment : study.moments) names.push_back(moment.moment);
  scene.groups = SourceGroups(names, study.keep_solution, study.north_deg);
  measure_moments(study, scene);
}

/// Names are given in the order of the sources, those of luminaires first.
void find_groups(const Study& study, Scene& scene) {
  find_groups_of_daylight(study, scene);
  std::set<std::string> names;
  for (Luminaire& luminaire : scene.luminaires) {
    scene.luminaire_group.push_back(scene.groups.add_lamps(luminaire.group));
    scene.luminaire_dimming.push_back(dimming_of(study, luminaire.group));
    scene.groups.set_strength(scene.luminaire_group.back(), scene.luminaire_dimming.back());
    luminaire.factor *= scene.luminaire_dimming.back();
    names.insert(luminaire.group);
  }
  for (std::size_t s = 0; s < 2 * scene.faces.count(); ++s) {
    const auto name = group_of(study, scene, mesh::face_side(s));
    if (!name) continue;
    scene.groups.add_lamps(*name);
    names.insert(*name);
  }
  for (const Dimming& dimming : study.dimming) {
    if (names.contains(dimming.group)) continue;
    throw InputError(study.name, 0, fmt::format("no lamps of a group '{}' are there to be dimmed", dimming.group),
                     "lamps are grouped by `group`, surfaces that shine else by the name of their material");
  }
}

void fill_exitances(const Study& study, Scene& scene) {
  scene.exitance.assign(2 * scene.faces.count() * scene.channels, 0.0F);
  scene.side_group.assign(2 * scene.faces.count(), 0);
  const auto surface = connected_surfaces(scene);
  const auto area = areas_of(scene, surface);
  for (std::size_t s = 0; s < surface.size(); ++s) {
    const FaceSide asked = mesh::face_side(s);
    const auto& emission = material_of(study, scene, asked).emission;
    if (!emission) continue;
    const mesh::Face& face = scene.faces.faces[asked.face.index()];
    const bool both = material_of(study, scene, {asked.face, mesh::other(asked.side)}).emission.has_value();
    const double sides = both && !face.back_material.valid() ? 2.0 : 1.0;
    const double value = emission->flux_lm ? *emission->flux_lm / (sides * area[surface[s]])
                                           : std::numbers::pi * *emission->luminance_cd_m2;
    const std::string& name = study.materials[face.material_of(asked.side).index()].name;
    const Side side = both ? asked.side : shining_side(scene, asked.face, asked.side, name);
    const std::size_t first = FaceSide{asked.face, side}.index() * scene.channels;
    const std::string group = *group_of(study, scene, asked);
    std::fill_n(scene.exitance.begin() + static_cast<std::ptrdiff_t>(first), scene.channels,
                static_cast<float>(dimming_of(study, group) * value));
    scene.side_group[FaceSide{asked.face, side}.index()] = scene.groups.add_lamps(group);
  }
}

/// Throws InputError for a luminaire within a wall.
void mount_luminaires(const Study& study, Scene& scene) {
  for (const Luminaire& luminaire : scene.luminaires) {
    scene.flush_faces.push_back(flush_faces(scene, luminaire));
    if (!is_walled_in(scene, luminaire, scene.flush_faces.back())) continue;
    const mesh::Point at = luminaire.at + scene.faces.origin;
    throw InputError(study.name, 0,
                     fmt::format("the luminaire {} at ({:.3f}, {:.3f}, {:.3f}) stands inside a solid", luminaire.name,
                                 at.x, at.y, at.z),
                     "move it into the room; `at` is the centre of its luminous opening, in metres");
  }
}

void find_reachable(Scene& scene, Progress& progress) {
  std::vector<std::uint8_t> seeds(2 * scene.faces.count(), 0);
  for (std::size_t s = 0; s < seeds.size(); ++s) seeds[s] = scene.shines(mesh::face_side(s)) ? 1 : 0;
  std::vector<mesh::Point> points;
  for (std::size_t k = 0; k < scene.luminaires.size(); ++k)
    points.push_back(light_start(scene.luminaires[k], scene.flush_faces[k]));
  scene.reachable = mesh::reachable_sides(scene.faces, *scene.rays, seeds, points, &progress);
  scene.has_elements = scene.reachable;
  for (std::size_t f = 0; f < scene.faces.count(); ++f) {
    if (scene.passable[f] == 0 || scene.glazing_of[f] >= 0) continue;
    scene.has_elements[2 * f] = 0;
    scene.has_elements[2 * f + 1] = 0;
  }
}

void find_rooms(const Study& study, Scene& scene, Progress& progress) {
  std::vector<std::uint8_t> glazing;
  std::vector<std::uint8_t> air;
  for (std::size_t f = 0; f < scene.faces.count(); ++f) {
    glazing.push_back(scene.glazing_of[f] >= 0 ? 1 : 0);
    air.push_back(scene.passable[f] != 0 && scene.glazing_of[f] < 0 ? 1 : 0);
  }
  scene.reachable_triangles = mesh::reachable_triangles(scene.faces, *scene.rays, scene.reachable, &progress);
  scene.rooms =
      mesh::find_rooms(scene.faces, *scene.rays,
                       {.glazing = glazing, .air = air, .reached = scene.reachable_triangles, .spaces = study.spaces});
}

void say_what_lights(Scene& scene) {
  const bool lamps = !scene.luminaires.empty() ||
                     std::any_of(scene.exitance.begin(), scene.exitance.end(), [](float m) { return m > 0.0F; });
  if (lamps) return;
  const bool outside =
      std::any_of(scene.reachable.begin(), scene.reachable.end(), [](std::uint8_t r) { return r != 0; });
  if (!scene.has_sky()) {
    scene.notices.emplace_back(
        "there is no lamp and no sky: every value is zero; give a material an emission, or set sky.type");
  } else if (!outside) {
    scene.notices.emplace_back(
        "the model has no lamp, and no opening lets the sky in: every value is zero; name a glazing material in "
        "[materials], or mark an opening");
  }
}

}  // namespace

Scene build_scene(const Study& study, Progress* progress) {
  NoProgress unwatched;
  Progress& watcher = progress != nullptr ? *progress : unwatched;
  Scene scene;
  mesh::CleanSurface surface = mesh::clean(study.model, study.clean, &watcher);
  scene.clean_report = surface.report;
  scene.notices = surface.report.notices;
  watcher.phase("faces");
  scene.faces = mesh::build_faces(surface, {}, &watcher);
  scene.sky = study.sky;
  for (Luminaire luminaire : study.luminaires) {
    luminaire.at = luminaire.at - scene.faces.origin;
    scene.luminaires.push_back(std::move(luminaire));
  }
  count_channels(study, scene);
  find_passable(study, scene);
  scene.rays = std::make_unique<mesh::Rays>(scene.faces, scene.passable);
  scene.shafts = std::make_unique<mesh::Shafts>(scene.faces, scene.passable);
  if (!study.parts.proofs) scene.shafts->prove_nothing();
  mount_luminaires(study, scene);
  watcher.phase("openings and rooms");
  fill_reflectances(study, scene);
  find_groups(study, scene);
  fill_exitances(study, scene);
  PhasePart reaching(watcher, kShareOfMaterials, kShareBeforeOpenings);
  find_reachable(scene, reaching);
  scene.slits = mesh::find_slits(scene.faces, scene.has_elements);
  find_openings(scene);
  scene.pane_normals = pane_normals(scene);
  PhasePart looking(watcher, kShareBeforeOpenings, kShareBeforeRooms);
  find_rooms(study, scene, looking);
  scene.materials = material_uses(study);
  for (const GlazingCurves& g : scene.glazings) {
    if (g.transmittance.back() > 0.918F) {
      scene.notices.push_back(
          fmt::format("a transmittance of {:.3f} is more than one uncoated pane can have: the angular "
                      "curve of clear glass is scaled to it",
                      g.transmittance.back()));
    }
  }
  scene.assumptions = study.assumptions;
  say_what_lights(scene);
  return scene;
}

double luminaire_flux(const Scene& scene) {
  double flux_lm = 0.0;
  for (const Luminaire& luminaire : scene.luminaires) flux_lm += luminaire.flux_lm();
  return flux_lm;
}

void set_sky(Scene& scene, const Sky& sky, SourceGroups groups) {
  std::vector<std::uint32_t> now(std::max<std::size_t>(1, scene.groups.count()), 0);
  for (std::uint32_t g = 0; g < scene.groups.count(); ++g) {
    const SourceGroup& own = scene.groups[g];
    if (own.kind != SourceGroup::Kind::kLamps) continue;
    now[g] = groups.add_lamps(own.name);
    groups.set_strength(now[g], own.strength);
  }
  for (std::uint32_t& group : scene.luminaire_group) group = now[group];
  for (std::uint32_t& group : scene.side_group) group = now[group];
  scene.groups = std::move(groups);
  scene.sky = sky;
  measure_sky(scene);
}

void add_sky_light(const Scene& scene, const Vector& direction, double lux, double weight, GroupSums& sums) {
  if (!scene.groups.parted()) return;
  if (scene.sky.type != Sky::Type::kSum) {
    sums.add(scene.groups.of_sky(direction), lux);
    return;
  }
  if (scene.groups.has_patches()) sums.add(scene.groups.of_sky(direction), lux);
  for (std::size_t m = 0; m < scene.sky.parts.size(); ++m)
    sums.add(scene.groups.of_sky_at(m), weight * sky_luminance(scene.sky.parts[m], direction));
}

std::vector<Results::MaterialUse> material_uses(const Study& study) {
  std::vector<Results::MaterialUse> uses;
  for (const Material& m : study.materials) uses.push_back({m.name, m.became, m.why});
  return uses;
}

std::vector<mesh::Room> rooms_in_model(const Scene& scene) {
  std::vector<mesh::Room> rooms = scene.rooms.rooms;
  for (mesh::Room& room : rooms) {
    room.box = {room.box.low + scene.faces.origin, room.box.high + scene.faces.origin};
    for (mesh::RoomOpening& opening : room.openings) opening.at = opening.at + scene.faces.origin;
  }
  return rooms;
}

}  // namespace clerestory::lighting
