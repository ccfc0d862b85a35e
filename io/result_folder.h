// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace clerestory::io {

// The folder that results go to. We replace or remove only files that its own summary.json lists; whatever else lies
// there is the user's. Nothing is left in it, not even hidden, from check_result_folder() to the writing of the
// results.

/// Makes sure that a run can write its results, before the run: the folder can be made and written to, and none of the
/// `names` is taken by a file that is not ours. Changes nothing.
/// Throws InputError that names the user's file, MachineError when the folder cannot be made or written to.
void check_result_folder(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// Results on their way to the folder: written to a hidden folder inside it, then moved to their places when all are
/// whole. One at a time: another process that writes to the same folder is waited for.
class ResultFolder {
 public:
  /// Makes the folder where it is missing. Throws MachineError.
  explicit ResultFolder(const std::filesystem::path& folder);

  /// Removes what was not committed, and the folder itself if it was made in vain.
  ~ResultFolder();

  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  /// Where to write.
  [[nodiscard]] const std::filesystem::path& staging() const { return staging_; }

  /// Replaces our older files by the `names` from staging(), which must be there and hold something, and `summary.json`
  /// among them. Older files of ours that have no successor are removed.
  /// On an error the older files are put back. Throws MachineError, and InputError when a name is taken by a file
  /// that is not ours.
  void commit(const std::vector<std::string>& names);

  /// Records a failed run: the older files of ours go to `previous/`, and a new summary.json stands alone.
  /// A failure after a failure leaves `previous/` as it is. Throws as commit() does.
  void commit_failure(const std::string& summary);

 private:
  void replace(const std::vector<std::string>& names, const std::filesystem::path& older_to);

  std::filesystem::path folder_;
  std::filesystem::path staging_;
  std::vector<std::filesystem::path> made_;  ///< folders that we made, the outermost first
  int lock_ = -1;
  bool committed_ = false;
};

}  // namespace clerestory::io
