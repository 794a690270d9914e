// A bus that loses, doubles and garbles what arrives, and does not take all that is sent; and one beside the loop that
// tells a shadow model of everything and can plant a frame that must not be.
#pragma once

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

#include "config/limits.hpp"
#include "hal/api/can_bus.hpp"
#include "tests/support/beside_the_loop.hpp"
#include "tests/support/shadow_model.hpp"

namespace ivo::test {

class RoughBus final : public hal::CanBus {
 public:
  /// In thousandths of the frames that arrive.
  struct Roughness {
    unsigned lost = 0;
    unsigned doubled = 0;
    unsigned garbled = 0;
    std::size_t takes = limits::kFramesPerCycle;  ///< frames of one send
  };

  RoughBus(hal::CanBus& inner, std::mt19937_64& random) : inner_(inner), random_(random) {}

  Roughness roughness;

  std::size_t receive(std::span<hal::ReceivedFrame> frames, Instant now) noexcept override {
    const BesideTheLoop beside;
    std::vector<hal::ReceivedFrame> arrived(frames.size());
    arrived.resize(inner_.receive(arrived, now));
    std::size_t count = 0;
    for (hal::ReceivedFrame& received : arrived) {
      if (one_of_thousand(roughness.lost)) {
        continue;
      }
      if (one_of_thousand(roughness.garbled)) {
        garble(received.frame);
      }
      const int copies = one_of_thousand(roughness.doubled) ? 2 : 1;
      for (int i = 0; i < copies && count < frames.size(); ++i) {
        frames[count++] = received;
      }
    }
    return count;
  }
  std::size_t send(std::span<const hal::CanFrame> frames, Instant now) noexcept override {
    const std::size_t takes = std::min(frames.size(), roughness.takes);
    dropped_ += frames.size() - takes;
    return inner_.send(frames.first(takes), now);
  }
  [[nodiscard]] std::span<const hal::CanFrame> handed_over() const noexcept override { return inner_.handed_over(); }
  [[nodiscard]] hal::BusState state() const noexcept override { return inner_.state(); }
  [[nodiscard]] hal::BusCounters counters() const noexcept override {
    hal::BusCounters counters = inner_.counters();
    counters.send_dropped += dropped_;
    return counters;
  }

 private:
  bool one_of_thousand(unsigned share) { return share > 0 && random_() % 1000 < share; }
  void garble(hal::CanFrame& frame) {
    if (random_() % 4 == 0) {
      frame.size = static_cast<std::uint8_t>(random_() % 9);
    } else if (frame.size > 0) {
      frame.data[random_() % frame.size] = static_cast<std::uint8_t>(random_());
    }
  }

  hal::CanBus& inner_;
  std::mt19937_64& random_;
  std::uint64_t dropped_ = 0;
};

class ShadowedBus final : public hal::CanBus {
 public:
  /// Changes what is about to leave.
  using Plant = std::function<void(std::vector<hal::CanFrame>&)>;

  ShadowedBus(hal::CanBus& inner, ShadowModel& shadow) : inner_(inner), shadow_(shadow) {}

  Plant plant;

  std::size_t receive(std::span<hal::ReceivedFrame> frames, Instant now) noexcept override {
    const std::size_t count = inner_.receive(frames, now);
    const BesideTheLoop beside;
    for (const hal::ReceivedFrame& received : frames.first(count)) {
      shadow_.received(received.frame);
    }
    return count;
  }
  std::size_t send(std::span<const hal::CanFrame> frames, Instant now) noexcept override {
    const BesideTheLoop beside;
    std::vector<hal::CanFrame> leaving(frames.begin(), frames.end());
    if (plant) {
      plant(leaving);
    }
    const std::size_t taken = inner_.send(leaving, now);
    shadow_.sent(leaving, taken);
    return std::min(taken, frames.size());
  }
  [[nodiscard]] std::span<const hal::CanFrame> handed_over() const noexcept override { return inner_.handed_over(); }
  [[nodiscard]] hal::BusState state() const noexcept override { return inner_.state(); }
  [[nodiscard]] hal::BusCounters counters() const noexcept override { return inner_.counters(); }

 private:
  hal::CanBus& inner_;
  ShadowModel& shadow_;
};

}  // namespace ivo::test
