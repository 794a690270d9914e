// Inputs that a test presses. By default nothing is pressed and each snapshot is new.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "hal/api/digital_io.hpp"

namespace ivo::hal {

class SimDigitalInputs final : public DigitalInputs {
 public:
  void press(std::size_t input) noexcept { set(input, true); }
  void release(std::size_t input) noexcept { set(input, false); }
  /// Pressed and released before anybody looks.
  void tap(std::size_t input) noexcept { tapped_ = static_cast<std::uint8_t>(tapped_ | 1U << input); }
  /// From `now` on nothing is read any more, until resume().
  void fall_silent(Instant now) noexcept {
    silent_ = true;
    last_read_ = now;
  }
  void resume() noexcept { silent_ = false; }

  [[nodiscard]] DigitalSnapshot snapshot(Instant now) noexcept override {
    const auto pressed = static_cast<std::uint8_t>(pressed_ | std::exchange(tapped_, std::uint8_t{0}));
    return {.pressed = pressed, .age = silent_ ? now - last_read_ : Duration::zero(), .valid = true};
  }

 private:
  void set(std::size_t input, bool pressed) noexcept {
    const unsigned bit = 1U << input;
    pressed_ = static_cast<std::uint8_t>(pressed ? pressed_ | bit : pressed_ & ~bit);
  }

  std::uint8_t pressed_ = 0;
  std::uint8_t tapped_ = 0;
  bool silent_ = false;
  Instant last_read_{};
};

}  // namespace ivo::hal
