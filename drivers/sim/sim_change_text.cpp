#include "drivers/sim/sim_change_text.hpp"

#include <array>
#include <chrono>
#include <string_view>

namespace ivo::drivers {
namespace {

/// By PowerState.
constexpr std::array<std::string_view, 9> kPower = {"not_ready_to_switch_on",
                                                    "switch_on_disabled",
                                                    "ready_to_switch_on",
                                                    "switched_on",
                                                    "operation_enabled",
                                                    "quick_stop_active",
                                                    "fault_reaction_active",
                                                    "fault",
                                                    "unknown"};

std::string_view name_of(NmtState state) noexcept {
  switch (state) {
    case NmtState::kBootUp:
      return "off";
    case NmtState::kStopped:
      return "stopped";
    case NmtState::kOperational:
      return "operational";
    case NmtState::kPreOperational:
      return "pre_operational";
  }
  return "unknown";
}

std::string seconds_text(Instant at) {
  const auto us = std::chrono::duration_cast<std::chrono::microseconds>(at.time_since_epoch()).count();
  std::string fraction = std::to_string(us % 1'000'000);
  fraction.insert(0, 6 - fraction.size(), '0');
  return std::to_string(us / 1'000'000) + "." + fraction;
}

}  // namespace

std::string describe(std::uint8_t node_id, const SimChange& change) {
  std::string line = "t_s=" + seconds_text(change.at) + " node=" + std::to_string(node_id);
  line.append(" nmt=").append(name_of(change.nmt));
  line.append(" power=").append(kPower[static_cast<std::size_t>(change.power)]);
  line.append(" velocity=").append(std::to_string(change.velocity));
  return line.append(" wheel=").append(change.at_rest ? "rests" : "turns");
}

}  // namespace ivo::drivers
