// Emergency stop and bumpers on GPIO lines, watched by a thread of their own.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>

#include "config/base/result.hpp"
#include "config/robot.hpp"
#include "hal/api/clock.hpp"
#include "hal/api/digital_io.hpp"
#include "hal/linux/gpio_lines.hpp"

namespace ivo::hal {

/// The thread waits for edges, reads all lines after each and every rates::kInputsRead besides, and hands over what it
/// read with its time in one atomic word. An edge reaches the loop in its next cycle. Lines that cannot be read, or a
/// thread that gets no processor, show as age.
class GpioInputs final : public DigitalInputs {
 public:
  /// `clock` is the loop's and outlives this; its now() is called in both threads, so it must bear that, as
  /// MonotonicClock does. Errors as open_gpio_lines.
  [[nodiscard]] static Result<std::unique_ptr<GpioInputs>> open(const InputParameters& inputs, Clock& clock);

  GpioInputs(std::unique_ptr<GpioLines> lines, Clock& clock);
  GpioInputs(const GpioInputs&) = delete;
  GpioInputs& operator=(const GpioInputs&) = delete;
  /// Waits for the thread, which ends within rates::kInputsRead.
  ~GpioInputs() override;

  [[nodiscard]] DigitalSnapshot snapshot(Instant now) noexcept override;

  /// Rounds in which a line could not be read.
  [[nodiscard]] std::uint64_t unreadable() const noexcept { return unreadable_.load(std::memory_order_relaxed); }

 private:
  void watch() noexcept;

  std::unique_ptr<GpioLines> lines_;
  Clock& clock_;
  std::atomic<std::uint64_t> word_{0};  // microseconds of the reading plus 1, then a byte of inputs; 0: none yet
  std::atomic<std::uint8_t> edges_{0};  // pressed since the last snapshot
  std::atomic<std::uint64_t> unreadable_{0};
  std::atomic<bool> stop_{false};
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<std::uint8_t>::is_always_lock_free);
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace ivo::hal
