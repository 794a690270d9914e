#include "firmware/loop/control_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/drive_fault_text.hpp"
#include "hal/sim/digital_inputs.hpp"
#include "tests/support/search_rig.hpp"
#include "tests/support/ticking_clock.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;
using std::chrono_literals::operator""us;
using test::SearchRig;

bool has(const std::vector<Event>& events, EventKind kind) {
  return std::any_of(events.begin(), events.end(), [&](const Event& event) { return event.kind == kind; });
}

TEST(ControlLoop, PlansWhileTheDrivesStartUpAndThenAwaitsConsent) {
  SearchRig rig({});
  ASSERT_TRUE(rig.run_until(Mode::kAwaitingConsent));
  EXPECT_TRUE(rig.loop().status().plan_ready);
  EXPECT_EQ(rig.loop().status().drives, drivers::GroupState::kReady);
  EXPECT_EQ(rig.loop().plan().paths.size(), 2U);
}

TEST(ControlLoop, MovesNothingAsLongAsNobodyConsents) {
  SearchRig rig({});
  ASSERT_TRUE(rig.run_until(Mode::kAwaitingConsent));
  for (int i = 0; i < 5000; ++i) {
    EXPECT_EQ(rig.cycle().mode, Mode::kAwaitingConsent);
    ASSERT_FALSE(rig.wheels_turn());
    ASSERT_EQ(rig.drives().drive(Wheel::kFrontLeft).power_state(), drivers::cia402::PowerState::kSwitchOnDisabled);
  }
}

TEST(ControlLoop, ConsentBeforeThePlanIsShownCountsForNothing) {
  SearchRig rig({});
  rig.cycle();
  ASSERT_EQ(rig.loop().status().mode, Mode::kPlanning);
  rig.loop().command(OperatorCommand::kConsent);
  ASSERT_TRUE(rig.run_until(Mode::kAwaitingConsent));
  rig.run(2s);
  EXPECT_EQ(rig.loop().status().mode, Mode::kAwaitingConsent);
  EXPECT_FALSE(rig.wheels_turn());
}

TEST(ControlLoop, TheRobotDrivesItsPlanToTheEndAndPowersOff) {
  SearchRig rig({});
  ASSERT_TRUE(rig.start_search());
  ASSERT_TRUE(rig.run_until(Mode::kDone));
  const LoopStatus& status = rig.loop().status();
  EXPECT_EQ(status.search, SearchState::kPathsEnded);
  EXPECT_FALSE(status.finder.has_value());
  const planner::AgentPath& path = rig.loop().plan().paths[0];
  EXPECT_NEAR(status.robot.x_m, path.waypoints.back().x_m, 0.06);
  EXPECT_NEAR(status.robot.y_m, path.waypoints.back().y_m, 0.06);
  EXPECT_NEAR(status.tracks[0].moved_m, path.length_m, 0.05 * path.length_m);
  EXPECT_FALSE(rig.wheels_turn());
  EXPECT_EQ(status.counters.refused_frames, 0U);
  EXPECT_EQ(status.counters.refused_commands, 0U);
  rig.run(1s);
  EXPECT_TRUE(rig.loop().finished());
  EXPECT_NE(rig.drives().drive(Wheel::kRearRight).power_state(), drivers::cia402::PowerState::kOperationEnabled);
}

TEST(ControlLoop, TheRobotIsWhereItsWheelsHaveTakenIt) {
  SearchRig rig({});
  ASSERT_TRUE(rig.start_search());
  for (int i = 0; i < 10'000; ++i) {
    rig.cycle();
    ASSERT_NEAR(rig.true_position().x_m, rig.loop().status().robot.x_m, 0.01);
    ASSERT_NEAR(rig.true_position().y_m, rig.loop().status().robot.y_m, 0.01);
  }
  EXPECT_GT(rig.true_position().y_m + rig.true_position().x_m, 3.5) << "it has not moved";
}

TEST(ControlLoop, ARobotThatSeesTheObjectEndsTheSearch) {
  SearchRig rig({.object = Point{2.0, 4.6}});
  ASSERT_TRUE(rig.start_search());
  ASSERT_TRUE(rig.run_until(Mode::kDone));
  EXPECT_EQ(rig.loop().status().search, SearchState::kFound);
  EXPECT_EQ(rig.loop().status().finder, 0);
  EXPECT_TRUE(has(rig.events(), EventKind::kFound));
}

