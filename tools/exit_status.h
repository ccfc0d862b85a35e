// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace clerestory::tools {

/// How the command ends.
enum ExitStatus {
  kDone = 0,
  kInputAtFault = 1,
  kCommandLineAtFault = 2,
  kMachineAtFault = 3,       ///< memory, disk, permissions; our own bugs too
  kAccuracyNotReached = 4,   ///< results are written, and marked so
  kInterruptedByUser = 130,  ///< as shells count SIGINT
};

}  // namespace clerestory::tools
