// A robot that stands until somebody agrees anew: because it was asked to, or because nobody is there.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/search_rig.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;
using test::SearchRig;

bool was_paused(const std::vector<Event>& events, PauseCause cause) {
  return std::any_of(events.begin(), events.end(), [&](const Event& event) {
    return event.kind == EventKind::kPaused && event.code == static_cast<std::int32_t>(cause);
  });
}

class Pausing : public testing::Test {
 protected:
  /// Until it moves at nearly its full speed.
  void speed_up() {
    for (int i = 0; i < 20'000 && rig_.speed_mps() < 0.45; ++i) {
      rig_.cycle();
    }
    ASSERT_GE(rig_.speed_mps(), 0.45);
  }
  void expect_to_stand(Duration time) {
    const Point stood = rig_.true_position();
    for (const Instant end = rig_.now() + time; rig_.now() < end;) {
      ASSERT_FALSE(permissions(rig_.cycle().mode).may_move);
      ASSERT_FALSE(rig_.wheels_turn());
    }
    EXPECT_EQ(rig_.true_position(), stood);
  }
  const LoopStatus& status() { return rig_.loop().status(); }

  SearchRig rig_{{.fault_waits = true}};
};

TEST_F(Pausing, RampsDownWithinTheConfiguredDeceleration) {
  ASSERT_TRUE(rig_.start_search());
  speed_up();
  rig_.loop().request_pause();
  ASSERT_EQ(rig_.cycle().mode, Mode::kPausing);
  // From 0.5 m/s at 1 m/s^2, and the drives' own ramp: neither abrupt nor slow.
  rig_.run(400ms);
  EXPECT_TRUE(rig_.wheels_turn());
  rig_.run(300ms);
  EXPECT_FALSE(rig_.wheels_turn());
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 1s));
  EXPECT_EQ(status().pause_cause, PauseCause::kAsked);
  EXPECT_EQ(status().pauses, 1U);
  EXPECT_EQ(status().search, SearchState::kRunning);
  EXPECT_EQ(status().stop_cause, StopCause::kNone);
  EXPECT_TRUE(was_paused(rig_.events(), PauseCause::kAsked));
  EXPECT_EQ(status().counters.refused_commands, 0U);
}

TEST_F(Pausing, StandsWithoutPowerUntilSomebodyAgreesAndThenGoesOnToTheEnd) {
  ASSERT_TRUE(rig_.start_search());
  rig_.run(5s);
  rig_.loop().request_pause();
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 2s));
  expect_to_stand(5s);
  EXPECT_FALSE(rig_.loop().finished());
  EXPECT_LE(rig_.drives().drive(Wheel::kFrontLeft).power_state(), drivers::cia402::PowerState::kReadyToSwitchOn);
  ASSERT_TRUE(rig_.consent());
  ASSERT_TRUE(rig_.run_until(Mode::kSearching, 1s));
  ASSERT_TRUE(rig_.run_until(Mode::kDone));
  const planner::AgentPath& path = rig_.loop().plan().paths[0];
  EXPECT_EQ(status().search, SearchState::kPathsEnded);
  EXPECT_NEAR(rig_.true_position().x_m, path.waypoints.back().x_m, 0.1);
  EXPECT_NEAR(rig_.true_position().y_m, path.waypoints.back().y_m, 0.1);
  EXPECT_EQ(status().plan_number, 1U);
}

// However soon after it may be given: the drives may still be on from before.
TEST_F(Pausing, GoesOnWithoutAFaultWhenConsentIsGivenAtOnce) {
  ASSERT_TRUE(rig_.start_search());
  for (int late = 0; late < 30; ++late) {
    rig_.run(1s);
    ASSERT_EQ(status().mode, Mode::kSearching) << late;
    rig_.loop().request_pause();
    ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 2s)) << late;
    for (int i = 0; i < late; ++i) {
      rig_.cycle();
    }
    ASSERT_TRUE(rig_.consent());
    ASSERT_TRUE(rig_.run_until(Mode::kSearching, 1s)) << late << " cycles later";
    rig_.run(500ms);
    ASSERT_EQ(status().mode, Mode::kSearching)
        << late << " cycles later: " << static_cast<int>(status().drive_fault.reason);
  }
}

