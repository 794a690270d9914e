#include "firmware/tools/wheels/wheel_turner.hpp"

#include <limits>
#include <random>

#include "drivers/drive_fault_text.hpp"
#include "tests/unit/firmware/tools/wheels/turner_rig.hpp"

namespace ivo::firmware {
namespace {

using drivers::DriveFaultReason;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Started up, with an order for one wheel.
class ReadyRig : public TurnerRig {
 public:
  explicit ReadyRig(const TurnOrder& order = {.wheel = Wheel::kRearLeft, .radps = 0.5, .limit_rad = 0.0},
                    const Robot& file = geared_robot(), const Robot& base = geared_robot(),
                    const drivers::SimDrives::Scripts& scripts = {})
      : TurnerRig(file, base, scripts) {
    EXPECT_TRUE(run_until(TurnPhase::kOff));
    turner.give(order);
  }
  [[nodiscard]] const TurnStatus& status() const { return turner.status(); }
};

TEST(WheelTurner, TurnsTheOneWheelWhileTheKeyIsHeld) {
  ReadyRig rig;
  rig.hold(5s);
  EXPECT_EQ(rig.status().phase, TurnPhase::kTurning);
  EXPECT_NEAR(rig.status().turned.radps, 0.5, 0.01);
  EXPECT_GT(rig.turns(Wheel::kRearLeft), 0.3);
  EXPECT_NEAR(rig.status().turned.rad / kTurn, rig.turns(Wheel::kRearLeft), 0.001);
  for (const Wheel other : {Wheel::kFrontLeft, Wheel::kFrontRight, Wheel::kRearRight}) {
    EXPECT_EQ(rig.turns(other), 0.0);
  }
  for (const std::uint8_t node : std::array<std::uint8_t, 3>{1, 2, 4}) {
    EXPECT_EQ(rig.largest_target(node), 0);
  }
}

TEST(WheelTurner, AWheelMountedTheOtherWayRoundTurnsForwardToo) {
  ReadyRig rig({.wheel = Wheel::kFrontRight, .radps = 0.5, .limit_rad = 0.0});
  rig.hold(3s);
  EXPECT_GT(rig.turns(Wheel::kFrontRight), 0.1);
  EXPECT_LT(rig.drives.drive(Wheel::kFrontRight).motion().position(), 0);
}

TEST(WheelTurner, MovesNothingAndPowersNothingWithoutAKey) {
  ReadyRig rig;
  rig.log.clear();
  for (int i = 0; i < 2000; ++i) {
    rig.cycle();
    ASSERT_FALSE(rig.any_power());
  }
  EXPECT_EQ(rig.largest_target(3), 0);
}

TEST(WheelTurner, AKeyThatIsHeldDuringStartUpTurnsTheWheelOnceTheDrivesAreReady) {
  TurnerRig rig;
  rig.turner.give({.wheel = Wheel::kRearLeft, .radps = 0.5, .limit_rad = 0.0});
  rig.hold(5s);
  EXPECT_EQ(rig.turner.status().end, TurnEnd::kNone) << drivers::describe(rig.turner.status().fault);
  EXPECT_EQ(rig.turner.status().phase, TurnPhase::kTurning);
}

TEST(WheelTurner, AnEmergencyStopEndsItWithPowerOff) {
  Robot robot = geared_robot();
  robot.inputs = {.chip = "gpiochip0", .emergency_stop = InputLine{}, .bumpers = {}};
  ReadyRig rig({.wheel = Wheel::kRearLeft, .radps = 0.5, .limit_rad = 0.0}, robot);
  rig.hold(3s);
  ASSERT_EQ(rig.status().phase, TurnPhase::kTurning);
  rig.inputs.press(0);
  rig.hold(2s);
  EXPECT_EQ(rig.status().end, TurnEnd::kFault);
  EXPECT_EQ(rig.status().fault.reason, drivers::DriveFaultReason::kStopInput);
  EXPECT_TRUE(rig.run_until(TurnPhase::kEnded));
  EXPECT_FALSE(rig.any_power());
}

TEST(WheelTurner, StopInputsThatNobodyReadsLetNoWheelTurn) {
  Robot robot = geared_robot();
  robot.inputs = {.chip = "gpiochip0", .emergency_stop = InputLine{}, .bumpers = {}};
  hal::VirtualBus bus;
  WheelTurner turner(bus.port(0), robot);
  turner.open(Instant{});
  EXPECT_EQ(turner.cycle(Instant(2ms), 0, {}).end, TurnEnd::kFault);
}

TEST(WheelTurner, ATapPowersTheDrivesButMovesNothing) {
  ReadyRig rig;
  rig.cycle({.hold = true});
  rig.run(500ms);
  EXPECT_TRUE(rig.any_power());
  rig.run(5s);
  EXPECT_FALSE(rig.any_power());
  EXPECT_EQ(rig.largest_target(3), 0);
}

TEST(WheelTurner, AKeyThatIsLetGoStopsTheWheelWithinSilenceOneCycleAndTheRamp) {
  ReadyRig rig;
  rig.hold(4s);
  const Instant last_key_at_latest = rig.clock.now();
  const Duration ramp = from_seconds(0.5 / WheelTurner::kRampDownRadps2);
  while (rig.turner.status().turned.told_units != 0 || rig.clock.now() == last_key_at_latest) {
    rig.cycle();
    ASSERT_LE(rig.clock.now() - last_key_at_latest, DeadMan::kSilence + rates::kCycle + ramp + 3 * rates::kCycle);
  }
  rig.run(500ms);
  EXPECT_TRUE(rig.at_rest(Wheel::kRearLeft));
  EXPECT_EQ(rig.status().phase, TurnPhase::kWaiting);
}

TEST(WheelTurner, PowerGoesOffWhenTheKeyWasLetGo) {
  ReadyRig rig;
  rig.hold(2s);
  EXPECT_TRUE(rig.any_power());
  rig.run(DeadMan::kSilence + WheelTurner::kPowerOffAfter + 500ms);
  EXPECT_EQ(rig.status().phase, TurnPhase::kOff);
  EXPECT_FALSE(rig.any_power());
  EXPECT_FALSE(rig.turner.ended());
}

TEST(WheelTurner, TurnsAgainWhenTheKeyIsHeldAgain) {
  ReadyRig rig;
  for (int time = 0; time < 3; ++time) {
    const double before = rig.turns(Wheel::kRearLeft);
    rig.hold(3s);
    EXPECT_GT(rig.turns(Wheel::kRearLeft), before + 0.1);
    rig.run(3s);
  }
}

TEST(WheelTurner, EndsWithPowerOffAtAnyOtherKey) {
  ReadyRig rig;
  rig.hold(3s);
  rig.cycle({.end = true});
  EXPECT_TRUE(rig.run_until(TurnPhase::kEnded));
  EXPECT_EQ(rig.status().end, TurnEnd::kAsked);
  EXPECT_TRUE(rig.status().power_off);
  EXPECT_FALSE(rig.any_power());
  EXPECT_TRUE(rig.at_rest(Wheel::kRearLeft));
}

TEST(WheelTurner, OnceItEndsAHeldKeyMovesNothing) {
  ReadyRig rig;
  rig.hold(2s);
  rig.cycle({.end = true});
  rig.run(1s);
  const double turned = rig.turns(Wheel::kRearLeft);
  rig.hold(3s);
  EXPECT_EQ(rig.turns(Wheel::kRearLeft), turned);
  EXPECT_FALSE(rig.any_power());
}

TEST(WheelTurner, EndsAtOnceWhenAskedDuringStartUp) {
  TurnerRig rig;
  rig.cycle({.end = true});
  EXPECT_TRUE(rig.turner.ended());
  EXPECT_TRUE(rig.turner.status().power_off);
}

TEST(WheelTurner, EndsWhenNobodyIsThere) {
  ReadyRig rig;
  rig.run(WheelTurner::kPatience - 1s);
  EXPECT_FALSE(rig.turner.ended());
  rig.cycle({.other = true});
  rig.run(WheelTurner::kPatience - 1s);
  EXPECT_FALSE(rig.turner.ended());
  rig.run(2s);
  EXPECT_TRUE(rig.turner.ended());
  EXPECT_EQ(rig.status().end, TurnEnd::kNobodyThere);
}

TEST(WheelTurner, HoldsTheSpeedWithinItsLimit) {
  for (const double asked : {1e9, -1e9, 2.5}) {
    ReadyRig rig({.wheel = Wheel::kFrontLeft, .radps = asked, .limit_rad = 0.0});
    rig.hold(6s);
    EXPECT_NEAR(std::abs(rig.status().turned.told_radps), WheelTurner::kFastestRadps, 0.001);
    EXPECT_EQ(rig.status().refused_frames, 0U);
  }
}

TEST(WheelTurner, ASpeedThatIsNoNumberIsNoMotion) {
  for (const double asked : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    ReadyRig rig({.wheel = Wheel::kFrontLeft, .radps = asked, .limit_rad = 0.0});
    rig.hold(3s);
    EXPECT_EQ(rig.largest_target(1), 0);
  }
}

TEST(WheelTurner, StopsByItselfWhereTheOrderEnds) {
  ReadyRig rig({.wheel = Wheel::kFrontLeft, .radps = 1.0, .limit_rad = kTurn});
  rig.hold(10s);
  EXPECT_TRUE(rig.status().limit_reached);
  EXPECT_NEAR(rig.turns(Wheel::kFrontLeft), 1.0, 0.02);
  EXPECT_TRUE(rig.at_rest(Wheel::kFrontLeft));
  rig.hold(3s);  // at its end it stays
  EXPECT_NEAR(rig.turns(Wheel::kFrontLeft), 1.0, 0.02);
}

TEST(WheelTurner, ANewOrderNeedsANewPress) {
  ReadyRig rig({.wheel = Wheel::kFrontLeft, .radps = 1.0, .limit_rad = 0.5});
  rig.hold(3s);
  rig.turner.give({.wheel = Wheel::kRearRight, .radps = 1.0, .limit_rad = 0.5});
  for (int i = 0; i < 100; ++i) {  // still held from before
    rig.run(28ms);
    rig.cycle({.hold = true});
  }
  EXPECT_EQ(rig.turns(Wheel::kRearRight), 0.0);
  rig.run(200ms);
  rig.hold(3s);
  EXPECT_GT(rig.turns(Wheel::kRearRight), 0.05);
}

TEST(WheelTurner, MeasuresTheSpeedThatItReallyTold) {
  Robot robot;  // whole revolutions a minute: 0.5 rad/s is 4.77 of them, told are 5
  for (DriveParameters& drive : robot.drives) {
    drive.velocity_per_radps = 60.0 / kTurn;
  }
  ReadyRig rig({.wheel = Wheel::kFrontLeft, .radps = 0.5, .limit_rad = 0.0}, robot, robot);
  rig.hold(5s);
  EXPECT_EQ(rig.status().turned.told_units, 5);
  EXPECT_NEAR(rig.status().turned.steady_told_radps, 5.0 / 60.0 * kTurn, 1e-9);
  EXPECT_NEAR(rig.status().turned.steady_radps, rig.status().turned.steady_told_radps, 0.01);
}

TEST(WheelTurner, StopsAWheelThatTurnsMuchFasterThanTold) {
  Robot base = geared_robot();
  base.drives[0].velocity_per_radps /= 10.0;
  ReadyRig rig({.wheel = Wheel::kFrontLeft, .radps = 0.5, .limit_rad = 0.0}, geared_robot(), base);
  rig.hold(3s);
  EXPECT_EQ(rig.status().turned.note, TurnNote::kTooFast);
  EXPECT_TRUE(rig.at_rest(Wheel::kFrontLeft));
  EXPECT_LT(rig.turns(Wheel::kFrontLeft), 0.2);
  EXPECT_FALSE(rig.turner.ended());
}

TEST(WheelTurner, StopsAWheelWhosePositionStays) {
  Robot base = geared_robot();
  base.drives[0].velocity_per_radps *= 1000.0;
  ReadyRig rig({.wheel = Wheel::kFrontLeft, .radps = 0.5, .limit_rad = 0.0}, geared_robot(), base);
  rig.hold(4s);
  EXPECT_EQ(rig.status().turned.note, TurnNote::kStays);
  EXPECT_EQ(rig.status().turned.told_units, 0);
  rig.run(2s);
  rig.hold(1s);  // tried again, the note is forgotten until it is true again
  EXPECT_EQ(rig.status().turned.note, TurnNote::kNone);
}

TEST(WheelTurner, StopsAWheelThatCountsAgainstItsVelocity) {
  Robot file = geared_robot();
  file.drives[0].counts_per_turn *= -1.0;  // as an encoder with exchanged phases looks
  ReadyRig rig({.wheel = Wheel::kFrontLeft, .radps = 0.5, .limit_rad = 0.0}, file);
  rig.hold(3s);
  EXPECT_EQ(rig.status().turned.note, TurnNote::kAgainst);
  EXPECT_TRUE(rig.at_rest(Wheel::kFrontLeft));
}

TEST(WheelTurner, EndsWithTheFaultOfADriveThatFails) {
  ReadyRig rig;
  rig.hold(2s);
  rig.drives.drive(Wheel::kFrontRight).script().fault_at = rig.clock.now();
  rig.hold(2s);
  EXPECT_TRUE(rig.turner.ended());
  EXPECT_EQ(rig.status().end, TurnEnd::kFault);
  EXPECT_EQ(rig.status().fault.node_id, 2);
  EXPECT_TRUE(rig.at_rest(Wheel::kRearLeft));
  EXPECT_FALSE(rig.any_power());
}

TEST(WheelTurner, EndsWithTheStepAtWhichADriveFailsToStartUp) {
  drivers::SimDrives::Scripts scripts;
  scripts[1].silent_from = Instant{};
  TurnerRig rig(geared_robot(), geared_robot(), scripts);
  EXPECT_TRUE(rig.run_until(TurnPhase::kEnded));
  EXPECT_EQ(rig.turner.status().fault.reason, DriveFaultReason::kNoAnswer);
  EXPECT_EQ(rig.turner.status().fault.node_id, 2);
}

TEST(WheelTurner, EndsWhenAnotherMasterSpeaks) {
  for (const std::uint16_t id : std::array<std::uint16_t, 3>{0x000, 0x080, 0x77F}) {
    ReadyRig rig;
    rig.hold(2s);
    rig.inject({.id = id, .size = static_cast<std::uint8_t>(id == 0 ? 2 : id == 0x80 ? 0 : 1), .data = {0x80, 99}});
    rig.hold(1s);
    EXPECT_TRUE(rig.turner.ended());
    EXPECT_EQ(rig.status().fault.reason, DriveFaultReason::kForeignMaster);
    EXPECT_EQ(rig.status().fault.code, id);
    EXPECT_TRUE(rig.at_rest(Wheel::kRearLeft));
  }
}

TEST(WheelTurner, EndsAndSaysThatPowerIsNotKnownToBeOffWhenTheBusIsLost) {
  ReadyRig rig;
  rig.hold(2s);
  rig.bus.set_state(0, hal::BusState::kOff);
  EXPECT_TRUE(rig.run_until(TurnPhase::kEnded));
  EXPECT_EQ(rig.status().end, TurnEnd::kFault);
  EXPECT_FALSE(rig.status().power_off);
  EXPECT_TRUE(rig.at_rest(Wheel::kRearLeft)) << "it stopped by our missing heartbeat";
}

TEST(WheelTurner, EndsWhenItsOwnCyclesAreLateUnderPower) {
  ReadyRig rig;
  rig.cycle({}, LoopParameters{}.latch_at);
  EXPECT_EQ(rig.status().end, TurnEnd::kNone) << "power is off";
  rig.hold(2s);
  rig.cycle({.hold = true}, LoopParameters{}.latch_at - 1);
  EXPECT_EQ(rig.status().end, TurnEnd::kNone);
  rig.cycle({.hold = true}, LoopParameters{}.latch_at);
  EXPECT_EQ(rig.status().fault.reason, DriveFaultReason::kCycleLate);
  EXPECT_TRUE(rig.run_until(TurnPhase::kEnded));
  EXPECT_FALSE(rig.any_power());
}

TEST(WheelTurner, AProgramThatWasSuspendedDoesNotGoOnTurning) {
  ReadyRig rig;
  rig.hold(2s);
  for (int i = 0; i < 1000; ++i) {  // 2 s without a cycle of ours
    rig.clock.sleep_until(rig.clock.now() + rates::kCycle);
    rig.drives.update(rig.clock.now());
  }
  EXPECT_TRUE(rig.at_rest(Wheel::kRearLeft));
  const double turned = rig.turns(Wheel::kRearLeft);
  for (int i = 0; i < 100; ++i) {  // the key was held all the time
    rig.run(28ms);
    rig.cycle({.hold = true});
  }
  EXPECT_EQ(rig.turns(Wheel::kRearLeft), turned);
}

TEST(WheelTurner, WhateverKeysComeItMovesOnlyOneWheelSlowlyAndEndsWithPowerOff) {
  constexpr unsigned kSeed = 402;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  for (int run = 0; run < 20; ++run) {
    ReadyRig rig({.wheel = Wheel::kRearRight, .radps = 1.0, .limit_rad = 0.0});
    std::uniform_int_distribution<int> gap(1, run % 2 == 0 ? 30 : 120);
    int next = gap(random);
    for (int cycle = 0; cycle < 5000; ++cycle) {
      const bool key = --next == 0;
      next = key ? gap(random) : next;
      rig.cycle({.hold = key});
      ASSERT_LE(std::abs(rig.status().turned.told_radps), 1.0 + 1e-3);
    }
    for (const Wheel other : {Wheel::kFrontLeft, Wheel::kFrontRight, Wheel::kRearLeft}) {
      EXPECT_EQ(rig.turns(other), 0.0);
    }
    rig.cycle({.end = true});
    EXPECT_TRUE(rig.run_until(TurnPhase::kEnded));
    EXPECT_FALSE(rig.any_power());
  }
}

}  // namespace
}  // namespace ivo::firmware