TEST(ControlLoop, AStopRampsDownWithinTheConfiguredDeceleration) {
  SearchRig rig({});
  ASSERT_TRUE(rig.start_search());
  rig.run(5s);
  ASSERT_TRUE(rig.wheels_turn());
  while (rig.speed_mps() < 0.45) {
    rig.cycle();
  }
  rig.loop().request_stop();
  ASSERT_TRUE(rig.run_until(Mode::kStopping, 4ms));
  // From 0.5 m/s at 1 m/s^2, and the drives' own ramp: neither abrupt nor slow.
  rig.run(400ms);
  EXPECT_TRUE(rig.wheels_turn());
  rig.run(300ms);
  EXPECT_FALSE(rig.wheels_turn());
  ASSERT_TRUE(rig.run_until(Mode::kDone, 1s));
  EXPECT_EQ(rig.loop().status().stop_cause, StopCause::kAsked);
}

TEST(ControlLoop, NobodyStartsASearchThatWasStopped) {
  SearchRig rig({});
  ASSERT_TRUE(rig.start_search());
  rig.run(1s);
  rig.loop().request_stop();
  ASSERT_TRUE(rig.run_until(Mode::kDone, 5s));
  rig.loop().command(OperatorCommand::kConsent);
  rig.run(2s);
  EXPECT_EQ(rig.loop().status().mode, Mode::kDone);
  EXPECT_FALSE(rig.wheels_turn());
}

class LosingADrive : public testing::TestWithParam<int> {};

TEST_P(LosingADrive, StopsAllFourAndSaysWhich) {
  SearchRig rig({});
  ASSERT_TRUE(rig.start_search());
  rig.run(4s);
  ASSERT_TRUE(rig.wheels_turn());
  drivers::SimScript& script = rig.drives().drive(Wheel::kRearLeft).script();
  switch (GetParam()) {
    case 0:
      script.silent_from = rig.now();
      break;
    case 1:
      script.feedback_lost_from = rig.now();
      break;
    case 2:
      script.heartbeat_lost_from = rig.now();
      break;
    case 3:
      script.reboot_at = rig.now();
      break;
    default:
      script.fault_at = rig.now();
      break;
  }
  ASSERT_TRUE(rig.run_until(Mode::kFault, rates::kDriveHeartbeatTimeout + 60ms));
  EXPECT_EQ(rig.loop().status().drive_fault.node_id, 3);
  EXPECT_EQ(rig.loop().status().drive_fault.wheel, Wheel::kRearLeft);
  EXPECT_TRUE(has(rig.events(), EventKind::kDriveFault));
  rig.run(1s);
  for (const Wheel wheel : {Wheel::kFrontLeft, Wheel::kFrontRight, Wheel::kRearRight}) {
    EXPECT_EQ(rig.drives().drive(wheel).motion().velocity(), 0) << static_cast<int>(wheel);
  }
  rig.loop().command(OperatorCommand::kConsent);
  rig.run(4s);
  EXPECT_EQ(rig.loop().status().mode, Mode::kFault);
  EXPECT_TRUE(rig.loop().finished());
}
INSTANTIATE_TEST_SUITE_P(SilentNoFeedbackNoHeartbeatRebootFault, LosingADrive, testing::Range(0, 5));

TEST(ControlLoop, ADriveThatFailsToStartUpEndsTheRunBeforeAnythingMoves) {
  SearchRig::Options options;
  options.scripts[1].device_type = 0x0003'0191;
  SearchRig rig(options);
  ASSERT_TRUE(rig.run_until(Mode::kFault, 10s));
  EXPECT_EQ(rig.loop().status().drive_fault.reason, drivers::DriveFaultReason::kUnexpectedValue);
  EXPECT_EQ(rig.loop().status().drive_fault.node_id, 2);
  rig.run(100ms);
  EXPECT_TRUE(rig.loop().finished());
  EXPECT_FALSE(rig.wheels_turn());
}

