// A door that lets a tool read and nothing else.
#pragma once

#include "config/base/static_vector.hpp"
#include "config/limits.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/sdo_frame.hpp"
#include "hal/api/can_bus.hpp"

namespace ivo::firmware {

/// What passes: SDO requests to read an object, to go on reading it in segments, and the abort that ends it. No NMT, no
/// SYNC, no PDO, no write. One thread.
class ReadingBus final : public hal::CanBus {
 public:
  /// `inner` outlives this.
  explicit ReadingBus(hal::CanBus& inner) noexcept : inner_(inner) {}

  std::size_t receive(std::span<hal::ReceivedFrame> frames, Instant now) noexcept override {
    return inner_.receive(frames, now);
  }
  std::size_t send(std::span<const hal::CanFrame> frames, Instant now) noexcept override {
    std::size_t taken = 0;
    passed_.clear();
    for (const hal::CanFrame& frame : frames) {
      if (!reads(frame)) {
        ++refused_;
        continue;
      }
      if (passed_.full()) {
        taken += inner_.send(passed_.span(), now);
        passed_.clear();
      }
      (void)passed_.push_back(frame);
    }
    return taken + inner_.send(passed_.span(), now);
  }
  [[nodiscard]] std::span<const hal::CanFrame> handed_over() const noexcept override { return inner_.handed_over(); }
  [[nodiscard]] hal::BusState state() const noexcept override { return inner_.state(); }
  [[nodiscard]] hal::BusCounters counters() const noexcept override { return inner_.counters(); }
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

  [[nodiscard]] static bool reads(const hal::CanFrame& frame) noexcept {
    constexpr std::uint8_t kSegment = 0x60;  // of an upload; 70h with the toggle bit set (CiA 301, 7.2.4.3.6)
    const bool to_a_node = frame.id > drivers::cob_id::sdo_request(0) && frame.id <= drivers::cob_id::sdo_request(127);
    const std::uint8_t command = frame.data[0];
    return to_a_node && frame.size == 8 &&
           (command == drivers::sdo_command::kUpload || (command & 0xEF) == kSegment ||
            command == drivers::sdo_command::kAbort);
  }

 private:
  hal::CanBus& inner_;
  StaticVector<hal::CanFrame, limits::kFramesPerCycle> passed_;  // of one send
  std::uint64_t refused_ = 0;
};

}  // namespace ivo::firmware
