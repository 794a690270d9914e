// A plan that is made anew while the search goes on: the robot stands meanwhile, and goes from where it stands.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/search_rig.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;
using test::SearchRig;

bool has_number(const std::vector<Event>& events, EventKind kind, std::int32_t code) {
  return std::any_of(events.begin(), events.end(),
                     [&](const Event& event) { return event.kind == kind && event.code == code; });
}

class PlanAnew : public testing::Test {
 protected:
  const LoopStatus& status() { return rig_.loop().status(); }
  void say(OperatorCommand::Kind kind) { ASSERT_TRUE(rig_.loop().command(kind)); }

  SearchRig rig_{{.fault_waits = true}};
};

TEST_F(PlanAnew, PausesARobotThatMovesAndMovesItOnlyAfterConsent) {
  ASSERT_TRUE(rig_.start_search());
  rig_.run(5s);
  say(OperatorCommand::kPlanAnew);
  EXPECT_EQ(rig_.cycle().mode, Mode::kPausing);
  EXPECT_FALSE(status().plan_ready);
  EXPECT_TRUE(status().preparing);
  EXPECT_EQ(status().pause_cause, PauseCause::kReplan);
  ASSERT_TRUE(rig_.run_until(Mode::kPlanning, 3s));
  for (int i = 0; i < 2000; ++i) {
    ASSERT_TRUE(rig_.consent());
    ASSERT_EQ(rig_.cycle().mode, Mode::kPlanning) << "there is no plan to agree to";
    ASSERT_FALSE(rig_.wheels_turn());
  }
}

TEST_F(PlanAnew, TheNewPlanIsFollowedFromWhereTheRobotStands) {
  ASSERT_TRUE(rig_.start_search());
  rig_.run(8s);
  ASSERT_TRUE(rig_.plan_anew(3));
  const Point stood = rig_.true_position();
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 30s));
  EXPECT_EQ(status().plan_number, 2U);
  EXPECT_FALSE(status().preparing);
  EXPECT_EQ(rig_.true_position(), stood);
  const planner::AgentPath path = rig_.loop().plan().paths[0];
  EXPECT_NEAR(path.waypoints[0].x_m, stood.x_m, 0.02);
  EXPECT_NEAR(path.waypoints[0].y_m, stood.y_m, 0.02);
  EXPECT_NEAR(status().distance_left_m, path.length_m, 1e-9);
  const double moved_m = status().tracks[0].moved_m;
  EXPECT_EQ(status().tracks[0].before_m, moved_m);

  ASSERT_TRUE(rig_.consent());
  ASSERT_TRUE(rig_.run_until(Mode::kSearching, 1s));
  double farthest_m = 0.0;
  for (Point before = rig_.true_position(); rig_.cycle().mode != Mode::kDone; before = rig_.true_position()) {
    farthest_m =
        std::max(farthest_m, std::hypot(rig_.true_position().x_m - before.x_m, rig_.true_position().y_m - before.y_m));
    ASSERT_LT(status().search_time, 600s);
  }
  EXPECT_LE(farthest_m, 0.5 * seconds(rates::kCycle) * 1.01) << "it jumps";
  EXPECT_EQ(status().search, SearchState::kPathsEnded);
  EXPECT_NEAR(rig_.true_position().x_m, path.waypoints.back().x_m, 0.1);
  EXPECT_NEAR(rig_.true_position().y_m, path.waypoints.back().y_m, 0.1);
  EXPECT_NEAR(status().tracks[0].moved_m, moved_m + path.length_m, 0.05 * path.length_m);
  const auto events = rig_.events();
  EXPECT_TRUE(has_number(events, EventKind::kPlanAsked, 2));
  EXPECT_TRUE(has_number(events, EventKind::kPlanTaken, 2));
  EXPECT_EQ(status().counters.refused_commands, 0U);
}

TEST_F(PlanAnew, WhoWalksWalksTheOldPathUntilTheRobotSetsOffAgain) {
  ASSERT_TRUE(rig_.start_search());
  rig_.run(2s);
  const planner::AgentPath old = rig_.loop().plan().paths[1];
  ASSERT_TRUE(rig_.plan_anew(3));
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 30s));
  rig_.run(3s);
  planner::AgentPath walked = old;
  SimulatedPerson person;
  person.start(walked, 0.5);
  person.walk(status().search_time);
  EXPECT_NEAR(status().tracks[1].position.x_m, person.position().x_m, 1e-6);
  EXPECT_NEAR(status().tracks[1].position.y_m, person.position().y_m, 1e-6);
  ASSERT_TRUE(rig_.consent());
  ASSERT_TRUE(rig_.run_until(Mode::kDone, 600s));
  const Point end = rig_.loop().plan().paths[1].waypoints.back();
  EXPECT_EQ(status().tracks[1].position, end) << "of the new path";
}

