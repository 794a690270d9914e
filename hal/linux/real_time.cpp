#include "hal/linux/real_time.hpp"

#include <linux/capability.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <thread>

namespace ivo::hal {
namespace {

constexpr std::size_t kStack = 256 * 1024;
constexpr std::size_t kPage = 4096;

// Not inlined: the array is on the stack below the caller's, where the loop's frames will be.
[[gnu::noinline]] void touch_stack() noexcept {
  std::array<volatile char, kStack> stack;  // NOLINT(cppcoreguidelines-pro-type-member-init): a page a touch, below
  for (std::size_t i = 0; i < stack.size(); i += kPage) {
    stack[i] = 0;
  }
}

std::string limit_text(rlim_t limit, const char* unit) {
  return limit == RLIM_INFINITY ? "unlimited" : std::to_string(limit) + unit;
}

rlim_t limit_of(__rlimit_resource resource) {
  rlimit limit{};
  (void)getrlimit(resource, &limit);
  return limit.rlim_cur;
}

bool may_lock_without_limit() {
  __user_cap_header_struct header{.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> sets{};
  return syscall(SYS_capget, &header, sets.data()) == 0 && (sets[0].effective & (1U << CAP_IPC_LOCK)) != 0;
}

}  // namespace

Result<void> lock_memory() {
  // A limit that suffices now would refuse what is mapped later, when the robot is under way.
  if (limit_of(RLIMIT_MEMLOCK) != RLIM_INFINITY && !may_lock_without_limit()) {
    errno = EPERM;
  } else if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) {
    return {};
  }
  const int reason = errno;
  return Error{"memory cannot be locked: " + std::string(std::strerror(reason)) + "; RLIMIT_MEMLOCK is " +
               limit_text(limit_of(RLIMIT_MEMLOCK), " bytes") +
               ", expected unlimited (LimitMEMLOCK=infinity, or \"memlock unlimited\" in /etc/security/limits.d)"};
}

Result<void> enter_real_time(const RealTimePlace& place) {
  touch_stack();
  if (place.cpu) {
    cpu_set_t cpus;
    CPU_ZERO(&cpus);
    CPU_SET(static_cast<std::size_t>(*place.cpu), &cpus);
    if (const int reason = pthread_setaffinity_np(pthread_self(), sizeof cpus, &cpus); reason != 0) {
      return Error{"the loop cannot be pinned to CPU " + std::to_string(*place.cpu) + ": " + std::strerror(reason) +
                   "; expected one that this process may use (loop.cpu of the robot file)"};
    }
  }
  sched_param parameters{};
  parameters.sched_priority = place.priority;
  if (const int reason = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters); reason != 0) {
    return Error{"SCHED_FIFO priority " + std::to_string(place.priority) + " is not granted: " + std::strerror(reason) +
                 "; RLIMIT_RTPRIO is " + limit_text(limit_of(RLIMIT_RTPRIO), "") + ", expected " +
                 std::to_string(place.priority) + " or more (LimitRTPRIO=, or \"rtprio\" in /etc/security/limits.d)"};
  }
  return {};
}

Result<void> may_enter_real_time(const RealTimePlace& place) {
  Result<void> entered;
  std::thread([&] { entered = enter_real_time(place); }).join();
  return entered;
}

void name_thread(const char* name) noexcept { (void)pthread_setname_np(pthread_self(), name); }

void leave_signals_to_others() noexcept {
  sigset_t all;
  (void)sigfillset(&all);
  (void)pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

PageFaults page_faults() noexcept {
  rusage usage{};
  (void)getrusage(RUSAGE_THREAD, &usage);
  return {static_cast<std::uint64_t>(usage.ru_minflt), static_cast<std::uint64_t>(usage.ru_majflt)};
}

}  // namespace ivo::hal
