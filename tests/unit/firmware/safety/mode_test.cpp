#include "firmware/safety/mode.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>

#include "config/rates.hpp"

namespace ivo::firmware {
namespace {

using namespace condition;

constexpr std::array<Mode, kModes> kEveryMode{Mode::kPlanning,  Mode::kStarting, Mode::kAwaitingConsent,
                                              Mode::kSearching, Mode::kStopping, Mode::kDone,
                                              Mode::kFault,     Mode::kPausing};

/// Calls visit(mode, conditions, next) for the whole table.
template <class Visit>
void walk(Visit visit) {
  for (const Mode mode : kEveryMode) {
    for (Conditions set = 0; set <= kAll; ++set) {
      SCOPED_TRACE(std::string(name_of(mode)) + " with conditions " + std::to_string(set));
      visit(mode, set, next_mode(mode, set));
      if (testing::Test::HasFailure()) {
        return;
      }
    }
  }
}

bool has(Conditions set, Conditions bit) { return (set & bit) != 0; }
bool moves(Mode mode) { return permissions(mode).may_move; }

TEST(ModeTable, LeadsNowhereFromDone) {
  walk([](Mode mode, Conditions, Mode next) {
    if (mode == Mode::kDone) {
      ASSERT_EQ(next, mode);
    }
  });
}

TEST(ModeTable, LeadsFromFaultOnlyByAnOperatorWithTheFaultGoneAndToNoMotion) {
  walk([](Mode mode, Conditions set, Mode next) {
    if (mode == Mode::kFault && next != mode) {
      ASSERT_TRUE(has(set, kClearAsked));
      ASSERT_FALSE(has(set, kDrivesFault) || has(set, kStopAsked));
      ASSERT_EQ(next, Mode::kStarting);
    }
  });
}

TEST(ModeTable, LeadsToMotionOnlyByConsentToAShownPlanWithDrivesReady) {
  walk([](Mode mode, Conditions set, Mode next) {
    if (moves(next) && !moves(mode)) {
      ASSERT_EQ(mode, Mode::kAwaitingConsent);
      ASSERT_EQ(next, Mode::kSearching);
      ASSERT_TRUE(has(set, kConsent) && has(set, kPlanReady) && has(set, kDrivesReady));
      ASSERT_FALSE(has(set, kStopAsked) || has(set, kDrivesFault));
    }
  });
}

TEST(ModeTable, LeadsToFaultFromEveryLivingModeWhenADriveFails) {
  walk([](Mode mode, Conditions set, Mode next) {
    if (has(set, kDrivesFault) && mode != Mode::kDone) {
      ASSERT_EQ(next, Mode::kFault);
    }
  });
}

TEST(ModeTable, NeverSearchesOnOnceAStopIsAsked) {
  walk([](Mode, Conditions set, Mode next) {
    if (has(set, kStopAsked)) {
      ASSERT_NE(next, Mode::kSearching);
    }
  });
}

TEST(ModeTable, NeverGoesBackToSearching) {
  walk([](Mode mode, Conditions, Mode next) {
    if (mode == Mode::kStopping) {
      ASSERT_NE(next, Mode::kSearching);
      ASSERT_TRUE(next == Mode::kStopping || next == Mode::kDone || next == Mode::kFault);
    }
  });
}

TEST(ModeTable, NeverSearchesOnOnceAPauseIsAsked) {
  walk([](Mode mode, Conditions set, Mode next) {
    if (mode == Mode::kSearching && has(set, kPauseAsked)) {
      ASSERT_TRUE(next == Mode::kPausing || next == Mode::kStopping || next == Mode::kFault);
    }
  });
}

TEST(ModeTable, PausesOnlyASearchAndOnlyWhenAskedTo) {
  walk([](Mode mode, Conditions set, Mode next) {
    if (next == Mode::kPausing && mode != next) {
      ASSERT_EQ(mode, Mode::kSearching);
      ASSERT_TRUE(has(set, kPauseAsked));
    }
    if (mode != Mode::kSearching) {
      ASSERT_EQ(next, next_mode(mode, set & ~kPauseAsked)) << "elsewhere nothing moves that could pause";
    }
  });
}

TEST(ModeTable, LeadsFromPausingToStandstillAndNotBackToTheSearch) {
  walk([](Mode mode, Conditions set, Mode next) {
    if (mode == Mode::kPausing) {
      ASSERT_TRUE(ramps_down(next) || !moves(next));
      ASSERT_TRUE(next != Mode::kStarting || has(set, kStandstill));
      ASSERT_FALSE(next == Mode::kAwaitingConsent || next == Mode::kPlanning || next == Mode::kDone);
      ASSERT_EQ(next, next_mode(mode, set & ~kConsent)) << "consent counts for nothing before the robot stands";
      ASSERT_EQ(next, next_mode(mode, set | kPauseAsked)) << "to ask twice changes nothing";
    }
  });
}

TEST(ModeTable, LeadsFromPausingToMotionByConsentAlone) {
  std::set<Mode> reached{Mode::kPausing};
  for (std::size_t before = 0; before != reached.size();) {
    before = reached.size();
    walk([&](Mode mode, Conditions set, Mode next) {
      if (reached.contains(mode) && !has(set, kConsent)) {
        reached.insert(next);
      }
    });
  }
  EXPECT_FALSE(reached.contains(Mode::kSearching));
  EXPECT_TRUE(reached.contains(Mode::kAwaitingConsent)) << "where it can be given";
}

TEST(ModeTable, APauseEndsWithTheRunOnceAStopIsAskedOrTheSearchHasEnded) {
  walk([](Mode mode, Conditions set, Mode next) {
    if (mode == Mode::kPausing && (has(set, kStopAsked) || has(set, kSearchEnded))) {
      ASSERT_TRUE(next == Mode::kStopping || next == Mode::kFault);
    }
  });
}

TEST(ModeTable, ASearchThatEndsWhereNothingMovesIsDone) {
  walk([](Mode mode, Conditions set, Mode next) {
    if ((mode == Mode::kPlanning || mode == Mode::kStarting || mode == Mode::kAwaitingConsent) &&
        has(set, kSearchEnded) && !has(set, kDrivesFault)) {
      ASSERT_EQ(next, Mode::kDone);
    }
  });
}

TEST(ModeTable, ReachesFaultOnlyByAFaultLostPowerOrALateStop) {
  walk([](Mode mode, Conditions set, Mode next) {
    if (next == Mode::kFault && mode != Mode::kFault) {
      ASSERT_TRUE(has(set, kDrivesFault | kPowerLost | kStopOverdue) || !has(set, kDrivesReady));
    }
  });
}

TEST(ModeTable, EndsDoneOnlyWithTheWheelsAtRestOrNeverMoved) {
  walk([](Mode mode, Conditions set, Mode next) {
    if (next == Mode::kDone && moves(mode)) {
      ASSERT_TRUE(has(set, kStandstill));
    }
  });
}

TEST(ModeTable, HasNoRowThatNeverDecides) {
  std::set<const Transition*> deciding;
  walk([&](Mode mode, Conditions set, Mode) {
    for (const Transition& row : transitions()) {
      if (row.from == mode && (set & row.all_of) == row.all_of && (set & row.none_of) == 0) {
        deciding.insert(&row);
        return;
      }
    }
  });
  EXPECT_EQ(deciding.size(), transitions().size());
}

TEST(ModeTable, PermitsMotionOnlyWithDrivesOn) {
  for (const Mode mode : kEveryMode) {
    const Permissions p = permissions(mode);
    EXPECT_EQ(p.may_move, p.enable_drives) << name_of(mode);
    EXPECT_EQ(p.may_move, mode == Mode::kSearching || ramps_down(mode)) << name_of(mode);
    EXPECT_EQ(p.think, mode == Mode::kPlanning) << name_of(mode);
  }
}

TEST(ModeTable, NamesEveryModeDifferently) {
  std::set<std::string_view> names;
  for (const Mode mode : kEveryMode) {
    names.insert(name_of(mode));
  }
  EXPECT_EQ(names.size(), kEveryMode.size());
}

class ModeMachineTest : public testing::Test {
 protected:
  Mode step() {
    now_ += rates::kCycle;
    return machine_.update(in_, now_);
  }
  void search() {
    in_.plan_ready = true;
    in_.drives_ready = true;
    ASSERT_EQ(step(), Mode::kAwaitingConsent);
    in_.consent_given = true;
    ASSERT_EQ(step(), Mode::kSearching);
    in_.drives_enabled = true;
    ASSERT_EQ(step(), Mode::kSearching);
  }
  ModeMachine machine_;
  ModeInputs in_;
  Instant now_{};
};

TEST_F(ModeMachineTest, PlansFirstAndStandsStill) {
  EXPECT_EQ(machine_.mode(), Mode::kPlanning);
  EXPECT_EQ(step(), Mode::kPlanning);
}

TEST_F(ModeMachineTest, PlansOnWhileTheDrivesAreReadyFirst) {
  in_.drives_ready = true;
  EXPECT_EQ(step(), Mode::kPlanning);
  in_.plan_ready = true;
  EXPECT_EQ(step(), Mode::kAwaitingConsent);
}

TEST_F(ModeMachineTest, WaitsForTheDrivesWhenThePlanIsReadyFirst) {
  in_.plan_ready = true;
  EXPECT_EQ(step(), Mode::kStarting);
  EXPECT_EQ(step(), Mode::kStarting);
  in_.drives_ready = true;
  EXPECT_EQ(step(), Mode::kAwaitingConsent);
}

TEST_F(ModeMachineTest, IgnoresConsentGivenBeforeThePlanIsShown) {
  in_.consent_given = true;
  EXPECT_EQ(step(), Mode::kPlanning);
  in_.plan_ready = true;
  in_.drives_ready = true;
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(step(), Mode::kAwaitingConsent);
  }
  in_.consent_given = false;
  EXPECT_EQ(step(), Mode::kAwaitingConsent);
  in_.consent_given = true;
  EXPECT_EQ(step(), Mode::kSearching);
}

TEST_F(ModeMachineTest, IgnoresConsentGivenWhileTheDrivesStart) {
  in_.plan_ready = true;
  EXPECT_EQ(step(), Mode::kStarting);
  in_.consent_given = true;
  EXPECT_EQ(step(), Mode::kStarting);
  in_.drives_ready = true;
  EXPECT_EQ(step(), Mode::kAwaitingConsent);
  EXPECT_EQ(step(), Mode::kAwaitingConsent);
}

TEST_F(ModeMachineTest, TakesConsentOnlyInTheCycleInWhichItIsGiven) {
  in_.plan_ready = true;
  in_.drives_ready = true;
  EXPECT_EQ(step(), Mode::kAwaitingConsent);
  in_.drives_ready = false;
  in_.consent_given = true;
  EXPECT_EQ(step(), Mode::kStarting) << "agreed in the very cycle in which a drive dropped out";
  in_.drives_ready = true;
  EXPECT_EQ(step(), Mode::kAwaitingConsent);
  EXPECT_EQ(step(), Mode::kAwaitingConsent);
}

TEST_F(ModeMachineTest, PlansAgainWhenThePlanIsWithdrawnBeforeConsent) {
  in_.plan_ready = true;
  in_.drives_ready = true;
  EXPECT_EQ(step(), Mode::kAwaitingConsent);
  in_.plan_ready = false;
  EXPECT_EQ(step(), Mode::kPlanning);
}

TEST_F(ModeMachineTest, GoesToFaultFromPlanningWithNothingMoved) {
  in_.drives_fault = true;
  EXPECT_EQ(step(), Mode::kFault);
  EXPECT_FALSE(permissions(machine_.mode()).may_move);
  EXPECT_FALSE(permissions(machine_.mode()).enable_drives);
}

TEST_F(ModeMachineTest, StaysInFaultWhenTheFaultGoes) {
  in_.drives_fault = true;
  EXPECT_EQ(step(), Mode::kFault);
  in_.drives_fault = false;
  in_.plan_ready = in_.drives_ready = in_.consent_given = true;
  EXPECT_EQ(step(), Mode::kFault);
}

TEST_F(ModeMachineTest, StopsAtRestWhenTheSearchEnds) {
  search();
  in_.search_ended = true;
  EXPECT_EQ(step(), Mode::kStopping);
  EXPECT_EQ(step(), Mode::kStopping);
  in_.drives_standstill = true;
  EXPECT_EQ(step(), Mode::kDone);
  EXPECT_EQ(step(), Mode::kDone);
}

TEST_F(ModeMachineTest, StopsWhenAskedAlthoughTheWishIsTakenBack) {
  search();
  in_.stop_asked = true;
  EXPECT_EQ(step(), Mode::kStopping);
  in_.stop_asked = false;
  EXPECT_EQ(step(), Mode::kStopping);
}

TEST_F(ModeMachineTest, IsDoneAtOnceWhenStoppedBeforeItMoved) {
  in_.stop_asked = true;
  EXPECT_EQ(step(), Mode::kDone);
}

TEST_F(ModeMachineTest, SearchesOnWhileTheDrivesAreStillBeingEnabled) {
  in_.plan_ready = in_.drives_ready = true;
  step();
  in_.consent_given = true;
  EXPECT_EQ(step(), Mode::kSearching);
  EXPECT_EQ(step(), Mode::kSearching);
}

TEST_F(ModeMachineTest, TakesLostPowerForAFaultSoThatItNeverComesBackMoving) {
  search();
  in_.drives_enabled = false;
  EXPECT_EQ(step(), Mode::kFault);
  in_.drives_enabled = true;
  EXPECT_EQ(step(), Mode::kFault);
}

TEST_F(ModeMachineTest, TakesADriveThatDropsOutWhileItIsBeingEnabledForAFault) {
  in_.plan_ready = in_.drives_ready = true;
  step();
  in_.consent_given = true;
  EXPECT_EQ(step(), Mode::kSearching);
  in_.drives_ready = false;
  EXPECT_EQ(step(), Mode::kFault);
}

TEST_F(ModeMachineTest, TakesAStopThatTakesTooLongForAFault) {
  search();
  in_.stop_asked = true;
  EXPECT_EQ(step(), Mode::kStopping);
  now_ += rates::kStandstillTimeout - rates::kCycle;
  EXPECT_EQ(step(), Mode::kStopping) << "exactly at the limit";
  EXPECT_EQ(step(), Mode::kFault);
}

TEST_F(ModeMachineTest, PausesToStandstillAndGoesOnAfterConsentAnew) {
  search();
  in_.pause_asked = true;
  EXPECT_EQ(step(), Mode::kPausing);
  in_.pause_asked = false;
  EXPECT_EQ(step(), Mode::kPausing) << "nobody takes it back";
  in_.drives_standstill = true;
  EXPECT_EQ(step(), Mode::kStarting);
  in_.drives_enabled = false;
  EXPECT_EQ(step(), Mode::kAwaitingConsent);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(step(), Mode::kAwaitingConsent) << "the consent of before is still held";
  }
  in_.consent_given = false;
  step();
  in_.consent_given = true;
  EXPECT_EQ(step(), Mode::kSearching);
}

