// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lighting/sky_patches.h"
#include "mesh/geometry.h"

namespace clerestory::lighting {

/// Whose results are given apart, beside those of all light.
enum class Columns {
  kMix,     ///< none
  kGroups,  ///< the sky with its ground, the sun, and each group of lamps
  kSky145,  ///< the same with the sky in Tregenza's patches, and the ground as one more
  kSky577,  ///< … in Reinhart's
};

/// Sources whose light is known apart from that of all others.
struct SourceGroup {
  enum class Kind : std::uint8_t { kSky, kSkyPatch, kGround, kSun, kLamps };

  std::string name;  ///< in columns: "sky", "sky-1" … "sky-145", "ground", "sun", or as lamps name it
  Kind kind = Kind::kSky;
  /// How bright its sources are: of a patch or the ground the mean luminance [cd/m²], of lamps how far they are dimmed. Sources of one
  /// group keep their proportions.
  double strength = 1.0;
  std::uint64_t source = 0;  ///< of a whole sky, and of the sun: a hash of what it is but for its strength
};

/// The source groups of a scene. A channel of the solution is one group in one band: number group · bands + band. All channels share one
/// set of links, which is refined for the sum of all groups; group's results are their shares of it, and add up to it.
/// Lamps name their group: Luminaire::group, Emission::group.
class SourceGroups {
 public:
  /// One group of everything.
  SourceGroups() = default;
  /// @param columns    whose results are given apart
  /// @param kept       whether a solution is kept, for which the sky is told apart in patches in any case
  /// @param north_deg  from +y, counter-clockwise
  SourceGroups(Columns columns, bool kept, bool sky, bool sun, double north_deg);
  /// Of the light of several moments in one: behind patches, where a solution is kept, the sky with the ground of each moment, then the
  /// sun of each. Nothing is given in columns.
  SourceGroups(const std::vector<std::string>& moments, bool kept, double north_deg);
  /// Of one moment of these: its sky with the ground, its sun, and lamps, whether columns are asked for or not.
  static SourceGroups of_moment(Columns columns, bool sky, bool sun);

  /// Whether there are groups to be told apart.
  [[nodiscard]] bool parted() const { return parts_ != Columns::kMix; }
  [[nodiscard]] std::size_t count() const { return groups_.size(); }
  [[nodiscard]] const SourceGroup& operator[](std::size_t group) const { return groups_[group]; }
  [[nodiscard]] const std::vector<SourceGroup>& all() const { return groups_; }

  /// Whether results are given apart, in columns: of a group each, or the sky's patches and the ground in one.
  [[nodiscard]] bool has_columns() const { return columns_ != Columns::kMix; }
  [[nodiscard]] std::size_t column_count() const { return groups_.size() - joined_; }
  [[nodiscard]] std::uint32_t column_of(std::uint32_t group) const { return group <= joined_ ? 0 : group - joined_; }
  [[nodiscard]] std::string column_name(std::size_t column) const {
    return joined_ > 0 && column == 0 ? "sky" : groups_[column + joined_].name;
  }

  void set_strength(std::uint32_t group, double strength) {
    if (parted()) groups_[group].strength = strength;
  }
  void set_source(std::uint32_t group, std::uint64_t source) {
    if (parted()) groups_[group].source = source;
  }

  /// The group of lamps of that name, made where it is not there yet; 0 where nothing is told apart.
  /// Throws InputError for the name of a group of the sky or the sun.
  std::uint32_t add_lamps(const std::string& name);
  /// The group of the sky, or of the ground beyond the model, in a unit direction that points away from the observer.
  [[nodiscard]] std::uint32_t of_sky(const mesh::Vector& direction) const;
  /// The group of the sun; there must be one, or nothing is told apart.
  [[nodiscard]] std::uint32_t of_sun() const { return sun_; }
  /// The group of the sky with the ground of a moment, and of its sun; only of several moments.
  [[nodiscard]] std::uint32_t of_sky_at(std::size_t moment) const {
    return moments_begin_ + static_cast<std::uint32_t>(moment);
  }
  [[nodiscard]] std::uint32_t of_sun_at(std::size_t moment) const {
    return moments_begin_ + static_cast<std::uint32_t>(moments_ + moment);
  }
  /// The patches of the sky, whose groups are 0 up to their count, with the ground behind them; only where it has patches.
  [[nodiscard]] const SkyPatches& patches() const { return patches_; }
  [[nodiscard]] bool has_patches() const { return parts_ == Columns::kSky145 || parts_ == Columns::kSky577; }

 private:
  Columns columns_ = Columns::kMix;
  Columns parts_ = Columns::kMix;  ///< into which light is told apart
  SkyPatches patches_;
  std::uint32_t sun_ = 0;
  std::uint32_t moments_begin_ = 0;
  std::size_t moments_ = 0;
  std::uint32_t joined_ = 0;  ///< groups of the sky in the first column, but one
  std::vector<SourceGroup> groups_{SourceGroup{"all", SourceGroup::Kind::kSky}};
};

/// Light of one group, where only some groups have any.
struct GroupLight {
  std::uint32_t group = 0;
  double lux = 0.0;
};

/// Adds up light by group. Adds nothing where the groups are not told apart.
class GroupSums {
 public:
  GroupSums() = default;
  explicit GroupSums(const SourceGroups& groups) : lux_(groups.parted() ? groups.count() : 0, 0.0) {}

  void add(std::uint32_t group, double lux) {
    if (!lux_.empty()) lux_[group] += lux;
  }
  /// Those that have any, by number.
  [[nodiscard]] std::vector<GroupLight> lit() const;

 private:
  std::vector<double> lux_;
};

}  // namespace clerestory::lighting
