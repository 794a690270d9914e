// Start-up of the four drives over the virtual bus: what is sent, in which order, and how each refusal is told.
#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/sdo_frame.hpp"
#include "drivers/cia402/objects.hpp"
#include "drivers/drive_fault_text.hpp"
#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {
namespace {

SimDrives::Scripts third_drive(const SimScript& script) {
  SimDrives::Scripts scripts;
  scripts[2] = script;
  return scripts;
}

std::string failure_of(Rig& rig) {
  EXPECT_TRUE(rig.run_until(GroupState::kFault));
  return describe(rig.feedback.fault);
}

/// SDO requests to node 1, in order.
std::vector<SdoMessage> requests(const Rig& rig) {
  std::vector<SdoMessage> messages;
  for (const hal::CanFrame& frame : rig.log) {
    if (frame.id == 0x601) {
      messages.push_back(*parse_sdo(frame));
    }
  }
  return messages;
}

TEST(StartUp, EndsReadyWithPowerOff) {
  Rig rig;
  ASSERT_TRUE(rig.run_until(GroupState::kReady)) << describe(rig.feedback.fault);
  rig.run(std::chrono::milliseconds(500));
  EXPECT_EQ(rig.feedback.state, GroupState::kReady);
  EXPECT_TRUE(rig.feedback.fresh);
  EXPECT_TRUE(rig.feedback.standstill);
  for (const Wheel wheel : {Wheel::kFrontLeft, Wheel::kFrontRight, Wheel::kRearLeft, Wheel::kRearRight}) {
    EXPECT_EQ(rig.drives.drive(wheel).power_state(), cia402::PowerState::kSwitchOnDisabled);
    EXPECT_EQ(rig.drives.drive(wheel).nmt_state(), NmtState::kOperational);
  }
  EXPECT_EQ(rig.group.malformed(), 0U);
}

TEST(StartUp, WritesThePdoMappingInTheOrderOfTheStandard) {
  Rig rig;
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  const std::vector<SdoMessage> all = requests(rig);
  const auto first =
      std::find_if(all.begin(), all.end(), [](const SdoMessage& m) { return m.address == object::kRpdo1CobId; });
  const std::vector<SdoMessage> expected{
      {0x40, {0x1400, 1}, 0},          {0x23, {0x1400, 1}, 0x80000201}, {0x2F, {0x1600, 0}, 0},
      {0x23, {0x1600, 1}, 0x60400010}, {0x23, {0x1600, 2}, 0x60FF0020}, {0x2F, {0x1600, 0}, 2},
      {0x40, {0x1600, 1}, 0},          {0x40, {0x1600, 2}, 0},          {0x40, {0x1600, 0}, 0},
      {0x2F, {0x1400, 2}, 1},          {0x40, {0x1400, 2}, 0},          {0x2B, {0x1400, 5}, 150},
      {0x23, {0x1400, 1}, 0x00000201}, {0x40, {0x1400, 1}, 0},          {0x40, {0x1800, 1}, 0},
      {0x23, {0x1800, 1}, 0xC0000181}, {0x2F, {0x1A00, 0}, 0},          {0x23, {0x1A00, 1}, 0x60410010},
      {0x23, {0x1A00, 2}, 0x60640020}, {0x2F, {0x1A00, 0}, 2},          {0x40, {0x1A00, 1}, 0},
      {0x40, {0x1A00, 2}, 0},          {0x40, {0x1A00, 0}, 0},          {0x2F, {0x1800, 2}, 1},
      {0x40, {0x1800, 2}, 0},          {0x23, {0x1800, 1}, 0x40000181}, {0x40, {0x1800, 1}, 0},
  };
  ASSERT_GE(std::distance(first, all.end()), static_cast<std::ptrdiff_t>(expected.size()));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const SdoMessage& sent = first[static_cast<std::ptrdiff_t>(i)];
    EXPECT_EQ(sent.command, expected[i].command) << i;
    EXPECT_EQ(sent.address, expected[i].address) << i;
    // A drive may ship with its remote bit set or not; that is left as it is.
    const std::uint32_t looked_at = expected[i].data >> 31 != 0 ? cob_id::kPdoCompared : 0xFFFFFFFF;
    EXPECT_EQ(sent.data & looked_at, expected[i].data & looked_at) << i;
  }
}

