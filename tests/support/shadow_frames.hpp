// Frames as the shadow model reads them, apart from the product's own reading (CiA 301, CiA 402-2).
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "config/base/time.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::test {

/// What a drive has said and been told.
struct ShadowDrive {
  int feedback = 1;            ///< number of the TPDO that is its feedback
  std::array<int, 5> heard{};  ///< of each TPDO by number: for how many cycles in a row it comes, this one not counted
  std::array<bool, 5> heard_now{};
  std::uint16_t statusword = 0;
  std::optional<Instant> feedback_at;
  std::optional<Instant> heartbeat_at;
  bool left_operational = false;  ///< as heard last in this cycle
  std::uint16_t word = 0;         ///< last sent
  std::int32_t target = 0;        ///< last sent
  double rim_mps = 0.0;           ///< last sent
  [[nodiscard]] bool told_to_run() const { return (word & 0x8F) == 0x0F; }
  /// Mapped anew the drives answer with TPDO1. One whose start-up was disturbed may be left with another, as it was:
  /// that comes cycle after cycle in TPDO1's place, which what a stranger sends with its COB-ID does not.
  void choose_feedback() {
    for (std::size_t number = 1; number < heard.size(); ++number) {
      heard[number] = std::exchange(heard_now[number], false) ? heard[number] + 1 : 0;
    }
    for (std::size_t number = 1; number < heard.size(); ++number) {
      if (heard[number] >= 5 && heard[static_cast<std::size_t>(feedback)] == 0) {
        feedback = static_cast<int>(number);
      }
    }
  }
  [[nodiscard]] bool enabled() const { return (statusword & 0x6F) == 0x27; }
  [[nodiscard]] bool faulty() const { return (statusword & 0x4F) == 0x08 || (statusword & 0x4F) == 0x0F; }
};

/// The frames of one send.
struct ShadowBatch {
  int syncs = 0;
  int commands = 0;  ///< drives whose target it carries
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

/// Number of the TPDO whose COB-IDs begin here; 0: none.
constexpr int tpdo_number(int function) {
  return function >= 0x180 && function <= 0x480 && function % 0x100 == 0x80 ? function / 0x100 : 0;
}
/// Any of four: what turns a wheel may not come from anybody else by any of them.
constexpr bool is_rpdo(int function) { return function >= 0x200 && function <= 0x500 && function % 0x100 == 0; }

/// Statusword or controlword of a PDO.
constexpr std::uint16_t word_in(const hal::CanFrame& frame) {
  return static_cast<std::uint16_t>(frame.data[0] | frame.data[1] << 8);
}
constexpr std::int32_t target_in(const hal::CanFrame& frame, std::size_t at) {
  return static_cast<std::int32_t>(
      static_cast<std::uint32_t>(frame.data[at]) | static_cast<std::uint32_t>(frame.data[at + 1]) << 8 |
      static_cast<std::uint32_t>(frame.data[at + 2]) << 16 | static_cast<std::uint32_t>(frame.data[at + 3]) << 24);
}

}  // namespace shadow
}  // namespace ivo::test
