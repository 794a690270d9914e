#include "firmware/mission/search_run.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "tests/support/drawn_map.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

planner::AgentPath path(std::initializer_list<Point> points) {
  planner::AgentPath path;
  for (const Point point : points) {
    (void)path.waypoints.push_back(point);
  }
  return path;
}

class SearchRunTest : public testing::Test {
 protected:
  SearchRunTest() : cells_(std::make_unique<planner::Cells>()), plan_(std::make_unique<planner::Plan>()) {
    test::DrawnMap map(10, 10, 0.25);
    map.put(SemanticClass::kWall, 4.75, 0, 5.25, 8);
    EXPECT_FALSE(cells_->build(map.view(), 0.25));
    (void)plan_->paths.push_back(path({{2, 2}, {2, 4}}));
    (void)plan_->paths.push_back(path({{8, 2}, {8, 3}, {9, 3}}));
    (void)searchers_.push_back({.kind = AgentKind::kRobot, .start = {2, 2}});
    (void)searchers_.push_back({.kind = AgentKind::kPerson, .start = {8, 2}, .speed_mps = 1.0});
  }

  std::unique_ptr<planner::Cells> cells_;
  std::unique_ptr<planner::Plan> plan_;
  Searchers searchers_;
  Instant now_{5s};
};

TEST_F(SearchRunTest, EndsWhenAllPathsHaveEnded) {
  SearchRun run(*cells_, searchers_);
  run.start(now_, *plan_, {});
  run.update(now_ + 1500ms, {2, 4}, true);
  EXPECT_EQ(run.state(), SearchState::kRunning);
  EXPECT_EQ(run.track(1).position, (Point{8.5, 3}));
  run.update(now_ + 2s, {2, 4}, true);
  EXPECT_EQ(run.state(), SearchState::kPathsEnded);
  EXPECT_EQ(run.elapsed(), 2s);
  EXPECT_DOUBLE_EQ(run.track(0).moved_m, 2.0);
  EXPECT_DOUBLE_EQ(run.track(1).moved_m, 2.0);
}

TEST_F(SearchRunTest, GoesOnWhereItWasLeft) {
  SearchRun first(*cells_, searchers_);
  first.start(now_, *plan_, {});
  first.update(now_ + 1200ms, {2, 3}, false);
  const SearchProgress left{
      .tracks = {first.track(0), first.track(1)}, .elapsed = first.elapsed(), .state = {}, .finder = {}};

  SearchRun second(*cells_, searchers_);
  second.resume(*plan_, {}, left);
  EXPECT_EQ(second.elapsed(), 1200ms);
  EXPECT_EQ(second.track(0).position, (Point{2, 3}));
  EXPECT_EQ(second.track(1).position, (Point{8.2, 3}));
  const Instant later{900s};
  second.go_on(later);
  second.update(later + 300ms, {2, 3.5}, false);
  EXPECT_EQ(second.elapsed(), 1500ms);
  EXPECT_DOUBLE_EQ(second.track(0).moved_m, 1.5);
  EXPECT_DOUBLE_EQ(second.track(1).position.x_m, 8.5);
  EXPECT_DOUBLE_EQ(second.track(1).moved_m, 1.5);
  second.update(later + 1s, {2, 4}, true);
  EXPECT_EQ(second.state(), SearchState::kPathsEnded);
}

TEST_F(SearchRunTest, WhatWasFoundIsNotSearchedForAgain) {
  SearchRun run(*cells_, searchers_);
  run.resume(*plan_, {}, {.tracks = {}, .elapsed = 3s, .state = SearchState::kFound, .finder = 1});
  run.go_on(now_);
  run.update(now_ + 1s, {2, 2}, false);
  EXPECT_EQ(run.state(), SearchState::kFound);
  EXPECT_EQ(run.finder(), 1);
  EXPECT_EQ(run.elapsed(), 3s);
}