TEST(ControlLoop, AFaultEndsTheRunOnlyWhenTheOtherDrivesAreOff) {
  SearchRig rig({});
  ASSERT_TRUE(rig.start_search());
  rig.run(4s);
  rig.drives().drive(Wheel::kRearLeft).script().fault_at = rig.now();
  for (int i = 0; i < 5'000 && !rig.loop().finished(); ++i) {
    rig.cycle();
  }
  ASSERT_TRUE(rig.loop().finished());
  EXPECT_TRUE(rig.loop().status().power_off);
  for (const Wheel wheel : {Wheel::kFrontLeft, Wheel::kFrontRight, Wheel::kRearRight}) {
    EXPECT_EQ(rig.drives().drive(wheel).power_state(), drivers::cia402::PowerState::kSwitchOnDisabled);
    EXPECT_EQ(rig.drives().drive(wheel).motion().velocity(), 0);
  }
}

TEST(ControlLoop, ABusThatIsOffStopsTheSearch) {
  SearchRig rig({});
  ASSERT_TRUE(rig.start_search());
  rig.run(3s);
  rig.bus().set_state(0, hal::BusState::kOff);
  ASSERT_TRUE(rig.run_until(Mode::kFault, 4ms));
  // The drives no longer hear our heartbeat and stop by themselves.
  rig.run(rates::kMasterHeartbeatTimeout + 1s);
  EXPECT_FALSE(rig.wheels_turn());
}

TEST(ControlLoop, TheSameRunHasTheSameEventsBitForBit) {
  std::vector<Event> runs[2];
  for (std::vector<Event>& run : runs) {
    SearchRig rig({});
    ASSERT_TRUE(rig.start_search());
    ASSERT_TRUE(rig.run_until(Mode::kDone));
    run = rig.events();
  }
  ASSERT_EQ(runs[0].size(), runs[1].size());
  for (std::size_t i = 0; i < runs[0].size(); ++i) {
    EXPECT_EQ(runs[0][i].at, runs[1][i].at);
    EXPECT_EQ(runs[0][i].kind, runs[1][i].kind);
    EXPECT_EQ(runs[0][i].x, runs[1][i].x);
    EXPECT_EQ(runs[0][i].y, runs[1][i].y);
  }
}

class ClearingAFault : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(rig_.start_search());
    rig_.run(4s);
    ASSERT_TRUE(rig_.wheels_turn());
  }
  void expect_stopped_in_fault() {
    ASSERT_TRUE(rig_.run_until(Mode::kFault, 200ms));
    rig_.run(2s);
    EXPECT_FALSE(rig_.wheels_turn());
    EXPECT_FALSE(rig_.loop().finished()) << "somebody may clear it";
  }
  void clear() { rig_.loop().command(OperatorCommand::kClearFault); }
  SearchRig rig_{{.object = {}, .fault_waits = true}};
};

TEST_F(ClearingAFault, TheRobotGoesOnAfterClearingAndConsentAndNotBefore) {
  rig_.drives().drive(Wheel::kRearLeft).script().reboot_at = rig_.now();
  expect_stopped_in_fault();
  const Point stood = rig_.true_position();
  rig_.loop().command(OperatorCommand::kConsent);
  rig_.run(2s);
  EXPECT_EQ(rig_.loop().status().mode, Mode::kFault) << "consent clears nothing";
  clear();
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 20s));
  EXPECT_TRUE(has(rig_.events(), EventKind::kFaultCleared));
  rig_.run(5s);
  EXPECT_EQ(rig_.loop().status().mode, Mode::kAwaitingConsent);
  EXPECT_EQ(rig_.true_position().x_m, stood.x_m);
  rig_.loop().command(OperatorCommand::kConsent);
  ASSERT_TRUE(rig_.run_until(Mode::kSearching, 1s));
  rig_.run(3s);
  EXPECT_TRUE(rig_.wheels_turn());
  ASSERT_TRUE(rig_.run_until(Mode::kDone));
  const planner::AgentPath& path = rig_.loop().plan().paths[0];
  EXPECT_NEAR(rig_.true_position().x_m, path.waypoints.back().x_m, 0.1);
  EXPECT_NEAR(rig_.true_position().y_m, path.waypoints.back().y_m, 0.1);
}

