// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/whole_file.h"

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace clerestory::io {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, int error) {
  throw WriteError(file, std::generic_category().message(error));
}

}  // namespace

void write_whole_file(const std::filesystem::path& file, std::string_view bytes) {
  // C's streams, since they keep errno, which says "No space left on device" where an ofstream says only "bad".
  errno = 0;
  std::FILE* const out = std::fopen(file.c_str(), "wb");
  if (out == nullptr) fail(file, errno);
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size() && std::fflush(out) == 0;
  int error = errno;
  const bool closed = std::fclose(out) == 0;
  if (written && closed) return;
  if (written) error = errno;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) std::filesystem::remove(file, ignored);  // never a device
  fail(file, error);
}

}  // namespace clerestory::io
