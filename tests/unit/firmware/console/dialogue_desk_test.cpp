// What clients may want of the run, in every mode, and what it does to what was agreed.
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "firmware/console/console_desk.hpp"
#include "firmware/loop/loop_status.hpp"

namespace ivo::firmware::console {
namespace {

constexpr std::array<Mode, kModes> kAllModes{Mode::kPlanning, Mode::kStarting, Mode::kAwaitingConsent, Mode::kSearching,
                                             Mode::kStopping, Mode::kDone,     Mode::kFault,           Mode::kPausing};

/// Agent 0 is the robot, 1 is a person who is reported, 2 one who is not.
class DialogueDeskTest : public testing::Test {
 protected:
  DialogueDeskTest() {
    status_.agents = 3;
    status_.plan_number = 1;
    status_.horizon_s = 60;
    status_.mode = static_cast<std::uint8_t>(Mode::kPlanning);
  }
  Verdict submit(Kind kind, std::uint32_t argument = 0) {
    return desk_.submit(Command{.header = {.kind = kind}, .question = desk_.status().question, .argument = argument});
  }
  Verdict put_area(std::uint8_t slot) {
    AreaCommand area;
    area.slot = slot;
    area.corners = 3;
    area.corner[0] = {1, 1};
    area.corner[1] = {5, 1};
    area.corner[2] = {1, 5};
    return desk_.submit(area);
  }
  Verdict report(std::uint8_t agent, double x_m = 3, double y_m = 4) {
    PoseCommand pose;
    pose.agent = agent;
    pose.x_m = x_m;
    pose.y_m = y_m;
    return desk_.submit(pose);
  }
  void show(Mode mode, Asks asks = Asks::kNothing) {
    status_.mode = static_cast<std::uint8_t>(mode);
    desk_.show(status_, asks);
  }
  /// A plan is shown, and somebody is asked to agree to it.
  void ask_for_consent() {
    status_.plan_ready = 1;
    show(Mode::kAwaitingConsent, Asks::kConsent);
  }

