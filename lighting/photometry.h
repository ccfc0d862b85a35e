// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lighting/luminous_opening.h"
#include "lighting/photometric_web.h"

namespace clerestory::lighting {

/// How the light output of a lamp depends on how its luminaire is tilted (LM-63's TILT).
struct TiltTable {
  int lamp_geometry = 1;            ///< 1 base up or down, 2 horizontal and stays so, 3 horizontal and tilts
  std::vector<double> angles_deg;   ///< ascending
  std::vector<double> multipliers;  ///< of the intensities

  /// At an angle from the position with γ = 0 straight down [degrees]; the nearest value beyond the table's ends.
  [[nodiscard]] double at(double angle_deg) const;
};

/// A set of lamps that a luminaire is fitted with.
struct LampSet {
  int count = 1;
  std::string type;
  double flux_lm = 0.0;  ///< of all lamps of the set; 0: not stated
  std::string colour;
  std::string rendering;
  double power_w = 0.0;
};

/// What a photometric file says of a luminaire, in SI units, with all its factors applied.
struct Photometry {
  enum class Type { kA, kB, kC };
  /// Which planes the file states; the others follow.
  enum class Symmetry {
    kNone,
    kAboutAxis,  ///< one plane for all
    kMirrorC0,   ///< the halves on either side of the plane C0–C180 are alike; types A and B: left and right
    kMirrorC90,  ///< those on either side of C90–C270
    kQuadrants,  ///< both
  };

  std::string format;  ///< "IESNA:LM-63-2002", "EULUMDAT"
  std::string name;
  std::string maker;
  std::string catalogue_number;
  Type type = Type::kC;
  Symmetry symmetry = Symmetry::kNone;
  std::vector<double> vertical_deg;    ///< as the file has them
  std::vector<double> horizontal_deg;  ///< of the planes that are stated
  std::vector<double> candela;         ///< [planes × vertical angles], of the lamp set that is fitted
  LuminousOpening opening;
  std::vector<LampSet> lamps;            ///< alternatives
  std::size_t fitted = 0;                ///< which of them
  bool absolute = false;                 ///< the intensities are the luminaire's own, not by the lamp's nominal flux
  std::optional<double> stated_flux_lm;  ///< of the luminaire, as the file has it
  std::optional<double> light_output_ratio;  ///< as the file has it; of relative photometry
  double power_w = 0.0;                      ///< 0: not stated
  std::optional<TiltTable> tilt;
  std::vector<std::string> notes;  ///< one sentence each
};

/// The intensities of a luminaire over the sphere.
/// Source: types A, B and C as in ANSI/IESNA LM-63-02, 3.0: type A has its poles above and below, and angles clockwise; type B has them at C0 and
/// C180, with the plane H = 0 through γ = 0.
PhotometricWeb web_of(const Photometry& photometry);

}  // namespace clerestory::lighting
