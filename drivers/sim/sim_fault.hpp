// What a simulated drive can do wrong, and when it is to.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "config/base/time.hpp"
#include "drivers/canopen/object_address.hpp"

namespace ivo::drivers {

enum class SimFault : std::uint8_t {
  // On the bus; from on to off.
  kSilent,          ///< sends nothing at all
  kNoHeartbeat,     ///< sends no heartbeat
  kNoTpdo,          ///< sends no TPDO
  kLateTpdo,        ///< each TPDO one SYNC later
  kDuplicateTpdo,   ///< each TPDO twice
  kReorderedTpdo,   ///< of two SYNCs the second TPDO before the first
  kStuckTpdo,       ///< TPDOs carry what the last one did
  kShortTpdo,       ///< TPDOs have `value` bytes
  kSyncProducer,    ///< sends SYNC too, every `value` microseconds; 0: every 1006h
  kForeignMaster,   ///< sends heartbeats with node-id `value` every 50 ms; 0: that of 1016h:1
  kForeignClient,   ///< every 50 ms somebody else asks for 1000h by SDO
  kDuplicateNode,   ///< a second device with the node-id: its boot-up, its heartbeats, its SDO answers
  kEmergencyStorm,  ///< an EMCY with code `value` every millisecond
  // On the bus; at once, when switched on.
  kReboot,            ///< power is gone for `value` milliseconds, then the boot-up message
  kLeaveOperational,  ///< to NMT state `value`; 0: Pre-operational
  kForeignNmt,        ///< an NMT command that no master sent: command in bits 8 to 15, node-id in bits 0 to 7
  // SDO; from on to off.
  kSlowSdo,        ///< each answer `value` milliseconds late
  kSdoSilent,      ///< no answer
  kSdoAbort,       ///< each access to `object` (0:0: to any) is aborted with code `value`
  kSdoToggle,      ///< segments with the wrong toggle bit
  kSdoWrongIndex,  ///< answers for the next index
  kSdoNoSize,      ///< 42h: expedited answers do not say their size
  kSdoSegmented,   ///< small objects in segments too
  kOtherIdentity,  ///< 1018h:1 is `value`
  // Drive; at once, when switched on.
  kFault,  ///< Fault with error code `value`; 0: 7300h
  // Drive; from on to off.
  kFaultAgain,    ///< as kFault, and again after each reset
  kStoOpen,       ///< Safe Torque Off: no voltage, no way out of Switch On Disabled
  kModeRefused,   ///< 6060h is taken and 6061h stays 0
  kNotEnabling,   ///< falls back to Switched On and stays there
  kEndlessStop,   ///< a quick stop does not slow down
  kSlip,          ///< the rim turns `value` per mille less than the motor
  kEncoderStuck,  ///< position and velocity actual stay as they are
  kBlocked,       ///< the wheel does not turn
  kCount,
};

/// Happens when the drive's time reaches `at`.
struct SimEvent {
  Instant at{};
  SimFault fault = SimFault::kSilent;
  bool on = true;
  std::uint32_t value = 0;
  ObjectAddress object{};  ///< of kSdoAbort
  bool done = false;       ///< set by the drive
};

/// Which faults are on.
class SimFaults {
 public:
  void apply(const SimEvent& event) noexcept { states_[static_cast<std::size_t>(event.fault)] = event; }
  [[nodiscard]] bool on(SimFault fault) const noexcept { return state(fault).on; }
  /// As it was switched on with; `fallback` for 0.
  [[nodiscard]] std::uint32_t value(SimFault fault, std::uint32_t fallback = 0) const noexcept {
    return state(fault).value != 0 ? state(fault).value : fallback;
  }
  [[nodiscard]] ObjectAddress object(SimFault fault) const noexcept { return state(fault).object; }

 private:
  [[nodiscard]] const SimEvent& state(SimFault fault) const noexcept {
    return states_[static_cast<std::size_t>(fault)];
  }
  static constexpr SimEvent kOff{.at = {}, .on = false, .object = {}};
  std::array<SimEvent, static_cast<std::size_t>(SimFault::kCount)> states_ = [] {
    std::array<SimEvent, static_cast<std::size_t>(SimFault::kCount)> states{};
    states.fill(kOff);
    return states;
  }();
};

}  // namespace ivo::drivers