TEST_F(ModeMachineTest, WithoutAPlanItPlansAfterThePause) {
  search();
  in_.pause_asked = true;
  in_.plan_ready = false;
  EXPECT_EQ(step(), Mode::kPausing);
  in_.drives_standstill = true;
  EXPECT_EQ(step(), Mode::kStarting);
  EXPECT_EQ(step(), Mode::kPlanning);
}

TEST_F(ModeMachineTest, TakesAPauseThatTakesTooLongForAFault) {
  search();
  in_.pause_asked = true;
  EXPECT_EQ(step(), Mode::kPausing);
  now_ += rates::kStandstillTimeout - rates::kCycle;
  EXPECT_EQ(step(), Mode::kPausing) << "exactly at the limit";
  EXPECT_EQ(step(), Mode::kFault);
}

TEST_F(ModeMachineTest, AStopInAPauseIsGivenItsFullTime) {
  search();
  in_.pause_asked = true;
  EXPECT_EQ(step(), Mode::kPausing);
  now_ += rates::kStandstillTimeout - 2 * rates::kCycle;
  in_.stop_asked = true;
  EXPECT_EQ(step(), Mode::kStopping);
  EXPECT_EQ(step(), Mode::kStopping);
  EXPECT_EQ(step(), Mode::kStopping);
}

TEST_F(ModeMachineTest, TakesPowerThatIsLostInAPauseForAFault) {
  search();
  in_.pause_asked = true;
  EXPECT_EQ(step(), Mode::kPausing);
  in_.drives_enabled = false;
  EXPECT_EQ(step(), Mode::kFault);
}

TEST_F(ModeMachineTest, GivesEveryStopItsFullTimeHoweverLongTheSearch) {
  search();
  now_ += std::chrono::hours(1);
  in_.search_ended = true;
  EXPECT_EQ(step(), Mode::kStopping);
  EXPECT_EQ(step(), Mode::kStopping);
}

}  // namespace
}  // namespace ivo::firmware
