// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/channels.h"

#include <algorithm>

#include "mesh/error.h"

namespace clerestory::lighting {

namespace {

std::size_t parts_of(Columns columns) { return columns == Columns::kSky577 ? 2 : 1; }

}  // namespace

SourceGroups::SourceGroups(Columns columns, bool kept, bool sky, bool sun, double north_deg)
    : columns_(columns),
      parts_(kept && columns != Columns::kSky577 ? Columns::kSky145 : columns),
      patches_(parts_of(parts_), north_deg) {
  using Kind = SourceGroup::Kind;
  if (!parted()) return;
  groups_.clear();
  if (sky && has_patches()) {
    for (std::size_t p = 0; p < patches_.count(); ++p)
      groups_.push_back({"sky-" + std::to_string(p + 1), Kind::kSkyPatch});
    groups_.push_back({"ground", Kind::kGround});
    if (columns == Columns::kGroups) joined_ = static_cast<std::uint32_t>(patches_.count());
  } else if (sky) {
    groups_.push_back({"sky", Kind::kSky});
  }
  if (!sun) return;
  sun_ = static_cast<std::uint32_t>(groups_.size());
  groups_.push_back({"sun", Kind::kSun});
}

SourceGroups::SourceGroups(const std::vector<std::string>& moments, bool kept, double north_deg)
    : SourceGroups(kept ? Columns::kSky145 : Columns::kGroups, false, kept, false, north_deg) {
  columns_ = Columns::kMix;
  if (!kept) groups_.clear();
  moments_ = moments.size();
  moments_begin_ = static_cast<std::uint32_t>(groups_.size());
  for (const std::string& moment : moments) groups_.push_back({"sky_" + moment, SourceGroup::Kind::kSky});
  for (const std::string& moment : moments) groups_.push_back({"sun_" + moment, SourceGroup::Kind::kSun});
}

SourceGroups SourceGroups::of_moment(Columns columns, bool sky, bool sun) {
  SourceGroups groups(Columns::kGroups, false, sky, sun, 0.0);
  groups.columns_ = columns;
  return groups;
}

std::uint32_t SourceGroups::add_lamps(const std::string& name) {
  if (!parted()) return 0;
  const auto found =
      std::find_if(groups_.begin(), groups_.end(), [&](const SourceGroup& group) { return group.name == name; });
  if (name != "sky" && found == groups_.end()) {
    groups_.push_back({name, SourceGroup::Kind::kLamps});
    return static_cast<std::uint32_t>(groups_.size() - 1);
  }
  if (name == "sky" || found->kind != SourceGroup::Kind::kLamps)
    throw InputError("", 0, "a group of lamps is named '" + name + "', as a part of the daylight is",
                     "give it another name");
  return static_cast<std::uint32_t>(found - groups_.begin());
}

std::uint32_t SourceGroups::of_sky(const mesh::Vector& direction) const {
  if (!has_patches()) return 0;
  return static_cast<std::uint32_t>(direction.z < 0.0 ? patches_.count() : patches_.of(direction));
}

std::vector<GroupLight> GroupSums::lit() const {
  std::vector<GroupLight> found;
  for (std::uint32_t g = 0; g < lux_.size(); ++g) {
    if (lux_[g] != 0.0) found.push_back({g, lux_[g]});
  }
  return found;
}

}  // namespace clerestory::lighting
