#include "hal/linux/gpio_inputs.hpp"

#include <pthread.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "config/rates.hpp"

namespace ivo::hal {
namespace {

constexpr unsigned kInputBits = 8;

std::uint64_t packed(Instant when, std::uint8_t pressed) noexcept {
  const auto us = std::chrono::duration_cast<std::chrono::microseconds>(when.time_since_epoch()).count();
  return (static_cast<std::uint64_t>(us) + 1) << kInputBits | pressed;
}

Instant time_of(std::uint64_t word) noexcept { return Instant(std::chrono::microseconds((word >> kInputBits) - 1)); }

}  // namespace

Result<std::unique_ptr<GpioInputs>> GpioInputs::open(const InputParameters& inputs, Clock& clock) {
  Result<std::unique_ptr<GpioLines>> lines = open_gpio_lines(inputs);
  if (!lines) {
    return lines.error();
  }
  return std::make_unique<GpioInputs>(std::move(lines).value(), clock);
}

GpioInputs::GpioInputs(std::unique_ptr<GpioLines> lines, Clock& clock) : lines_(std::move(lines)), clock_(clock) {
  // Signals are the main thread's business: this one inherits a mask that leaves it none.
  sigset_t all{};
  sigset_t before{};
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { watch(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  pthread_setname_np(thread_.native_handle(), "ivo-inputs");
}

GpioInputs::~GpioInputs() {
  stop_.store(true, std::memory_order_relaxed);
  thread_.join();
}

void GpioInputs::watch() noexcept {
  std::uint8_t edges = 0;
  while (!stop_.load(std::memory_order_relaxed)) {
    edges_.fetch_or(edges, std::memory_order_acq_rel);
    const Instant before = clock_.now();
    if (const std::optional<std::uint8_t> pressed = lines_->read()) {
      word_.store(packed(before, *pressed), std::memory_order_release);
    } else {
      unreadable_.fetch_add(1, std::memory_order_relaxed);
    }
    edges = lines_->wait(rates::kInputsRead);
  }
}

DigitalSnapshot GpioInputs::snapshot(Instant now) noexcept {
  const std::uint8_t edges = edges_.exchange(0, std::memory_order_acq_rel);
  const std::uint64_t word = word_.load(std::memory_order_acquire);
  if (word == 0) {
    return {};
  }
  return {.pressed = static_cast<std::uint8_t>((word & 0xFF) | edges),
          .age = std::max(Duration::zero(), now - time_of(word)),
          .valid = true};
}

}  // namespace ivo::hal
