// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <new>
#include <thread>
#include <utility>

#include "io/model_stream.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kReadBytes = std::size_t{1} << 20;
/// How often a child that has closed its pipe is looked after until it is gone.
constexpr std::chrono::milliseconds kLookAfter{1};

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }

 private:
  int number_;
};

// What happens in the child.

/// The address space that this process holds [bytes]: what a fork hands on, to which the limit is added.
std::uint64_t address_space() {
  unsigned long long pages = 0;
  std::FILE* statm = std::fopen("/proc/self/statm", "r");
  if (statm == nullptr) return 0;
  if (std::fscanf(statm, "%llu", &pages) != 1) pages = 0;
  std::fclose(statm);
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void limit(__rlimit_resource resource, std::uint64_t soft, std::uint64_t hard) {
  struct rlimit now {};
  ::getrlimit(resource, &now);
  const struct rlimit wanted { std::min<rlim_t>(soft, now.rlim_max), std::min<rlim_t>(hard, now.rlim_max) };
  ::setrlimit(resource, &wanted);
}

void set_limits(const ChildLimits& limits) {
  limit(RLIMIT_CORE, 0, 0);
  ::prctl(PR_SET_DUMPABLE, 0);  // no core for a program that collects them either
  limit(RLIMIT_CPU, limits.cpu_s, std::uint64_t{limits.cpu_s} + 1);
  const std::uint64_t bytes = address_space() + limits.memory_bytes;
  limit(RLIMIT_AS, bytes, bytes);
}

/// The parent's handlers would write its messages, or swallow a crash.
void reset_signals() {
  for (const int signal :
       {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ, SIGXCPU, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM})
    ::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// Libraries print; nobody shall read it.
void silence() {
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nowhere < 0) return;
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, standard);
}

ModelAnswer failure(ModelAnswer::Kind kind, std::string problem = {}) {
  ModelAnswer answer;
  answer.kind = kind;
  answer.problem = std::move(problem);
  return answer;
}

ModelAnswer ask(ModelReaderFunction reader, const std::filesystem::path& path, const ModelFormat& format) {
  try {
    ModelAnswer answer;
    answer.model = reader(path, format);
    return answer;
  } catch (const InputError& error) {
    ModelAnswer answer = failure(ModelAnswer::Kind::kInputError, error.problem());
    answer.file = error.file();
    answer.line = error.line();
    answer.hint = error.hint();
    return answer;
  } catch (const MachineError& error) {
    return failure(ModelAnswer::Kind::kMachineError, error.what());
  } catch (const std::bad_alloc&) {
    return failure(ModelAnswer::Kind::kOutOfMemory);
  } catch (const std::exception& error) {
    return failure(ModelAnswer::Kind::kFailure, error.what());
  } catch (...) {
    return failure(ModelAnswer::Kind::kFailure, "an exception without a name");
  }
}

