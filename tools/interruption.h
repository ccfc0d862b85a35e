// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace clerestory::tools {

/// Takes ctrl-C (SIGINT) and SIGTERM: the first ends the program at once while nothing has been written, or else
/// raises the flag that interrupted() tells; the second ends it at once. Makes a write beyond a file size limit an
/// error of that write.
void take_signals();

/// From here on files are written: the first signal is answered in an orderly way, by interrupted().
void end_orderly();

/// Whether the user wants the run to stop.
bool interrupted();

}  // namespace clerestory::tools
