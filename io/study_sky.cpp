// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "io/study_schema.h"
#include "io/study_tables.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

/// Keys that another sky than the overcast one has.
constexpr std::array<std::string_view, 10> kOwnKeys{
    "time",     "sun_altitude",  "sun_azimuth",        "zenith_luminance", "sun", "sun_normal_illuminance",
    "sun_disc", "direct_normal", "diffuse_horizontal", "dew_point"};

/// Puts the CIE overcast sky in place of what the study says, and says so where that differs.
void make_overcast(StudyValue& table, lighting::Study& study) {
  StudyValue& type = *table.find("type");
  std::vector<std::string> set_aside;
  if (type.text != "cie-overcast") set_aside.push_back("type = \"" + type.text + "\"");
  std::erase_if(table.children, [&](const StudyValue& member) {
    if (std::find(kOwnKeys.begin(), kOwnKeys.end(), member.key) == kOwnKeys.end()) return false;
    if (!is_default(*find_key("sky." + member.key), member)) set_aside.push_back(member.key);
    return true;
  });
  table.find("type")->text = "cie-overcast";
  if (!set_aside.empty())
    study.assumptions.push_back(
        fmt::format("The daylight factor is that under the CIE overcast sky; the study's {} in [sky] was set aside.",
                    list_names(set_aside)));
}

/// The number of a general sky, 0 for other words.
int general_type(std::string_view word) {
  if (word == "cie-clear") return 12;
  const auto number = word.starts_with("cie-") ? parse_number(word.substr(4)) : std::nullopt;
  return number ? static_cast<int>(*number) : 0;
}

const StudySun& need(const std::optional<StudySun>& sun, const StudyValue& for_this, const std::string& what) {
  if (!sun)
    throw for_this.error(what + " needs to know where the sun stands",
                         "give sky.time with [site], or sky.sun_altitude and sky.sun_azimuth");
  return *sun;
}

/// perez and weather: the sky's light and the beam's.
lighting::Sky by_irradiance(const StudyValue& table, const StudySun& sun, lighting::Study& study) {
  lighting::Irradiance irradiance{number_or(table, "direct_normal", 0.0), number_or(table, "diffuse_horizontal", 0.0),
                                  number_or(table, "dew_point", 11.0), sun.day_of_year};
  if (sun.irradiance) irradiance = *sun.irradiance;
  const StudyValue& type = *table.find("type");
  std::vector<std::string> set_aside;
  for (const char* const key : {"horizontal_illuminance", "zenith_luminance", "sun_normal_illuminance"}) {
    const StudyValue* given = table.find(key);
    if (given != nullptr && given->is_given()) set_aside.emplace_back(key);
  }
  if (!set_aside.empty())
    study.assumptions.push_back(
        fmt::format("The light of sky.type = \"{}\" comes from irradiances; {} in [sky] was set aside.", type.text,
                    list_names(set_aside)));
  if (!sun.irradiance && irradiance.diffuse_horizontal_w_m2 <= 0.0 && irradiance.direct_normal_w_m2 <= 0.0)
    throw type.error("sky.type = \"perez\" needs irradiances", "give sky.diffuse_horizontal and sky.direct_normal");
  lighting::Sky sky = lighting::perez_sky(irradiance, sun.towards);
  sky.name = type.text == "weather" ? "sky of the weather" : "Perez sky";
  if (sky.horizontal_illuminance_lux <= 0.0)
    study.assumptions.emplace_back("The sky is dark: there is no diffuse irradiance.");
  return sky;
}

