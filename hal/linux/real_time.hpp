// What Linux grants to a program that must not be late: memory that stays where it is, and a thread that runs before
// all others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "config/base/result.hpp"

namespace ivo::hal {

/// Locks all memory that the process has and will have, so that no access waits for a page. Fails without
/// RLIMIT_MEMLOCK or CAP_IPC_LOCK for all of it.
[[nodiscard]] Result<void> lock_memory();

struct RealTimePlace {
  int priority = 80;         ///< SCHED_FIFO, 1 to 99
  std::optional<int> cpu{};  ///< to be pinned to; none: wherever the process may run
};

/// Of the calling thread, for good: its priority and CPU, and its stack touched down to 256 kB. Fails without
/// RLIMIT_RTPRIO or CAP_SYS_NICE, and on a CPU that is not there; then the thread is as it was or pinned.
[[nodiscard]] Result<void> enter_real_time(const RealTimePlace& place);

/// Whether a thread could enter, tried on one that ends at once.
[[nodiscard]] Result<void> may_enter_real_time(const RealTimePlace& place);

/// The calling thread's name for ps, strace and kernelshark, at most 15 characters.
void name_thread(const char* name) noexcept;

/// Signals to the process interrupt other threads than the calling one.
void leave_signals_to_others() noexcept;

/// Page faults of the calling thread since it began: without and with reading from a disk.
struct PageFaults {
  std::uint64_t minor = 0;
  std::uint64_t major = 0;
};
[[nodiscard]] PageFaults page_faults() noexcept;

}  // namespace ivo::hal
