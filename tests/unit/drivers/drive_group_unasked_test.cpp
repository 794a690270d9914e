// Drives that change their power state unasked while none should move yet.
#include <gtest/gtest.h>

#include "drivers/drive_fault_text.hpp"
#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {
namespace {

using std::chrono::milliseconds;

/// From now on the rear left drive's feedback is what is injected.
class UnaskedState : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(rig_.run_until(GroupState::kReady));
    rig_.run(milliseconds(20));
  }
  void say(std::uint8_t statusword) {
    rig_.drives.drive(Wheel::kRearLeft).script().feedback_lost_from = Instant{};
    rig_.inject({.id = 0x183, .size = 6, .data = {statusword, 0x02}});
    rig_.cycle();
  }
  void expect_latched() {
    EXPECT_EQ(rig_.feedback.state, GroupState::kFault);
    EXPECT_EQ(rig_.feedback.fault.reason, DriveFaultReason::kUnaskedState) << describe(rig_.feedback.fault);
    EXPECT_EQ(rig_.feedback.fault.node_id, 3);
    expect_stopped_command(rig_);
  }
  Rig rig_;
};

TEST_F(UnaskedState, PowerInReadyIsAFaultAfterATenthOfASecond) {
  for (const int statusword : {0x33, 0x37, 0x17}) {
    Rig rig;
    ASSERT_TRUE(rig.run_until(GroupState::kReady));
    rig.drives.drive(Wheel::kRearLeft).script().feedback_lost_from = Instant{};
    for (int i = 0; i <= 50; ++i) {
      EXPECT_EQ(rig.feedback.state, GroupState::kReady) << i;
      rig.inject({.id = 0x183, .size = 6, .data = {static_cast<std::uint8_t>(statusword), 0x02}});
      rig.cycle();
    }
    EXPECT_EQ(rig.feedback.state, GroupState::kFault) << statusword;
    EXPECT_EQ(rig.feedback.fault.reason, DriveFaultReason::kUnaskedState);
    EXPECT_EQ(rig.feedback.fault.node_id, 3);
  }
}

TEST_F(UnaskedState, PowerInReadyForAMomentIsForgiven) {
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < 40; ++i) {
      say(0x37);
      EXPECT_FALSE(rig_.feedback.off);
    }
    say(0x50);
  }
  EXPECT_EQ(rig_.feedback.state, GroupState::kReady);
}

TEST_F(UnaskedState, BeyondTheFirstStepOfEnablingIsAFaultAtOnce) {
  rig_.enable = true;
  say(0x50);
  ASSERT_EQ(rig_.group.update(rig_.clock.now()).state, GroupState::kEnabling);
  say(0x33);
  expect_latched();
}

TEST_F(UnaskedState, BeyondTheSecondStepOfEnablingIsAFaultAtOnce) {
  rig_.enable = true;
  say(0x31);
  say(0x31);
  say(0x31);
  say(0x31);
  ASSERT_EQ(rig_.feedback.state, GroupState::kEnabling);
  say(0x37);
  expect_latched();
}

TEST_F(UnaskedState, FallingBackWhileEnablingIsAFaultAtOnce) {
  rig_.enable = true;
  for (int i = 0; i < 6; ++i) {
    say(0x31);
  }
  for (int i = 0; i < 2; ++i) {
    say(0x33);
  }
  ASSERT_EQ(rig_.feedback.state, GroupState::kEnabling);
  say(0x50);
  expect_latched();
}

}  // namespace
}  // namespace ivo::drivers
