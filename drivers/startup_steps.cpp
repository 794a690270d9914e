#include "drivers/startup_steps.hpp"

#include <chrono>

#include "config/rates.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/cia402/controlword.hpp"
#include "drivers/cia402/objects.hpp"
#include "drivers/startup_pdo_steps.hpp"
#include "drivers/startup_ramp_steps.hpp"

namespace ivo::drivers {
namespace {

constexpr std::uint32_t milliseconds(Duration d) noexcept {
  return static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::milliseconds>(d).count());
}

constexpr std::uint32_t microseconds(Duration d) noexcept {
  return static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::microseconds>(d).count());
}

void add_device_type(StartupSteps& steps) noexcept {
  add(steps, {.name = "device type 1000h",
              .action = StepAction::kVerify,
              .object = object::kDeviceType,
              .bytes = 4,
              .value = cia402::kProfileNumber,
              .mask = 0xFFFF});
}

void add_identity(StartupSteps& steps, const DriveParameters& drive) noexcept {
  if (drive.vendor_id != 0) {
    add(steps, {.name = "vendor-ID 1018h:1",
                .action = StepAction::kVerify,
                .object = object::kVendorId,
                .bytes = 4,
                .value = drive.vendor_id});
  }
  if (drive.product_code != 0) {
    add(steps, {.name = "product code 1018h:2",
                .action = StepAction::kVerify,
                .object = object::kProductCode,
                .bytes = 4,
                .value = drive.product_code});
  }
}

void add_stop(StartupSteps& steps) noexcept {
  add(steps, {.name = "target velocity 60FFh", .object = object::kTargetVelocity, .bytes = 4, .value = 0});
  add(steps, {.name = "controlword 6040h",
              .object = object::kControlword,
              .bytes = 2,
              .value = cia402::controlword::kDisableVoltage});
}

// For people to see. All but the vendor-ID are optional (CiA 301, 7.5.2.19), and some nodes leave that out as well.
void add_kept(StartupSteps& steps) noexcept {
  const auto keep = [&steps](const char* name, ObjectAddress object) {
    add(steps, {.name = name, .action = StepAction::kKeep, .object = object, .bytes = 4, .may_refuse = true});
  };
  keep("vendor-ID 1018h:1, to be shown", object::kVendorId);
  keep("product code 1018h:2, to be shown", object::kProductCode);
  keep("revision number 1018h:3, to be shown", object::kRevisionNumber);
  keep("serial number 1018h:4, to be shown", object::kSerialNumber);
}

void add_mode_choice(StartupSteps& steps) noexcept {
  add(steps, {.name = "supported drive modes 6502h",
              .action = StepAction::kChooseMode,
              .object = object::kSupportedModes,
              .bytes = 4});
}

// Two nodes that produce SYNC would make all drives act twice a cycle. A drive without 1005h listens to 080h, as it
// must by default; that it does is seen by its feedback.
void add_sync(StartupSteps& steps, Duration cycle) noexcept {
  add(steps, {.name = "COB-ID SYNC 1005h",
              .object = object::kSyncCobId,
              .bytes = 4,
              .value = cob_id::kSync,
              .may_refuse = true});
  add(steps, {.name = "COB-ID SYNC 1005h in force: 080h, and not produced by the drive",
              .action = StepAction::kVerify,
              .object = object::kSyncCobId,
              .bytes = 4,
              .value = cob_id::kSync,
              .mask = cob_id::kSyncCompared,
              .may_be_missing = true});
  add(steps, {.name = "communication cycle period 1006h",
              .object = object::kCyclePeriod,
              .bytes = 4,
              .value = microseconds(cycle),
              .may_be_missing = true});
}

// A drive whose clock has a coarse tick may round our time up, by less than two of our heartbeats.
void add_supervision(StartupSteps& steps, std::uint8_t master_node_id) noexcept {
  // A drive that stayed Operational when its master is lost would act on whatever RPDO and SYNC still come.
  add(steps, {.name = "error behaviour 1029h:1",
              .action = StepAction::kWrite,
              .object = object::kErrorBehaviour,
              .bytes = 1,
              .value = 0,
              .may_refuse = true});
  add(steps, {.name = "error behaviour 1029h:1 in force: 0 or 2, Pre-operational or Stopped",
              .action = StepAction::kVerifyOneOf,
              .object = object::kErrorBehaviour,
              .bytes = 1,
              .value = 1U << 0 | 1U << 2,
              .may_be_missing = true});
  const std::uint32_t master = std::uint32_t{master_node_id} << 16;
  add(steps, {.name = "consumer heartbeat time 1016h:1",
              .object = object::kConsumerHeartbeat,
              .bytes = 4,
              .value = master | milliseconds(rates::kMasterHeartbeatTimeout)});
  add(steps, {.name = "consumer heartbeat time 1016h:1 in force: our node-id and at most 240 ms",
              .action = StepAction::kVerifyRange,
              .object = object::kConsumerHeartbeat,
              .bytes = 4,
              .value = master | milliseconds(rates::kMasterHeartbeat),
              .highest = master | milliseconds(rates::kMasterHeartbeatTimeout + 9 * rates::kMasterHeartbeat / 5)});
  add(steps, {.name = "producer heartbeat time 1017h",
              .object = object::kProducerHeartbeat,
              .bytes = 2,
              .value = milliseconds(rates::kDriveHeartbeat)});
}

