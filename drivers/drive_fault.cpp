#include "drivers/drive_fault.hpp"

namespace ivo::drivers {

bool needs_start_up(const DriveFault& fault) noexcept {
  switch (fault.reason) {
    case DriveFaultReason::kSdoAborted:
    case DriveFaultReason::kSdoTimedOut:
    case DriveFaultReason::kNoAnswer:
    case DriveFaultReason::kUnexpectedValue:
    case DriveFaultReason::kNotOperational:
    case DriveFaultReason::kRebooted:
    case DriveFaultReason::kLeftOperational:
    case DriveFaultReason::kHeartbeatLost:
    case DriveFaultReason::kFeedbackLost:
    case DriveFaultReason::kFeedbackErratic:
    case DriveFaultReason::kDuplicateNodeId:
    case DriveFaultReason::kCommandsNotSent:
    case DriveFaultReason::kFrameRefused:
    case DriveFaultReason::kBusLost:
    case DriveFaultReason::kFramesLost:
    case DriveFaultReason::kBusFlooded:
    case DriveFaultReason::kForeignMaster:
    case DriveFaultReason::kCycleLate:
      return true;
    case DriveFaultReason::kEmergency:
      return (fault.code & 0xFF00) == 0x8100;  // of communication (CiA 301, table 26): it may have left Operational
    case DriveFaultReason::kNone:
    case DriveFaultReason::kDriveInFault:
    case DriveFaultReason::kLeftOperationEnabled:
    case DriveFaultReason::kUnaskedState:
    case DriveFaultReason::kStateChangeTimedOut:
    case DriveFaultReason::kNotStill:
    case DriveFaultReason::kFaultResetFailed:
    case DriveFaultReason::kVoltageMissing:
    case DriveFaultReason::kEncoderStuck:
    case DriveFaultReason::kWheelNotFollowing:
    case DriveFaultReason::kResetLimit:
    case DriveFaultReason::kWheelSlip:
    case DriveFaultReason::kStopInput:
      break;
  }
  return false;
}

}  // namespace ivo::drivers