  Status status_;
  int stops_ = 0;
  int pauses_ = 0;
  int beats_ = 0;
  ConsoleDesk desk_{{.agents = 3, .width_m = 20, .height_m = 10},
                    {false, true, false},
                    {.stop = [this] { ++stops_; }, .pause = [this] { ++pauses_; }, .beat = [this] { ++beats_; }}};
};

TEST_F(DialogueDeskTest, StopPauseAndBeatAreHeardAtOnceInEveryMode) {
  int expected = 0;
  for (const Mode mode : kAllModes) {
    for (const Asks asks : {Asks::kNothing, Asks::kConsent, Asks::kClearing}) {
      show(mode, asks);
      ++expected;
      EXPECT_EQ(submit(Kind::kStop), Verdict::kAccepted);
      EXPECT_EQ(submit(Kind::kPause), Verdict::kAccepted);
      EXPECT_EQ(submit(Kind::kBeat), Verdict::kAccepted);
      EXPECT_EQ(stops_, expected);
      EXPECT_EQ(pauses_, expected);
      EXPECT_EQ(beats_, expected);
    }
  }
  EXPECT_TRUE(desk_.requests().empty());
}

TEST_F(DialogueDeskTest, APlanMayBeWantedInEveryModeInWhichTheSearchGoesOn) {
  for (const Kind kind : {Kind::kInit, Kind::kReplan}) {
    for (const Mode mode : kAllModes) {
      const bool fits = mode != Mode::kStopping && mode != Mode::kDone && mode != Mode::kFault;
      show(mode);
      const std::uint32_t argument = kind == Kind::kReplan ? desk_.status().areas_revision : 0;
      EXPECT_EQ(submit(kind, argument), fits ? Verdict::kAccepted : Verdict::kNotNow) << name_of(mode);
      const std::vector<DeskRequest> requests = desk_.requests();
      ASSERT_EQ(requests.size(), fits ? 1U : 0U) << name_of(mode);
      EXPECT_TRUE(!fits || requests[0].kind == kind);
      EXPECT_TRUE(desk_.requests().empty()) << "once";
    }
  }
}

TEST_F(DialogueDeskTest, NoPlanMayBeWantedOnceTheSearchIsOverOrWhileOneIsPrepared) {
  status_.search = static_cast<std::uint8_t>(SearchState::kFound);
  show(Mode::kAwaitingConsent);
  EXPECT_EQ(submit(Kind::kInit), Verdict::kNotNow);
  status_.search = 0;
  status_.finished = 1;
  show(Mode::kAwaitingConsent);
  EXPECT_EQ(submit(Kind::kInit), Verdict::kNotNow);
  status_.finished = 0;
  status_.preparing = 1;
  show(Mode::kAwaitingConsent);
  EXPECT_EQ(submit(Kind::kInit), Verdict::kNotNow);
  status_.preparing = 0;
  show(Mode::kAwaitingConsent);
  EXPECT_EQ(submit(Kind::kInit), Verdict::kAccepted);
}

TEST_F(DialogueDeskTest, OneWishForAPlanWaitsAtATime) {
  show(Mode::kSearching);
  EXPECT_EQ(submit(Kind::kInit), Verdict::kAccepted);
  EXPECT_EQ(submit(Kind::kInit), Verdict::kNotNow);
  EXPECT_EQ(submit(Kind::kReplan, 1), Verdict::kNotNow);
  EXPECT_EQ(desk_.requests().size(), 1U);
  show(Mode::kSearching);
  EXPECT_EQ(submit(Kind::kReplan, 1), Verdict::kAccepted) << "it was taken, and is over";
}

TEST_F(DialogueDeskTest, AWishForAPlanVoidsConsentAtOnce) {
  ask_for_consent();
  const std::uint32_t question = desk_.status().question;
  ASSERT_EQ(submit(Kind::kConsent), Verdict::kAccepted);
  ASSERT_EQ(submit(Kind::kAccept, 1), Verdict::kAccepted);
  ASSERT_EQ(submit(Kind::kReplan, 1), Verdict::kAccepted);
  EXPECT_EQ(desk_.take(Asks::kConsent), std::nullopt) << "given, and not taken in time";
  EXPECT_EQ(desk_.status().asks, Asks::kNothing);
  EXPECT_EQ(desk_.status().preparing, 1);
  EXPECT_EQ(desk_.status().accepted, 0);
  EXPECT_EQ(submit(Kind::kConsent), Verdict::kNotAsked);
  EXPECT_EQ(submit(Kind::kAccept, 1), Verdict::kNotNow);
  // The run has not seen the wish yet, and asks on.
  show(Mode::kAwaitingConsent, Asks::kConsent);
  EXPECT_EQ(desk_.status().asks, Asks::kNothing);
  EXPECT_EQ(desk_.status().preparing, 1);
  EXPECT_EQ(submit(Kind::kConsent), Verdict::kNotAsked);
  ASSERT_EQ(desk_.requests().size(), 1U);
  show(Mode::kAwaitingConsent, Asks::kConsent);
  EXPECT_EQ(desk_.status().question, question + 1);
  EXPECT_EQ(submit(Kind::kConsent), Verdict::kAccepted) << "to the new question";
}

TEST_F(DialogueDeskTest, APauseVoidsAnswersAndAcceptance) {
  ask_for_consent();
  const std::uint32_t question = desk_.status().question;
  ASSERT_EQ(submit(Kind::kConsent), Verdict::kAccepted);
  ASSERT_EQ(submit(Kind::kAccept, 1), Verdict::kAccepted);
  ASSERT_EQ(submit(Kind::kPause), Verdict::kAccepted);
  EXPECT_EQ(desk_.take(Asks::kConsent), std::nullopt);
  EXPECT_EQ(desk_.status().asks, Asks::kNothing);
  EXPECT_EQ(desk_.status().accepted, 0);
  ask_for_consent();
  EXPECT_EQ(desk_.status().question, question + 1) << "asked anew";
  EXPECT_EQ(desk_.take(Asks::kConsent), std::nullopt);
  EXPECT_EQ(submit(Kind::kConsent), Verdict::kAccepted);
}

TEST_F(DialogueDeskTest, APauseLeavesTheQuestionWhetherAFaultIsToBeCleared) {
  show(Mode::kFault, Asks::kClearing);
  const std::uint32_t question = desk_.status().question;
  ASSERT_EQ(submit(Kind::kPause), Verdict::kAccepted);
  EXPECT_EQ(desk_.status().asks, Asks::kClearing);
  show(Mode::kFault, Asks::kClearing);
  EXPECT_EQ(desk_.status().question, question);
  EXPECT_EQ(submit(Kind::kClearFault), Verdict::kAccepted);
}

TEST_F(DialogueDeskTest, AReplanHeedsTheAreasThatWereSeenOrIsOutdated) {
  show(Mode::kAwaitingConsent);
  EXPECT_EQ(submit(Kind::kReplan, 0), Verdict::kOutdated);
  EXPECT_EQ(submit(Kind::kReplan, 2), Verdict::kOutdated);
  ASSERT_EQ(put_area(0), Verdict::kAccepted);
  EXPECT_EQ(desk_.status().areas_revision, 2U) << "at once";
  EXPECT_EQ(submit(Kind::kReplan, 1), Verdict::kOutdated) << "somebody has drawn meanwhile";
  ASSERT_EQ(submit(Kind::kRemoveArea, 0), Verdict::kAccepted);
  EXPECT_EQ(desk_.status().areas_revision, 3U);
  EXPECT_EQ(submit(Kind::kReplan, 2), Verdict::kOutdated);
  EXPECT_TRUE(desk_.requests().empty());
  EXPECT_EQ(submit(Kind::kReplan, 3), Verdict::kAccepted);
}

TEST_F(DialogueDeskTest, EnoughIsAboutThePlanThatIsMadeAndOnlyOnceThereIsOne) {
  for (const Mode mode : kAllModes) {
    show(mode);
    const bool fits = mode == Mode::kPlanning;
    EXPECT_EQ(submit(Kind::kEnough, 1), fits ? Verdict::kAccepted : Verdict::kNotNow) << name_of(mode);
    EXPECT_EQ(submit(Kind::kEnough, 2), Verdict::kOutdated) << name_of(mode);
    EXPECT_EQ(desk_.requests().size(), fits ? 1U : 0U);
  }
  status_.horizon_s = 0;
  show(Mode::kPlanning);
  EXPECT_EQ(submit(Kind::kEnough, 1), Verdict::kNotNow) << "there is none yet";
  status_.horizon_s = 60;
  status_.preparing = 1;
  show(Mode::kPlanning);
  EXPECT_EQ(submit(Kind::kEnough, 1), Verdict::kNotNow) << "it is the one before";
}

TEST_F(DialogueDeskTest, FoundIsHeardInEveryModeWhileTheSearchRuns) {
  for (const bool started : {false, true}) {
    status_.search_started = started ? 1 : 0;
    for (const Mode mode : kAllModes) {
      show(mode);
      EXPECT_EQ(submit(Kind::kFound, 2), started ? Verdict::kAccepted : Verdict::kNotNow) << name_of(mode);
      EXPECT_EQ(submit(Kind::kFound, 3), Verdict::kOutOfRange) << "nobody";
      EXPECT_EQ(desk_.requests().size(), started ? 1U : 0U);
    }
  }
  status_.search = static_cast<std::uint8_t>(SearchState::kFound);
  show(Mode::kStopping);
  EXPECT_EQ(submit(Kind::kFound, 1), Verdict::kNotNow) << "it is found";
}

TEST_F(DialogueDeskTest, AcceptIsOfThePlanThatIsShownUntilThereIsAnother) {
  show(Mode::kPlanning);
  EXPECT_EQ(submit(Kind::kAccept, 1), Verdict::kNotNow) << "not planned to its end";
  ask_for_consent();
  EXPECT_EQ(submit(Kind::kAccept, 2), Verdict::kOutdated);
  EXPECT_EQ(submit(Kind::kAccept, 0), Verdict::kOutdated);
  EXPECT_EQ(desk_.status().accepted, 0);
  EXPECT_EQ(submit(Kind::kAccept, 1), Verdict::kAccepted);
  EXPECT_EQ(desk_.status().accepted, 1);
  ask_for_consent();
  EXPECT_EQ(desk_.status().accepted, 1) << "a new status changes nothing";
  EXPECT_EQ(desk_.take(Asks::kConsent), std::nullopt) << "to accept is not to consent";
  status_.plan_number = 2;
  ask_for_consent();
  EXPECT_EQ(desk_.status().accepted, 0);
}

TEST_F(DialogueDeskTest, SaysWhetherAConsentIsWatched) {
  for (const std::uint32_t watched : {0U, 1U}) {
    show(Mode::kStarting);
    ask_for_consent();
    ASSERT_EQ(submit(Kind::kAccept, 1), Verdict::kAccepted);
    ASSERT_EQ(submit(Kind::kConsent, watched), Verdict::kAccepted);
    const std::optional<DeskAnswer> answer = desk_.take(Asks::kConsent);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->kind, Kind::kConsent);
    EXPECT_EQ(answer->watched, watched == 1);
  }
}

TEST_F(DialogueDeskTest, AWatchedConsentIsToAPlanThatWasAcceptedAndNotStoppedSince) {
  ask_for_consent();
  EXPECT_EQ(submit(Kind::kConsent, 1), Verdict::kNotNow);
  ASSERT_EQ(submit(Kind::kAccept, 1), Verdict::kAccepted);
  ASSERT_EQ(submit(Kind::kPause), Verdict::kAccepted);
  ask_for_consent();
  EXPECT_EQ(submit(Kind::kConsent, 1), Verdict::kNotNow);
  EXPECT_EQ(desk_.take(Asks::kConsent), std::nullopt);
  ASSERT_EQ(submit(Kind::kAccept, 1), Verdict::kAccepted);
  EXPECT_EQ(submit(Kind::kConsent, 1), Verdict::kAccepted);
}

TEST_F(DialogueDeskTest, NobodyAgreesToAWayIntoANoGoArea) {
  ask_for_consent();
  ASSERT_EQ(submit(Kind::kAccept, 1), Verdict::kAccepted);
  status_.into_no_go = 1;
  ask_for_consent();
  EXPECT_EQ(submit(Kind::kConsent), Verdict::kOutdated);
  EXPECT_EQ(submit(Kind::kConsent, 1), Verdict::kOutdated);
  EXPECT_EQ(submit(Kind::kAccept, 1), Verdict::kOutdated);
  EXPECT_EQ(submit(Kind::kNoConsent), Verdict::kAccepted);
}

TEST_F(DialogueDeskTest, AreasMayBeDrawnInEveryModeAndARefusedOneChangesNothing) {
  std::uint32_t revision = 1;
  for (const Mode mode : kAllModes) {
    show(mode);
    EXPECT_EQ(put_area(31), Verdict::kAccepted) << name_of(mode);
    EXPECT_EQ(desk_.status().areas_revision, ++revision);
  }
  AreaCommand line;
  line.corners = 3;
  line.corner[1] = {1, 1};
  line.corner[2] = {2, 2};
  EXPECT_EQ(desk_.submit(line), Verdict::kNotAnArea);
  EXPECT_EQ(desk_.areas().revision(), revision);
  EXPECT_FALSE(desk_.areas().slots()[0]);
  EXPECT_TRUE(desk_.areas().slots()[31]);
}

TEST_F(DialogueDeskTest, TakesPosesOfThoseWhoAreReportedAndOfNobodyElse) {
  for (const Mode mode : kAllModes) {
    show(mode);
    EXPECT_EQ(report(1), Verdict::kAccepted) << name_of(mode);
    EXPECT_EQ(report(0), Verdict::kNotNow) << "the robot knows better";
    EXPECT_EQ(report(2), Verdict::kNotNow) << "simulated";
    EXPECT_EQ(report(3), Verdict::kOutOfRange) << "nobody";
    EXPECT_EQ(desk_.poses().size(), 1U);
    EXPECT_TRUE(desk_.poses().empty()) << "once";
  }
}

TEST_F(DialogueDeskTest, TakesPosesOnTheMapAloneAndOfEachTheNewest) {
  EXPECT_EQ(report(1, -0.01, 4), Verdict::kOutOfRange);
  EXPECT_EQ(report(1, 3, -0.01), Verdict::kOutOfRange);
  EXPECT_EQ(report(1, 20.01, 4), Verdict::kOutOfRange);
  EXPECT_EQ(report(1, 3, 10.01), Verdict::kOutOfRange);
  EXPECT_TRUE(desk_.poses().empty());
  EXPECT_EQ(report(1, 0, 0), Verdict::kAccepted);
  EXPECT_EQ(report(1, 20, 10), Verdict::kAccepted);
  const std::vector<PoseCommand> poses = desk_.poses();
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].x_m, 20);
}

TEST_F(DialogueDeskTest, ARunThatTakesNothingIsAskedForNoMoreThanItWillEverNeed) {
  status_.search_started = 1;
  show(Mode::kSearching);
  int accepted = 0;
  for (int i = 0; i < 1000; ++i) {
    accepted += submit(Kind::kFound, 1) == Verdict::kAccepted ? 1 : 0;
  }
  EXPECT_EQ(submit(Kind::kFound, 1), Verdict::kTooOften);
  EXPECT_EQ(desk_.requests().size(), static_cast<std::size_t>(accepted));
  EXPECT_LE(accepted, 16);
}

}  // namespace
}  // namespace ivo::firmware::console
