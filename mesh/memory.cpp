// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

namespace clerestory {

namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

/// The value of a line "Name:   123 kB" of a file of the kernel [bytes]; 0 where it is not there.
std::uint64_t kernel_figure(const char* file, const std::string& name) {
  std::ifstream in(file);
  for (std::string word; in >> word;) {
    std::uint64_t kilobytes = 0;
    if (word == name + ":" && in >> kilobytes) return kilobytes * 1024;
  }
  return 0;
}

/// The least of the limits that a control group and those that hold it have [bytes]. A file without a number ("max") limits nothing.
std::uint64_t least_limit(const std::filesystem::path& root, std::filesystem::path group, const char* file) {
  std::uint64_t least = kUnlimited;
  for (;; group = group.parent_path()) {
    std::ifstream in(root / group.relative_path() / file);
    std::uint64_t bytes = 0;
    if (in >> bytes) least = std::min(least, bytes);
    if (!group.has_relative_path()) return least;
  }
}

/// By either version of control groups: lines "0::/group", "4:memory:/group" [man 7 cgroups].
std::uint64_t limit_of_control_groups() {
  std::uint64_t least = kUnlimited;
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    std::istringstream parts(line);
    std::string number;
    std::string controllers;
    std::string group;
    std::getline(std::getline(std::getline(parts, number, ':'), controllers, ':'), group);
    if (controllers.empty()) least = std::min(least, least_limit("/sys/fs/cgroup", group, "memory.max"));
    if (controllers == "memory")
      least = std::min(least, least_limit("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
  }
  return least;
}

/// What a limit of the process leaves beside what it counts already [bytes].
std::uint64_t left_by(__rlimit_resource resource, const char* counted) {
  struct rlimit limit {};
  if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
  const std::uint64_t used = kernel_figure("/proc/self/status", counted);
  return limit.rlim_cur > used ? limit.rlim_cur - used : 0;
}

}  // namespace

std::uint64_t resident_bytes() {
  std::ifstream in("/proc/self/statm");
  std::uint64_t all_pages = 0;
  std::uint64_t resident_pages = 0;
  in >> all_pages >> resident_pages;
  return resident_pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

std::uint64_t memory_within_reach() {
  const std::uint64_t resident = resident_bytes();
  const std::uint64_t free = kernel_figure("/proc/meminfo", "MemAvailable");
  std::uint64_t left = free == 0 ? kUnlimited : free;
  left = std::min({left, left_by(RLIMIT_AS, "VmSize"), left_by(RLIMIT_DATA, "VmData")});
  return std::min(left == kUnlimited ? left : resident + left, limit_of_control_groups());
}

void refuse_memory_beyond(std::uint64_t bytes) {
  if (kernel_figure("/proc/self/status", "VmData") >= bytes) return;
  struct rlimit now {};
  if (::getrlimit(RLIMIT_DATA, &now) != 0) return;
  now.rlim_cur = std::min<rlim_t>(bytes, now.rlim_cur);
  ::setrlimit(RLIMIT_DATA, &now);
}

}  // namespace clerestory