TEST_F(SearchRunTest, TheAgentThatSeesTheObjectFindsIt) {
  SearchRun run(*cells_, searchers_);
  run.start(now_, *plan_, SearchObject({8.0, 4.9}, FindRule::kSight));
  run.update(now_ + 100ms, {2, 2}, false);
  EXPECT_EQ(run.state(), SearchState::kRunning);  // 2.8 m away
  run.update(now_ + 900ms, {2, 2}, false);
  EXPECT_EQ(run.state(), SearchState::kFound);
  EXPECT_EQ(run.finder(), 1);
  EXPECT_EQ(run.elapsed(), 900ms);
}

TEST_F(SearchRunTest, TheLowestNumberedAgentIsTheFinderWhenTwoSeeIt) {
  SearchRun run(*cells_, searchers_);
  run.start(now_, *plan_, SearchObject({8.0, 2.5}, FindRule::kSight));
  run.update(now_, {7.5, 2}, false);
  EXPECT_EQ(run.finder(), 0);
}

TEST_F(SearchRunTest, AWallHidesTheObjectUnlessDistanceAloneDecides) {
  for (const FindRule rule : {FindRule::kSight, FindRule::kDistance}) {
    SearchRun run(*cells_, searchers_);
    run.start(now_, *plan_, SearchObject({4.0, 2.0}, rule));
    run.update(now_, {6.0, 2.0}, false);  // 2 m away, the wall between
    EXPECT_EQ(run.state(), rule == FindRule::kSight ? SearchState::kRunning : SearchState::kFound);
  }
}

TEST_F(SearchRunTest, NothingChangesAfterTheEnd) {
  SearchRun run(*cells_, searchers_);
  run.start(now_, *plan_, SearchObject({2.0, 2.0}, FindRule::kSight));
  run.update(now_ + 1s, {2, 2}, false);
  ASSERT_EQ(run.state(), SearchState::kFound);
  run.update(now_ + 9s, {3, 3}, true);
  EXPECT_EQ(run.elapsed(), 1s);
  EXPECT_EQ(run.track(0).position, (Point{2, 2}));
}

TEST_F(SearchRunTest, AReportedPersonDoesNotWalkByItselfAndDoesNotHoldUpTheEnd) {
  searchers_[1].motion = PersonMotion::kReported;
  SearchRun run(*cells_, searchers_);
  run.start(now_, *plan_, SearchObject({8.0, 2.5}, FindRule::kSight));
  run.update(now_ + 10s, {2, 3}, false);
  EXPECT_EQ(run.track(1).position, (Point{8, 2}));
  EXPECT_EQ(run.state(), SearchState::kRunning);
  run.update(now_ + 11s, {2, 4}, true);
  EXPECT_EQ(run.state(), SearchState::kPathsEnded);
}

TEST_F(SearchRunTest, AnUnknownObjectIsNeverFound) {
  SearchRun run(*cells_, searchers_);
  run.start(now_, *plan_, SearchObject());
  run.update(now_ + 1s, {2, 2}, false);
  EXPECT_FALSE(run.finder().has_value());
}

TEST_F(SearchRunTest, ANewPlanIsFollowedByEverybodyFromWhereTheyAre) {
  SearchRun run(*cells_, searchers_);
  run.start(now_, *plan_, {});
  run.update(now_ + 1s, {2, 3}, false);
  ASSERT_EQ(run.track(1).position, (Point{8, 3}));
  auto other = std::make_unique<planner::Plan>();
  (void)other->paths.push_back(path({{2, 3}, {4, 3}}));
  (void)other->paths.push_back(path({{7, 3}, {7, 4}}));
  run.follow(*other);
  run.update(now_ + 1500ms, {2.5, 3}, false);
  EXPECT_EQ(run.track(1).position, (Point{7.5, 3})) << "on the way to where the path begins";
  EXPECT_DOUBLE_EQ(run.track(1).moved_m, 1.5);
  EXPECT_DOUBLE_EQ(run.track(1).before_m, 1.0);
  EXPECT_DOUBLE_EQ(run.track(0).moved_m, 1.5);
  EXPECT_DOUBLE_EQ(run.track(0).before_m, 1.0);
  run.update(now_ + 3s, {4, 3}, true);
  EXPECT_EQ(run.state(), SearchState::kPathsEnded);
  EXPECT_EQ(run.track(1).position, (Point{7, 4}));
  EXPECT_DOUBLE_EQ(run.track(1).moved_m, 3.0);
}

