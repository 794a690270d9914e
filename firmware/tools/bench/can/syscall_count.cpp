#include "firmware/tools/bench/can/syscall_count.hpp"

#include <sys/ptrace.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
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

/// Which call the child is about to make.
std::optional<long> number_of_call(pid_t child) {
#if defined(__x86_64__)
  errno = 0;
  const long number = ptrace(PTRACE_PEEKUSER, child, offsetof(user_regs_struct, orig_rax), nullptr);
  return errno == 0 ? std::optional(number) : std::nullopt;
#else
  __ptrace_syscall_info info{};
  const bool told = ptrace(PTRACE_GET_SYSCALL_INFO, child, sizeof info, &info) > 0;
  return told && info.op == PTRACE_SYSCALL_INFO_ENTRY ? std::optional(static_cast<long>(info.entry.nr)) : std::nullopt;
#endif
}

/// From stop to stop until the child has ended: each call stops it as it begins and as it ends. None when it failed.
std::optional<std::vector<long>> follow(pid_t child) {
  std::vector<long> calls;
  bool begins = true;
  int status = 0;
  while (ptrace(PTRACE_SYSCALL, child, nullptr, nullptr) == 0 && wait_for(child, status) && WIFSTOPPED(status)) {
    if (WSTOPSIG(status) != kAtCall) {
      continue;
    }
    if (begins) {
      const std::optional<long> number = number_of_call(child);
      if (!number) {
        return std::nullopt;
      }
      calls.push_back(*number);
    }
    begins = !begins;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? std::optional(calls) : std::nullopt;
}

}  // namespace

Result<std::vector<long>> system_calls_of(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child < 0) {
    return Error{std::string("no child to trace: ") + std::strerror(errno)};
  }
  if (child == 0) {
    be_traced(work);
  }
  int status = 0;
  const bool stopped = wait_for(child, status) && WIFSTOPPED(status);
  constexpr long options = PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL;
  if (stopped && ptrace(PTRACE_SETOPTIONS, child, nullptr, options) == 0) {
    if (std::optional<std::vector<long>> calls = follow(child)) {
      return *std::move(calls);
    }
  }
  (void)kill(child, SIGKILL);
  (void)waitpid(child, &status, 0);
  return Error{"this kernel does not let a child be traced"};
}

}  // namespace ivo::firmware::bench
