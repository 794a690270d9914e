// Nothing here allocates, in any call of a cycle. What this says beyond "it runs" it says in the preset noheap.
#include <gtest/gtest.h>

#include <array>

#include "config/rates.hpp"
#include "firmware/safety/command_gate.hpp"
#include "firmware/safety/guarded_bus.hpp"
#include "firmware/safety/mode.hpp"
#include "firmware/safety/stop_inputs.hpp"
#include "firmware/safety/wheel_monitor.hpp"
#include "hal/sim/digital_inputs.hpp"
#include "hal/sim/virtual_bus.hpp"
#include "tests/support/heap_trap.hpp"

namespace ivo::firmware {
namespace {

TEST(Safety, JudgesAllThatThereIsToJudgeWithoutAHeap) {
  Robot robot;
  robot.inputs.emergency_stop = InputLine{};
  hal::VirtualBus virtual_bus;
  hal::SimDigitalInputs inputs;
  int stops = 0;
  int faults = 0;
  std::uint64_t refused = 0;
  {
    const test::NoHeap no_heap;
    GuardedBus bus(virtual_bus.port(0), robot);
    CommandGate gate(robot.limits, rates::kFeedbackTimeout);
    ModeMachine modes;
    WheelMonitor monitor(robot);
    const StopInputs stop(robot.inputs);
    const Kinematics kinematics(robot.base);
    std::array<hal::ReceivedFrame, 16> received{};
    Instant now{};
    WheelValues angles{};
    for (int cycle = 0; cycle < 2000; ++cycle) {
      now += rates::kCycle;
      (void)bus.receive(received, now);
      const Twist command{cycle % 3 == 0 ? 9.0 : 0.4, 0.0, 0.1};
      const CommandGate::Verdict verdict = gate.judge(
          {.may_move = true, .drives_enabled = true, .feedback_age = Duration::zero(), .pose = {}, .command = command});
      refused += verdict.refusal == Refusal::kNone ? 0 : 1;
      (void)modes.update({.plan_ready = true, .drives_ready = true}, now);
      const WheelValues told = kinematics.wheel_speeds({0.4, 0.0, 0.1});
      for (std::size_t i = 1; i < angles.size(); ++i) {
        angles[i] += told[i] * seconds(rates::kCycle);
      }
      faults += monitor.update({.told_radps = told, .angle_rad = angles, .enabled = true}, now) ? 1 : 0;
      inputs.tap(static_cast<std::size_t>(cycle % 2));
      stops += stop.judge(inputs.snapshot(now)) ? 1 : 0;
      bus.permit_motion(cycle % 2 == 0);
      const std::array<hal::CanFrame, 2> frames{hal::CanFrame{.id = 0x080, .size = 0, .data = {}},
                                                hal::CanFrame{.id = 0x333, .size = 8, .data = {}}};
      (void)bus.send(frames, now);
    }
  }
  EXPECT_EQ(stops, 1000);
  EXPECT_GT(faults, 0) << "one wheel stands still";
  EXPECT_GT(refused, 0U);
}

}  // namespace
}  // namespace ivo::firmware
