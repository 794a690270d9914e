#include "firmware/tools/wheels/state_words.hpp"

#include <algorithm>
#include <array>

#include "drivers/cia402/mode.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {
namespace {

using drivers::NmtState;
using drivers::cia402::PowerState;

struct WheelWords {
  std::string_view name;
  std::string_view key;
  std::string_view initials;
};
constexpr std::array<WheelWords, kWheels> kWheelWords{{{"front left", "front_left", "fl"},
                                                       {"front right", "front_right", "fr"},
                                                       {"rear left", "rear_left", "rl"},
                                                       {"rear right", "rear_right", "rr"}}};

// The first that fits counts: a whole code, a group, a class.
struct ErrorWords {
  std::uint16_t code;
  std::uint16_t mask;
  std::string_view words;
};
constexpr std::array kErrorWords{
    ErrorWords{0x0000, 0xFFFF, "errors gone"},
    ErrorWords{0x1000, 0xF000, "generic error"},
    ErrorWords{0x2310, 0xFFF0, "continuous over-current at the motor"},
    ErrorWords{0x2320, 0xFFF0, "short circuit or earth fault at the motor"},
    ErrorWords{0x2300, 0xFF00, "current at the motor"},
    ErrorWords{0x2000, 0xF000, "current"},
    ErrorWords{0x3100, 0xFF00, "mains voltage"},
    ErrorWords{0x3210, 0xFFF0, "DC link over-voltage: braking energy has nowhere to go, or the supply is too high"},
    ErrorWords{0x3220, 0xFFF0, "DC link under-voltage: supply, fuse or emergency stop"},
    ErrorWords{0x3200, 0xFF00, "DC link voltage"},
    ErrorWords{0x3000, 0xF000, "voltage"},
    ErrorWords{0x4310, 0xFFF0, "drive too hot"},
    ErrorWords{0x4000, 0xF000, "temperature"},
    ErrorWords{0x5440, 0xFFF0, "contactor"},
    ErrorWords{0x5530, 0xFFF0, "parameter memory"},
    ErrorWords{0x5000, 0xF000, "hardware of the drive"},
    ErrorWords{0x6320, 0xFFF0, "parameters"},
    ErrorWords{0x6000, 0xF000, "software of the drive"},
    ErrorWords{0x7110, 0xFFF0, "brake chopper"},
    ErrorWords{0x7121, 0xFFFF, "motor blocked"},
    ErrorWords{0x7120, 0xFFF0, "motor"},
    ErrorWords{0x7300, 0xFF00, "sensor: encoder or its cable"},
    ErrorWords{0x7500, 0xFF00, "communication inside the drive"},
    ErrorWords{0x7000, 0xF000, "additional module"},
    ErrorWords{0x8110, 0xFFFF, "CAN overrun: frames lost in the drive"},
    ErrorWords{0x8120, 0xFFFF, "CAN error passive"},
    ErrorWords{0x8130, 0xFFFF, "heartbeat lost: the controller's, or node guarding"},
    ErrorWords{0x8140, 0xFFFF, "recovered from bus-off"},
    ErrorWords{0x8150, 0xFFFF, "COB-ID collision: two nodes with one node-id?"},
    ErrorWords{0x8100, 0xFF00, "communication"},
    ErrorWords{0x8210, 0xFFFF, "PDO too short for its mapping"},
    ErrorWords{0x8220, 0xFFFF, "PDO too long for its mapping"},
    ErrorWords{0x8240, 0xFFFF, "SYNC of an unexpected length"},
    ErrorWords{0x8250, 0xFFFF, "RPDO time-out"},
    ErrorWords{0x8200, 0xFF00, "protocol"},
    ErrorWords{0x8300, 0xFF00, "torque control"},
    ErrorWords{0x8400, 0xFF00, "velocity control: wheel blocked, or speed out of reach"},
    ErrorWords{0x8611, 0xFFFF, "following error"},
    ErrorWords{0x8600, 0xFF00, "position control"},
    ErrorWords{0x8000, 0xF000, "monitoring"},
    ErrorWords{0x9000, 0xF000, "external error: a stop input, say"},
    ErrorWords{0xF000, 0xFF00, "additional function"},
    ErrorWords{0xFF00, 0xFF00, "the maker's own code, see the drive's manual"},
};

constexpr std::array<std::string_view, 10> kModes{"PP", "VL", "PV", "TQ", "", "HM", "IP", "CSP", "CSV", "CST"};

}  // namespace

std::string_view name_of(Wheel wheel) noexcept { return kWheelWords[static_cast<std::size_t>(wheel)].name; }
std::string_view key_of(Wheel wheel) noexcept { return kWheelWords[static_cast<std::size_t>(wheel)].key; }

std::optional<Wheel> wheel_called(std::string_view text) noexcept {
  for (std::size_t i = 0; i < kWheelWords.size(); ++i) {
    const WheelWords& words = kWheelWords[i];
    if (text == words.key || text == words.name || text == words.initials) {
      return static_cast<Wheel>(i);
    }
  }
  return std::nullopt;
}

std::optional<Wheel> wheel_of(const Robot& robot, std::uint8_t node_id) noexcept {
  const auto* const drive = std::ranges::find(robot.drives, node_id, &DriveParameters::node_id);
  if (drive == robot.drives.end()) {
    return std::nullopt;
  }
  return static_cast<Wheel>(drive - robot.drives.begin());
}

std::string name_of(NmtState state) {
  switch (state) {
    case NmtState::kBootUp:
      return "booted";
    case NmtState::kStopped:
      return "stopped";
    case NmtState::kOperational:
      return "operational";
    case NmtState::kPreOperational:
      return "pre-operational";
  }
  return "state " + hexadecimal(static_cast<std::uint8_t>(state), 2);
}

std::string_view name_of(PowerState state) noexcept {
  switch (state) {
    case PowerState::kNotReadyToSwitchOn:
      return "not ready to switch on";
    case PowerState::kSwitchOnDisabled:
      return "switch on disabled";
    case PowerState::kReadyToSwitchOn:
      return "ready to switch on";
    case PowerState::kSwitchedOn:
      return "switched on";
    case PowerState::kOperationEnabled:
      return "operation enabled";
    case PowerState::kQuickStopActive:
      return "quick stop active";
    case PowerState::kFaultReactionActive:
      return "fault reaction";
    case PowerState::kFault:
      return "fault";
    case PowerState::kUnknown:
      break;
  }
  return "unknown state";
}

std::string hexadecimal(std::uint32_t value, int digits) { return format("%0*Xh", digits, value); }

std::string error_code_text(std::uint16_t code) {
  const auto* const found =
      std::ranges::find_if(kErrorWords, [code](const ErrorWords& entry) { return (code & entry.mask) == entry.code; });
  const std::string number = hexadecimal(code, 4);
  return found == kErrorWords.end() ? number : number + ": " + std::string(found->words);
}

std::string modes_text(std::uint32_t supported_modes) {
  const auto chosen = drivers::cia402::velocity_mode(supported_modes);
  std::string text;
  for (std::size_t i = 0; i < kModes.size(); ++i) {
    if ((supported_modes >> i & 1) == 0 || kModes[i].empty()) {
      continue;
    }
    const bool ours = chosen.has_value() && static_cast<std::size_t>(*chosen) == i + 1;
    text += (text.empty() ? "" : " ") + std::string(kModes[i]) + (ours ? "*" : "");
  }
  return text.empty() ? "none" : text;
}

}  // namespace ivo::firmware
