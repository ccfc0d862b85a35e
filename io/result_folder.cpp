// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "io/summary.h"
#include "io/whole_file.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace fs = std::filesystem;

namespace {

constexpr const char* kSummary = "summary.json";
constexpr const char* kStaging = ".clerestory-writing";

/// More than any file system keeps inside an inode, so that a full disk shows.
constexpr std::size_t kProbeBytes = 8192;

/// Moves of files, undone unless they are kept.
class Moves {
 public:
  Moves() = default;
  Moves(const Moves&) = delete;
  Moves& operator=(const Moves&) = delete;
  ~Moves() {
    for (auto move = done_.rbegin(); move != done_.rend(); ++move) {
      std::error_code ignored;
      fs::rename(move->second, move->first, ignored);
    }
  }
  void move(const fs::path& from, const fs::path& to) {
    fs::rename(from, to);
    done_.emplace_back(from, to);
  }
  void keep() { done_.clear(); }

 private:
  std::vector<std::pair<fs::path, fs::path>> done_;
};

/// Whether a file of whatever kind has the name, a link that leads nowhere included.
bool is_there(const fs::path& path) { return fs::symlink_status(path).type() != fs::file_type::not_found; }

/// Our files in the folder, as far as they are still there: what its summary.json lists.
std::vector<std::string> our_files(const fs::path& folder) {
  const auto summary = read_earlier_summary(folder / kSummary);
  if (!summary) return {};
  std::vector<std::string> ours = {kSummary};
  for (const std::string& name : summary->files) {
    const auto type = fs::symlink_status(folder / name).type();
    const bool is_file = type == fs::file_type::regular || type == fs::file_type::symlink;
    if (is_file && name != kSummary) ours.push_back(name);
  }
  return ours;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The first name that a file which is not ours has; empty where none has.
std::string taken_name(const fs::path& folder, const std::vector<std::string>& names) {
  const auto ours = our_files(folder);
  for (const std::string& name : names)
    if (!contains(ours, name) && is_there(folder / name)) return name;
  return {};
}

void expect_no_taken_name(const fs::path& folder, const std::vector<std::string>& names) {
  const std::string taken = taken_name(folder, names);
  if (taken.empty()) return;
  throw InputError((folder / taken).string(), 0, "is not a result of this program and would be overwritten",
                   "move it away, or write to another folder with -o");
}

/// Makes the folder with its parents, and lists those that were missing, the outermost first.
void make_folders(const fs::path& folder, std::vector<fs::path>& made) {
  if (fs::is_directory(folder)) return;
  if (is_there(folder)) throw fs::filesystem_error("", folder, std::make_error_code(std::errc::not_a_directory));
  if (folder.has_parent_path() && folder != folder.parent_path()) make_folders(folder.parent_path(), made);
  if (fs::create_directory(folder)) made.push_back(folder);
}

void remove_empty_folders(const std::vector<fs::path>& folders) noexcept {
  std::error_code ignored;
  for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) fs::remove(*folder, ignored);
}

[[noreturn]] void fail(const fs::path& folder, const std::string& why) {
  throw MachineError(folder.string() + ": results cannot be written there: " + why + "; choose another folder with -o");
}

fs::path absolute_folder(const fs::path& folder) {
  fs::path absolute = fs::absolute(folder).lexically_normal();
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

/// Opens the folder and waits until no other process holds it. -1 where the file system knows no locks.
int lock(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) ::flock(descriptor, LOCK_EX);
  return descriptor;
}

}  // namespace

void check_result_folder(const fs::path& folder, const std::vector<std::string>& names) {
  const fs::path place = absolute_folder(folder);
  try {
    expect_no_taken_name(place, names);
    const ResultFolder probe(place);
    write_whole_file(probe.staging() / "probe", std::string(kProbeBytes, ' '));
  } catch (const WriteError& error) {
    fail(folder, error.reason());
  } catch (const fs::filesystem_error& error) {
    fail(folder, error.code().message());
  }
}

ResultFolder::ResultFolder(const fs::path& folder) : folder_(absolute_folder(folder)), staging_(folder_ / kStaging) {
  try {
    make_folders(folder_, made_);
    lock_ = lock(folder_);
    make_folders(folder_, made_);  // another process may have removed it while we waited
    fs::remove_all(staging_);      // of a run that was killed: nobody else can be writing now
    fs::create_directory(staging_);
  } catch (const fs::filesystem_error& error) {
    if (lock_ >= 0) ::close(lock_);
    remove_empty_folders(made_);
    fail(folder_, error.code().message());
  }
}

ResultFolder::~ResultFolder() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  if (!committed_) remove_empty_folders(made_);
  if (lock_ >= 0) ::close(lock_);
}

void ResultFolder::commit(const std::vector<std::string>& names) {
  if (!contains(names, kSummary)) throw std::logic_error("results without a summary.json");
  for (const std::string& name : names) {
    std::error_code error;
    if (fs::file_size(staging_ / name, error) == 0 || error) fail(folder_, "'" + name + "' was not written whole");
  }
  replace(names, staging_ / "older");
}

void ResultFolder::commit_failure(const std::string& summary) {
  write_whole_file(staging_ / kSummary, summary);
  const auto earlier = read_earlier_summary(folder_ / kSummary);
  fs::path older_to = staging_ / "older";
  if (earlier && earlier->status != kStatusFailed) {
    const auto older = our_files(folder_);
    older_to = folder_ / "previous";
    // Where the user keeps something of that name: previous-2, previous-3 …
    for (int i = 2; (is_there(older_to) && !fs::is_directory(older_to)) || !taken_name(older_to, older).empty(); ++i)
      older_to = folder_ / ("previous-" + std::to_string(i));
  }
  replace({kSummary}, older_to);
}

void ResultFolder::replace(const std::vector<std::string>& names, const fs::path& older_to) {
  expect_no_taken_name(folder_, names);
  try {
    fs::create_directory(older_to);
    const fs::path replaced = staging_ / "replaced";
    fs::create_directory(replaced);
    Moves moves;
    for (const std::string& name : our_files(older_to)) moves.move(older_to / name, replaced / name);
    for (const std::string& name : our_files(folder_)) moves.move(folder_ / name, older_to / name);
    for (const std::string& name : names)  // the summary last: it says that the others are there
      if (name != kSummary) moves.move(staging_ / name, folder_ / name);
    moves.move(staging_ / kSummary, folder_ / kSummary);
    moves.keep();
    committed_ = true;
  } catch (const fs::filesystem_error& error) {
    fail(folder_, error.code().message());
  }
}

}  // namespace clerestory::io
