// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/failure.h"

#include <cctype>
#include <new>
#include <system_error>

#include "mesh/error.h"
#include "tools/options.h"

namespace clerestory::tools {

namespace {

template <class Error>
bool is(const std::exception& error) {
  return dynamic_cast<const Error*>(&error) != nullptr;
}

Failure with_words(const std::exception& error) {
  if (is<CommandLineError>(error)) return {kCommandLineAtFault, error.what()};
  if (const auto* input = dynamic_cast<const InputError*>(&error)) {
    const bool in_command = input->file().starts_with("--");  // the option whose value the reader of studies refuses
    return {in_command ? kCommandLineAtFault : kInputAtFault, error.what()};
  }
  if (is<LimitReached>(error)) return {kAccuracyNotReached, error.what()};
  if (is<Interrupted>(error)) return {kInterruptedByUser, error.what()};
  if (is<MachineError>(error) || is<std::system_error>(error)) return {kMachineAtFault, error.what()};
  if (is<std::bad_alloc>(error)) return {kMachineAtFault, "out of memory; ask for a lower accuracy or a coarser grid"};
  return {kMachineAtFault, std::string("internal error, please report it: ") + error.what()};
}

}  // namespace

Failure describe(const std::exception& error) {
  Failure failure = with_words(error);
  for (char& c : failure.line)  // a file's name may hold an end of line
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0) c = ' ';
  return failure;
}

}  // namespace clerestory::tools