TEST_F(PlanAnew, OneThatCannotBeMadeLeavesThePlanThatIsFollowed) {
  ASSERT_TRUE(rig_.start_search());
  rig_.run(5s);
  const Point end = rig_.loop().plan().paths[0].waypoints.back();
  const double left_m = status().distance_left_m;
  say(OperatorCommand::kPlanAnew);
  ASSERT_TRUE(rig_.run_until(Mode::kPlanning, 3s));
  say(OperatorCommand::kPlanAsBefore);
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 3s));
  EXPECT_EQ(status().plan_number, 1U);
  EXPECT_LE(status().distance_left_m, left_m);
  EXPECT_GT(status().distance_left_m, left_m - 0.5);
  rig_.run(1s);
  EXPECT_FALSE(rig_.wheels_turn());
  ASSERT_TRUE(rig_.consent());
  ASSERT_TRUE(rig_.run_until(Mode::kDone));
  EXPECT_EQ(status().search, SearchState::kPathsEnded);
  EXPECT_NEAR(rig_.true_position().x_m, end.x_m, 0.1);
  EXPECT_NEAR(rig_.true_position().y_m, end.y_m, 0.1);
}

TEST_F(PlanAnew, BeforeAnybodySetsOffItIsAsThePlanOfTheBeginning) {
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent));
  ASSERT_TRUE(rig_.consent());
  ASSERT_TRUE(rig_.plan_anew(3)) << "and the consent of before is void";
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent, 30s));
  rig_.run(1s);
  EXPECT_EQ(status().mode, Mode::kAwaitingConsent);
  EXPECT_EQ(status().plan_number, 2U);
  EXPECT_EQ(status().pause_cause, PauseCause::kNone);
  ASSERT_TRUE(rig_.start_search());
  ASSERT_TRUE(rig_.run_until(Mode::kDone));
  EXPECT_EQ(status().search, SearchState::kPathsEnded);
  EXPECT_EQ(status().tracks[0].before_m, 0.0);
  EXPECT_FALSE(has_number(rig_.events(), EventKind::kPlanTaken, 2)) << "nobody was under way";
}

