// Why the drives are stopped: which drive, what happened, at which step, with which number.
#pragma once

#include <cstdint>

#include "config/robot.hpp"

namespace ivo::drivers {

enum class DriveFaultReason : std::uint8_t {
  kNone,
  // At start-up; `step` names the step.
  kSdoAborted,       ///< code: abort code
  kSdoTimedOut,      ///< no answer to any attempt
  kNoAnswer,         ///< neither a boot-up message nor an SDO answer
  kUnexpectedValue,  ///< code: what was read
  kNotOperational,   ///< no heartbeat said Operational in time; code: the last NMT state heard, 0 for none
  // At any time.
  kRebooted,         ///< a boot-up message that nobody asked for
  kEmergency,        ///< code: error code of the EMCY, 0 for one of a wrong length
  kLeftOperational,  ///< code: NMT state
  kHeartbeatLost,
  kFeedbackLost,          ///< no TPDO1 for rates::kFeedbackTimeout
  kDriveInFault,          ///< code: statusword
  kLeftOperationEnabled,  ///< unasked; code: statusword
  kUnaskedState,          ///< another power state than asked for, while ready or enabling; code: statusword
  kStateChangeTimedOut,   ///< a CiA 402 transition; code: statusword
  kNotStill,              ///< wheels still moved rates::kStandstillTimeout after a stop
  kFaultResetFailed,      ///< code: statusword
  kFeedbackErratic,       ///< TPDO1 missing or double too often; code: how many of the last 100
  kDuplicateNodeId,       ///< two devices answer to one node-id
  kVoltageMissing,        ///< does not leave Switch On Disabled: STO or emergency stop open; code: statusword
  kEncoderStuck,          ///< the wheel was told to turn and its position stays
  kWheelNotFollowing,     ///< the wheel turns otherwise than told: blocked, driven, or its belt slips; code: mm/s
  kResetLimit,            ///< faults come back after each reset; code: resets that were tried
  // Of no drive.
  kCommandsNotSent,  ///< the bus did not take kUnsentWrites writes in a row whole
  kBusLost,          ///< code: hal::BusState
  kFramesLost,       ///< the receive queue overflowed; code: frames
  kBusFlooded,       ///< more frames than a healthy bus of this robot carries; code: frames in a cycle
  kForeignMaster,    ///< somebody else sends what only a master sends; code: COB-ID
  kCycleLate,        ///< our own cycle; code: periods skipped
  kWheelSlip,        ///< the wheels turn as no body can move; code: residual in mm/s
  kStopInput,        ///< emergency stop or bumper; code: number of the input, or kStopInputsSilent
  kFrameRefused,     ///< a bus that judges frames did not let some of ours pass; code: how many
};
/// Code of kStopInput: the inputs were not read for too long, which counts as pressed.
inline constexpr std::uint32_t kStopInputsSilent = 255;

/// Plain data, made in the loop. No fault: reason kNone. node_id 0: of the bus, not of one drive.
struct DriveFault {
  DriveFaultReason reason = DriveFaultReason::kNone;
  std::uint8_t node_id = 0;
  Wheel wheel = Wheel::kFrontLeft;
  const char* step = "";  ///< static; of start-up, else empty
  std::uint32_t code = 0;
  std::uint8_t turning_node_id = 0;  ///< a wheel that still turned when the quick stop had had its time; 0: none
  Wheel turning_wheel = Wheel::kFrontLeft;
};

/// True when only a new start-up of the drives can clear `fault`: what the drive was told may be forgotten.
[[nodiscard]] bool needs_start_up(const DriveFault& fault) noexcept;

}  // namespace ivo::drivers
