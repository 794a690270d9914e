// 1 to 3, 14, 19 to 21 and 28: a drive falls silent, boots anew, faults, has no power or does not stop.
#include "config/rates.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "firmware/tools/bench/can/fault_row.hpp"

namespace ivo::firmware::bench {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

constexpr std::uint8_t kVictimNode = 3;
constexpr std::uint8_t kPreOperational = 0x80;  // NMT commands
constexpr std::uint8_t kStop = 0x02;

hal::CanFrame nmt(std::uint8_t command) { return {.id = 0x000, .size = 2, .data = {command, kVictimNode}}; }

void begin(FaultRig& rig, Wheel wheel, drivers::SimFault fault, std::uint32_t value = 0) {
  (void)rig.drive(wheel).script().events.push_back({.at = rig.now(), .fault = fault, .on = true, .value = value});
}
void end(FaultRig& rig, Wheel wheel, drivers::SimFault fault) {
  (void)rig.drive(wheel).script().events.push_back({.at = rig.now(), .fault = fault, .on = false});
}

void keep_failing(FaultRig& rig) {
  const drivers::cia402::PowerState state = rig.drive(kVictim).power_state();
  const bool failed = state == drivers::cia402::PowerState::kFault;
  if (!failed && state != drivers::cia402::PowerState::kFaultReactionActive) {
    victim(rig).fault_at = rig.now();
  } else if (failed && rig.at_rest()) {
    (void)rig.loop().command(OperatorCommand::kClearFault);
  }
}

}  // namespace

std::vector<FaultRow> faults_of_drives() {
  return {
      {.number = 1,
       .name = "a drive sends nothing any more",
       .by = "drive 3 sends nothing",
       .says = "drive 3 (rear left): feedback lost: TPDO1 does not arrive",
       .detected_within = rates::kFeedbackTimeout + kAtOnce,
       .provoke = [](FaultRig& rig) { victim(rig).silent_from = rig.now(); },
       .mend = [](FaultRig& rig) { victim(rig).silent_from = drivers::SimScript::kNever; },
       .also_at_1khz = true},
      {.number = 1,
       .name = "a drive's heartbeat alone is missing",
       .by = "drive 3 sends no 703h",
       .says = "drive 3 (rear left): heartbeat lost",
       .detected_within = rates::kDriveHeartbeatTimeout + kAtOnce,
       .provoke = [](FaultRig& rig) { victim(rig).heartbeat_lost_from = rig.now(); },
       .mend = [](FaultRig& rig) { victim(rig).heartbeat_lost_from = drivers::SimScript::kNever; }},
      {.number = 2,
       .name = "a drive reboots",
       .by = "power of drive 3 off and on",
       .says = "drive 3 (rear left): rebooted",
       .detected_within = kAtOnce,
       .provoke = [](FaultRig& rig) { victim(rig).reboot_at = rig.now(); },
       .also_at_1khz = true},
      {.number = 3,
       .name = "a drive goes back to Pre-operational",
       .by = "drive 3 alone hears NMT 80h",
       .says = "drive 3 (rear left): left NMT state Operational (now 7Fh)",
       .detected_within = kAtOnce,
       .provoke = [](FaultRig& rig) { rig.tell(kVictim, nmt(kPreOperational)); }},
      {.number = 3,
       .name = "a drive goes to Stopped",
       .by = "drive 3 alone hears NMT 02h",
       .says = "drive 3 (rear left): left NMT state Operational (now 04h)",
       .detected_within = kAtOnce,
       .provoke = [](FaultRig& rig) { rig.tell(kVictim, nmt(kStop)); }},
      {.number = 14,
       .name = "a hundred emergencies a cycle",
       .by = "100 of 083h a cycle by a third socket",
       .says = "drive 3 (rear left): emergency 2310h",
       .detected_within = kAtOnce,
       .provoke =
           [](FaultRig& rig) {
             rig.each_cycle([](FaultRig& each) {
               each.injector().send(drivers::cob_id::emcy(kVictimNode), {0x10, 0x23, 0x03, 0, 0, 0, 0, 0});
               each.injector().flood(99, drivers::cob_id::emcy(kVictimNode), {0x20, 0x32, 0x05, 0, 0, 0, 0, 0});
             });
           }},
      {.number = 19,
       .name = "a drive faults",
       .by = "fault of a sensor in drive 3",
       .says = "drive 3 (rear left): emergency 7300h",
       .detected_within = kAtOnce,
       .provoke = [](FaultRig& rig) { victim(rig).fault_at = rig.now(); }},
      {.number = 19,
       .name = "a fault that comes back after each reset",
       .by = "drive 3 faults after each reset",
       .says = "drive 3 (rear left): faults come back: * resets did not help; start anew when it is mended",
       .detected_within = 10s,
       .provoke = [](FaultRig& rig) { rig.each_cycle(keep_failing); },
       .recovers = false,
       .detected =
           [](FaultRig& rig) { return rig.status().drive_fault.reason == drivers::DriveFaultReason::kResetLimit; },
       .rest_within = 500ms},
      {.number = 20,
       .name = "STO opens while driving",
       .by = "STO of drive 3 opens",
       .says = "drive 3 (rear left): left Operation Enabled unasked (statusword *h)",
       .detected_within = kAtOnce,
       .provoke = [](FaultRig& rig) { begin(rig, kVictim, drivers::SimFault::kStoOpen); },
       .mend = [](FaultRig& rig) { end(rig, kVictim, drivers::SimFault::kStoOpen); }},
      {.number = 20,
       .name = "STO is open from the start",
       .by = "STO of drive 3 open at power-on",
       .outcome = Outcome::kNoStart,
       .says = "drive 3 (rear left): does not take power: is its STO or the emergency stop open? (statusword *h)",
       .provoke =
           [](FaultRig& rig) {
             begin(rig, kVictim, drivers::SimFault::kStoOpen);
             rig.each_cycle([cycles = 0](FaultRig& each) mutable {
               if (++cycles % 100 == 0) {
                 (void)each.loop().command(OperatorCommand::kConsent);
               }
             });
           },
       .mend = [](FaultRig& rig) { end(rig, kVictim, drivers::SimFault::kStoOpen); }},
      {.number = 21,
       .name = "a drive that does not slow down in a quick stop",
       .by = "drive 3 deaf to quick stop, drive 1 faults",
       .says =
           "drive 1 (front left): emergency 7300h; drive 3 (rear left) still turned when the quick stop had had its "
           "time",
       .detected_within = kAtOnce,
       .provoke =
           [](FaultRig& rig) {
             begin(rig, kVictim, drivers::SimFault::kEndlessStop);
             begin(rig, Wheel::kFrontLeft, drivers::SimFault::kFault);
           },
       .mend = [](FaultRig& rig) { end(rig, kVictim, drivers::SimFault::kEndlessStop); },
       .rest_within = rates::kStandstillTimeout + 500ms},
      {.number = 28,
       .name = "one wheel's power is taken away",
       .by = "drive 3 alone hears 6040h = 0",
       .says = "drive 3 (rear left): left Operation Enabled unasked (statusword 0250h)",
       .detected_within = kAtOnce,
       .provoke =
           [](FaultRig& rig) {
             rig.tell(kVictim, {.id = 0x603, .size = 8, .data = {0x2B, 0x40, 0x60, 0x00, 0, 0, 0, 0}});
           },
       .also_at_1khz = true},
  };
}

}  // namespace ivo::firmware::bench