TEST_F(ClearingAFault, ABusThatComesBackIsUsedAgain) {
  rig_.bus().set_state(0, hal::BusState::kDown);
  expect_stopped_in_fault();
  rig_.run(2s);  // nobody can say that the wheels rest: the quick stop is given all its time
  clear();
  rig_.run(1s);
  EXPECT_EQ(rig_.loop().status().mode, Mode::kFault) << "it is still down";
  rig_.bus().set_state(0, hal::BusState::kActive);
  rig_.run(1s);
  EXPECT_EQ(rig_.loop().status().mode, Mode::kFault) << "nobody has asked since";
  clear();
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 20s));
  rig_.loop().command(OperatorCommand::kConsent);
  ASSERT_TRUE(rig_.run_until(Mode::kSearching, 1s));
}

TEST_F(ClearingAFault, AStopEndsTheRunInstead) {
  rig_.drives().drive(Wheel::kRearLeft).script().fault_at = rig_.now();
  expect_stopped_in_fault();
  rig_.loop().request_stop();
  rig_.run(10ms);
  EXPECT_TRUE(rig_.loop().finished());
  clear();
  rig_.run(1s);
  EXPECT_EQ(rig_.loop().status().mode, Mode::kFault);
}

TEST_F(ClearingAFault, AskedForBeforeThereIsOneCountsForNothing) {
  clear();
  rig_.run(1s);
  rig_.drives().drive(Wheel::kRearLeft).script().fault_at = rig_.now();
  expect_stopped_in_fault();
  rig_.run(2s);
  EXPECT_EQ(rig_.loop().status().mode, Mode::kFault);
}

TEST_F(ClearingAFault, ASearchThatSomebodyElseEndedMeanwhileIsOver) {
  SearchRig rig({.object = Point{10.5, 6.0}, .fault_waits = true});
  ASSERT_TRUE(rig.start_search());
  rig.run(1s);
  rig.drives().drive(Wheel::kRearLeft).script().fault_at = rig.now();
  ASSERT_TRUE(rig.run_until(Mode::kFault, 200ms));
  for (int i = 0; i < 100'000 && rig.loop().status().search == SearchState::kRunning; ++i) {
    rig.cycle();
  }
  ASSERT_EQ(rig.loop().status().finder, 1);
  rig.loop().command(OperatorCommand::kClearFault);
  EXPECT_TRUE(rig.run_until(Mode::kDone, 20s));
}

class StopInputsOfTheLoop : public testing::Test {
 protected:
  hal::SimDigitalInputs inputs_;
  SearchRig rig_{{.object = {}, .fault_waits = true, .inputs = &inputs_}};
};

TEST_F(StopInputsOfTheLoop, AnEmergencyStopInMotionStopsAllFourInTheSameCycle) {
  ASSERT_TRUE(rig_.start_search());
  rig_.run(4s);
  ASSERT_TRUE(rig_.wheels_turn());
  inputs_.press(0);
  EXPECT_EQ(rig_.cycle().mode, Mode::kFault);
  EXPECT_EQ(drivers::describe(rig_.loop().status().drive_fault), "emergency stop pressed");
  rig_.run(500ms);
  EXPECT_FALSE(rig_.wheels_turn());
  rig_.loop().command(OperatorCommand::kClearFault);
  rig_.run(5s);
  EXPECT_EQ(rig_.loop().status().mode, Mode::kFault) << "it is still pressed";
  inputs_.release(0);
  rig_.run(5s);
  EXPECT_EQ(rig_.loop().status().mode, Mode::kFault) << "released is not cleared";
  rig_.loop().command(OperatorCommand::kClearFault);
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 5s));
  rig_.loop().command(OperatorCommand::kConsent);
  ASSERT_TRUE(rig_.run_until(Mode::kSearching, 1s));
}

TEST_F(StopInputsOfTheLoop, ATapOfABumperIsEnough) {
  ASSERT_TRUE(rig_.start_search());
  rig_.run(4s);
  inputs_.tap(1);
  EXPECT_EQ(rig_.cycle().mode, Mode::kFault);
  EXPECT_EQ(drivers::describe(rig_.loop().status().drive_fault), "bumper 1 touched");
}

