#include "firmware/tools/consent_state.hpp"

#include <gtest/gtest.h>

namespace ivo::firmware {
namespace {

LoopStatus in(Mode mode, bool stop_pressed = false) {
  LoopStatus status;
  status.mode = mode;
  if (stop_pressed) {
    status.stop_held.reason = drivers::DriveFaultReason::kStopInput;
  }
  return status;
}

TEST(ConsentState, AQuestionIsPutOnce) {
  ConsentState consent(false);
  EXPECT_FALSE(consent.withdrawn_by(in(Mode::kStarting))) << "there is nothing to withdraw";
  EXPECT_FALSE(consent.withdrawn_by(in(Mode::kAwaitingConsent)));
  EXPECT_TRUE(consent.ask());
  EXPECT_FALSE(consent.withdrawn_by(in(Mode::kAwaitingConsent)));
  EXPECT_FALSE(consent.ask());
}

TEST(ConsentState, AQuestionThatIsOpenWhenTheEmergencyStopIsPressedIsPutAnewWhenItIsReleased) {
  ConsentState consent(false);
  ASSERT_TRUE(consent.ask());
  EXPECT_TRUE(consent.withdrawn_by(in(Mode::kStarting, true)));
  EXPECT_FALSE(consent.withdrawn_by(in(Mode::kStarting, true))) << "once";
  EXPECT_FALSE(consent.withdrawn_by(in(Mode::kAwaitingConsent)));
  EXPECT_TRUE(consent.ask());
}

TEST(ConsentState, AnAnswerToARobotThatIsNotReadyAnyMoreIsVoid) {
  ConsentState consent(false);
  ASSERT_TRUE(consent.ask());
  consent.answer(true);
  EXPECT_TRUE(consent.answered());
  EXPECT_TRUE(consent.withdrawn_by(in(Mode::kStarting)));
  EXPECT_FALSE(consent.answered());
  EXPECT_TRUE(consent.ask());
}

TEST(ConsentState, AStopThatIsPressedAndReleasedBeforeAnybodyLooksVoidsWhatWasAskedToo) {
  ConsentState consent(false);
  LoopStatus status = in(Mode::kAwaitingConsent);
  status.times_ready = 1;
  EXPECT_FALSE(consent.withdrawn_by(status));
  ASSERT_TRUE(consent.ask());
  EXPECT_FALSE(consent.withdrawn_by(status));
  status.times_ready = 2;
  EXPECT_TRUE(consent.withdrawn_by(status));
  EXPECT_FALSE(consent.withdrawn_by(status)) << "once";
  EXPECT_TRUE(consent.ask());
}

TEST(ConsentState, AnAnswerThatTheLoopHadNoRoomForIsGivenAgain) {
  ConsentState consent(true);
  consent.answer(false);
  EXPECT_FALSE(consent.answered());
}

TEST(ConsentState, ConsentBeforehandIsVoidOnceAStopWasPressedAfterThePlanWasThere) {
  for (const Mode mode : {Mode::kStarting, Mode::kAwaitingConsent, Mode::kSearching, Mode::kFault}) {
    ConsentState consent(true);
    EXPECT_FALSE(consent.withdrawn_by(in(Mode::kPlanning, true)));
    EXPECT_TRUE(consent.beforehand()) << "released before there was a plan";
    (void)consent.withdrawn_by(in(mode, true));
    (void)consent.withdrawn_by(in(Mode::kAwaitingConsent));
    EXPECT_FALSE(consent.beforehand()) << static_cast<int>(mode);
  }
}

TEST(ConsentState, ConsentBeforehandIsForTheTimeBeforeAFault) {
  ConsentState consent(true);
  consent.answer(true);
  EXPECT_FALSE(consent.after_fault());
  consent.fault_cleared();
  EXPECT_FALSE(consent.beforehand());
  EXPECT_FALSE(consent.answered());
  EXPECT_TRUE(consent.after_fault());
  EXPECT_TRUE(consent.ask());
}

}  // namespace
}  // namespace ivo::firmware