bool write_all(int pipe, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(pipe, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// An answer in the pipe: its size, then its bytes.
bool send(int pipe, const ModelAnswer& answer) {
  const std::string bytes = pack(answer);
  const std::uint64_t size = bytes.size();
  return write_all(pipe, {reinterpret_cast<const char*>(&size), sizeof size}) && write_all(pipe, bytes);
}

/// Ends the process without the exit handlers and buffers, which are the parent's.
[[noreturn]] void answer_and_exit(int pipe, ModelReaderFunction reader, const std::filesystem::path& path,
                                  const ModelFormat& format) noexcept {
  bool sent = false;
  try {
    const ModelAnswer answer = ask(reader, path, format);
    sent = send(pipe, answer);
  } catch (const std::bad_alloc&) {
    sent = send(pipe, failure(ModelAnswer::Kind::kOutOfMemory));
  }
  ::_exit(sent ? 0 : 1);
}

[[noreturn]] void live_as_child(pid_t parent, int pipe, ModelReaderFunction reader, const std::filesystem::path& path,
                                const ModelFormat& format, const ChildLimits& limits) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it died before this could be asked for
  reset_signals();
  silence();
  set_limits(limits);
  answer_and_exit(pipe, reader, path, format);
}

// What happens in the parent.

/// A child that does not outlive its owner.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() { end(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void end() {
    if (id_ < 0) return;
    ::kill(id_, SIGKILL);
    while (::waitpid(id_, &status_, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
  }
  /// Waits until it has ended by itself; false where it has not by the deadline.
  bool wait(Clock::time_point deadline) {
    while (id_ >= 0) {
      const pid_t ended = ::waitpid(id_, &status_, WNOHANG);
      if (ended == id_ || (ended < 0 && errno != EINTR)) {
        id_ = -1;
      } else if (Clock::now() >= deadline) {
        return false;
      } else {
        std::this_thread::sleep_for(kLookAfter);
      }
    }
    return true;
  }
  /// As waitpid() gives it.
  [[nodiscard]] int status() const { return status_; }

 private:
  pid_t id_;
  int status_ = 0;
};

enum class Received { kWhole, kCutOff, kLate, kTooLong };

/// The bytes of an answer, as send() puts them into the pipe.
class Inbox {
 public:
  Inbox(int pipe, std::uint64_t most_bytes) : pipe_(pipe), most_bytes_(most_bytes), buffer_(kReadBytes, '\0') {}

  Received receive(Clock::time_point deadline) {
    for (;;) {
      if (size_ && bytes_.size() >= *size_) return Received::kWhole;
      if (!wait(deadline)) return Received::kLate;
      const ssize_t got = ::read(pipe_, buffer_.data(), buffer_.size());
      if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
      if (got <= 0) return Received::kCutOff;
      bytes_.append(buffer_.data(), static_cast<std::size_t>(got));
      if (!take_size()) return Received::kTooLong;
    }
  }
  [[nodiscard]] std::string_view bytes() const { return bytes_; }

 private:
  bool wait(Clock::time_point deadline) const {
    for (;;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
      if (left <= 0) return false;
      pollfd pipe{pipe_, POLLIN, 0};
      const int ready = ::poll(&pipe, 1, static_cast<int>(std::min<std::int64_t>(left, 60'000)));
      if (ready > 0) return true;
    }
  }
  bool take_size() {
    if (size_ || bytes_.size() < sizeof(std::uint64_t)) return true;
    std::uint64_t size = 0;
    std::memcpy(&size, bytes_.data(), sizeof size);
    bytes_.erase(0, sizeof size);
    size_ = size;
    return size <= most_bytes_;
  }

  int pipe_;
  std::uint64_t most_bytes_;
  std::string buffer_;
  std::string bytes_;
  std::optional<std::uint64_t> size_;
};

constexpr const char* kExportAgain = "the file may be damaged: export it again, or in another format";
constexpr const char* kSmaller = "split or simplify the model, or export it in another format";

class Refusal {
 public:
  Refusal(const std::filesystem::path& path, const ChildLimits& limits) : file_(path.string()), limits_(limits) {}

  [[noreturn]] void late() const {
    throw InputError(file_, 0, fmt::format("reading it was given up after {} s", limits_.wall_s), kSmaller);
  }
  [[noreturn]] void out_of_memory() const {
    throw InputError(file_, 0, fmt::format("reading it takes more than {} MiB of memory", limits_.memory_bytes >> 20),
                     kSmaller);
  }
  [[noreturn]] void damaged() const {
    throw InputError(file_, 0, "its importer went astray and gave no model", kExportAgain);
  }
  [[noreturn]] void died(int status) const;
  [[noreturn]] void told(const ModelAnswer& answer) const;

 private:
  std::string file_;
  ChildLimits limits_;
};

/// For a child that ended without an answer.
void Refusal::died(int status) const {
  if (!WIFSIGNALED(status))
    throw InputError(file_, 0, fmt::format("its importer ended without a word (status {})", WEXITSTATUS(status)),
                     kExportAgain);
  const int signal = WTERMSIG(status);
  if (signal == SIGINT || signal == SIGTERM) throw Interrupted();
  if (signal == SIGXCPU)
    throw InputError(file_, 0, fmt::format("reading it was given up after {} s of CPU time", limits_.cpu_s), kSmaller);
  const char* description = ::sigdescr_np(signal);
  throw InputError(file_, 0,
                   fmt::format("its importer crashed ({})", description != nullptr ? description : "unknown signal"),
                   kExportAgain);
}

void Refusal::told(const ModelAnswer& answer) const {
  switch (answer.kind) {
    case ModelAnswer::Kind::kInputError:
      throw InputError(answer.file, answer.line, answer.problem, answer.hint);
    case ModelAnswer::Kind::kMachineError:
      throw MachineError(answer.problem);
    case ModelAnswer::Kind::kOutOfMemory:
      out_of_memory();
    case ModelAnswer::Kind::kFailure:
    case ModelAnswer::Kind::kModel:
      break;
  }
  throw InputError(file_, 0, fmt::format("its importer failed: {}", printable(answer.problem)), kExportAgain);
}

ModelFile receive_model(Child& child, int pipe, const Refusal& refusal, const ChildLimits& limits) {
  const Clock::time_point deadline = Clock::now() + std::chrono::seconds(limits.wall_s);
  Inbox inbox(pipe, limits.memory_bytes);
  const Received received = inbox.receive(deadline);
  if (received == Received::kCutOff) {
    if (!child.wait(deadline)) refusal.late();
    refusal.died(child.status());
  }
  child.end();
  if (received == Received::kLate) refusal.late();
  if (received == Received::kTooLong) refusal.damaged();
  std::optional<ModelAnswer> answer = unpack(inbox.bytes());
  if (!answer) refusal.damaged();
  if (answer->kind != ModelAnswer::Kind::kModel) refusal.told(*answer);
  return std::move(answer->model);
}

}  // namespace

ModelFile read_in_child(const std::filesystem::path& path, const ModelFormat& format, ModelReaderFunction reader,
                        const ChildLimits& limits) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw MachineError(fmt::format("no pipe to a child process: {}", std::strerror(errno)));
  Descriptor from_child(ends[0]);
  Descriptor to_parent(ends[1]);
  const pid_t parent = ::getpid();
  const pid_t id = ::fork();
  if (id < 0) throw MachineError(fmt::format("no child process: {}", std::strerror(errno)));
  if (id == 0) {
    from_child.close();
    live_as_child(parent, to_parent.number(), reader, path, format, limits);
  }
  Child child(id);
  to_parent.close();
  return receive_model(child, from_child.number(), Refusal(path, limits), limits);
}

}  // namespace clerestory::io
