// Start-up against a node that is slow, reboots, or answers SDOs in every odd way.
#include <gtest/gtest.h>

#include "tests/unit/drivers/startup_rig.hpp"

namespace ivo::drivers {
namespace {

using std::chrono::milliseconds;
using Values = std::vector<std::uint32_t>;

TEST(StartUpOfANode, EndsOperationalAndKnowsWhoItIs) {
  StartupRig rig;
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.startup.identity().vendor_id, 0x111U);
  EXPECT_EQ(rig.startup.identity().product_code, 0x222U);
  EXPECT_EQ(rig.startup.identity().revision, 0x333U);
  EXPECT_EQ(rig.startup.identity().serial_number, 0x444U);
  EXPECT_EQ(rig.startup.mode(), cia402::Mode::kCyclicSynchronousVelocity);
  EXPECT_EQ(rig.startup.channels(), (PdoChannels{0x203, 0, 0x183}));
  EXPECT_TRUE(rig.node.aborts_received.empty());
}

TEST(StartUpOfANode, TellsItWhatToDoByItself) {
  Robot robot = test_robot();
  robot.limits = {.max_accel_mps2 = 0.5, .max_turn_accel_radps2 = 1.5, .stop_decel_mps2 = 1.0, .quick_stop_mps2 = 2.0};
  robot.drives[2].gear_ratio = 20.0;
  robot.drives[2].accel_per_radps2 = 10.0;
  StartupRig rig(robot);
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.written(0x605A, 0), Values{2});
  EXPECT_EQ(rig.written(0x605B, 0), Values{1});
  EXPECT_EQ(rig.written(0x605C, 0), Values{1});
  EXPECT_EQ(rig.written(0x605D, 0), Values{1});
  EXPECT_EQ(rig.written(0x605E, 0), Values{2});
  EXPECT_EQ(rig.written(0x6007, 0), Values{3});
  // At the rim 2 (sqrt(2) 1 + 0.4 1.5) = 4.028 m/s2; a wheel of 0.1 m, gear 20, 10 units.
  EXPECT_EQ(rig.written(0x6083, 0), Values{8057});
  EXPECT_EQ(rig.written(0x6084, 0), Values{8057});
  EXPECT_EQ(rig.written(0x6085, 0), Values{4000});
  EXPECT_EQ(rig.written(0x1400, 5), Values{150});
  EXPECT_EQ(rig.written(0x1005, 0), Values{0x80});
  EXPECT_EQ(rig.written(0x1006, 0), Values{2000});
  EXPECT_EQ(rig.written(0x60C2, 1), Values{2});
  EXPECT_EQ(rig.written(0x60C2, 2), Values{0xFD});
  EXPECT_EQ(rig.written(0x60FF, 0), (Values{0, 0})) << "before all else, and in the mode";
}

TEST(StartUpOfANode, TakesTheCycleOfTheRobot) {
  Robot robot = test_robot();
  robot.cycle = milliseconds(1);
  StartupRig rig(robot);
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.written(0x1006, 0), Values{1000});
  EXPECT_EQ(rig.written(0x60C2, 1), Values{1});
}

TEST(StartUpOfANode, LeavesCyclicThingsOutInProfileVelocity) {
  StartupRig rig;
  rig.node.set(0x6502, 0, 4, 0x4);
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.startup.mode(), cia402::Mode::kProfileVelocity);
  EXPECT_TRUE(rig.written(0x60C2, 1).empty());
  EXPECT_EQ(rig.written(0x6060, 0), Values{3});
}

class OddAnswers : public testing::TestWithParam<BareNode::Answers> {};

TEST_P(OddAnswers, AreAllTaken) {
  StartupRig rig;
  rig.node.answers = GetParam();
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.startup.identity().serial_number, 0x444U);
  EXPECT_TRUE(rig.node.aborts_received.empty());
}