TEST(StartUp, TellsDrivesToStopWithoutOurHeartbeatAndToBeStillBeforeTheMode) {
  Rig rig;
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  const std::vector<SdoMessage> all = requests(rig);
  const auto written = [&all](ObjectAddress address) {
    return std::find_if(all.begin(), all.end(),
                        [&](const SdoMessage& m) { return m.address == address && m.command != 0x40; });
  };
  EXPECT_EQ(written(object::kConsumerHeartbeat)->data, 127U << 16 | 150U);
  EXPECT_EQ(written(object::kProducerHeartbeat)->data, 50U);
  EXPECT_EQ(written(object::kCyclePeriod)->data, 2000U);
  EXPECT_EQ(written(object::kQuickStopOption)->data, 2U);
  EXPECT_EQ(written(object::kAbortConnectionOption)->data, 3U);
  EXPECT_EQ(written(object::kTargetVelocity)->data, 0U);
  EXPECT_EQ(written(object::kModeOfOperation)->data, 9U);
  EXPECT_LT(written(object::kTargetVelocity), written(object::kModeOfOperation));
}

TEST(StartUp, SendsNoSyncAndNoTargetBeforeAllFourAreOperational) {
  SimScript slow;
  slow.silent_from = Instant{};
  Rig rig(third_drive(slow));
  rig.run(std::chrono::seconds(2));
  for (const hal::CanFrame& frame : rig.log) {
    EXPECT_NE(frame.id, 0x080);
    EXPECT_NE(frame.id & 0x780, 0x200);
  }
}

TEST(StartUp, SendsAtMostOneStartUpFrameToADriveInACycle) {
  Rig rig;
  std::size_t before = 0;
  while (rig.cycle().state == GroupState::kBooting) {
    const auto to_first = std::count_if(rig.log.begin() + static_cast<std::ptrdiff_t>(before), rig.log.end(),
                                        [](const hal::CanFrame& frame) { return frame.id == 0x601; });
    EXPECT_LE(to_first, 1);
    before = rig.log.size();
  }
}

TEST(StartUp, UsesProfileVelocityWhereThereIsNoCyclicMode) {
  SimScript script;
  script.supported_modes = 0x4;
  Rig rig({script, script, script, script});
  ASSERT_TRUE(rig.drive_at(2.0));
  EXPECT_NEAR(rig.feedback.radps[0], 2.0, 0.05);
}

TEST(StartUp, GoesOnWithoutABootUpMessageWhenTheNodeAnswers) {
  Rig rig;
  rig.drives.drive(Wheel::kFrontLeft).script().silent_from = Instant{};
  rig.cycle();  // its boot-up message is lost
  rig.cycle();
  rig.drives.drive(Wheel::kFrontLeft).script().silent_from = SimScript::kNever;
  EXPECT_TRUE(rig.run_until(GroupState::kReady)) << describe(rig.feedback.fault);
  EXPECT_GE(rig.clock.now(), Instant(rates::kBootTimeout));
}

TEST(StartUp, NamesADriveThatNeverAnswers) {
  SimScript script;
  script.silent_from = Instant{};
  Rig rig(third_drive(script));
  EXPECT_EQ(failure_of(rig),
            "drive 3 (rear left) failed at \"device type 1000h\": neither a boot-up message nor an SDO answer: is it "
            "powered, on this bus and set to this node-id?");
}

TEST(StartUp, NamesADriveThatFallsSilentHalfway) {
  SimScript script;
  script.silent_from = Instant(std::chrono::milliseconds(20));
  Rig rig(third_drive(script));
  EXPECT_NE(failure_of(rig).find("drive 3 (rear left) failed at \""), std::string::npos);
  EXPECT_EQ(rig.feedback.fault.reason, DriveFaultReason::kSdoTimedOut);
}

TEST(StartUp, RefusesAWrongProfile) {
  SimScript script;
  script.device_type = 0x00020191;
  Rig rig(third_drive(script));
  EXPECT_EQ(failure_of(rig), "drive 3 (rear left) failed at \"device type 1000h\": unexpected value 00020191h");
}

TEST(StartUp, RefusesADriveWithoutAVelocityMode) {
  SimScript script;
  script.supported_modes = 0x21;
  Rig rig(third_drive(script));
  EXPECT_EQ(failure_of(rig),
            "drive 3 (rear left) failed at \"supported drive modes 6502h\": unexpected value 00000021h");
}

TEST(StartUp, RefusesADriveThatDoesNotEnterTheMode) {
  SimScript script;
  script.refuse_mode = true;
  Rig rig(third_drive(script));
  EXPECT_EQ(failure_of(rig), "drive 3 (rear left) failed at \"mode of operation 6061h\": unexpected value 00000000h");
}

