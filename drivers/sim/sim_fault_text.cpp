#include "drivers/sim/sim_fault_text.hpp"

#include <algorithm>
#include <array>

namespace ivo::drivers {
namespace {

constexpr std::array<std::string_view, static_cast<std::size_t>(SimFault::kCount)> kNames = {"silent",
                                                                                             "no_heartbeat",
                                                                                             "no_tpdo",
                                                                                             "late_tpdo",
                                                                                             "duplicate_tpdo",
                                                                                             "reordered_tpdo",
                                                                                             "stuck_tpdo",
                                                                                             "short_tpdo",
                                                                                             "sync_producer",
                                                                                             "foreign_master",
                                                                                             "foreign_client",
                                                                                             "duplicate_node",
                                                                                             "emergency_storm",
                                                                                             "reboot",
                                                                                             "leave_operational",
                                                                                             "foreign_nmt",
                                                                                             "slow_sdo",
                                                                                             "sdo_silent",
                                                                                             "sdo_abort",
                                                                                             "sdo_toggle",
                                                                                             "sdo_wrong_index",
                                                                                             "sdo_no_size",
                                                                                             "sdo_segmented",
                                                                                             "other_identity",
                                                                                             "fault",
                                                                                             "fault_again",
                                                                                             "sto_open",
                                                                                             "mode_refused",
                                                                                             "not_enabling",
                                                                                             "endless_stop",
                                                                                             "slip",
                                                                                             "encoder_stuck",
                                                                                             "blocked"};
static_assert(kNames.back() == "blocked", "one name a fault");

}  // namespace

std::span<const std::string_view> sim_fault_names() noexcept { return kNames; }

std::string_view name_of(SimFault fault) noexcept { return kNames[static_cast<std::size_t>(fault)]; }

std::optional<SimFault> sim_fault_of(std::string_view name) noexcept {
  const auto* const at = std::find(kNames.begin(), kNames.end(), name);
  return at == kNames.end() ? std::nullopt : std::optional(static_cast<SimFault>(at - kNames.begin()));
}

}  // namespace ivo::drivers