TEST_P(OddAnswers, AreTakenTwentyMillisecondsLate) {
  StartupRig rig;
  rig.node.answers = GetParam();
  rig.node.delay = milliseconds(20);
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_TRUE(rig.node.aborts_received.empty());
  EXPECT_LT(rig.now, Instant(std::chrono::seconds(12)));
}

INSTANTIATE_TEST_SUITE_P(Everywhere, OddAnswers,
                         testing::Values(BareNode::Answers::kExpedited, BareNode::Answers::kFourBytes,
                                         BareNode::Answers::kNoSize, BareNode::Answers::kSegments,
                                         BareNode::Answers::kSegmentsNoSize, BareNode::Answers::kSegmentsOfAByte));

struct Stray {
  const char* name;
  std::vector<hal::CanFrame> (*before)(const hal::CanFrame& request);
};

hal::CanFrame to_client(std::uint8_t command, const hal::CanFrame& request, int index_by = 0, int sub_by = 0) {
  const SdoMessage message = *parse_sdo(request);
  return sdo_frame(0x583, {command,
                           {static_cast<std::uint16_t>(message.address.index + index_by),
                            static_cast<std::uint8_t>(message.address.sub + sub_by)},
                           0xDEADBEEF});
}

const Stray kStrays[] = {
    {"AnswerToAnotherIndex", [](const hal::CanFrame& r) { return std::vector{to_client(0x43, r, 1)}; }},
    {"AnswerToAnotherSubIndex", [](const hal::CanFrame& r) { return std::vector{to_client(0x43, r, 0, 1)}; }},
    {"ConfirmationOfAnotherIndex", [](const hal::CanFrame& r) { return std::vector{to_client(0x60, r, 1)}; }},
    {"AbortOfAnotherIndex", [](const hal::CanFrame& r) { return std::vector{to_client(0x80, r, 1)}; }},
    {"AnswerOfTheOtherService",
     [](const hal::CanFrame& r) { return std::vector{to_client(r.data[0] == 0x40 ? 0x60 : 0x43, r)}; }},
    {"SegmentThatNobodyAskedFor", [](const hal::CanFrame& r) { return std::vector{to_client(0x00, r)}; }},
    {"BlockTransfer",
     [](const hal::CanFrame& r) {
       return std::vector{to_client(0xC0, r), to_client(0xA0, r)};
     }},
    {"ShortFrame",
     [](const hal::CanFrame& r) {
       hal::CanFrame frame = to_client(0x43, r);
       frame.size = 7;
       return std::vector{frame};
     }},
};

class StrayFrames : public testing::TestWithParam<Stray> {};

TEST_P(StrayFrames, BeforeEveryAnswerAreDropped) {
  StartupRig rig;
  rig.node.before = GetParam().before;
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.startup.identity().vendor_id, 0x111U);
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, StrayFrames, testing::ValuesIn(kStrays),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(StartUpOfANode, GoesOnWhenEverySecondRequestIsLost) {
  StartupRig rig;
  rig.node.before = [&](const hal::CanFrame&) {
    rig.node.answers_nothing = true;  // the next one; the client then asks again
    return std::vector<hal::CanFrame>{};
  };
  rig.startup.open();
  for (int i = 0; i < 60'000 && rig.startup.phase() != DriveStartup::Phase::kConfigured; ++i) {
    rig.cycle();
    if (!rig.log.empty() && rig.log.back().data[0] == 0x80) {
      rig.node.answers_nothing = false;
    }
  }
  EXPECT_EQ(rig.startup.phase(), DriveStartup::Phase::kConfigured) << rig.failure();
}

TEST(StartUpOfANode, NamesTheStepAtWhichItFellSilent) {
  StartupRig rig;
  rig.node.before = [&](const hal::CanFrame& request) {
    rig.node.answers_nothing = parse_sdo(request)->address == ObjectAddress{0x6502, 0};
    return std::vector<hal::CanFrame>{};
  };
  EXPECT_FALSE(rig.run());
  EXPECT_EQ(rig.startup.fault().reason, DriveFaultReason::kSdoTimedOut);
  EXPECT_EQ(rig.failure(), "drive 3 (rear left) failed at \"COB-ID SYNC 1005h\": no SDO answer");
}