TEST(StartUp, RefusesAnotherVendorOrProduct) {
  hal::VirtualBus bus;
  hal::ManualClock clock;
  Robot built = test_robot();
  built.drives[1].vendor_id = 0x111;
  Robot expected = test_robot();
  expected.drives[1].vendor_id = 0x222;
  SimDrives drives(bus.port(1), built, SimDrives::TimeFrom::kClock);
  DriveGroup group(bus.port(0), expected);
  drives.open();
  group.open(clock.now());
  GroupFeedback feedback;
  for (int i = 0; i < 100 && feedback.state == GroupState::kBooting; ++i) {
    std::array<hal::ReceivedFrame, 64> frames;
    const std::size_t count = bus.port(0).receive(frames, clock.now());
    std::for_each_n(frames.begin(), count, [&](const hal::ReceivedFrame& r) { group.on_frame(r); });
    feedback = group.update(clock.now());
    group.write(clock.now(), false, {});
    clock.sleep_until(clock.now() + rates::kCycle);
    drives.update(clock.now());
  }
  EXPECT_EQ(describe(feedback.fault),
            "drive 2 (front right) failed at \"vendor-ID 1018h:1\": unexpected value 00000111h");
}

TEST(StartUp, TellsTheNameOfAnSdoAbort) {
  SimScript script;
  script.refusal = {object::kModeDisplay, SdoAbort::kValueRange};
  Rig rig(third_drive(script));
  EXPECT_EQ(failure_of(rig),
            "drive 3 (rear left) failed at \"mode of operation 6061h\": SDO abort 06090030h, value range exceeded");
}

TEST(StartUp, EveryStepThatMayNotFailIsToldByItsName) {
  const StartupSteps steps = startup_steps(test_robot(), Wheel::kRearLeft);
  for (const StartupStep& step : steps) {
    if (step.role != PdoRole::kNone || step.action == StepAction::kSilencePdo || step.action == StepAction::kKeep) {
      continue;  // startup_pdo_test.cpp; what is only shown may be missing
    }
    const bool judged = std::any_of(steps.begin(), steps.end(), [&](const StartupStep& other) {
      return other.object == step.object && !other.may_refuse && other.mode == StepMode::kAny;
    });
    if (!judged) {
      continue;  // in this mode all of it may be refused
    }
    SimScript script;
    script.refusal = {step.object, SdoAbort::kHardware};
    Rig rig(third_drive(script));
    const auto first = std::find_if(steps.begin(), steps.end(), [&](const StartupStep& other) {
      return other.object == step.object && !other.may_refuse;
    });
    ASSERT_NE(first, steps.end()) << step.name;
    EXPECT_NE(failure_of(rig).find(std::string("\"") + first->name + "\": SDO abort 06060000h"), std::string::npos)
        << step.name;
  }
}

TEST(StartUp, AcceptsAnyQuickStopOptionThatIsARampAndNoOther) {
  for (const std::uint32_t option : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 0xFFFFU, 33U}) {
    SimScript script;
    script.stuck = {object::kQuickStopOption, option, SdoAbort::kValueRange};
    Rig rig(third_drive(script));
    const bool ramp = option == 1 || option == 2 || option == 5 || option == 6;
    EXPECT_EQ(rig.run_until(ramp ? GroupState::kReady : GroupState::kFault), true) << option;
    EXPECT_EQ(rig.feedback.state, ramp ? GroupState::kReady : GroupState::kFault) << option;
  }
}

TEST(StartUp, AcceptsAnyReactionToALostMasterThatStopsAndNoOther) {
  for (const std::uint32_t option : {0U, 1U, 2U, 3U, 4U, 0xFFFFU, 33U}) {
    for (const std::optional<SdoAbort> code : {std::optional(SdoAbort::kReadOnly), std::optional<SdoAbort>()}) {
      SimScript script;
      script.stuck = {object::kAbortConnectionOption, option, code};
      Rig rig(third_drive(script));
      const bool stops = option >= 1 && option <= 3;
      EXPECT_TRUE(rig.run_until(stops ? GroupState::kReady : GroupState::kFault)) << option;
    }
  }
}

TEST(StartUp, SaysThatADriveWouldGoOnMovingWithoutItsMaster) {
  SimScript script;
  script.stuck = {object::kAbortConnectionOption, 0, SdoAbort::kValueRange};
  Rig rig(third_drive(script));
  EXPECT_EQ(
      failure_of(rig),
      "drive 3 (rear left) failed at \"abort connection option code 6007h in force: 1, 2 or 3, or the drive would "
      "go on moving without its master\": unexpected value 00000000h");
}

TEST(StartUp, RefusesADriveWithoutAReactionToALostMaster) {
  SimScript script;
  script.refusal = {object::kAbortConnectionOption, SdoAbort::kNoObject};
  Rig rig(third_drive(script));
  EXPECT_NE(failure_of(rig).find("go on moving without its master\": SDO abort 06020000h"), std::string::npos);
}

