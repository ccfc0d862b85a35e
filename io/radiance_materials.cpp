// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance_materials.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace clerestory::io {

namespace {

using Reals = std::vector<double>;
using Rgb = std::array<double, 3>;

constexpr double kLumensPerWatt = 179.0;  // Radiance's own, for white light
constexpr Rgb kWeights{0.265, 0.670, 0.065};

Rgb rgb(const Reals& reals, std::size_t at = 0) { return {reals[at], reals[at + 1], reals[at + 2]}; }
Rgb times(double factor, const Rgb& c) { return {factor * c[0], factor * c[1], factor * c[2]}; }
double luminous(const Rgb& c) { return kWeights[0] * c[0] + kWeights[1] * c[1] + kWeights[2] * c[2]; }

void tell_plastic(const Reals& reals, SourceMaterial& told) {
  told.diffuse = times(1.0 - reals[3], rgb(reals));
  told.specular = reals[3];
}

void tell_metal(const Reals& reals, SourceMaterial& told) {
  tell_plastic(reals, told);
  told.specular = reals[3] * luminous(rgb(reals));
}

void tell_trans(const Reals& reals, double trans, double straight_share, SourceMaterial& told) {
  const double passed = (1.0 - reals[3]) * trans;
  told.diffuse = times(1.0 - reals[3] - passed, rgb(reals));
  told.specular = reals[3];
  const double straight = passed * straight_share * luminous(rgb(reals));
  const double spread = passed * (1.0 - straight_share) * luminous(rgb(reals));
  if (straight > spread) {
    told.transmittance_normal = straight;
  } else if (spread > 0.0) {
    told.translucent = spread;
  }
}

void tell_trans_with_roughness(const Reals& reals, SourceMaterial& told) {
  tell_trans(reals, reals[5], reals[6], told);
}
void tell_trans2(const Reals& reals, SourceMaterial& told) { tell_trans(reals, reals[6], reals[7], told); }
void tell_trans_function(const Reals& reals, SourceMaterial& told) { tell_trans(reals, reals[4], reals[5], told); }

void tell_ashik2(const Reals& reals, SourceMaterial& told) {
  told.specular = luminous(rgb(reals, 3));
  told.diffuse = times(1.0 - *told.specular, rgb(reals));
}

void tell_brtd(const Reals& reals, SourceMaterial& told) {
  told.diffuse = rgb(reals);
  if (const double spread = luminous(rgb(reals, 6)); spread > 0.0) told.translucent = spread;
}

void tell_glass(const Reals& reals, SourceMaterial& told) {
  const double index = reals.size() > 3 ? reals[3] : 1.52;
  Rgb passed = rgb(reals);
  for (double& band : passed) band = sheet_transmittance(band, index);
  told.transmittance_normal = luminous(passed);
}

void tell_dielectric(const Reals& reals, SourceMaterial& told) {
  told.transmittance_normal = sheet_transmittance(1.0, reals[3]);
}

void tell_interface(const Reals& reals, SourceMaterial& told) {
  told.transmittance_normal = sheet_transmittance(1.0, reals[3] / reals[7]);
}

void tell_light(const Reals& reals, SourceMaterial& told) {
  told.diffuse = Rgb{};
  told.luminance_cd_m2 = kLumensPerWatt * luminous(rgb(reals));
}

void tell_spotlight(const Reals& /*reals*/, SourceMaterial& told) {
  told.diffuse = Rgb{};
  told.shines = true;
}

void tell_mirror(const Reals& reals, SourceMaterial& told) {
  told.diffuse = Rgb{};
  told.specular = luminous(rgb(reals));
}

struct Rule {
  std::string_view type;
  std::size_t least_reals;
  void (*tell)(const Reals& reals, SourceMaterial& told);
};

constexpr std::array kRules{Rule{"plastic", 4, &tell_plastic},
                            Rule{"plastic2", 4, &tell_plastic},
                            Rule{"plasfunc", 4, &tell_plastic},
                            Rule{"plasdata", 4, &tell_plastic},
                            Rule{"metal", 4, &tell_metal},
                            Rule{"metal2", 4, &tell_metal},
                            Rule{"metfunc", 4, &tell_metal},
                            Rule{"metdata", 4, &tell_metal},
                            Rule{"ashik2", 6, &tell_ashik2},
                            Rule{"trans", 7, &tell_trans_with_roughness},
                            Rule{"trans2", 8, &tell_trans2},
                            Rule{"transfunc", 6, &tell_trans_function},
                            Rule{"transdata", 6, &tell_trans_function},
                            Rule{"BRTDfunc", 9, &tell_brtd},
                            Rule{"glass", 3, &tell_glass},
                            Rule{"dielectric", 4, &tell_dielectric},
                            Rule{"interface", 8, &tell_interface},
                            Rule{"light", 3, &tell_light},
                            Rule{"glow", 3, &tell_light},
                            Rule{"illum", 3, &tell_light},
                            Rule{"spotlight", 3, &tell_spotlight},
                            Rule{"mirror", 3, &tell_mirror}};

}  // namespace

double sheet_transmittance(double transmissivity, double refractive_index) {
  // A transmissivity over 1 has no formula; it stays over 1, and is pointed out as such.
  if (!(transmissivity <= 1.0) || !(refractive_index > 0.0)) return transmissivity;
  const double amplitude = (refractive_index - 1.0) / (refractive_index + 1.0);
  const double r = amplitude * amplitude;
  const double t = transmissivity;
  return (1.0 - r) * (1.0 - r) * t / (1.0 - r * r * t * t);
}

std::optional<SourceMaterial> tell_radiance_material(const RadiancePrimitive& material) {
  SourceMaterial told;
  told.name = material.identifier;
  told.line = material.line;
  told.told_by = fmt::format("the Radiance {}", material.type);
  for (const Rule& rule : kRules) {
    if (rule.type != material.type) continue;
    if (material.reals.size() < rule.least_reals) return std::nullopt;
    rule.tell(material.reals, told);
    told.photometric = true;
  }
  return told;
}

}  // namespace clerestory::io
