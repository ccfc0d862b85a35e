// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/photometry_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "io/report_json.h"
#include "io/text_table.h"
#include "io/words.h"
#include "lighting/ugr_table.h"

namespace clerestory::io {

namespace {

using lighting::LuminousOpening;
using lighting::PhotometricWeb;
using lighting::Photometry;

const char* type_word(Photometry::Type type) {
  return type == Photometry::Type::kA ? "A" : type == Photometry::Type::kB ? "B" : "C";
}

const char* symmetry_words(const Photometry& p) {
  switch (p.symmetry) {
    case Photometry::Symmetry::kNone:
      return "none";
    case Photometry::Symmetry::kAboutAxis:
      return "about the axis";
    case Photometry::Symmetry::kMirrorC0:
      return p.type == Photometry::Type::kC ? "to the plane C0-C180" : "left and right alike";
    case Photometry::Symmetry::kMirrorC90:
      return "to the plane C90-C270";
    case Photometry::Symmetry::kQuadrants:
      return "to the planes C0-C180 and C90-C270";
  }
  return "";
}

const char* shape_words(LuminousOpening::Shape shape) {
  switch (shape) {
    case LuminousOpening::Shape::kPoint:
      return "point";
    case LuminousOpening::Shape::kRectangle:
      return "rectangle";
    case LuminousOpening::Shape::kEllipse:
      return "ellipse";
    case LuminousOpening::Shape::kEllipsoid:
      return "ellipsoid";
    case LuminousOpening::Shape::kCylinderAlongX:
      return "cylinder along C0";
    case LuminousOpening::Shape::kCylinderAlongY:
      return "cylinder along C90";
    case LuminousOpening::Shape::kUprightDisc:
      return "upright disc facing C0";
  }
  return "";
}

/// What follows from a file by summing its light.
struct Summary {
  double flux_lm = 0.0;
  double downward = 0.0;  ///< share of the flux below the horizontal
  double lamps_lm = 0.0;  ///< 0: not stated, or absolute photometry
  double efficacy = 0.0;  ///< [lm/W]; 0: no power is stated
};

/// The flux below the horizontal, by the midpoint rule in steps of 1° and 5°.
double downward_lm(const PhotometricWeb& web) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  double sum = 0.0;
  for (int gamma = 0; gamma < 90; ++gamma) {
    for (int c = 0; c < 72; ++c)
      sum += web.intensity_cd(5.0 * c + 2.5, gamma + 0.5) * std::sin((gamma + 0.5) * kDegree);
  }
  return sum * kDegree * 5.0 * kDegree;
}

Summary summed(const Photometry& p, const PhotometricWeb& web) {
  Summary s;
  s.flux_lm = web.flux_lm();
  s.downward = std::min(1.0, downward_lm(web) / s.flux_lm);
  if (!p.absolute && !p.lamps.empty()) s.lamps_lm = p.lamps[p.fitted].flux_lm;
  s.efficacy = p.power_w > 0.0 ? s.flux_lm / p.power_w : 0.0;
  return s;
}

std::string opening_text(const LuminousOpening& o) {
  if (o.shape == LuminousOpening::Shape::kPoint) return "point";
  return fmt::format("{}, {:.3f} m along C0, {:.3f} m along C90, {:.3f} m high", shape_words(o.shape), o.x_m, o.y_m,
                     o.z_m);
}

std::string lamps_text(const Photometry& p) {
  std::string text;
  for (std::size_t k = 0; k < p.lamps.size(); ++k) {
    const lighting::LampSet& set = p.lamps[k];
    text +=
        fmt::format("{:<12}{} x {}", k == 0 ? "lamps" : "", set.count, set.type.empty() ? "lamp" : printable(set.type));
    if (set.flux_lm > 0.0) text += fmt::format(", {:g} lm", set.flux_lm);
    if (set.power_w > 0.0) text += fmt::format(", {:g} W", set.power_w);
    if (p.lamps.size() > 1 && k == p.fitted) text += " (fitted)";
    text += '\n';
  }
  return text;
}

bool has_ugr(const Photometry& p) { return p.type == Photometry::Type::kC && p.opening.has_area(); }

/// IES lengths lie along C0, those of EULUMDAT along C90.
lighting::UgrTable table_of(const Photometry& p, const PhotometricWeb& web) {
  return lighting::ugr_table(web, p.opening, p.format == "EULUMDAT");
}

std::string ugr_text(const Photometry& p, const PhotometricWeb& web) {
  const lighting::UgrTable table = table_of(p, web);
  std::string text = "\nUGR by CIE 190, luminaires 0.25 H apart: seen across their length, then along it\n";
  TextRow head{"room"};
  for (int side = 0; side < 2; ++side) {
    for (const lighting::UgrFinish& f : lighting::kUgrFinishes)
      head.push_back(fmt::format("{:.0f}/{:.0f}/{:.0f}", 100 * f.ceiling, 100 * f.walls, 100 * f.floor));
  }
  std::vector<TextRow> rows{head};
  for (std::size_t r = 0; r < table.size(); ++r) {
    TextRow row{fmt::format("{:g}H x {:g}H", lighting::kUgrRooms[r].across, lighting::kUgrRooms[r].along)};
    for (const double ugr : table[r]) row.push_back(std::isfinite(ugr) ? fmt::format("{:.1f}", ugr) : "-");
    rows.push_back(std::move(row));
  }
  return text + text_table(rows);
}

Json intensities_json(const PhotometricWeb& web) {
  Json planes = Json::array();
  for (int c = 0; c < 360; c += 15) {
    Json candela = Json::array();
    for (int gamma = 0; gamma <= 180; gamma += 5) candela.push_back(web.intensity_cd(c, gamma));
    planes.push_back({{"c_deg", c}, {"candela", std::move(candela)}});
  }
  return {{"gamma_step_deg", 5}, {"planes", std::move(planes)}};
}

Json opening_json(const LuminousOpening& o) {
  return {{"shape", shape_words(o.shape)}, {"along_c0_m", o.x_m}, {"along_c90_m", o.y_m}, {"height_m", o.z_m}};
}

Json lamps_json(const Photometry& p) {
  Json lamps = Json::array();
  for (const lighting::LampSet& set : p.lamps)
    lamps.push_back({{"count", set.count}, {"type", set.type}, {"flux_lm", set.flux_lm}, {"power_w", set.power_w}});
  return lamps;
}

}  // namespace

