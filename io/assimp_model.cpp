// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/assimp_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/assimp_materials.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

/// Coordinates that lie further apart than this are worth a word [m].
constexpr double kCoarse = 0.001;

mesh::Affine affine(const aiMatrix4x4& m) {
  return {{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
}

/// How far apart numbers in single precision lie at this one.
double spacing_at(double x) {
  const float size = static_cast<float>(std::abs(x));
  return std::nextafter(size, std::numeric_limits<float>::infinity()) - size;
}

double largest(double x, double y, double z) { return std::max({std::abs(x), std::abs(y), std::abs(z)}); }

double scale_of(const mesh::Affine& map) { return std::max({norm(map.x), norm(map.y), norm(map.z)}); }

/// "nodes[7]" and the like, which assimp makes up for what has no name.
bool is_made_up(std::string_view name) {
  return name.empty() || name.starts_with("$ColladaAutoName$") ||
         ((name.starts_with("nodes[") || name.starts_with("meshes[")) && name.ends_with(']'));
}

class SceneReader {
 public:
  SceneReader(const aiScene& scene, const std::filesystem::path& path, const SceneConvention& convention)
      : scene_(scene), file_(path.string()), materials_(materials_of_scene(scene, file_, convention)), builder_(file_) {
    read_nodes(convention.to_file);
  }

  ModelFile finish(AssimpImport& import, const ModelFormat& format, const SceneConvention& convention);

 private:
  struct Placed {
    const aiNode* node;
    mesh::Affine parent;
  };

  void read_nodes(const mesh::Affine& root);
  void read_mesh(const aiMesh& mesh, const mesh::Affine& place, const std::string& part_name);
  void read_face(const aiMesh& mesh, const aiFace& face, std::uint32_t first, bool mirrored, mesh::MaterialId material,
                 mesh::PartId part);
  [[nodiscard]] std::string part_name(const aiNode& node, unsigned which) const;
  void note_spacing(double spacing) { spacing_ = std::max(spacing_, spacing); }

  const aiScene& scene_;
  std::string file_;
  std::vector<SourceMaterial> materials_;
  ModelBuilder builder_;
  std::vector<std::uint32_t> corners_;
  std::size_t lines_and_points_ = 0;
  double spacing_ = 0.0;  // of coordinates, the widest, in the file's unit
};

/// Without recursion: the depth of the tree is the file's choice.
void SceneReader::read_nodes(const mesh::Affine& root) {
  std::vector<Placed> waiting{{scene_.mRootNode, root}};
  while (!waiting.empty()) {
    const auto [node, parent] = waiting.back();
    waiting.pop_back();
    const aiMatrix4x4& matrix = node->mTransformation;
    const mesh::Affine place = parent * affine(matrix);
    if (node->mNumMeshes > 0) note_spacing(scale_of(parent) * spacing_at(largest(matrix.a4, matrix.b4, matrix.c4)));
    for (unsigned at = 0; at < node->mNumMeshes; ++at) {
      if (node->mMeshes[at] >= scene_.mNumMeshes) throw InputError(file_, 0, "a node names a mesh that does not exist");
      read_mesh(*scene_.mMeshes[node->mMeshes[at]], place, part_name(*node, at));
    }
    for (unsigned at = node->mNumChildren; at-- > 0;) waiting.push_back({node->mChildren[at], place});
  }
}

std::string SceneReader::part_name(const aiNode& node, unsigned which) const {
  if (!is_made_up(node.mName.C_Str())) return node.mName.C_Str();
  std::string name = scene_.mMeshes[node.mMeshes[which]]->mName.C_Str();
  const std::string number = fmt::format("-{}", which);  // assimp's, for a mesh that it takes apart by material
  if (node.mNumMeshes > 1 && name.ends_with(number)) name.resize(name.size() - number.size());
  return is_made_up(name) ? kUnnamed : name;
}

void SceneReader::read_mesh(const aiMesh& mesh, const mesh::Affine& place, const std::string& part_name) {
  const bool has_polygons =
      std::any_of(mesh.mFaces, mesh.mFaces + mesh.mNumFaces, [](const aiFace& face) { return face.mNumIndices >= 3; });
  if (!has_polygons) {
    lines_and_points_ += mesh.mNumFaces;
    return;
  }
  const auto first = static_cast<std::uint32_t>(builder_.vertex_count());
  double farthest = 0.0;
  for (unsigned at = 0; at < mesh.mNumVertices; ++at) {
    const aiVector3D& v = mesh.mVertices[at];
    farthest = std::max(farthest, largest(v.x, v.y, v.z));
    builder_.vertex(place({v.x, v.y, v.z}));
  }
  note_spacing(scale_of(place) * spacing_at(farthest));
  const std::string& material = mesh.mMaterialIndex < materials_.size() ? materials_[mesh.mMaterialIndex].name : "";
  const mesh::MaterialId material_id = builder_.material(material.empty() ? kUnnamed : material);
  const mesh::PartId part = builder_.part(part_name);
  const bool mirrored = place.determinant() < 0.0;
  for (unsigned at = 0; at < mesh.mNumFaces; ++at) read_face(mesh, mesh.mFaces[at], first, mirrored, material_id, part);
}

void SceneReader::read_face(const aiMesh& mesh, const aiFace& face, std::uint32_t first, bool mirrored,
                            mesh::MaterialId material, mesh::PartId part) {
  if (face.mNumIndices < 3) {
    ++lines_and_points_;
    return;
  }
  corners_.clear();
  for (unsigned at = 0; at < face.mNumIndices; ++at) {
    if (face.mIndices[at] >= mesh.mNumVertices)
      throw InputError(
          file_, 0, fmt::format("vertex {} of a mesh does not exist: it has {}", face.mIndices[at], mesh.mNumVertices),
          "export the model again; was a file cut off?");
    corners_.push_back(first + face.mIndices[at]);
  }
  if (mirrored) std::reverse(corners_.begin() + 1, corners_.end());
  builder_.polygon(corners_, material, part);
}

ModelFile SceneReader::finish(AssimpImport& import, const ModelFormat& format, const SceneConvention& convention) {
  ModelFile result;
  result.files = import.files();
  result.notices = import.notices();
  builder_.finish(result, format, convention.unit, convention.up);
  std::erase_if(materials_, [](const SourceMaterial& material) { return material.name.empty(); });
  attach_materials(std::move(materials_), result);
  if (lines_and_points_ > 0)
    result.notices.push_back(fmt::format("{} lines and points of the model were passed over.", lines_and_points_));
  const double spacing_m = spacing_ * metres_per(result.unit);
  if (spacing_m > kCoarse)
    result.notices.push_back(fmt::format(
        "Coordinates came in single precision, which is {:.2g} mm coarse where this model lies. Export it nearer to "
        "the origin, or as OBJ.",
        1e3 * spacing_m));
  return result;
}

}  // namespace

ModelFile model_of_scene(AssimpImport& import, const aiScene& scene, const std::filesystem::path& path,
                         const ModelFormat& format, const SceneConvention& convention) {
  return SceneReader(scene, path, convention).finish(import, format, convention);
}

}  // namespace clerestory::io
