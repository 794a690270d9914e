// PDOs at start-up: mapped and read back, those of a drive that will not be mapped, and those that drives share.
#include <gtest/gtest.h>

#include "tests/unit/drivers/startup_rig.hpp"

namespace ivo::drivers {
namespace {

using Key = BareNode::Key;

void expect_own_mapping(const BareNode& node) {
  EXPECT_EQ(node.get(0x1600, 0), 2U);
  EXPECT_EQ(node.get(0x1600, 1), 0x60400010U);
  EXPECT_EQ(node.get(0x1600, 2), 0x60FF0020U);
  EXPECT_EQ(node.get(0x1400, 1), 0x203U);
  EXPECT_EQ(node.get(0x1400, 2), 1U);
  EXPECT_EQ(node.get(0x1A00, 0), 2U);
  EXPECT_EQ(node.get(0x1A00, 1), 0x60410010U);
  EXPECT_EQ(node.get(0x1A00, 2), 0x60640020U);
  EXPECT_EQ(node.get(0x1800, 1), 0x4000'0183U);
  EXPECT_EQ(node.get(0x1800, 2), 1U);
}

std::vector<std::uint16_t> valid_tpdos(const BareNode& node) {
  std::vector<std::uint16_t> valid;
  for (std::uint16_t index = 0x1800; index < 0x1804; ++index) {
    if (node.objects.contains({index, 1}) && (node.get(index, 1) & cob_id::kPdoInvalid) == 0) {
      valid.push_back(static_cast<std::uint16_t>(node.get(index, 1) & 0x7FF));
    }
  }
  return valid;
}

TEST(PdoMapping, IsWrittenAndTheOtherTpdosAreSilenced) {
  StartupRig rig;
  ASSERT_TRUE(rig.run()) << rig.failure();
  expect_own_mapping(rig.node);
  EXPECT_EQ(valid_tpdos(rig.node), std::vector<std::uint16_t>{0x183});
  EXPECT_EQ(rig.node.get(0x1802, 1), 0xC000'0383U) << "nothing but the bit that says so";
}

TEST(PdoMapping, OfADriveThatWillNotBeSilencedIsNoFailure) {
  StartupRig rig;
  rig.node.refused_writes[{0x1801, 1}] = SdoAbort::kReadOnly;
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(valid_tpdos(rig.node), (std::vector<std::uint16_t>{0x183, 0x283}));
}

TEST(PdoMapping, LeavesTheIdAloneUntilThePdoIsInvalid) {
  StartupRig rig;
  rig.node.set(0x1400, 1, 4, 0x345);  // another id than that of the set
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.written(0x1400, 1), (std::vector<std::uint32_t>{0x8000'0345, 0x203}));
}

TEST(PdoMapping, FallsBackToTheDefaultSetOfADriveWhoseMappingIsFixed) {
  StartupRig rig;
  rig.node.fixed_mapping = true;
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.startup.channels(), (PdoChannels{0x503, 0, 0x383}));
  EXPECT_EQ(rig.node.get(0x1403, 1), 0x503U);
  EXPECT_EQ(rig.node.get(0x1403, 2), 1U);
  EXPECT_EQ(rig.node.get(0x1802, 1), 0x4000'0383U);
  EXPECT_EQ(rig.node.get(0x1802, 2), 1U);
  EXPECT_EQ(valid_tpdos(rig.node), std::vector<std::uint16_t>{0x383}) << "TPDO1 is silenced as well";
}

TEST(PdoMapping, FallsBackWhereverTheDriveRefuses) {
  for (const Key& key : {Key{0x1400, 1}, Key{0x1600, 0}, Key{0x1600, 1}, Key{0x1600, 2}, Key{0x1400, 2}}) {
    StartupRig rig;
    rig.node.refused_writes[key] = SdoAbort::kReadOnly;
    ASSERT_TRUE(rig.run()) << std::hex << key.first << ": " << rig.failure();
    EXPECT_EQ(rig.startup.channels(), (PdoChannels{0x503, 0, 0x183})) << std::hex << key.first;
  }
  for (const Key& key : {Key{0x1800, 1}, Key{0x1A00, 0}, Key{0x1A00, 1}, Key{0x1A00, 2}, Key{0x1800, 2}}) {
    StartupRig rig;
    rig.node.refused_writes[key] = SdoAbort::kReadOnly;
    ASSERT_TRUE(rig.run()) << std::hex << key.first << ": " << rig.failure();
    EXPECT_EQ(rig.startup.channels(), (PdoChannels{0x203, 0, 0x383})) << std::hex << key.first;
  }
}

TEST(PdoMapping, FallsBackWhereverItReadsBackOtherwise) {
  const std::map<Key, std::uint32_t> others{{{0x1600, 0}, 1},
                                            {{0x1600, 1}, 0x60400008},
                                            {{0x1600, 2}, 0x607A0020},
                                            {{0x1400, 2}, 255},
                                            {{0x1400, 1}, 0x8000'0203}};
  for (const auto& [key, value] : others) {
    StartupRig rig;
    rig.node.stuck[key] = value;
    ASSERT_TRUE(rig.run()) << std::hex << key.first << ' ' << int{key.second} << ": " << rig.failure();
    EXPECT_EQ(rig.startup.channels().command_id, 0x503) << std::hex << key.first << ' ' << int{key.second};
  }
}

TEST(PdoMapping, UsesAPdoThatIsRightWithoutWritingToIt) {
  StartupRig rig;
  rig.node.fixed_mapping = true;
  rig.node.set(0x1403, 2, 1, 1);
  rig.node.set(0x1802, 2, 1, 1);
  for (const Key& key : {Key{0x1403, 1}, Key{0x1403, 2}, Key{0x1802, 1}, Key{0x1802, 2}}) {
    rig.node.refused_writes[key] = SdoAbort::kReadOnly;
  }
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.startup.channels(), (PdoChannels{0x503, 0, 0x383}));
}

TEST(PdoMapping, GivesAFoundPdoTheIdOfTheSet) {
  StartupRig rig;
  rig.node.fixed_mapping = true;
  rig.node.set(0x1403, 1, 4, 0x8000'0000);
  rig.node.set(0x1802, 1, 4, 0x8000'0000);
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.node.get(0x1403, 1), 0x503U);
  EXPECT_EQ(rig.node.get(0x1802, 1), 0x4000'0383U);
}

TEST(PdoMapping, RestoresTheCountThatARefusedRemapLeftEmpty) {
  StartupRig rig;
  rig.node.set(0x1600, 0, 1, 2);
  rig.node.set(0x1600, 2, 4, 0x60FF0020);  // RPDO1 is right already, but its entries cannot be written
  rig.node.set(0x1603, 2, 4, 0x607A0020);
  rig.node.refused_writes[{0x1600, 1}] = SdoAbort::kReadOnly;
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.startup.channels().command_id, 0x203);
  EXPECT_EQ(rig.node.get(0x1600, 0), 2U);
  EXPECT_EQ(rig.node.get(0x1400, 1), 0x203U);
}

TEST(PdoMapping, PassesOverAPdoThatDoesNotActAtEverySync) {
  StartupRig rig;
  rig.node.fixed_mapping = true;
  rig.node.set(0x1601, 2, 4, 0x60FF0020);  // RPDO2 would do as well
  rig.node.stuck[{0x1401, 2}] = 255;
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.startup.channels().command_id, 0x503);
}

TEST(PdoMapping, NamesTheRefusedStepWhenNoOtherPdoWillDo) {
  StartupRig rig;
  rig.node.refused_writes[{0x1600, 2}] = SdoAbort::kNotMappable;
  rig.node.set(0x1603, 2, 4, 0x607A0020);
  EXPECT_FALSE(rig.run());
  EXPECT_EQ(
      rig.failure(),
      "drive 3 (rear left) failed at \"map target velocity 1600h:2; nor does any of RPDO1 to RPDO4 hold 6040h and "
      "60FFh as it is\": SDO abort 06040041h, object cannot be mapped to the PDO");
  StartupRig other;
  other.node.stuck[{0x1A00, 2}] = 0x606C0020;
  other.node.set(0x1A02, 2, 4, 0x606C0020);
  EXPECT_FALSE(other.run());
  EXPECT_EQ(other.failure(),
            "drive 3 (rear left) failed at \"read back position in 1A00h:2; nor does any of TPDO1 to TPDO4 hold 6041h "
            "and 6064h as it is\": unexpected value 606C0020h");
}

TEST(PdoMapping, IsToldByTheNameOfEachStepWhenNothingElseWillDo) {
  const StartupSteps steps = startup_steps(test_robot(), Wheel::kRearLeft);
  int tried = 0;
  for (const StartupStep& step : steps) {
    if (step.role == PdoRole::kNone || step.may_refuse) {
      continue;
    }
    StartupRig rig;
    rig.node.set(0x1603, 2, 4, 0x607A0020);
    rig.node.set(0x1A02, 2, 4, 0x606C0020);
    const Key key{step.object.index, step.object.sub};
    const bool reads = step.action == StepAction::kVerify || step.action == StepAction::kDisablePdo;
    (reads ? rig.node.refused_reads : rig.node.refused_writes)[key] = SdoAbort::kHardware;
    EXPECT_FALSE(rig.run()) << step.name;
    EXPECT_NE(rig.failure().find("; nor does any of "), std::string::npos) << rig.failure();
    EXPECT_NE(rig.failure().find("SDO abort 06060000h"), std::string::npos) << rig.failure();
    ++tried;
  }
  EXPECT_EQ(tried, 24);
}

TEST(PdoMapping, FindsThePdosOfADriveThatAnswersLateAndInSegments) {
  StartupRig rig;
  rig.node.fixed_mapping = true;
  rig.node.answers = BareNode::Answers::kSegments;
  rig.node.delay = std::chrono::milliseconds(20);
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.startup.channels(), (PdoChannels{0x503, 0, 0x383}));
}

TEST(SharedPdo, IsMappedWithADummyForTheOtherDrive) {
  for (const Wheel wheel : kAll) {
    StartupRig rig(shared_robot(), wheel);
    ASSERT_TRUE(rig.run()) << rig.failure();
    const bool first = wheel == Wheel::kFrontLeft || wheel == Wheel::kRearLeft;
    const std::uint8_t node = rig.node.node_id();
    EXPECT_EQ(rig.node.get(0x1600, 0), 1U);
    EXPECT_EQ(rig.node.get(0x1600, 1), 0x60400010U);
    EXPECT_EQ(rig.node.get(0x1400, 1), 0x200U + node);
    EXPECT_EQ(rig.node.get(0x1601, 0), 2U);
    EXPECT_EQ(rig.node.get(0x1601, 1), first ? 0x60FF0020U : 0x00070020U);
    EXPECT_EQ(rig.node.get(0x1601, 2), first ? 0x00070020U : 0x60FF0020U);
    EXPECT_EQ(rig.node.get(0x1401, 1), node <= 2 ? 0x301U : 0x303U);
    EXPECT_EQ(rig.node.get(0x1401, 2), 1U);
    EXPECT_EQ(rig.written(0x1401, 5), std::vector<std::uint32_t>{150});
    EXPECT_EQ(rig.startup.channels(), standard_channels(shared_robot(), wheel));
  }
}

TEST(SharedPdo, TakesTheOtherDummyWhereTheDriveKnowsOnlyThat) {
  StartupRig rig(shared_robot());
  rig.node.before = [&](const hal::CanFrame& request) {
    const SdoMessage message = *parse_sdo(request);
    rig.node.dummies = message.data != 0x00070020;
    return std::vector<hal::CanFrame>{};
  };
  ASSERT_TRUE(rig.run()) << rig.failure();
  EXPECT_EQ(rig.node.get(0x1601, 2), 0x00040020U);
}

TEST(SharedPdo, IsRefusedByNameForADriveWithoutDummies) {
  StartupRig first(shared_robot(), Wheel::kRearLeft);
  first.node.dummies = false;
  EXPECT_FALSE(first.run());
  EXPECT_EQ(
      first.failure(),
      "drive 3 (rear left) failed at \"map dummy 0007h or 0004h 1601h:2, to share targets with another drive\": SDO "
      "abort 06040041h, object cannot be mapped to the PDO");
  StartupRig second(shared_robot(), Wheel::kRearRight);
  second.node.dummies = false;
  EXPECT_FALSE(second.run());
  EXPECT_EQ(second.failure(),
            "drive 4 (rear right) failed at \"map dummy 0007h or 0004h 1601h:1, to share targets with another drive\": "
            "SDO abort 06040041h, object cannot be mapped to the PDO");
}

TEST(SharedPdo, LetsFeedbackFallBackButNoCommand) {
  StartupRig feedback(shared_robot());
  feedback.node.refused_writes[{0x1A00, 0}] = SdoAbort::kReadOnly;
  ASSERT_TRUE(feedback.run()) << feedback.failure();
  EXPECT_EQ(feedback.startup.channels(), (PdoChannels{0x203, 0x303, 0x383}));
  StartupRig command(shared_robot());
  command.node.refused_writes[{0x1600, 0}] = SdoAbort::kReadOnly;
  EXPECT_FALSE(command.run());
  EXPECT_EQ(command.failure(),
            "drive 3 (rear left) failed at \"clear RPDO1 mapping 1600h:0\": SDO abort 06010002h, attempt to write a "
            "read-only object");
}

}  // namespace
}  // namespace ivo::drivers
