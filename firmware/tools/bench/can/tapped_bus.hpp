// Buses with somebody in between: one that keeps what the loop sends, and one that changes what the drives say and
// hear.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "hal/api/can_bus.hpp"

namespace ivo::firmware::bench {

/// The loop's side. Arrivals are stamped with the loop's time, because time here is simulated and the kernel's is not.
class TappedBus final : public hal::CanBus {
 public:
  /// `inner` outlives this.
  explicit TappedBus(hal::CanBus& inner) noexcept : inner_(inner) {}

  std::size_t receive(std::span<hal::ReceivedFrame> frames, Instant now) noexcept override {
    const std::size_t count = inner_.receive(frames, now);
    for (hal::ReceivedFrame& received : frames.first(count)) {
      received.at = now;
    }
    received_ += count;
    return count;
  }
  std::size_t send(std::span<const hal::CanFrame> frames, Instant now) noexcept override {
    sent_.insert(sent_.end(), frames.begin(), frames.end());
    return inner_.send(frames, now);
  }
  [[nodiscard]] std::span<const hal::CanFrame> handed_over() const noexcept override { return inner_.handed_over(); }
  [[nodiscard]] hal::BusState state() const noexcept override { return inner_.state(); }
  [[nodiscard]] hal::BusCounters counters() const noexcept override { return inner_.counters(); }

  /// Handed over since clear().
  [[nodiscard]] const std::vector<hal::CanFrame>& sent() const noexcept { return sent_; }
  [[nodiscard]] std::size_t received() const noexcept { return received_; }
  void clear() noexcept {
    sent_.clear();
    received_ = 0;
  }

 private:
  hal::CanBus& inner_;
  std::vector<hal::CanFrame> sent_;
  std::size_t received_ = 0;
};

/// The drives' side.
class MeddledBus final : public hal::CanBus {
 public:
  /// Changes what is sent, or has been received, in one call.
  using Meddle = std::function<void(std::vector<hal::CanFrame>&)>;

  /// `inner` outlives this.
  explicit MeddledBus(hal::CanBus& inner) noexcept : inner_(inner) {}

  Meddle outgoing;  ///< none: nothing is changed
  Meddle incoming;  ///< ditto; must not make more than it is given

  std::size_t receive(std::span<hal::ReceivedFrame> frames, Instant now) noexcept override;
  std::size_t send(std::span<const hal::CanFrame> frames, Instant now) noexcept override;
  [[nodiscard]] std::span<const hal::CanFrame> handed_over() const noexcept override { return inner_.handed_over(); }
  [[nodiscard]] hal::BusState state() const noexcept override { return inner_.state(); }
  [[nodiscard]] hal::BusCounters counters() const noexcept override { return inner_.counters(); }

 private:
  hal::CanBus& inner_;
};

}  // namespace ivo::firmware::bench
