// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/installed.h"

#include <algorithm>

namespace clerestory::lighting {

namespace {

/// How far before its opening the room of a luminaire is looked for [m].
constexpr double kBeforeM = 0.1;

}  // namespace

std::vector<LuminaireUse> luminaire_uses(const Scene& scene) {
  std::vector<LuminaireUse> uses;
  for (const Luminaire& luminaire : scene.luminaires) {
    auto at = std::ranges::find_if(
        uses, [&](const LuminaireUse& u) { return u.name == luminaire.name && u.group == luminaire.group; });
    if (at == uses.end()) at = uses.insert(uses.end(), {.name = luminaire.name, .group = luminaire.group});
    ++at->count;
    at->flux_lm += luminaire.flux_lm();
    at->power_w += luminaire.power_w;
  }
  return uses;
}

std::vector<RoomPower> room_powers(const Scene& scene) {
  std::vector<RoomPower> powers(scene.rooms.rooms.size());
  for (const Luminaire& luminaire : scene.luminaires) {
    const mesh::Point before = luminaire.at - kBeforeM * luminaire.axes.w;
    const std::uint32_t room = mesh::room_at(scene.rooms, *scene.rays, before);
    if (room == mesh::kNoRoom) continue;
    ++powers[room].luminaires;
    powers[room].power_w += luminaire.power_w;
  }
  for (std::size_t r = 0; r < powers.size(); ++r) {
    const mesh::Room& room = scene.rooms.rooms[r];
    powers[r].room = room.name;
    powers[r].number = r;
    if (room.floor_area_m2 > 0.0) powers[r].per_area_w_m2 = powers[r].power_w / room.floor_area_m2;
  }
  std::erase_if(powers, [](const RoomPower& p) { return p.luminaires == 0; });
  return powers;
}

std::vector<MaterialLight> material_lights(const SurfaceResult& surfaces) {
  std::vector<MaterialLight> lights(surfaces.material_names.size());
  for (std::size_t m = 0; m < lights.size(); ++m) lights[m].name = surfaces.material_names[m];
  for (std::size_t c = 0; c < surfaces.cells.size(); ++c) {
    if (surfaces.material[c] < 0) continue;
    const auto& [i, j, k] = surfaces.cells[c];
    const mesh::Point& a = surfaces.points[i];
    const double area_m2 = 0.5 * norm(cross(surfaces.points[j] - a, surfaces.points[k] - a));
    MaterialLight& light = lights[static_cast<std::size_t>(surfaces.material[c])];
    light.area_m2 += area_m2;
    light.illuminance_lux += area_m2 * surfaces.illuminance_lux[c];
    light.luminance_cd_m2 += area_m2 * surfaces.luminance_cd_m2[c];
  }
  std::erase_if(lights, [](const MaterialLight& light) { return light.area_m2 <= 0.0; });
  for (MaterialLight& light : lights) {
    light.illuminance_lux /= light.area_m2;
    light.luminance_cd_m2 /= light.area_m2;
  }
  return lights;
}

}  // namespace clerestory::lighting