TEST_F(SearchRunTest, APathThatHadEndedGoesOnWithANewPlan) {
  SearchRun run(*cells_, searchers_);
  run.start(now_, *plan_, {});
  run.update(now_ + 3s, {2, 3}, false);
  ASSERT_TRUE(run.track(1).path_ended);
  auto other = std::make_unique<planner::Plan>();
  (void)other->paths.push_back(path({{2, 3}, {4, 3}}));
  (void)other->paths.push_back(path({{9, 3}, {9, 9}}));
  run.follow(*other);
  EXPECT_FALSE(run.track(1).path_ended);
  run.update(now_ + 4s, {4, 3}, true);
  EXPECT_EQ(run.state(), SearchState::kRunning);
  EXPECT_EQ(run.track(1).position, (Point{9, 4}));
}

TEST_F(SearchRunTest, IsTakenUpWithinAPlanThatWasMadeUnderWay) {
  SearchRun first(*cells_, searchers_);
  first.start(now_, *plan_, {});
  first.update(now_ + 2s, {2, 3}, false);
  ASSERT_EQ(first.track(1).position, (Point{9, 3}));
  auto other = std::make_unique<planner::Plan>();
  (void)other->paths.push_back(path({{2, 3}, {4, 3}}));
  (void)other->paths.push_back(path({{9, 3}, {9, 9}}));
  first.follow(*other);
  first.update(now_ + 3s, {2.5, 3}, false);
  const SearchProgress left{
      .tracks = {first.track(0), first.track(1)}, .elapsed = first.elapsed(), .state = {}, .finder = {}};
  SearchRun second(*cells_, searchers_);
  second.resume(*other, {}, left);
  second.go_on(now_ + 900s);
  second.update(now_ + 901s, {3, 3}, false);
  EXPECT_DOUBLE_EQ(second.track(1).position.y_m, 5);
  EXPECT_DOUBLE_EQ(second.track(1).moved_m, 4.0);
  EXPECT_DOUBLE_EQ(second.track(1).before_m, 2.0);
}

TEST_F(SearchRunTest, FoundBySomebodyIsFoundOnceAndOnlyWhileTheSearchGoesOn) {
  SearchRun run(*cells_, searchers_);
  run.found_by(1);
  EXPECT_EQ(run.state(), SearchState::kRunning) << "nobody has set off";
  run.start(now_, *plan_, {});
  run.found_by(-1);
  run.found_by(2);
  EXPECT_EQ(run.state(), SearchState::kRunning) << "by nobody";
  run.found_by(1);
  EXPECT_EQ(run.state(), SearchState::kFound);
  EXPECT_EQ(run.finder(), 1);
  run.found_by(0);
  EXPECT_EQ(run.finder(), 1) << "the first who says so";
  run.update(now_ + 9s, {2, 4}, true);
  EXPECT_EQ(run.state(), SearchState::kFound);
}

class ReportedSearchRun : public SearchRunTest {
 protected:
  ReportedSearchRun() {
    searchers_[1].motion = PersonMotion::kReported;
    plan_->paths[1].length_m = 2.0;
  }
};

TEST_F(ReportedSearchRun, MovesFromReportToReportAndNotToTheFirst) {
  SearchRun run(*cells_, searchers_);
  run.start(now_, *plan_, {});
  EXPECT_EQ(run.report_age(1, now_), std::nullopt);
  run.report(1, {9, 9}, now_);
  EXPECT_EQ(run.track(1).position, (Point{9, 9}));
  EXPECT_EQ(run.track(1).moved_m, 0.0) << "that is where they are, not where they went";
  run.report(1, {6, 5}, now_ + 3s);
  EXPECT_DOUBLE_EQ(run.track(1).moved_m, 5.0);
  EXPECT_EQ(run.report_age(1, now_ + 5s), 2s);
  run.update(now_ + 6s, {2, 3}, false);
  EXPECT_EQ(run.track(1).position, (Point{6, 5}));
  EXPECT_DOUBLE_EQ(run.track(1).moved_m, 5.0);
}