TEST_F(StopInputsOfTheLoop, InputsThatNobodyReadsAnyMoreStopTheRobot) {
  ASSERT_TRUE(rig_.start_search());
  rig_.run(4s);
  inputs_.fall_silent(rig_.now());
  EXPECT_TRUE(rig_.run_until(Mode::kFault, rates::kInputsAge + 4ms));
}

TEST_F(StopInputsOfTheLoop, PressedAtTheStartItOnlyKeepsTheRobotFromGettingReady) {
  inputs_.press(0);
  EXPECT_FALSE(rig_.run_until(Mode::kAwaitingConsent, 20s));
  EXPECT_EQ(rig_.loop().status().mode, Mode::kStarting);
  EXPECT_EQ(drivers::describe(rig_.loop().status().stop_held), "emergency stop pressed");
  inputs_.release(0);
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 1s));
  inputs_.press(0);
  rig_.cycle();
  rig_.loop().command(OperatorCommand::kConsent);
  rig_.run(1s);
  EXPECT_EQ(rig_.loop().status().mode, Mode::kStarting);
}

TEST(ControlLoop, AnEncoderThatStaysStopsTheRobotAndIsNamed) {
  SearchRig rig({});
  ASSERT_TRUE(rig.start_search());
  rig.run(4s);
  (void)rig.drives()
      .drive(Wheel::kRearLeft)
      .script()
      .events.push_back({.at = rig.now(), .fault = drivers::SimFault::kEncoderStuck, .on = true});
  ASSERT_TRUE(rig.run_until(Mode::kFault, 500ms));
  EXPECT_EQ(drivers::describe(rig.loop().status().drive_fault),
            "drive 3 (rear left): told to turn, but its position stays: encoder, coupling or a blocked wheel");
}

TEST(ControlLoop, AVeryLateCycleStopsTheRobotAndAFewLostPeriodsDoNot) {
  SearchRig rig({});
  ASSERT_TRUE(rig.start_search());
  rig.run(4s);
  rig.late_cycle(LoopParameters{}.latch_at - 1);
  EXPECT_EQ(rig.loop().status().mode, Mode::kSearching);
  rig.late_cycle(LoopParameters{}.latch_at);
  EXPECT_EQ(rig.loop().status().mode, Mode::kFault);
  EXPECT_EQ(rig.loop().status().drive_fault.reason, drivers::DriveFaultReason::kCycleLate);
  rig.run(1s);
  EXPECT_FALSE(rig.wheels_turn());
}

TEST(ControlLoop, ACycleThatOversleptStopsTheRobotItself) {
  SearchRig rig({});
  ASSERT_TRUE(rig.start_search());
  rig.run(4s);
  rig.sleep(20ms);  // nobody was told yet that periods are lost
  EXPECT_EQ(rig.cycle().mode, Mode::kFault);
  EXPECT_EQ(rig.loop().status().drive_fault.reason, drivers::DriveFaultReason::kCycleLate);
}

TEST(ControlLoop, LatenessThatDoesNotEndStopsTheRobotToo) {
  SearchRig rig({});
  ASSERT_TRUE(rig.start_search());
  rig.run(4s);
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(rig.late_cycle(1).mode, Mode::kSearching);
    rig.run(40ms);
  }
  rig.late_cycle(3);
  EXPECT_EQ(rig.loop().status().mode, Mode::kSearching);
  rig.late_cycle(3);
  EXPECT_EQ(rig.loop().status().mode, Mode::kFault);
}

TEST(ControlLoop, SomeLostPeriodsRampTheRobotDownAndItGoesOnWhenTheyAreForgotten) {
  SearchRig rig({});
  ASSERT_TRUE(rig.start_search());
  rig.run(4s);
  ASSERT_GT(rig.speed_mps(), 0.3);
  for (int i = 0; i < 30; ++i) {  // a period is lost every 16 cycles: never forgotten, never enough to latch
    rig.late_cycle(i == 0 ? LoopParameters{}.ramp_down_at : i % 16 == 0 ? 1 : 0);
  }
  EXPECT_EQ(rig.loop().status().lateness, Lateness::kRampDown);
  EXPECT_EQ(rig.loop().status().mode, Mode::kSearching);
  double slowest_mps = rig.speed_mps();
  for (int i = 0; i < 100; ++i) {
    rig.cycle();
    slowest_mps = std::min(slowest_mps, rig.speed_mps());
  }
  EXPECT_LT(slowest_mps, 0.35);
  EXPECT_EQ(rig.loop().status().lateness, Lateness::kInTime);
  ASSERT_TRUE(rig.run_until(Mode::kDone));
  EXPECT_EQ(rig.loop().status().search, SearchState::kPathsEnded);
}

