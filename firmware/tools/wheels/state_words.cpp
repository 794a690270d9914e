#include "firmware/tools/wheels/state_words.hpp"

#include <algorithm>
#include <array>

#include "drivers/canopen/emcy_text.hpp"
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
  return hexadecimal(code, 4) + ": " + std::string(drivers::emergency_class(code));
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
