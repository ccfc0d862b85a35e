// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lighting/channels.h"
#include "lighting/direct_light.h"

namespace clerestory::lighting {

struct Scene;

/// Direct light on the nodes of a solution, by the source groups that it was told apart in.
struct KnownLight {
  std::vector<SourceGroup> groups;
  std::vector<GroupDirect> direct;
  std::vector<GroupError> errors;  ///< of suns
};

/// What a scene's light is made of, by its own groups.
struct FittedLight {
  std::vector<GroupDirect> direct;
  std::vector<GroupError> errors;
  bool lacks_sun = false;  ///< whether the scene's sun is to be cast
};

/// Makes a scene's direct light of what is known: of lamps and of the patches of the sky as much brighter or darker as these have become, of
/// the sky of a moment or a sun where the scene has the very same.
/// Throws InputError where the scene has a source that is not known but a sun.
FittedLight fit(const KnownLight& known, const Scene& scene);

}  // namespace clerestory::lighting
