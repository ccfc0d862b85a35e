// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "io/model_file.h"

/// The entry that libFuzzer and the driver call: 0 whatever the input is, and never an end of the program.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT: libFuzzer's name

namespace clerestory::fuzz {

/// The folder in which the inputs of this process stand; a target may put files beside them.
std::filesystem::path folder();

/// Writes the bytes to a file of that name and has it read. Only an InputError of one line may leave the reader; anything else that does
/// goes on and ends the program.
int read_bytes(const std::uint8_t* data, std::size_t size, const std::string& name,
               const std::function<void(const std::filesystem::path&)>& read);

/// Aborts unless all ids and corners of a model exist and all its coordinates are finite.
void check(const io::ModelFile& file);

}  // namespace clerestory::fuzz