TEST_F(Pausing, IsAskedAgainAndAgainWithoutHarm) {
  ASSERT_TRUE(rig_.start_search());
  speed_up();
  for (int i = 0; i < 2000; ++i) {
    rig_.loop().request_pause();
    ASSERT_NE(rig_.cycle().mode, Mode::kSearching);
  }
  EXPECT_EQ(status().mode, Mode::kAwaitingConsent);
  EXPECT_EQ(status().pauses, 2000U);
  ASSERT_TRUE(rig_.consent());
  EXPECT_TRUE(rig_.run_until(Mode::kSearching, 1s));
}

TEST_F(Pausing, VoidsAConsentThatWasGivenBefore) {
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent));
  // Both are said within one cycle, in either order.
  ASSERT_TRUE(rig_.consent());
  rig_.loop().request_pause();
  expect_to_stand(1s);
  rig_.loop().request_pause();
  ASSERT_TRUE(rig_.consent());
  expect_to_stand(1s);
  EXPECT_EQ(status().mode, Mode::kAwaitingConsent);
  EXPECT_EQ(status().pause_cause, PauseCause::kNone) << "nothing moved";
  // Who agrees to what is shown by now is heard.
  ASSERT_TRUE(rig_.consent());
  EXPECT_TRUE(rig_.run_until(Mode::kSearching, 1s));
}

TEST_F(Pausing, VoidsAConsentThatIsStillUnderWayWhenTheRobotStands) {
  ASSERT_TRUE(rig_.start_search());
  rig_.run(2s);
  OperatorCommand late(OperatorCommand::kConsent);
  late.pauses = status().pauses;
  rig_.loop().request_pause();
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 2s));
  ASSERT_TRUE(rig_.loop().command(late));
  expect_to_stand(1s);
}

TEST_F(Pausing, ConsentInAPauseCountsForNothing) {
  ASSERT_TRUE(rig_.start_search());
  speed_up();
  rig_.loop().request_pause();
  ASSERT_EQ(rig_.cycle().mode, Mode::kPausing);
  while (status().mode == Mode::kPausing) {
    ASSERT_TRUE(rig_.consent());
    rig_.cycle();
  }
  ASSERT_NE(status().mode, Mode::kSearching);
  rig_.run(1s);
  EXPECT_EQ(status().mode, Mode::kAwaitingConsent);
  EXPECT_FALSE(rig_.wheels_turn());
}

TEST_F(Pausing, BeforeTheDrivesAreOnNothingMoves) {
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent));
  ASSERT_TRUE(rig_.consent());
  ASSERT_EQ(rig_.cycle().mode, Mode::kSearching);
  const Point stood = rig_.true_position();
  rig_.loop().request_pause();
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 3s));
  rig_.run(1s);
  EXPECT_EQ(rig_.true_position(), stood);
  EXPECT_FALSE(status().search_started) << "nobody has set off";
}

TEST_F(Pausing, AStopInAPauseEndsTheRun) {
  ASSERT_TRUE(rig_.start_search());
  speed_up();
  rig_.loop().request_pause();
  ASSERT_EQ(rig_.cycle().mode, Mode::kPausing);
  rig_.loop().request_stop();
  ASSERT_EQ(rig_.cycle().mode, Mode::kStopping);
  ASSERT_TRUE(rig_.run_until(Mode::kDone, 2s));
}

TEST_F(Pausing, OthersSearchOnMeanwhile) {
  ASSERT_TRUE(rig_.start_search());
  rig_.run(2s);
  rig_.loop().request_pause();
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 2s));
  const AgentTrack robot = status().tracks[0];
  const AgentTrack person = status().tracks[1];
  const Duration time = status().search_time;
  rig_.run(4s);
  EXPECT_EQ(status().tracks[0].position, robot.position);
  EXPECT_NEAR(status().tracks[1].moved_m, person.moved_m + 2.0, 0.01);
  EXPECT_EQ(status().search_time, time + 4s);
}