TEST(StartUpOfANode, ClosesTheChannelOfANumberThatIsTooShort) {
  StartupRig rig;
  rig.node.set(0x1000, 0, 2, 0x0192);
  EXPECT_FALSE(rig.run());
  EXPECT_EQ(
      rig.failure(),
      "drive 3 (rear left) failed at \"device type 1000h\": SDO abort 06070013h, data type does not match, length "
      "of service parameter too low");
  rig.cycle();
  EXPECT_EQ(rig.node.aborts_received, std::vector{SdoAbort::kLengthTooLow});
}

TEST(StartUpOfANode, BeginsAnewWhenItBootsTwiceOrReboots) {
  StartupRig rig;
  rig.node.boot_ups = 2;
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.written(0x6040, 0).size(), 2U) << "all of it once more";
  EXPECT_EQ(rig.written(0x6060, 0).size(), 1U) << "the second came before that step";
}

TEST(StartUpOfANode, FailsOneThatBootsAgainAndAgain) {
  StartupRig rig;
  rig.node.boot_ups = 2 + DriveStartup::kRestarts;
  EXPECT_FALSE(rig.run());
  EXPECT_EQ(rig.startup.fault().reason, DriveFaultReason::kRebooted);
  EXPECT_EQ(rig.startup.fault().node_id, 3);
}

TEST(StartUpOfANode, ConfiguresAnewOneThatRebootsWhileItWaitsForTheOthers) {
  StartupRig rig;
  rig.startup.open();
  for (int i = 0; i < 10'000 && rig.startup.phase() != DriveStartup::Phase::kConfigured; ++i) {
    rig.cycle();
  }
  ASSERT_EQ(rig.startup.phase(), DriveStartup::Phase::kConfigured);
  rig.node.boot(rig.now);
  rig.node.set(0x1016, 1, 4, 0);
  rig.cycle();
  EXPECT_EQ(rig.startup.phase(), DriveStartup::Phase::kConfiguring);
  for (int i = 0; i < 10'000 && rig.startup.phase() != DriveStartup::Phase::kConfigured; ++i) {
    rig.cycle();
  }
  EXPECT_EQ(rig.startup.phase(), DriveStartup::Phase::kConfigured);
  EXPECT_EQ(rig.node.get(0x1016, 1), 127U << 16 | 150U);
}

TEST(StartUpOfANode, SaysNothingMoreAfterTheNodesAbort) {
  StartupRig rig;
  rig.node.refused_writes[{0x1016, 1}] = SdoAbort::kParameterIncompatible;
  EXPECT_FALSE(rig.run());
  const std::size_t sent = rig.log.size();
  for (int i = 0; i < 2000; ++i) {
    rig.cycle();
  }
  EXPECT_EQ(rig.log.size(), sent);
  EXPECT_EQ(rig.failure(),
            "drive 3 (rear left) failed at \"consumer heartbeat time 1016h:1\": SDO abort 06040043h, general parameter "
            "incompatibility");
}

TEST(StartUpOfANode, RefusesADriveThatProducesSync) {
  StartupRig rig;
  rig.node.stuck[{0x1005, 0}] = 0x4000'0080;
  EXPECT_FALSE(rig.run());
  EXPECT_EQ(
      rig.failure(),
      "drive 3 (rear left) failed at \"COB-ID SYNC 1005h in force: 080h, and not produced by the drive\": unexpected "
      "value 40000080h");
}

