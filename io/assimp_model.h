// SPDX-License-Identifier: GPL-3.0-or-later
// Private to this folder: it shows assimp's types.
#pragma once

#include <optional>
#include <string>

#include "io/assimp_import.h"
#include "io/model_builder.h"
#include "mesh/affine.h"

namespace clerestory::io {

/// What a format adds to a scene of assimp.
struct SceneConvention {
  std::string told_by;           ///< of its materials: "the base colour of the glTF"
  mesh::Affine to_file;          ///< from the scene to the file's unit and axes, where these are none of ours
  std::optional<ToldUnit> unit;  ///< nothing: guessed
  UpAxis up = UpAxis::kZ;
  std::string stand_in;  ///< name of a material that the reader put in for faces without one; empty for none
  /// 1 opaque, 0 clear, of a material's alpha; nothing where it means nothing in this format.
  std::optional<double> (*opacity)(const aiMaterial& material) = nullptr;
};

/// The polygons of a scene: node matrices, which assimp gives in single precision, are accumulated in double; a part has the name of
/// its node, or of its mesh where the node has none. A node that mirrors keeps its front sides. Lines and points are passed over.
/// Throws InputError where ModelBuilder does, and for a face with a corner that its mesh has not.
ModelFile model_of_scene(AssimpImport& import, const aiScene& scene, const std::filesystem::path& path,
                         const ModelFormat& format, const SceneConvention& convention);

}  // namespace clerestory::io
