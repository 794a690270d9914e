// The group with drives of several kinds: those that can be mapped, those that cannot, those that share their targets.
#include <gtest/gtest.h>

#include "drivers/drive_fault_text.hpp"
#include "drivers/eds/shipped_eds.hpp"
#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {
namespace {

using std::chrono::milliseconds;

void expect_to_turn(Rig& rig) {
  rig.targets.radps = {2.0, 3.0, -2.0, 4.0};
  ASSERT_TRUE(rig.enable_all()) << describe(rig.feedback.fault);
  rig.run(milliseconds(500));
  ASSERT_EQ(rig.feedback.state, GroupState::kEnabled) << describe(rig.feedback.fault);
  for (std::size_t i = 0; i < kWheels; ++i) {
    EXPECT_NEAR(rig.feedback.radps[i], rig.targets.radps[i], 0.05) << i;
  }
  rig.enable = false;
  ASSERT_TRUE(rig.run_until(GroupState::kReady)) << describe(rig.feedback.fault);
  EXPECT_TRUE(all_at_rest(rig));
}

TEST(DriveGroupWith, DrivesWhoseMappingIsFixedTurnsThem) {
  Rig rig({}, test_robot(), SimDrives::TimeFrom::kClock, fixed_mapping_drive_eds());
  expect_to_turn(rig);
}

TEST(DriveGroupWith, SharedTargetsTurnsEachByItsOwn) {
  Robot robot = test_robot();
  robot.pdo_layout = PdoLayout::kShared;
  Rig rig({}, robot);
  expect_to_turn(rig);
}

TEST(DriveGroupWith, AMappingThatIsFixedOtherwiseNamesTheDriveAndTheStep) {
  Robot robot = test_robot();
  robot.pdo_layout = PdoLayout::kShared;
  Rig rig({}, robot, SimDrives::TimeFrom::kClock, fixed_mapping_drive_eds());
  ASSERT_TRUE(rig.run_until(GroupState::kFault));
  EXPECT_EQ(rig.feedback.fault.reason, DriveFaultReason::kSdoAborted) << describe(rig.feedback.fault);
  EXPECT_NE(describe(rig.feedback.fault).find("RPDO"), std::string::npos) << describe(rig.feedback.fault);
}

TEST(DriveGroupWith, SlowAnswersAndStringsInPlaceOfNumbersStartsAllTheSame) {
  SimScript slow;
  ASSERT_TRUE(slow.events.push_back({.fault = SimFault::kSlowSdo, .value = 20}));
  SimScript segmented;
  ASSERT_TRUE(segmented.events.push_back({.fault = SimFault::kSdoSegmented}));
  SimScript unsized;
  ASSERT_TRUE(unsized.events.push_back({.fault = SimFault::kSdoNoSize}));
  Rig rig({slow, segmented, unsized, SimScript()});
  expect_to_turn(rig);
}

}  // namespace
}  // namespace ivo::drivers
