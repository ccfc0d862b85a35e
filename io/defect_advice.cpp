// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/defect_advice.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace clerestory::io {

namespace {

struct Advice {
  std::string_view kind;
  std::string_view of_what_was_left;
};

constexpr std::array kAdvice{
    Advice{"gaps", "draw the surfaces until they meet, or allow wider gaps with --gap"},
    Advice{"self-crossing polygons", "draw the polygon anew, so that its sides do not cross"},
    Advice{"intersecting polygons",
           "let one surface end at the other; until then no shadow line is drawn where they cross"},
    Advice{"overlapping polygons",
           "remove one of the two surfaces; until then light takes the one that it meets first"},
    Advice{"non-planar polygons", "draw them as triangles"},
    Advice{"one-sided shells",
           "nothing, unless a surface shines or has two materials: then cut it where it turns over"},
    Advice{"stray specks", "nothing where they are meant; else delete them"},
};

}  // namespace

std::string defect_advice(const mesh::Defect& defect, mesh::CleanOptions::Repair repair) {
  if (repair == mesh::CleanOptions::Repair::kReport) return "let them be mended: --repair auto";
  if (defect.mended == defect.found)
    return "nothing, they are mended in every run; clerestory clean writes the mended model";
  const auto known =
      std::find_if(kAdvice.begin(), kAdvice.end(), [&](const Advice& advice) { return advice.kind == defect.kind; });
  return known != kAdvice.end() ? std::string(known->of_what_was_left)
                                : "look at them where they are left, and mend them in the program that drew the model";
}

std::vector<mesh::Defect::Place> worst_places(const mesh::Defect& defect, std::size_t count) {
  std::vector<mesh::Defect::Place> worst(std::min(count, defect.places.size()));
  std::vector<std::size_t> order(defect.places.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto is_worse = [&](std::size_t a, std::size_t b) {
    const auto& p = defect.places[a];
    const auto& q = defect.places[b];
    if (p.mended != q.mended) return q.mended;
    return p.size_m != q.size_m ? p.size_m > q.size_m : a < b;
  };
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(worst.size());
  std::partial_sort(order.begin(), end, order.end(), is_worse);
  for (std::size_t i = 0; i < worst.size(); ++i) worst[i] = defect.places[order[i]];
  return worst;
}

std::vector<std::pair<std::string, std::size_t>> reasons_of_left(const mesh::Defect& defect) {
  std::vector<std::pair<std::string, std::size_t>> reasons;
  for (const mesh::Defect::Place& place : defect.places) {
    if (place.mended) continue;
    const auto known = std::ranges::find_if(reasons, [&](const auto& reason) { return reason.first == place.note; });
    known == reasons.end() ? reasons.emplace_back(place.note, 1) : * known = {place.note, known->second + 1};
  }
  return reasons;
}

bool has_unmended(const mesh::CleanReport& report) {
  return std::any_of(report.defects.begin(), report.defects.end(),
                     [](const mesh::Defect& defect) { return defect.mended < defect.found; });
}

}  // namespace clerestory::io
