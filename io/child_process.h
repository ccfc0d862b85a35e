// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>

#include "io/model_file.h"

namespace clerestory::io {

/// What a process that reads a model may use. The defaults are far beyond what a building needs.
struct ChildLimits {
  std::uint32_t cpu_s = 300;
  std::uint32_t wall_s = 900;
  std::uint64_t memory_bytes = std::uint64_t{4} << 30;  ///< address space beyond what this process holds already
};

/// A reader as the table of read_model() has it, with the work done by somebody else's library.
using ModelReaderFunction = ModelFile (*)(const std::filesystem::path& path, const ModelFormat& format);

/// Runs `reader` in a child process and gives its ModelFile, so that what an importer that we did not write does wrong ends the
/// child and not the program. This is how a reader that wraps such a library is written:
///
///     ModelFile read_ifc(const std::filesystem::path& path, const ModelFormat& format) {
///       return read_in_child(path, format, &import_ifc);
///     }
///
/// The reader gets the path and format as given, may print what it likes (it goes nowhere), throws InputError as any reader does, and
/// hands all that it knows over in its result: nothing else that it changes is seen here. It must not use the threads of TBB: of the
/// parent's threads a child has only the one that calls. No shell, and no other program, is involved.
///
/// Throws what the reader throws: its InputError or MachineError whole, any other exception as an InputError with its text. Throws
/// InputError with the file's name and the reason for a child that crashes, runs out of a limit, or answers with what is no
/// model; Interrupted where a signal that ends programs (ctrl-C, SIGTERM) ended it; MachineError where no process can be started.
/// The child ends with this process, whatever ends it.
ModelFile read_in_child(const std::filesystem::path& path, const ModelFormat& format, ModelReaderFunction reader,
                        const ChildLimits& limits = {});

}  // namespace clerestory::io
