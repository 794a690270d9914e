#include "hal/linux/monotonic_clock.hpp"

#include <time.h>

#include <cmath>

#include "config/base/contract.hpp"

namespace ivo::hal {
namespace {

constexpr Duration::rep kNanosecondsPerSecond = 1'000'000'000;

Duration monotonic() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return Duration(t.tv_sec * kNanosecondsPerSecond + t.tv_nsec);
}

}  // namespace

MonotonicClock::MonotonicClock(double speed) noexcept : speed_(speed), start_(monotonic()) {
  IVO_CONTRACT(speed > 0.0);
}

Instant MonotonicClock::now() noexcept {
  const auto real_ns = static_cast<double>((monotonic() - start_).count());
  return Instant(Duration(static_cast<Duration::rep>(real_ns * speed_)));
}

void MonotonicClock::sleep_until(Instant deadline) noexcept {
  const double real_ns = std::ceil(static_cast<double>(deadline.time_since_epoch().count()) / speed_);
  // Rounding may wake us a nanosecond early and a signal at any time: only now() says that the deadline has come.
  for (Duration wake = start_ + Duration(static_cast<Duration::rep>(real_ns)); now() < deadline; wake += Duration(1)) {
    const timespec t{.tv_sec = wake.count() / kNanosecondsPerSecond, .tv_nsec = wake.count() % kNanosecondsPerSecond};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr);
  }
}

}  // namespace ivo::hal