TEST(StartUpOfANode, RefusesADriveThatDoesNotWatchOurHeartbeat) {
  for (const std::uint32_t value : {0U, 127U << 16, 126U << 16 | 150U, 127U << 16 | 1000U, 127U << 16 | 20U}) {
    StartupRig rig;
    rig.node.stuck[{0x1016, 1}] = value;
    EXPECT_FALSE(rig.run()) << std::hex << value;
    EXPECT_EQ(rig.startup.fault().reason, DriveFaultReason::kUnexpectedValue);
  }
  StartupRig rig;
  rig.node.stuck[{0x1016, 1}] = 127U << 16 | 160U;
  EXPECT_TRUE(rig.run()) << "rounded to its tick";
}

TEST(StartUpOfANode, RefusesATargetThatDoesNotBecomeZero) {
  StartupRig rig;
  rig.node.stuck[{0x60FF, 0}] = 5;
  EXPECT_FALSE(rig.run());
  EXPECT_EQ(rig.failure(),
            "drive 3 (rear left) failed at \"target velocity 60FFh in force: 0\": unexpected value 00000005h");
}

TEST(StartUpOfANode, RefusesAQuickStopThatIsLessSteepThanWasSaid) {
  StartupRig rig;
  rig.node.stuck[{0x6085, 0}] = 100;
  EXPECT_FALSE(rig.run());
  EXPECT_NE(rig.failure().find("at least nine tenths of limits.quick_stop_mps2\": unexpected value 00000064h"),
            std::string::npos)
      << rig.failure();
}

TEST(StartUpOfANode, JudgesProfileRampsWhereTheWheelFollowsThem) {
  StartupRig cyclic;
  cyclic.node.stuck[{0x6083, 0}] = 100;
  EXPECT_TRUE(cyclic.run()) << cyclic.failure();
  StartupRig profile;
  profile.node.set(0x6502, 0, 4, 0x4);
  profile.node.stuck[{0x6083, 0}] = 100;
  EXPECT_FALSE(profile.run());
  EXPECT_NE(profile.failure().find("profile acceleration 6083h in force"), std::string::npos) << profile.failure();
}

TEST(StartUpOfANode, DoesWithoutWhateverIsOptional) {
  StartupRig rig;
  for (const std::uint16_t index : std::initializer_list<std::uint16_t>{0x1005, 0x1006, 0x605B, 0x605C, 0x605D, 0x605E,
                                                                        0x6083, 0x6084, 0x6085, 0x60C2}) {
    rig.node.remove(index);
  }
  for (const std::uint8_t sub : std::initializer_list<std::uint8_t>{2, 3, 4}) {
    rig.node.remove(0x1018, sub);
  }
  for (std::uint16_t k = 0; k < 4; ++k) {
    rig.node.remove(static_cast<std::uint16_t>(0x1400 + k), 5);
  }
  for (const std::uint16_t index :
       std::initializer_list<std::uint16_t>{0x1801, 0x1802, 0x1803, 0x1A01, 0x1A02, 0x1A03}) {
    rig.node.remove(index);
  }
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.startup.identity().vendor_id, 0x111U);
  EXPECT_EQ(rig.startup.identity().serial_number, 0U);
}

TEST(StartUpOfANode, AcceptsReactionsThatEndWithPowerOffAndNoneOfTheManufacturers) {
  struct Case {
    std::uint16_t index;
    std::uint32_t value;
    bool good;
  };
  for (const Case& c : {Case{0x605B, 0, true}, Case{0x605B, 0xFFFF, false}, Case{0x605C, 0, true},
                        Case{0x605C, 0xFFFE, false}, Case{0x605D, 2, true}, Case{0x605D, 0, false},
                        Case{0x605E, 0, true}, Case{0x605E, 1, true}, Case{0x605E, 0xFFFF, false}}) {
    StartupRig rig;
    rig.node.set(c.index, 0, 2, c.value);
    rig.node.refused_writes[{c.index, 0}] = SdoAbort::kValueRange;
    EXPECT_EQ(rig.run(), c.good) << std::hex << c.index << ' ' << c.value;
  }
}

}  // namespace
}  // namespace ivo::drivers
