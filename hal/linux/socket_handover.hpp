// What is seen and prepared outside of the loop, handed over to it: the loop's side is atomics only, no system call.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "hal/api/can_bus.hpp"
#include "hal/api/file_descriptor.hpp"

namespace ivo::hal {

/// An interface as it was seen at one time.
struct LinkReport {
  bool present = true;
  bool up = true;
  std::optional<BusState> controller;
  bool counts_errors = false;
  std::uint16_t transmit_errors = 0;
  std::uint16_t receive_errors = 0;
  friend bool operator==(const LinkReport&, const LinkReport&) = default;
};

/// One thread calls the watcher's functions, one the loop's.
class SocketHandover {
 public:
  SocketHandover() = default;
  SocketHandover(const SocketHandover&) = delete;
  SocketHandover& operator=(const SocketHandover&) = delete;
  ~SocketHandover() {
    (void)FileDescriptor(offered_.load());
    close_discarded();
  }

  /// Watcher: takes the place of a socket that was offered and not taken.
  void offer(FileDescriptor socket) noexcept {
    close_discarded();
    (void)FileDescriptor(offered_.exchange(socket.release(), std::memory_order_acq_rel));
  }
  void close_discarded() noexcept { (void)FileDescriptor(discarded_.exchange(-1, std::memory_order_acq_rel)); }
  /// Watcher: before it looks.
  void begin_look() noexcept { changes_at_look_ = changes_.load(std::memory_order_acquire); }
  void report(const LinkReport& report) noexcept {
    // Two looks may see the same; each is news, or an older guess of the loop's would stay.
    report_.store(packed(report) | std::uint64_t{++looks_} << 40U | std::uint64_t{changes_at_look_} << 56U,
                  std::memory_order_release);
  }

  /// Loop: the socket offered since, or -1; from then on the caller's, which discards the one that it replaces.
  [[nodiscard]] int take() noexcept {
    return offered_.load(std::memory_order_relaxed) < 0 ? -1 : offered_.exchange(-1, std::memory_order_acq_rel);
  }
  /// Loop: at most one for each that was taken; the watcher closes it.
  void discard(int socket) noexcept { discarded_.store(socket, std::memory_order_release); }
  /// Loop: it has seen a change by itself. What a look that began before has seen is older, and is not handed out: the
  /// next look tells.
  void note_change() noexcept { changes_.fetch_add(1, std::memory_order_acq_rel); }
  /// Loop: the newest report, when there is one that was not yet taken.
  [[nodiscard]] std::optional<LinkReport> take_report() noexcept {
    const std::uint64_t word = report_.load(std::memory_order_acquire);
    if (word == taken_report_) {
      return std::nullopt;
    }
    taken_report_ = word;
    const bool outdated = static_cast<std::uint8_t>(word >> 56U) != changes_.load(std::memory_order_relaxed);
    return outdated ? std::nullopt : std::optional(unpacked(word));
  }

 private:
  static constexpr std::uint64_t packed(const LinkReport& report) noexcept {
    const std::uint64_t state = report.controller ? 1U + static_cast<std::uint64_t>(*report.controller) : 0U;
    return (report.present ? 1U : 0U) | (report.up ? 2U : 0U) | (report.counts_errors ? 4U : 0U) | state << 4U |
           std::uint64_t{report.transmit_errors} << 8U | std::uint64_t{report.receive_errors} << 24U;
  }
  static constexpr LinkReport unpacked(std::uint64_t word) noexcept {
    LinkReport report;
    report.present = (word & 1U) != 0;
    report.up = (word & 2U) != 0;
    report.counts_errors = (word & 4U) != 0;
    if (const std::uint64_t state = word >> 4U & 0xFU; state != 0) {
      report.controller = static_cast<BusState>(state - 1);
    }
    report.transmit_errors = static_cast<std::uint16_t>(word >> 8U);
    report.receive_errors = static_cast<std::uint16_t>(word >> 24U);
    return report;
  }

  std::atomic<int> offered_{-1};
  std::atomic<int> discarded_{-1};
  std::atomic<std::uint64_t> report_{0};
  std::atomic<std::uint8_t> changes_{0};
  std::uint8_t changes_at_look_ = 0;  // the watcher's
  std::uint16_t looks_ = 0;           // the watcher's
  std::uint64_t taken_report_ = 0;    // the loop's
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<int>::is_always_lock_free);
};

}  // namespace ivo::hal
