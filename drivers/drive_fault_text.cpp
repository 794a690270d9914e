#include "drivers/drive_fault_text.hpp"

#include <array>
#include <cstdio>
#include <string_view>

#include "drivers/canopen/sdo_abort.hpp"
#include "hal/api/can_bus.hpp"

namespace ivo::drivers {
namespace {

std::string hexadecimal(std::uint32_t code, int digits) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%0*Xh", digits, code);
  return text.data();
}

std::string_view name_of(Wheel wheel) noexcept {
  switch (wheel) {
    case Wheel::kFrontLeft:
      return "front left";
    case Wheel::kFrontRight:
      return "front right";
    case Wheel::kRearLeft:
      return "rear left";
    case Wheel::kRearRight:
      return "rear right";
  }
  return "unknown wheel";
}

std::string drive_of(std::uint8_t node_id, Wheel wheel) {
  return "drive " + std::to_string(node_id) + " (" + std::string(name_of(wheel)) + ")";
}

std::string reason_of(const DriveFault& fault) {
  switch (fault.reason) {
    case DriveFaultReason::kNone:
      return "no fault";
    case DriveFaultReason::kSdoAborted:
      return "SDO abort " + hexadecimal(fault.code, 8) + ", " + std::string(name_of(SdoAbort{fault.code}));
    case DriveFaultReason::kSdoTimedOut:
      return "no SDO answer";
    case DriveFaultReason::kNoAnswer:
      return "neither a boot-up message nor an SDO answer: is it powered, on this bus and set to this node-id?";
    case DriveFaultReason::kUnexpectedValue:
      return "unexpected value " + hexadecimal(fault.code, 8);
    case DriveFaultReason::kNotOperational:
      return "no heartbeat said Operational (NMT state " + hexadecimal(fault.code, 2) + ")";
    case DriveFaultReason::kRebooted:
      return "rebooted";
    case DriveFaultReason::kEmergency:
      return fault.code == 0 ? "emergency of a wrong length" : "emergency " + hexadecimal(fault.code, 4);
    case DriveFaultReason::kLeftOperational:
      return "left NMT state Operational (now " + hexadecimal(fault.code, 2) + ")";
    case DriveFaultReason::kHeartbeatLost:
      return "heartbeat lost";
    case DriveFaultReason::kFeedbackLost:
      return "feedback lost: TPDO1 does not arrive";
    case DriveFaultReason::kDriveInFault:
      return "in fault (statusword " + hexadecimal(fault.code, 4) + ")";
    case DriveFaultReason::kLeftOperationEnabled:
      return "left Operation Enabled unasked (statusword " + hexadecimal(fault.code, 4) + ")";
    case DriveFaultReason::kUnaskedState:
      return "in a power state that was not asked for (statusword " + hexadecimal(fault.code, 4) + ")";
    case DriveFaultReason::kStateChangeTimedOut:
      return "did not change its power state in time (statusword " + hexadecimal(fault.code, 4) + ")";
    case DriveFaultReason::kNotStill:
      return "wheel not at rest in time after a stop";
    case DriveFaultReason::kFaultResetFailed:
      return "fault could not be reset (statusword " + hexadecimal(fault.code, 4) + ")";
    case DriveFaultReason::kCommandsNotSent:
      return "commands do not get out: no other node acknowledges them, the transmit queue is full, or the interface "
             "is down";
    case DriveFaultReason::kFeedbackErratic:
      return "feedback comes missing or double too often (" + std::to_string(fault.code) + " of 100)";
    case DriveFaultReason::kDuplicateNodeId:
      return "two devices answer to this node-id; expected one each";
    case DriveFaultReason::kVoltageMissing:
      return "does not take power: is its STO or the emergency stop open? (statusword " + hexadecimal(fault.code, 4) +
             ")";
    case DriveFaultReason::kEncoderStuck:
      return "told to turn, but its position stays: encoder, coupling or a blocked wheel";
    case DriveFaultReason::kWheelNotFollowing:
      return "turns " + std::to_string(fault.code) +
             " mm/s otherwise than told: blocked, driven from outside, or a slipping belt";
    case DriveFaultReason::kResetLimit:
      return "faults come back: " + std::to_string(fault.code) + " resets did not help; start anew when it is mended";
    case DriveFaultReason::kBusLost:
      return "bus lost: " + std::string(name_of(static_cast<hal::BusState>(fault.code)));
    case DriveFaultReason::kFramesLost:
      return std::to_string(fault.code) + " frames were lost on the way in: the receive queue overflowed";
    case DriveFaultReason::kBusFlooded:
      return "bus flooded: " + std::to_string(fault.code) + " frames in one cycle";
    case DriveFaultReason::kForeignMaster:
      return "another master on the bus sent COB-ID " + hexadecimal(fault.code, 3) +
             "; expected none but this controller";
    case DriveFaultReason::kCycleLate:
      return "own cycle late by " + std::to_string(fault.code) + " periods";
    case DriveFaultReason::kWheelSlip:
      return "wheels slip: " + std::to_string(fault.code) + " mm/s that no motion of the base explains";
    case DriveFaultReason::kStopInput:
      if (fault.code == kStopInputsSilent) {
        return "emergency stop and bumpers are not read any more, which counts as pressed";
      }
      return fault.code == 0 ? "emergency stop pressed" : "bumper " + std::to_string(fault.code) + " touched";
    case DriveFaultReason::kFrameRefused:
      return "the last door before the bus refused what this controller was to send (" + std::to_string(fault.code) +
             " of its frames): a fault of the program";
  }
  return "unknown fault";
}

}  // namespace

std::string describe(const DriveFault& fault) {
  std::string text = reason_of(fault);
  if (fault.reason != DriveFaultReason::kNone && fault.node_id != 0) {
    const std::string step = *fault.step == '\0' ? "" : " failed at \"" + std::string(fault.step) + "\"";
    text = drive_of(fault.node_id, fault.wheel) + step + ": " + text;
  }
  if (fault.turning_node_id != 0) {
    text += "; " + drive_of(fault.turning_node_id, fault.turning_wheel) +
            " still turned when the quick stop had had its time";
  }
  return text;
}

}  // namespace ivo::drivers
