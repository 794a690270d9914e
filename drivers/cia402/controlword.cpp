#include "drivers/cia402/controlword.hpp"

#include "config/base/contract.hpp"

namespace ivo::drivers::cia402 {

std::uint16_t toward(PowerState now, PowerState goal) noexcept {
  IVO_CONTRACT(goal == PowerState::kReadyToSwitchOn || goal == PowerState::kSwitchedOn ||
               goal == PowerState::kOperationEnabled);
  switch (now) {
    case PowerState::kSwitchOnDisabled:
      return controlword::kShutdown;
    case PowerState::kReadyToSwitchOn:
      return goal == PowerState::kReadyToSwitchOn ? controlword::kShutdown : controlword::kSwitchOn;
    case PowerState::kSwitchedOn:
    case PowerState::kOperationEnabled:
      if (goal == PowerState::kReadyToSwitchOn) {
        return controlword::kShutdown;
      }
      return goal == PowerState::kSwitchedOn ? controlword::kSwitchOn : controlword::kEnableOperation;
    case PowerState::kNotReadyToSwitchOn:
    case PowerState::kQuickStopActive:
    case PowerState::kFaultReactionActive:
    case PowerState::kFault:
    case PowerState::kUnknown:
      break;
  }
  return controlword::kDisableVoltage;
}

}  // namespace ivo::drivers::cia402
