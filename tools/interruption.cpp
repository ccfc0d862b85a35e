// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/interruption.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <string_view>

#include "tools/exit_status.h"

namespace clerestory::tools {

namespace {

// The only state that a signal handler can reach; lock-free atomics are safe there.
std::atomic<bool> g_orderly = false;
std::atomic<bool> g_interrupted = false;
std::atomic<bool> g_terminal = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int) {
  if (g_orderly.load() && !g_interrupted.exchange(true)) return;
  constexpr std::string_view kLine = "\r\033[Kerror: interrupted\n";  // over the line of the progress
  constexpr std::size_t kErase = 4;
  const std::string_view line = g_terminal.load() ? kLine : kLine.substr(kErase);
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
  ::_exit(kInterruptedByUser);
}

}  // namespace

void take_signals() {
  g_terminal = ::isatty(STDERR_FILENO) == 1;
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
  action.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &action, nullptr);
}

void end_orderly() { g_orderly = true; }

bool interrupted() { return g_interrupted; }

}  // namespace clerestory::tools
