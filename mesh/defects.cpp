// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/defects.h"

#include <algorithm>
#include <string>
#include <utility>

namespace clerestory::mesh {

namespace {

/// Places told for each kind: enough for markers of every defect in all but hopeless models.
constexpr std::size_t kMaxPlaces = 100'000;

void add_place(Defect& defect, Defect::Place place) {
  ++defect.found;
  if (place.mended) ++defect.mended;
  if (defect.places.size() < kMaxPlaces) defect.places.push_back(std::move(place));
}

}  // namespace

Defect& DefectList::of_kind(std::string_view kind) {
  const auto known = std::find_if(defects_.begin(), defects_.end(), [&](const Defect& d) { return d.kind == kind; });
  if (known != defects_.end()) return *known;
  defects_.push_back({std::string(kind), 0, 0, {}});
  return defects_.back();
}

void DefectList::add(std::string_view kind, const DefectPlace& place, std::string_view note) {
  add_place(of_kind(kind), {place.polygon, place.at, std::string(note), place.size_m, true});
}

void DefectList::leave(std::string_view kind, const DefectPlace& place, std::string_view reason) {
  add_place(of_kind(kind), {place.polygon, place.at, std::string(reason), place.size_m, false});
}

void DefectList::append(DefectList other) {
  for (Defect& defect : other.defects_) {
    Defect& own = of_kind(defect.kind);
    own.found += defect.found;
    own.mended += defect.mended;
    const std::size_t room = kMaxPlaces - own.places.size();
    const auto end = defect.places.begin() + static_cast<std::ptrdiff_t>(std::min(room, defect.places.size()));
    own.places.insert(own.places.end(), std::move_iterator(defect.places.begin()), std::move_iterator(end));
  }
}

std::vector<Defect> DefectList::take(const Vector& origin) && {
  for (Defect& defect : defects_) {
    for (Defect::Place& place : defect.places) place.at = place.at + origin;
  }
  return std::move(defects_);
}

}  // namespace clerestory::mesh