TEST_F(PlanAnew, WhileOneIsBeingMadeReplacesIt) {
  SearchRig rig({.generations = 100'000});
  rig.run(2s);
  ASSERT_EQ(rig.loop().status().mode, Mode::kPlanning);
  ASSERT_TRUE(rig.plan_anew(3));
  ASSERT_TRUE(rig.run_until(Mode::kAwaitingConsent, 30s));
  EXPECT_EQ(rig.loop().status().plan_number, 2U);
  EXPECT_EQ(rig.loop().status().planning.generations, 3);
}

TEST_F(PlanAnew, EnoughTakesTheBestPlanSoFar) {
  SearchRig rig({.generations = 100'000});
  ASSERT_TRUE(rig.loop().command(OperatorCommand::kEnough));
  rig.cycle();
  EXPECT_EQ(rig.loop().status().mode, Mode::kPlanning) << "there is none yet";
  rig.run(4s);
  ASSERT_EQ(rig.loop().status().mode, Mode::kPlanning);
  ASSERT_TRUE(rig.loop().status().planning.has_plan);
  ASSERT_GT(rig.loop().shown_plan().number, 0U) << "it is shown while it is made";
  EXPECT_FALSE(rig.loop().shown_plan().ready);
  ASSERT_TRUE(rig.loop().command(OperatorCommand::kEnough));
  ASSERT_TRUE(rig.run_until(Mode::kAwaitingConsent, 3s));
  EXPECT_TRUE(rig.loop().shown_plan().ready);
  EXPECT_EQ(rig.loop().plan().score.expected_time_s, rig.loop().status().planning.best.expected_time_s);
  ASSERT_TRUE(rig.start_search());
  rig.run(1s);
  EXPECT_EQ(rig.loop().status().mode, Mode::kSearching);
}

class FoundBySomebody : public PlanAnew {
 protected:
  void found_by(std::uint8_t agent) {
    OperatorCommand found(OperatorCommand::kFound);
    found.agent = agent;
    ASSERT_TRUE(rig_.loop().command(found));
  }
  void expect_found_by(int agent) {
    EXPECT_EQ(status().search, SearchState::kFound);
    EXPECT_EQ(status().finder, agent);
  }
};

TEST_F(FoundBySomebody, RampsDownAndEnds) {
  ASSERT_TRUE(rig_.start_search());
  rig_.run(5s);
  found_by(1);
  EXPECT_EQ(rig_.cycle().mode, Mode::kStopping);
  ASSERT_TRUE(rig_.run_until(Mode::kDone, 2s));
  expect_found_by(1);
}

TEST_F(FoundBySomebody, EndsAPauseAndAPlanThatIsMade) {
  for (const bool planning : {false, true}) {
    SearchRig rig({.fault_waits = true});
    ASSERT_TRUE(rig.start_search());
    rig.run(3s);
    if (planning) {
      ASSERT_TRUE(rig.loop().command(OperatorCommand::kPlanAnew));
      ASSERT_TRUE(rig.run_until(Mode::kPlanning, 3s));
    } else {
      rig.loop().request_pause();
      ASSERT_TRUE(rig.run_until(Mode::kAwaitingConsent, 3s));
    }
    OperatorCommand found(OperatorCommand::kFound);
    found.agent = 0;
    ASSERT_TRUE(rig.loop().command(found));
    EXPECT_EQ(rig.cycle().mode, Mode::kDone) << planning;
    EXPECT_EQ(rig.loop().status().finder, 0);
    rig.run(1s);
    EXPECT_TRUE(rig.loop().finished());
  }
}

TEST_F(FoundBySomebody, BeforeAnybodySetsOffCountsForNothing) {
  ASSERT_TRUE(rig_.run_until(Mode::kAwaitingConsent));
  found_by(0);
  rig_.run(100ms);
  EXPECT_EQ(status().mode, Mode::kAwaitingConsent);
  EXPECT_FALSE(status().finder.has_value());
}

TEST_F(FoundBySomebody, ANobodyFindsNothing) {
  ASSERT_TRUE(rig_.start_search());
  found_by(2);
  found_by(255);
  rig_.run(100ms);
  EXPECT_EQ(status().mode, Mode::kSearching);
}

class ReportedPerson : public testing::Test {
 protected:
  void report(SearchRig& rig, Point place, std::uint8_t agent = 1) {
    OperatorCommand report(OperatorCommand::kReport);
    report.agent = agent;
    report.place = place;
    ASSERT_TRUE(rig.loop().command(report));
  }
};

TEST_F(ReportedPerson, IsWhereTheyAreReportedAndHoldsUpTheEndUntilTheyArrive) {
  SearchRig rig({.fault_waits = true, .person = PersonMotion::kReported});
  ASSERT_TRUE(rig.start_search());
  const planner::AgentPath path = rig.loop().plan().paths[1];
  EXPECT_FALSE(rig.loop().status().report_age[1].has_value());
  for (const Point place : path.waypoints.span()) {
    report(rig, place);
    rig.run(500ms);
    ASSERT_EQ(rig.loop().status().tracks[1].position, place);
    ASSERT_LT(rig.loop().status().report_age[1], 501ms);
  }
  EXPECT_TRUE(rig.loop().status().tracks[1].path_ended);
  EXPECT_NEAR(rig.loop().status().tracks[1].moved_m, path.length_m, 1e-6);
  report(rig, {0.5, 0.5}, 0);
  rig.cycle();
  EXPECT_GT(
      std::hypot(rig.loop().status().tracks[0].position.x_m - 0.5, rig.loop().status().tracks[0].position.y_m - 0.5),
      0.5)
      << "the robot knows better where it is";
  ASSERT_TRUE(rig.run_until(Mode::kDone));
  EXPECT_EQ(rig.loop().status().search, SearchState::kPathsEnded);
}

TEST_F(ReportedPerson, FindsTheObjectWhereTheyAreReported) {
  SearchRig rig({.object = Point{10.5, 10.5}, .fault_waits = true, .person = PersonMotion::kReported});
  ASSERT_TRUE(rig.start_search());
  rig.run(1s);
  ASSERT_EQ(rig.loop().status().search, SearchState::kRunning);
  report(rig, {10.0, 9.5});
  ASSERT_TRUE(rig.run_until(Mode::kDone, 2s));
  EXPECT_EQ(rig.loop().status().finder, 1);
}

TEST_F(ReportedPerson, OneWhoIsSimulatedIsNotReported) {
  SearchRig rig({});
  ASSERT_TRUE(rig.start_search());
  report(rig, {5.0, 5.0});
  rig.run(100ms);
  EXPECT_FALSE(rig.loop().status().report_age[1].has_value());
  EXPECT_LT(rig.loop().status().tracks[1].moved_m, 0.2);
}

}  // namespace
}  // namespace ivo::firmware