TEST_F(ReportedSearchRun, BeforeTheStartCountsAsTheStart) {
  SearchRun run(*cells_, searchers_);
  run.report(1, {9, 9}, now_);
  run.report(1, {9, 8}, now_ + 1s);
  run.start(now_ + 2s, *plan_, {});
  EXPECT_EQ(run.track(1).position, (Point{9, 8}));
  EXPECT_EQ(run.track(1).moved_m, 0.0);
  run.report(1, {9, 7}, now_ + 3s);
  EXPECT_DOUBLE_EQ(run.track(1).moved_m, 1.0);
}

TEST_F(ReportedSearchRun, OfOthersNothingIsHeeded) {
  SearchRun run(*cells_, searchers_);
  run.start(now_, *plan_, {});
  run.report(0, {9, 9}, now_);
  run.report(2, {9, 9}, now_);
  run.report(-1, {9, 9}, now_);
  EXPECT_EQ(run.track(0).position, (Point{2, 2}));
  EXPECT_EQ(run.report_age(0, now_), std::nullopt);
}

TEST_F(ReportedSearchRun, APathEndsWhereItEndsOnceHalfOfItIsWalked) {
  SearchRun run(*cells_, searchers_);
  run.start(now_, *plan_, {});
  run.report(1, {9, 2.5}, now_);
  run.update(now_ + 1s, {2, 4}, true);
  EXPECT_FALSE(run.track(1).path_ended) << "near the end, but has not gone there";
  EXPECT_EQ(run.state(), SearchState::kRunning);
  run.report(1, {8, 2.5}, now_ + 2s);
  run.report(1, {8.9, 2.9}, now_ + 3s);
  run.update(now_ + 3s, {2, 4}, true);
  EXPECT_EQ(run.state(), SearchState::kPathsEnded);
}

TEST_F(ReportedSearchRun, SeesTheObjectFromWhereTheyAreReportedAndNotFromWhereNobodyKnows) {
  SearchRun run(*cells_, searchers_);
  run.start(now_, *plan_, SearchObject({8.0, 6.0}, FindRule::kSight));
  run.report(1, {8, 5}, now_);
  run.update(now_ + 100ms, {2, 2}, false);
  EXPECT_EQ(run.finder(), 1);
}

TEST(SimulatedPerson, PassesSeveralWaypointsInOneStepAndStandsAtTheEnd) {
  const planner::AgentPath zigzag = path({{0, 0}, {1, 0}, {1, 1}, {1, 1}, {2, 1}});
  SimulatedPerson person;
  person.start(zigzag, 0.5);
  person.walk(5s);
  EXPECT_EQ(person.position(), (Point{1.5, 1}));
  EXPECT_FALSE(person.arrived());
  person.walk(60s);
  EXPECT_EQ(person.position(), (Point{2, 1}));
  EXPECT_TRUE(person.arrived());
  EXPECT_DOUBLE_EQ(person.walked_m(), 3.0);
}

TEST(SearchObject, IsDrawnWhereTheMassIsAndTheSameForTheSameSeed) {
  const auto cells = std::make_unique<planner::Cells>();
  const test::DrawnMap map(10, 10, 0.25);
  ASSERT_FALSE(cells->build(map.view(), 0.25));
  const auto belief = std::make_unique<planner::Belief>();
  // A quarter of the mass in one cell, the rest in another.
  const planner::Cell a = cells->at(3, 4);
  const planner::Cell b = cells->at(30, 20);
  belief->mass[static_cast<std::size_t>(a)] = 0.25;
  belief->mass[static_cast<std::size_t>(b)] = 0.75;
  belief->mass_cells[0] = a;
  belief->mass_cells[1] = b;
  belief->mass_cell_count = 2;
  int in_a = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const Point place = *SearchObject::drawn(*cells, *belief, seed, FindRule::kSight).place();
    EXPECT_EQ(place, *SearchObject::drawn(*cells, *belief, seed, FindRule::kSight).place());
    ASSERT_TRUE(place == cells->centre(a) || place == cells->centre(b));
    in_a += place == cells->centre(a) ? 1 : 0;
  }
  EXPECT_NEAR(in_a, 500, 80);  // four standard deviations
}

}  // namespace
}  // namespace ivo::firmware