struct OptionCode {
  const char* name = "";
  const char* in_force = "";
  ObjectAddress object;
  std::uint32_t wished = 0;
  std::uint32_t accepted = 0;  // bit n for value n
  bool optional = false;       // without it the drive's own, unchangeable reaction is one of those accepted
};

void add_option(StartupSteps& steps, const OptionCode& option) noexcept {
  add(steps, {.name = option.name, .object = option.object, .bytes = 2, .value = option.wished, .may_refuse = true});
  add(steps, {.name = option.in_force,
              .action = StepAction::kVerifyOneOf,
              .object = option.object,
              .bytes = 2,
              .value = option.accepted,
              .may_be_missing = option.optional});
}

// What must be there: a quick stop that is a ramp, and a stop when the master is lost. Of the rest a drive may do what
// ends with its power off: shutdown and disable operation are said to wheels at rest only, halt never, and a fault may
// need the power off at once (605Eh 0), which leaves the other three drives and their ramps. What a manufacturer
// defined (negative values) may be anything and is refused.
void add_option_codes(StartupSteps& steps) noexcept {
  add_option(steps, {.name = "quick stop option code 605Ah",
                     .in_force = "quick stop option code 605Ah in force: 1, 2, 5 or 6, a ramp",
                     .object = object::kQuickStopOption,
                     .wished = cia402::kQuickStopRampThenOff,
                     .accepted = cia402::kQuickStopsWithRamp});
  add_option(steps, {.name = "shutdown option code 605Bh",
                     .in_force = "shutdown option code 605Bh in force: 0 or 1",
                     .object = object::kShutdownOption,
                     .wished = cia402::kRampThenOff,
                     .accepted = cia402::kShutdowns,
                     .optional = true});
  add_option(steps, {.name = "disable operation option code 605Ch",
                     .in_force = "disable operation option code 605Ch in force: 0 or 1",
                     .object = object::kDisableOperationOption,
                     .wished = cia402::kRampThenOff,
                     .accepted = cia402::kShutdowns,
                     .optional = true});
  add_option(steps, {.name = "halt option code 605Dh",
                     .in_force = "halt option code 605Dh in force: 1 to 4",
                     .object = object::kHaltOption,
                     .wished = cia402::kHaltRamp,
                     .accepted = cia402::kHalts,
                     .optional = true});
  add_option(steps, {.name = "fault reaction option code 605Eh",
                     .in_force = "fault reaction option code 605Eh in force: 0 to 4, power off at once or after a ramp",
                     .object = object::kFaultReactionOption,
                     .wished = cia402::kQuickStopRampOnFault,
                     .accepted = cia402::kFaultReactions,
                     .optional = true});
  add_option(steps, {.name = "abort connection option code 6007h",
                     .in_force = "abort connection option code 6007h in force: 1, 2 or 3, or the drive would go on "
                                 "moving without its master",
                     .object = object::kAbortConnectionOption,
                     .wished = cia402::kQuickStopOnLostMaster,
                     .accepted = cia402::kStopsOnLostMaster});
}

// A drive that does not take the period interpolates by its own: its wheel lags by that, and nothing worse.
void add_interpolation(StartupSteps& steps, Duration cycle) noexcept {
  constexpr std::uint32_t kMilliseconds = 0xFD;  // 10^-3 s
  add(steps, {.name = "interpolation time period 60C2h:1",
              .object = object::kInterpolationPeriod,
              .bytes = 1,
              .value = milliseconds(cycle),
              .may_refuse = true,
              .mode = StepMode::kCyclicSynchronousVelocity});
  add(steps, {.name = "interpolation time index 60C2h:2",
              .object = object::kInterpolationExponent,
              .bytes = 1,
              .value = kMilliseconds,
              .may_refuse = true,
              .mode = StepMode::kCyclicSynchronousVelocity});
}

// Some drives set their target when the mode changes: what is in force then is what the first enabling would follow.
void add_mode(StartupSteps& steps) noexcept {
  add(steps, {.name = "mode of operation 6060h",
              .action = StepAction::kWriteMode,
              .object = object::kModeOfOperation,
              .bytes = 1});
  add(steps, {.name = "mode of operation 6061h",
              .action = StepAction::kVerifyMode,
              .object = object::kModeDisplay,
              .bytes = 1});
  add(steps, {.name = "target velocity 60FFh, in the mode", .object = object::kTargetVelocity, .bytes = 4, .value = 0});
  add(steps, {.name = "target velocity 60FFh in force: 0",
              .action = StepAction::kVerify,
              .object = object::kTargetVelocity,
              .bytes = 4,
              .value = 0});
}

}  // namespace

StartupSteps startup_steps(const Robot& robot, Wheel wheel) noexcept {
  const DriveParameters& drive = robot.drives[static_cast<std::size_t>(wheel)];
  StartupSteps steps;
  add_device_type(steps);
  add_stop(steps);
  add_identity(steps, drive);
  add_kept(steps);
  add_mode_choice(steps);
  add_sync(steps, robot.cycle);
  add_supervision(steps, robot.master_node_id);
  add_option_codes(steps);
  add_ramp_steps(steps, robot, drive);
  add_interpolation(steps, robot.cycle);
  add_pdo_steps(steps, robot, wheel);
  add_mode(steps);
  return steps;
}

}  // namespace ivo::drivers