TEST(StartUp, TellsADriveToStopBeforeAllButItsIdentity) {
  Rig rig;
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  const std::vector<SdoMessage> all = requests(rig);
  ASSERT_GE(all.size(), 3U);
  EXPECT_EQ(all[0].address, object::kDeviceType);
  EXPECT_EQ(all[1].command, 0x23);
  EXPECT_EQ(all[1].address, object::kTargetVelocity);
  EXPECT_EQ(all[1].data, 0U);
  EXPECT_EQ(all[2].command, 0x2B);
  EXPECT_EQ(all[2].address, object::kControlword);
  EXPECT_EQ(all[2].data, 0U);
}

TEST(StartUp, StopsWheelsThatADeadMasterLeftTurningEvenWhenAnotherDriveFails) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  for (const Wheel wheel : kAll) {
    rig.drives.drive(wheel).script().stuck = {object::kAbortConnectionOption, 0, SdoAbort::kReadOnly};
  }
  rig.drives.drive(Wheel::kRearLeft).script().refusal = {object::kDeviceType, SdoAbort::kHardware};
  rig.enable = false;
  rig.group.open(rig.clock.now());  // as a successor would
  ASSERT_TRUE(rig.run_until(GroupState::kFault));
  EXPECT_EQ(rig.feedback.fault.node_id, 3);
  EXPECT_FALSE(rig.feedback.off) << "the others are not told to stop yet";
  for (int i = 0; i < 20 && !rig.feedback.off; ++i) {
    rig.cycle();
  }
  EXPECT_TRUE(rig.feedback.off);
  for (const Wheel wheel : {Wheel::kFrontLeft, Wheel::kFrontRight, Wheel::kRearRight}) {
    EXPECT_EQ(rig.drives.drive(wheel).power_state(), cia402::PowerState::kSwitchOnDisabled);
  }
}

TEST(StartUp, ForgivesTheBootUpMessageThatCameBeforeTheReset) {
  Rig rig;
  rig.group.write(rig.clock.now(), false, {});  // the reset goes out before the drives' power-on messages are read
  EXPECT_TRUE(rig.run_until(GroupState::kReady)) << describe(rig.feedback.fault);
}

TEST(StartUp, ConfiguresADriveThatRebootsHalfwayAnew) {
  SimScript script;
  script.reboot_at = Instant(std::chrono::milliseconds(30));
  Rig rig(third_drive(script));
  EXPECT_TRUE(rig.run_until(GroupState::kReady)) << describe(rig.feedback.fault);
  EXPECT_TRUE(rig.drive_at(2.0));
}

TEST(StartUp, ADriveThatRebootsAgainAndAgainFailsIt) {
  Rig rig;
  for (int i = 0; i < 200 && rig.cycle().state == GroupState::kBooting; ++i) {
    if (i % 10 == 5) {
      rig.drives.drive(Wheel::kRearLeft).script().reboot_at = rig.clock.now();
    }
  }
  EXPECT_NE(failure_of(rig).find("drive 3 (rear left) failed at \""), std::string::npos);
  EXPECT_EQ(rig.feedback.fault.reason, DriveFaultReason::kRebooted);
}

TEST(StartUp, ADriveThatDoesNotBecomeOperationalFailsIt) {
  SimScript script;
  script.heartbeat_lost_from = Instant{};
  Rig rig(third_drive(script));
  EXPECT_EQ(failure_of(rig),
            "drive 3 (rear left) failed at \"NMT start\": no heartbeat said Operational (NMT state 00h)");
}

TEST(StartUp, CanBeTriedAgainAfterItFailed) {
  SimScript script;
  script.refusal = {object::kCyclePeriod, SdoAbort::kHardware};
  Rig rig(third_drive(script));
  failure_of(rig);
  rig.drives.drive(Wheel::kRearLeft).script().refusal.reset();
  rig.group.reset_fault();
  EXPECT_TRUE(rig.run_until(GroupState::kReady));
  EXPECT_EQ(rig.feedback.fault.reason, DriveFaultReason::kNone);
}

TEST(StartUp, IgnoresAnswersWithAWrongLengthOrAnotherNode) {
  Rig rig;
  while (rig.cycle().state == GroupState::kBooting) {
    rig.inject({.id = 0x581, .size = 4, .data = {0x80}});
    rig.inject({.id = 0x701, .size = 0, .data = {}});
    rig.inject({.id = 0x5C0, .size = 8, .data = {0x80}});
  }
  EXPECT_EQ(rig.feedback.state, GroupState::kReady);
  EXPECT_GT(rig.group.malformed(), 0U);
}

}  // namespace
}  // namespace ivo::drivers
