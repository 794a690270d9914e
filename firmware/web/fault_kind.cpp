#include "firmware/web/fault_kind.hpp"

namespace ivo::firmware::web {

std::string_view fault_kind(drivers::DriveFaultReason reason) noexcept {
  using enum drivers::DriveFaultReason;
  switch (reason) {
    case kNone:
      return "none";
    case kSdoAborted:
    case kSdoTimedOut:
    case kNoAnswer:
    case kUnexpectedValue:
    case kNotOperational:
    case kDuplicateNodeId:
      return "start_up";
    case kRebooted:
    case kEmergency:
    case kLeftOperational:
    case kDriveInFault:
    case kLeftOperationEnabled:
    case kUnaskedState:
    case kStateChangeTimedOut:
    case kFaultResetFailed:
    case kResetLimit:
      return "drive";
    case kHeartbeatLost:
    case kFeedbackLost:
    case kFeedbackErratic:
      return "silent";
    case kVoltageMissing:
      return "power";
    case kNotStill:
    case kEncoderStuck:
    case kWheelNotFollowing:
      return "wheel";
    case kWheelSlip:
      return "slip";
    case kCommandsNotSent:
    case kBusLost:
    case kFramesLost:
    case kBusFlooded:
    case kForeignMaster:
      return "wiring";
    case kCycleLate:
    case kFrameRefused:
      return "computer";
    case kStopInput:
      return "stop_input";
  }
  return "unknown";
}

}  // namespace ivo::firmware::web
