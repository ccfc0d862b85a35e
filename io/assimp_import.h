// SPDX-License-Identifier: GPL-3.0-or-later
// Private to this folder: it shows assimp's types.
#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace clerestory::io {

/// One file's way through assimp, in the child process: assimp's log is one for the whole process.
class AssimpImport {
 public:
  /// @param extension  of the one format that the file may have, as assimp knows it: "gltf", "dae"
  AssimpImport(const std::filesystem::path& path, const std::string& extension);
  ~AssimpImport();
  AssimpImport(const AssimpImport&) = delete;
  AssimpImport& operator=(const AssimpImport&) = delete;

  /// The scene in the file, which lives as long as this object. Throws InputError with assimp's reason in one line, and with the line
  /// of the file where assimp knows it.
  const aiScene& read_file();
  /// The same, of a text that stands for the file.
  const aiScene& read_text(const std::string& text);

  /// What assimp remarked upon; one sentence each.
  [[nodiscard]] std::vector<std::string> notices() const;
  /// That were read; the model first.
  [[nodiscard]] std::vector<std::filesystem::path> files() const;

 private:
  struct Log;
  class Files;
  class LogInto;

  void keep_only(const std::string& extension);
  const aiScene& checked(const aiScene* scene, const std::string& text) const;
  [[noreturn]] void refuse(const std::string& text) const;

  std::filesystem::path path_;
  std::string extension_;
  std::unique_ptr<Log> log_;
  Assimp::Importer importer_;
  Files* files_;  ///< owned by importer_
};

}  // namespace clerestory::io
