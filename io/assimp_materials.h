// SPDX-License-Identifier: GPL-3.0-or-later
// Private to this folder: it shows assimp's types.
#pragma once

#include <assimp/scene.h>

#include <string>
#include <vector>

#include "io/assimp_model.h"
#include "io/source_material.h"

namespace clerestory::io {

/// What the file tells of each material of a scene, in the scene's order. Materials that assimp adds for faces without one come without
/// a name and tell nothing; of several that share a name but differ, the later ones get a number: "wall (2)".
std::vector<SourceMaterial> materials_of_scene(const aiScene& scene, const std::string& file,
                                               const SceneConvention& convention);

}  // namespace clerestory::io