std::string photometry_text(const Photometry& p, const std::string& file) {
  const PhotometricWeb web = lighting::web_of(p);
  const Summary s = summed(p, web);
  std::string text = fmt::format("{}: {}\n\n", printable(file), printable(p.format));
  const auto line = [&](const char* what, const std::string& value) {
    if (!value.empty()) text += fmt::format("{:<12}{}\n", what, value);
  };
  line("luminaire", printable(p.name));
  line("maker", printable(p.maker));
  line("number", printable(p.catalogue_number));
  line("photometry", fmt::format("type {}, {}, symmetry {}", type_word(p.type), p.absolute ? "absolute" : "relative",
                                 symmetry_words(p)));
  line("angles", fmt::format("{} vertical from {:g} to {:g}, {} horizontal from {:g} to {:g} degrees",
                             p.vertical_deg.size(), p.vertical_deg.front(), p.vertical_deg.back(),
                             p.horizontal_deg.size(), p.horizontal_deg.front(), p.horizontal_deg.back()));
  line("opening", opening_text(p.opening));
  text += lamps_text(p);
  line("flux", fmt::format("{:.1f} lm by integration", s.flux_lm) +
                   (p.stated_flux_lm ? fmt::format(", {:.1f} lm stated ({:+.2f} %)", *p.stated_flux_lm,
                                                   100.0 * (s.flux_lm / *p.stated_flux_lm - 1.0))
                                     : std::string()));
  line("downwards", fmt::format("{:.1f} % of it", 100.0 * s.downward));
  if (s.lamps_lm > 0.0) line("output", fmt::format("{:.1f} % of the lamps' flux", 100.0 * s.flux_lm / s.lamps_lm));
  if (s.efficacy > 0.0) line("power", fmt::format("{:g} W, {:.1f} lm/W", p.power_w, s.efficacy));
  line("peak", fmt::format("{:.1f} cd", web.peak_cd()));
  for (const std::string& note : p.notes) line("note", note);
  if (has_ugr(p)) text += ugr_text(p, web);
  return text;
}

std::string photometry_json(const Photometry& p, const std::string& file, const std::string& version) {
  const PhotometricWeb web = lighting::web_of(p);
  const Summary s = summed(p, web);
  const auto or_null = [](double value) { return value > 0.0 ? Json(value) : Json(); };
  Json json = {{"program", kProgram},
               {"version", version},
               {"file", file},
               {"format", p.format},
               {"luminaire", p.name},
               {"maker", p.maker},
               {"catalogue_number", p.catalogue_number},
               {"photometry", {{"type", type_word(p.type)}, {"absolute", p.absolute}, {"symmetry", symmetry_words(p)}}},
               {"opening", opening_json(p.opening)},
               {"lamps", lamps_json(p)},
               {"fitted", p.fitted + 1},
               {"flux_lm", s.flux_lm},
               {"flux_stated_lm", p.stated_flux_lm ? Json(*p.stated_flux_lm) : Json()},
               {"downward_share", s.downward},
               {"light_output_ratio", s.lamps_lm > 0.0 ? Json(s.flux_lm / s.lamps_lm) : Json()},
               {"power_w", or_null(p.power_w)},
               {"efficacy_lm_w", or_null(s.efficacy)},
               {"peak_cd", web.peak_cd()},
               {"notes", p.notes},
               {"intensities", intensities_json(web)}};
  if (has_ugr(p)) {
    Json rows = Json::array();
    const lighting::UgrTable table = table_of(p, web);
    for (std::size_t r = 0; r < table.size(); ++r)
      rows.push_back(
          {{"across_H", lighting::kUgrRooms[r].across}, {"along_H", lighting::kUgrRooms[r].along}, {"ugr", table[r]}});
    json["ugr_table"] = std::move(rows);
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace clerestory::io
