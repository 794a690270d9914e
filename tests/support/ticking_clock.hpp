// A stopwatch on which everything takes equally long: each reading is later than the one before by the same time.
#pragma once

#include "hal/api/clock.hpp"

namespace ivo::test {

class TickingClock final : public hal::Clock {
 public:
  explicit TickingClock(Duration reading) noexcept : reading_(reading) {}
  [[nodiscard]] Instant now() noexcept override { return now_ += reading_; }
  void sleep_until(Instant deadline) noexcept override { now_ = deadline; }

 private:
  Duration reading_;
  Instant now_{};
};

}  // namespace ivo::test
