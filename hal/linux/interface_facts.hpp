// What the kernel knows of a network interface that is, or should be, a CAN interface: asked by rtnetlink, without
// privileges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "config/base/result.hpp"
#include "hal/api/can_bus.hpp"

namespace ivo::hal {

struct InterfaceFacts {
  enum class Kind : std::uint8_t { kCan, kVcan, kVxcan, kOther };

  std::string name;
  int index = 0;
  Kind kind = Kind::kOther;
  bool carries_can = false;
  bool up = false;
  std::uint32_t bit_rate_bps = 0;      ///< 0: it has none, as vcan
  std::uint32_t restart_ms = 0;        ///< of kCan: after bus-off; 0: it stays off
  std::uint32_t queue_frames = 0;      ///< txqueuelen: what waits there cannot be called back
  std::uint32_t mtu = 0;               ///< 16 for classical CAN, 72 for CAN FD
  std::optional<BusState> controller;  ///< of kCan, unless stopped or asleep
  bool counts_errors = false;          ///< the two counters are told
  std::uint16_t transmit_errors = 0;
  std::uint16_t receive_errors = 0;
};

/// What is in the interface's queue cannot be called back; so many frames of 8 bytes are 4 ms at 1 Mbit/s.
inline constexpr std::uint32_t kLongestQueueFrames = 32;

/// What an RTM_NEWLINK message says; none of another or a broken one. Bytes are as the kernel sends them.
[[nodiscard]] std::optional<InterfaceFacts> parse_link_message(std::span<const std::byte> message);

struct LinkAnswer {
  enum class Outcome : std::uint8_t { kFound, kMissing, kNotTold };
  Outcome outcome = Outcome::kNotTold;  ///< kNotTold: the kernel gave no answer that we understand
  InterfaceFacts facts;                 ///< of kFound
};
/// Asks the kernel; for start-up and watching, not for the loop.
[[nodiscard]] LinkAnswer ask_for_link(const std::string& name);

/// For a person: the same with the reason why there are none.
[[nodiscard]] Result<InterfaceFacts> interface_facts(const std::string& name);

/// The commands that set right what is not: one line to be typed, in full. `name`: of the interface.
[[nodiscard]] std::string command_for_bit_rate(const std::string& name, std::uint32_t bit_rate_bps);
[[nodiscard]] std::string command_for_queue(const std::string& name);
[[nodiscard]] std::string command_for_restart(const std::string& name);

/// Why an interface of a robot whose bus runs at `bit_rate_bps` cannot be used, with the command that sets it right;
/// nothing of one without a bit rate of its own.
[[nodiscard]] Result<void> check_bit_rate(const InterfaceFacts& facts, std::uint32_t bit_rate_bps);

/// What is better changed, in one line with the command that changes it; empty: nothing. Of real interfaces only.
[[nodiscard]] std::string advice(const InterfaceFacts& facts);

}  // namespace ivo::hal
