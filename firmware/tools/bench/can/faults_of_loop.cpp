// 9 and 22 to 25: what goes wrong on this computer.
#include <cstdlib>

#include "config/rates.hpp"
#include "firmware/tools/bench/can/fault_row.hpp"
#include "firmware/tools/bench/can/twist_trial.hpp"

namespace ivo::firmware::bench {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

bool no_drive_is_enabled(FaultRig& rig) {
  for (int i = 0; i < kWheels; ++i) {
    if (rig.drive(static_cast<Wheel>(i)).power_state() == drivers::cia402::PowerState::kOperationEnabled) {
      return false;
    }
  }
  return true;
}

FaultRow wrong_command(const char* name, const char* says, WrongCommand wrong) {
  return {.number = 25,
          .name = name,
          .by = "put at the doors by hand",
          .says = says,
          .detected_within = wrong == WrongCommand::kHugePastTheGate ? kAtOnce : Duration::zero(),
          .provoke = nullptr,
          .instead = [wrong] { return try_command(wrong); }};
}

// In a network namespace the clock is the host's, and not ours to set.
std::string why_no_clock_step() {
  return std::getenv("IVO_OWN_CLOCK") != nullptr
             ? std::string()
             : "the clock here is the host's; a guest has its own (toolchain/vcan --which: uml)";
}

}  // namespace

std::vector<FaultRow> faults_of_loop() {
  return {
      {.number = 9,
       .name = "one cycle comes a period late",
       .by = "1 period without a cycle",
       .outcome = Outcome::kGoesOn,
       .says = "no fault",
       .provoke = [](FaultRig& rig) { rig.be_late(1); }},
      {.number = 9,
       .name = "a cycle comes fifty periods late",
       .by = "50 periods without a cycle",
       .says = "own cycle late by 50 periods",
       .detected_within = 52 * rates::kCycle,
       .provoke = [](FaultRig& rig) { rig.be_late(50); }},
      {.number = 22,
       .name = "nobody commands any more: the loop hangs",
       .by = "no cycle at all from now on",
       .outcome = Outcome::kStopsBus,
       .says = "own cycle late by * periods",
       .detected_within = rates::kMasterHeartbeatTimeout + kAtOnce,
       .provoke = [](FaultRig& rig) { rig.hold_loop(true); },
       .also_at_1khz = true,
       .detected = no_drive_is_enabled},
      {.number = 23,
       .name = "the program is killed or stopped",
       .by = "SIGKILL, SIGSTOP",
       .says = "",
       .provoke = nullptr,
       .skip = "a process on a real clock: tests/rt does it on a real-time kernel"},
      {.number = 24,
       .name = "the host's clock steps an hour ahead and back",
       .by = "date -s",
       .outcome = Outcome::kGoesOn,
       .says = "no fault",
       .provoke =
           [](FaultRig& rig) {
             rig.tool({"date", "-s", "+1 hour"});
             rig.each_cycle([cycles = 0](FaultRig& each) mutable {
               if (cycles++ == 100) {
                 each.tool({"date", "-s", "-1 hour"});
               }
             });
           },
       .skip = why_no_clock_step()},
      wrong_command("a twist that is not a number", "command not finite", WrongCommand::kNotANumber),
      wrong_command("an infinite twist", "command not finite", WrongCommand::kInfinite),
      wrong_command("a twist of 1e9 m/s", "too fast", WrongCommand::kHuge),
      wrong_command("wheel speeds of 1e9 m/s past the first door",
                    "the last door before the bus refused what this controller was to send (4 of its frames): a fault "
                    "of the program",
                    WrongCommand::kHugePastTheGate),
  };
}

}  // namespace ivo::firmware::bench
