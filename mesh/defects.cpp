// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/defects.h"

#include <algorithm>
#include <utility>

namespace clerestory::mesh {

namespace {
/// Places told for each kind; more would not be read.
constexpr std::size_t kMaxPlaces = 10;
}  // namespace

void DefectList::add(std::string_view kind, std::uint32_t polygon, const Point& at, std::string_view note) {
  auto defect = std::find_if(defects_.begin(), defects_.end(), [&](const Defect& d) { return d.kind == kind; });
  if (defect == defects_.end()) {
    defects_.push_back({std::string(kind), 0, 0, {}});
    defect = std::prev(defects_.end());
  }
  ++defect->found;
  ++defect->mended;
  if (defect->places.size() < kMaxPlaces) defect->places.push_back({polygon, at, std::string(note)});
}

std::vector<Defect> DefectList::take(const Vector& origin) && {
  for (Defect& defect : defects_) {
    for (Defect::Place& place : defect.places) place.at = place.at + origin;
  }
  return std::move(defects_);
}

}  // namespace clerestory::mesh