// The loop's clock tells of an oversleep in the cycle that wakes, the scheduler in the next one: of the same periods.
TEST(ControlLoop, APeriodThatIsLostCountsOnce) {
  struct Oversleep {
    Duration late;
    Lateness expected;
  };
  for (const auto& [late, expected] : {Oversleep{900us, Lateness::kInTime}, Oversleep{1800us, Lateness::kHeld},
                                       Oversleep{4ms, Lateness::kHeld}, Oversleep{6ms, Lateness::kRampDown},
                                       Oversleep{8ms, Lateness::kRampDown}, Oversleep{10ms, Lateness::kLatched}}) {
    SearchRig rig({});
    ASSERT_TRUE(rig.start_search());
    rig.run(4s);
    Scheduler scheduler(rig.now(), rates::kCycle);
    Lateness worst = Lateness::kInTime;
    Instant wakes = rig.now() + late;
    std::int64_t skipped = 0;
    for (int i = 0; i < 3; ++i) {
      worst = std::max(worst, rig.cycle_at(wakes, skipped).lateness);
      skipped = scheduler.advance(wakes, wakes + 20us);
      wakes = scheduler.deadline();
    }
    EXPECT_EQ(worst, expected) << late.count() << " ns late";
  }
}

TEST(ControlLoop, OnASimulatedBusALateHostDoesNotStopTheRobot) {
  SearchRig rig({.overruns_count_only = true});
  ASSERT_TRUE(rig.start_search());
  rig.run(4s);
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ(rig.late_cycle(8).mode, Mode::kSearching);
  }
  EXPECT_EQ(rig.loop().status().counters.skipped, 80U);
  EXPECT_EQ(rig.loop().status().lateness, Lateness::kHeld);
}

TEST(ControlLoop, TheSamePlanComesOutHoweverLongItsSlicesTake) {
  SearchRig counted({});
  ASSERT_TRUE(counted.run_until(Mode::kAwaitingConsent));
  const planner::Plan expected = counted.loop().plan();
  for (const Duration reading : {Duration(5us), Duration(20us), Duration(100us)}) {
    test::TickingClock stopwatch(reading);
    SearchRig timed({.stopwatch = &stopwatch});
    ASSERT_TRUE(timed.run_until(Mode::kAwaitingConsent));
    const planner::Plan& plan = timed.loop().plan();
    ASSERT_EQ(plan.paths.size(), expected.paths.size());
    for (std::size_t m = 0; m < plan.paths.size(); ++m) {
      EXPECT_TRUE(std::ranges::equal(plan.paths[m].waypoints.span(), expected.paths[m].waypoints.span()));
    }
  }
}

TEST(ControlLoop, MeasuresEachOfItsPhasesOnceACycle) {
  test::TickingClock stopwatch(7us);
  SearchRig rig({.stopwatch = &stopwatch});
  for (int i = 0; i < 50; ++i) {
    rig.cycle();
  }
  const PhaseTimes& times = rig.loop().times();
  EXPECT_EQ(times.cycle.count(), 50U);
  Duration sum{};
  for (const TimeHistogram& phase : times.phases) {
    EXPECT_EQ(phase.count(), 50U);
    sum += phase.total();
  }
  EXPECT_EQ(times.cycle.total(), sum);
  EXPECT_EQ(times.of(Phase::kDecideMode).quantile(0.5), Duration(7us)) << "one reading after the other";
  EXPECT_EQ(rig.loop().cycles(), 50U);
}

TEST(ControlLoop, SkippedPeriodsAreCountedAndRecorded) {
  SearchRig rig({});
  rig.loop().cycle({.now = rig.now(), .skipped = 3});
  EXPECT_EQ(rig.loop().status().counters.skipped, 3U);
  EXPECT_TRUE(has(rig.events(), EventKind::kOverrun));
}

}  // namespace
}  // namespace ivo::firmware