TEST_F(Pausing, AnObjectThatSomebodyElseSeesMeanwhileEndsTheRun) {
  SearchRig rig({.object = Point{10.5, 6.0}, .fault_waits = true});
  ASSERT_TRUE(rig.start_search());
  rig.run(1s);
  rig.loop().request_pause();
  ASSERT_TRUE(rig.run_until(Mode::kDone, 60s));
  EXPECT_EQ(rig.loop().status().finder, 1);
}

class WatchedConsent : public Pausing {
 protected:
  static constexpr Duration kTimeout = LoopParameters{}.beat_timeout;

  /// Returns when it was taken.
  Instant agree() {
    EXPECT_TRUE(rig_.run_until(Mode::kAwaitingConsent));
    EXPECT_TRUE(rig_.consent(true));
    const Instant taken = rig_.now();
    EXPECT_EQ(rig_.cycle().mode, Mode::kSearching);
    return taken;
  }
  /// Cycles up to and with the one at `end`.
  void go_on_until(Instant end) {
    while (rig_.now() <= end) {
      ASSERT_EQ(rig_.cycle().mode, Mode::kSearching);
    }
  }
};

TEST_F(WatchedConsent, WithoutABeatPausesAfterTheTimeoutAndNotACycleSooner) {
  const Instant taken = agree();
  EXPECT_TRUE(status().watched);
  go_on_until(taken + kTimeout);
  EXPECT_TRUE(rig_.wheels_turn());
  EXPECT_EQ(status().beat_age, kTimeout);
  EXPECT_EQ(rig_.cycle().mode, Mode::kPausing);
  EXPECT_EQ(status().pause_cause, PauseCause::kBeatLost);
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 2s));
  expect_to_stand(2s);
  EXPECT_TRUE(was_paused(rig_.events(), PauseCause::kBeatLost));
}

TEST_F(WatchedConsent, GoesOnAsLongAsBeatsCome) {
  (void)agree();
  Instant beat{};
  for (int i = 0; i < 5; ++i) {
    rig_.loop().beat();
    beat = rig_.now();
    go_on_until(beat + kTimeout - rates::kCycle);
  }
  go_on_until(beat + kTimeout);
  EXPECT_EQ(rig_.cycle().mode, Mode::kPausing);
}

TEST_F(WatchedConsent, ABeatThatComesTooLateSetsNothingInMotion) {
  const Instant taken = agree();
  go_on_until(taken + kTimeout);
  ASSERT_EQ(rig_.cycle().mode, Mode::kPausing);
  for (int i = 0; i < 2000; ++i) {
    rig_.loop().beat();
    ASSERT_NE(rig_.cycle().mode, Mode::kSearching);
  }
  EXPECT_EQ(status().mode, Mode::kAwaitingConsent);
  EXPECT_EQ(status().pauses, 1U) << "it stands, and is not paused over and over";
}

TEST_F(WatchedConsent, OneThatIsNotWatchedNeedsNoBeat) {
  ASSERT_TRUE(rig_.start_search());
  rig_.loop().beat();
  go_on_until(rig_.now() + 2 * kTimeout);
  EXPECT_FALSE(status().watched);
  EXPECT_GT(status().beat_age, kTimeout);
}

TEST_F(WatchedConsent, AWordThatNobodyAskedForIsNeitherABeatNorAConsent) {
  const Instant taken = agree();
  while (rig_.now() <= taken + kTimeout) {
    ASSERT_TRUE(rig_.consent());  // not watched, and not awaited
    ASSERT_EQ(rig_.cycle().mode, Mode::kSearching);
  }
  EXPECT_TRUE(status().watched);
  EXPECT_EQ(rig_.cycle().mode, Mode::kPausing);
}

TEST_F(WatchedConsent, TheLastConsentDecidesWhetherItIsWatched) {
  (void)agree();
  rig_.loop().request_pause();
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 2s));
  ASSERT_TRUE(rig_.consent());
  ASSERT_TRUE(rig_.run_until(Mode::kSearching, 1s));
  go_on_until(rig_.now() + 2 * kTimeout);
}

}  // namespace
}  // namespace ivo::firmware
