#include "firmware/tools/bench/can/syscall_count.hpp"

#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>

namespace ivo::firmware::bench {
namespace {

constexpr int kAtCall = SIGTRAP | 0x80;

[[noreturn]] void be_traced(const std::function<void()>& work) {
  if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0 || raise(SIGSTOP) != 0) {
    _exit(1);
  }
  work();
  _exit(0);
}

bool wait_for(pid_t child, int& status) {
  pid_t got = -1;
  while ((got = waitpid(child, &status, 0)) < 0 && errno == EINTR) {
  }
  return got == child;
}

/// From stop to stop until the child has ended: each call stops it as it begins and as it ends. None when it failed.
std::optional<int> stops_of(pid_t child) {
  int stops = 0;
  int status = 0;
  while (ptrace(PTRACE_SYSCALL, child, nullptr, nullptr) == 0 && wait_for(child, status) && WIFSTOPPED(status)) {
    stops += WSTOPSIG(status) == kAtCall ? 1 : 0;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? std::optional(stops) : std::nullopt;
}

Result<int> stops_with(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child < 0) {
    return Error{std::string("no child to trace: ") + std::strerror(errno)};
  }
  if (child == 0) {
    be_traced(work);
  }
  int status = 0;
  const bool stopped = wait_for(child, status) && WIFSTOPPED(status);
  auto* const options = reinterpret_cast<void*>(PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL);
  if (stopped && ptrace(PTRACE_SETOPTIONS, child, nullptr, options) == 0) {
    if (const std::optional<int> stops = stops_of(child)) {
      return *stops;
    }
  }
  (void)kill(child, SIGKILL);
  (void)waitpid(child, &status, 0);
  return Error{"this kernel does not let a child be traced"};
}

}  // namespace

Result<int> count_system_calls(const std::function<void()>& work) {
  const Result<int> with = stops_with(work);
  const Result<int> without = stops_with([] {});
  return with && without ? Result<int>((with.value() - without.value()) / 2) : with ? without : with;
}

}  // namespace ivo::firmware::bench
