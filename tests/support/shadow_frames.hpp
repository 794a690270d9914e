// Frames as the shadow model reads them, apart from the product's own reading (CiA 301, CiA 402-2).
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "config/base/time.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::test {

/// What a drive has said and been told.
struct ShadowDrive {
  std::uint16_t statusword = 0;
  std::optional<Instant> feedback_at;
  std::optional<Instant> heartbeat_at;
  bool left_operational = false;  ///< as heard last in this cycle
  std::uint16_t word = 0;         ///< last sent
  double rim_mps = 0.0;           ///< last sent
  [[nodiscard]] bool enabled() const { return (statusword & 0x6F) == 0x27; }
  [[nodiscard]] bool faulty() const { return (statusword & 0x4F) == 0x08 || (statusword & 0x4F) == 0x0F; }
};

/// The frames of one send.
struct ShadowBatch {
  int syncs = 0;
  int commands = 0;
  int enabling = 0;
  int targets = 0;
  int requests = 0;  ///< SDO
  int orders = 0;    ///< NMT
  bool sync_first = true;
  bool heartbeat = false;
  bool heartbeat_last = true;
};

namespace shadow {

constexpr Duration ms(int count) { return std::chrono::milliseconds(count); }

constexpr int kFeedback = 0x180;  // these drives are mapped anew, to TPDO1: what has the id of another says nothing
/// Any of four: what turns a wheel may not come from anybody else by any of them.
constexpr bool is_rpdo(int function) { return function >= 0x200 && function <= 0x500 && function % 0x100 == 0; }

/// Statusword or controlword of a PDO.
constexpr std::uint16_t word_in(const hal::CanFrame& frame) {
  return static_cast<std::uint16_t>(frame.data[0] | frame.data[1] << 8);
}
constexpr std::int32_t target_in(const hal::CanFrame& frame) {
  return static_cast<std::int32_t>(
      static_cast<std::uint32_t>(frame.data[2]) | static_cast<std::uint32_t>(frame.data[3]) << 8 |
      static_cast<std::uint32_t>(frame.data[4]) << 16 | static_cast<std::uint32_t>(frame.data[5]) << 24);
}

}  // namespace shadow
}  // namespace ivo::test
