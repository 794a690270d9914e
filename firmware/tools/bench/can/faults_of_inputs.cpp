// 20: somebody, or something, presses an input that stops the robot.
#include "config/rates.hpp"
#include "firmware/tools/bench/can/fault_row.hpp"

namespace ivo::firmware::bench {
namespace {

constexpr std::size_t kEmergencyStop = 0;
constexpr std::size_t kBumper = 1;

}  // namespace

std::vector<FaultRow> faults_of_inputs() {
  return {
      {.number = 20,
       .name = "the emergency stop is pressed while driving",
       .by = "input 0 is pressed and stays so",
       .says = "emergency stop pressed",
       .detected_within = kAtOnce,
       .provoke = [](FaultRig& rig) { rig.inputs().press(kEmergencyStop); },
       .mend = [](FaultRig& rig) { rig.inputs().release(kEmergencyStop); },
       .also_at_1khz = true},
      {.number = 20,
       .name = "a bumper is touched for less than a cycle",
       .by = "input 1 is pressed and let go",
       .says = "bumper 1 touched",
       .detected_within = kAtOnce,
       .provoke = [](FaultRig& rig) { rig.inputs().tap(kBumper); }},
      {.number = 20,
       .name = "emergency stop and bumpers are not read any more",
       .by = "no new reading of the inputs",
       .says = "emergency stop and bumpers are not read any more, which counts as pressed",
       .detected_within = rates::kInputsAge + kAtOnce,
       .provoke = [](FaultRig& rig) { rig.inputs().fall_silent(rig.now()); },
       .mend = [](FaultRig& rig) { rig.inputs().resume(); }},
  };
}

}  // namespace ivo::firmware::bench
