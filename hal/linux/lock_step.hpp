// Time in lock step with the drives: it moves when they have answered, whatever the host's clock does.
//
// For tests and simulation against drives that take their time from SYNC: thousands of cycles a second, no time-out
// ever judged by a busy host. It stands in front of the socket because only there is seen what was asked and what came
// back.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>

#include "config/base/static_vector.hpp"
#include "hal/api/can_bus.hpp"
#include "hal/api/clock.hpp"
#include "hal/linux/monotonic_clock.hpp"
#include "hal/linux/socketcan_bus.hpp"

namespace ivo::hal {

/// Both the bus and the clock of one loop. sleep_until(deadline) sets now to `deadline` once all that is due has
/// arrived:
/// - SYNC was sent since the last sleep: one frame of each of `answer_ids`, or of what answer_with() said since;
/// - otherwise: as many frames as expect_answers() said;
/// - nothing was ever sent, or nothing is expected: nothing.
/// Drives that fall silent therefore stop time. Only one limit looks at the host's clock: when `patience` has passed
/// without a frame that was due (a machine that stood still in between has not waited), stalled() is true and no later
/// sleep waits, so that the program can end and say so. A signal during a wait, or interrupt(), leaves kHurry of it, in
/// this wait and in later ones.
///
/// Frames of our own that come back are no answers. While the bus is lost nothing can be due: time goes on without
/// waiting, and each sleep looks whether the interface is back. Unconfirmed is not lost here: how long a frame is on
/// its way is the host's affair.
class LockStep final : public CanBus, public Clock {
 public:
  static constexpr std::size_t kAnswerIds = 8;
  static constexpr std::size_t kQueueFrames = 1024;
  static constexpr Duration kHurry = std::chrono::seconds(1);

  struct Options {
    std::uint16_t sync_id = 0x080;
    StaticVector<std::uint16_t, kAnswerIds> answer_ids;  ///< COB-IDs that answer a SYNC: the TPDOs of all drives
    Duration patience = std::chrono::seconds(30);
  };

  /// `bus` outlives this.
  LockStep(SocketCanBus& bus, const Options& options) noexcept;

  /// How many answers outside of SYNC are outstanding (boot-ups, SDO answers): to be said each cycle before
  /// sleep_until.
  void expect_answers(int count) noexcept { expected_ = count; }
  /// The COB-ID of answer number `index` from now on: a drive's feedback may turn out to be another of its TPDOs.
  void answer_with(std::size_t index, std::uint16_t id) noexcept { options_.answer_ids[index] = id; }
  [[nodiscard]] bool stalled() const noexcept { return stalled_; }
  /// A person wants an end. Any thread, and a signal handler.
  void interrupt() noexcept { hurry_.store(true, std::memory_order_relaxed); }

  /// Hands out what arrived during sleep_until, and nothing that arrives later.
  std::size_t receive(std::span<ReceivedFrame> frames, Instant now) noexcept override;
  std::size_t send(std::span<const CanFrame> frames, Instant now) noexcept override;
  [[nodiscard]] std::span<const CanFrame> handed_over() const noexcept override { return bus_.handed_over(); }
  [[nodiscard]] BusState state() const noexcept override { return bus_.state(); }
  [[nodiscard]] BusCounters counters() const noexcept override;

  [[nodiscard]] Instant now() noexcept override { return now_; }
  void sleep_until(Instant deadline) noexcept override;

 private:
  [[nodiscard]] bool complete() const noexcept;
  [[nodiscard]] bool bus_gone() const noexcept;
  void await_answers() noexcept;
  void await_departure() noexcept;
  bool collect() noexcept;
  bool take(const ReceivedFrame& received) noexcept;

  SocketCanBus& bus_;
  Options options_;
  MonotonicClock host_;
  Instant now_{};
  bool ever_sent_ = false;
  bool stalled_ = false;
  std::atomic<bool> hurry_{false};
  int expected_ = 0;
  int arrived_ = 0;
  std::uint32_t sync_answers_missing_ = 0;  // a bit for each of answer_ids; 0 when no SYNC is out
  bool sync_sent_ = false;
  std::array<ReceivedFrame, kQueueFrames> queue_{};
  std::size_t first_ = 0;
  std::size_t queued_ = 0;
  std::uint64_t overflowed_ = 0;
};

}  // namespace ivo::hal
