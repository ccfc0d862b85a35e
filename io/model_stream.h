// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/model_file.h"

namespace clerestory::io {

/// What a process that reads a model tells the one that asked for it: the model, or why there is none.
struct ModelAnswer {
  enum class Kind : std::uint8_t { kModel, kInputError, kMachineError, kOutOfMemory, kFailure };

  Kind kind = Kind::kModel;
  ModelFile model;
  std::string file;        ///< of an InputError
  std::uint64_t line = 0;  ///< of an InputError
  std::string problem;     ///< of any error but kOutOfMemory
  std::string hint;        ///< of an InputError
};

/// The answer as bytes, for a pipe between two processes of one program: every field of it, in this machine's byte order.
std::string pack(const ModelAnswer& answer);

/// The answer that pack() made into these bytes. The bytes are not trusted, since a library gone astray may have written them: nothing
/// where they do not hold exactly one answer, or one whose model contradicts itself (a corner, material or part that does not exist,
/// loops out of order, a coordinate that is not finite). Never takes memory out of proportion to their number.
std::optional<ModelAnswer> unpack(std::string_view bytes);

}  // namespace clerestory::io