/// All others: their distribution, and how bright it is.
lighting::Sky by_illuminance(const StudyValue& table, const std::optional<StudySun>& sun) {
  const StudyValue& type = *table.find("type");
  lighting::Sky sky;
  const int general = general_type(type.text);
  const double lux = number_or(table, "horizontal_illuminance", 10'000.0);
  if (general > 0) {
    // Of some types the luminance does not depend on the sun.
    lighting::SkyDistribution distribution = lighting::cie_general_sky(general, {0.0, 0.0, 1.0});
    if (distribution.c != 0.0 || distribution.e != 0.0)
      distribution.towards_sun = need(sun, type, "sky.type = \"" + type.text + "\"").towards;
    sky = lighting::sky_of(distribution, lux);
    sky.name = fmt::format("CIE general sky, type {},", general);
  } else {
    sky.type = type.text == "none"      ? lighting::Sky::Type::kNone
               : type.text == "uniform" ? lighting::Sky::Type::kUniform
                                        : lighting::Sky::Type::kCieOvercast;
    sky.horizontal_illuminance_lux = lux;
  }
  const StudyValue* zenith = table.find("zenith_luminance");
  if (zenith == nullptr) return sky;
  const StudyValue* horizontal = table.find("horizontal_illuminance");
  if (horizontal != nullptr && horizontal->is_given())
    throw zenith->error("sky.zenith_luminance and sky.horizontal_illuminance both say how bright the sky is",
                        "give one of them");
  const double by_zenith = lighting::horizontal_illuminance_of(sky, zenith->number);
  if (general > 0) sky.luminance_scale *= by_zenith / lux;
  sky.horizontal_illuminance_lux = by_zenith;
  return sky;
}

/// The beam, where it is asked for.
void read_beam(const StudyValue& table, const std::optional<StudySun>& place, bool by_irradiance, lighting::Sky& sky,
               lighting::Study& study) {
  const StudyValue* given = table.find("sun");
  const StudyValue* normal = table.find("sun_normal_illuminance");
  if (!flag_or(table, "sun", false)) {
    sky.sun.normal_illuminance_lux = 0.0;
    if (normal != nullptr && !by_irradiance)
      throw normal->error("sky.sun_normal_illuminance is given, and the sun is off", "write sun = true, or remove it");
    return;
  }
  const StudySun& sun = need(place, *given, "sky.sun");
  if (!by_irradiance) {
    if (normal == nullptr)
      throw given->error("sky.sun = true needs to know how bright the sun is",
                         "give sky.sun_normal_illuminance, or take sky.type = \"perez\" or \"weather\"");
    sky.sun.normal_illuminance_lux = normal->number;
  }
  sky.sun.towards = sun.towards;
  sky.sun.disc = flag_or(table, "sun_disc", false);
  if (sun.towards.z <= 0.0)
    study.assumptions.push_back(fmt::format(
        "The sun stands {:.2f} degrees under the horizon: no light comes straight from it.", -sun.altitude_deg));
}

lighting::Sky read_sky(const StudyValue& table, const std::optional<StudySun>& sun, lighting::Study& study) {
  const std::string type = text_or(table, "type", "cie-overcast");
  const bool irradiated = type == "perez" || type == "weather";
  lighting::Sky sky = irradiated
                          ? by_irradiance(table, need(sun, *table.find("type"), "sky.type = \"" + type + "\""), study)
                          : by_illuminance(table, sun);
  sky.ground_reflectance = number_or(table, "ground_reflectance", 0.2);
  read_beam(table, sun, irradiated, sky, study);
  return sky;
}

/// One of several. At night there may still be lamps.
lighting::Sky at_moment(const StudyValue& table, const StudySun& sun, lighting::Study& study) {
  lighting::Sky sky;
  if (sun.towards.z > 0.0) {
    sky = read_sky(table, sun, study);
  } else {
    sky.type = lighting::Sky::Type::kNone;
    study.assumptions.push_back(fmt::format(
        "At {} the sun stands {:.2f} degrees under the horizon: the sky is dark, and lamps alone give light.",
        sun.moment, -sun.altitude_deg));
  }
  sky.moment = sun.moment;
  return sky;
}

}  // namespace

void read_sky_table(StudyValue& root, StudyPlace& place, lighting::Study& study) {
  StudyValue& table = *root.find("sky");
  if (study.kind == lighting::Study::Kind::kDaylight) make_overcast(table, study);
  const std::vector<StudySun> suns = read_study_suns(root, place, study);
  if (suns.size() < 2) {
    study.sky = read_sky(table, suns.empty() ? std::nullopt : std::optional(suns.front()), study);
    return;
  }
  for (const StudySun& sun : suns) study.moments.push_back(at_moment(table, sun, study));
  study.sky = lighting::mean_sky(study.moments);
}

void read_mesh_table(const StudyValue& root, lighting::Study& study) {
  const StudyValue& table = *root.find("mesh");
  study.mesh.discontinuities = text_or(table, "discontinuities", "auto") != "off";
  study.mesh.max_elements = static_cast<std::size_t>(table.find("max_elements")->number);
}

void read_accuracy_table(StudyValue& root, lighting::Study& study) {
  StudyValue& target = *root.find("accuracy")->find("target");
  if (target.kind == StudyValue::Kind::kText) {
    target.number = parse_share(target.text).value_or(target.number);
    target.kind = StudyValue::Kind::kNumber;
  }
  study.accuracy.target = target.number;
}

}  // namespace clerestory::io
