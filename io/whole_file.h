// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/error.h"

namespace clerestory::io {

/// A file that cannot be written, and the system's word on it.
class WriteError : public MachineError {
 public:
  WriteError(const std::filesystem::path& file, std::string reason)
      : MachineError(file.string() + ": cannot be written: " + reason), file_(file), reason_(std::move(reason)) {}

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::filesystem::path file_;
  std::string reason_;
};

/// Writes the bytes to a file, replacing it, and checks every step to the close.
/// Throws WriteError; the part that was written is removed.
void write_whole_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace clerestory::io
