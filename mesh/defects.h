// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "mesh/clean.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Where a defect is, and how bad.
struct DefectPlace {
  std::uint32_t polygon = 0;  ///< of the model
  Point at;                   ///< [m, local]
  double size_m = 0.0;        ///< as Defect::Place
};

/// Collects what the steps of the clean-up find, by kind, in the order in which kinds first come.
class DefectList {
 public:
  /// One defect, found and mended.
  void add(std::string_view kind, const DefectPlace& place, std::string_view note = {});
  /// One defect, found and left as it is.
  void leave(std::string_view kind, const DefectPlace& place, std::string_view reason);
  /// Takes over what another list holds.
  void append(DefectList other);

  /// The list, with places in model coordinates.
  [[nodiscard]] std::vector<Defect> take(const Vector& origin) &&;

 private:
  Defect& of_kind(std::string_view kind);

  std::vector<Defect> defects_;
};

}  // namespace clerestory::mesh
