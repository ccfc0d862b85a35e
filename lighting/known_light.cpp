// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/known_light.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "lighting/scene.h"
#include "lighting/scene_hash.h"
#include "mesh/error.h"

namespace clerestory::lighting {

namespace {

using Kind = SourceGroup::Kind;

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("", 0, "the stored solution cannot answer this: " + what,
                   "run the study again with --save-solution");
}

/// What becomes of a known group.
struct Use {
  std::uint32_t group = kNone;  ///< of the scene; kNone: its light is left out
  double ratio = 0.0;           ///< how much brighter it has become
};

class Fitter {
 public:
  Fitter(const std::vector<SourceGroup>& known, const Scene& scene)
      : known_(known), scene_(scene), uses_(known.size()) {}

  std::vector<Use> run() {
    if (scene_.has_sky() && !use_same_sky()) use_patches();
    use_named(Kind::kLamps, Kind::kLamps);
    if (scene_.sky.sun.shines()) use_sun();
    return uses_;
  }
  [[nodiscard]] bool lacks_sun() const { return scene_.sky.sun.shines() && !has_sun_; }

 private:
  /// The sky of a moment, exactly; only where nobody asks for its patches.
  bool use_same_sky() {
    const SourceGroups& groups = scene_.groups;
    if (groups.has_patches() && groups.has_columns() && groups.column_of(1) != 0) return false;
    const std::uint64_t source = source_of(scene_.sky);
    for (std::size_t g = 0; g < known_.size(); ++g) {
      if (known_[g].kind != Kind::kSky || known_[g].source != source || known_[g].strength <= 0.0) continue;
      uses_[g] = {0, 1.0 / known_[g].strength};
      return true;
    }
    return false;
  }

  void use_sun() {
    const std::uint64_t source = source_of(scene_.sky.sun);
    for (std::size_t g = 0; g < known_.size() && !has_sun_; ++g) {
      if (known_[g].kind != Kind::kSun || known_[g].source != source || known_[g].strength <= 0.0) continue;
      uses_[g] = {scene_.groups.of_sun(), scene_.sky.sun.normal_illuminance_lux / known_[g].strength};
      has_sun_ = true;
    }
  }

  void use_patches() {
    const auto patches = [](const std::vector<SourceGroup>& groups) {
      return std::count_if(groups.begin(), groups.end(),
                           [](const SourceGroup& group) { return group.kind == Kind::kSkyPatch; });
    };
    if (patches(known_) == 0) refuse("it has no light of the sky");
    if (patches(known_) != patches(scene_.groups.all())) refuse("it tells other sources apart");
    use_named(Kind::kSkyPatch, Kind::kGround);
  }

  /// Groups of the scene of either kind, by their names.
  void use_named(Kind kind, Kind other) {
    for (std::uint32_t g = 0; g < scene_.groups.count(); ++g) {
      const SourceGroup& now = scene_.groups[g];
      if (now.kind != kind && now.kind != other) continue;
      const auto found = std::find_if(known_.begin(), known_.end(), [&](const SourceGroup& before) {
        return before.kind == now.kind && before.name == now.name;
      });
      if (found == known_.end()) refuse("it does not know the group '" + now.name + "'");
      if (found->strength <= 0.0 && now.strength > 0.0) refuse("it has no light of '" + now.name + "'");
      uses_[static_cast<std::size_t>(found - known_.begin())] = {
          g, found->strength > 0.0 ? now.strength / found->strength : 0.0};
    }
  }

  const std::vector<SourceGroup>& known_;
  const Scene& scene_;
  std::vector<Use> uses_;
  bool has_sun_ = false;
};

}  // namespace

FittedLight fit(const KnownLight& known, const Scene& scene) {
  Fitter fitter(known.groups, scene);
  const std::vector<Use> uses = fitter.run();
  FittedLight fitted;
  fitted.lacks_sun = fitter.lacks_sun();
  for (const GroupDirect& given : known.direct) {
    const Use& use = uses[given.group];
    if (use.group == kNone) continue;
    const auto ratio = static_cast<float>(use.ratio);
    fitted.direct.push_back(
        {given.node, use.group, {ratio * given.lux.value, ratio * given.lux.slope_u, ratio * given.lux.slope_v}});
  }
  for (const GroupError& given : known.errors) {
    const Use& use = uses[given.group];
    if (use.group == kNone) continue;
    const auto squared = static_cast<float>(use.ratio * use.ratio);
    fitted.errors.push_back({given.node, use.group, {squared * given.errors.noise2, squared * given.errors.misfit2}});
  }
  return fitted;
}

}  // namespace clerestory::lighting
