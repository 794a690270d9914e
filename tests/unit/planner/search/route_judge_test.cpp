#include "planner/search/route_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "planner/search/path_score.hpp"
#include "tests/support/drawn_map.hpp"
#include "tests/support/m1.hpp"
#include "tests/support/random_search.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

constexpr int kRows = 40;  // of a part of the work: routes are judged in several

// A pool and two judges on the shared planner's tables: one that goes on from what it keeps, one that always begins
// anew.
class Bench {
 public:
  static Bench& get() {
    static Bench bench;  // large
    return bench;
  }

  bool open(const SearchProblem& problem) {
    if (!pool_.open()) {
      return false;
    }
    problem_ = &problem;
    agents_ = static_cast<int>(problem.agents.size());
    for (int m = 0; m < agents_; ++m) {
      paces_[index(m)] = SecondsAMetre(1.0 / problem.agents[index(m)].speed_mps);
      int work = 0;
      starts_[index(m)] = pool_.make(m, pool_.place_of(m), pool_.place_of(m), work);
      current_.legs[index(m)].clear();
    }
    open(restarting_);
    return true;
  }

  Judgement judge_anew(const Route& route) {
    open(fresh_);
    return judge(fresh_, route, Seconds{});
  }
  Judgement judge_on(const Route& route, Seconds changed_s) { return judge(restarting_, route, changed_s); }
  void demand(double mass) { restarting_.demand(mass); }
  void accept(const Route& route) {
    restarting_.accept();
    current_.assign(route, agents_);
  }

  [[nodiscard]] Seconds time_at(int agent, std::size_t leg) const {
    Seconds time_s{};
    for (std::size_t i = 0; i < leg; ++i) {
      time_s += restarting_.seconds_along(agent, current_.legs[index(agent)][i].segment);
    }
    return time_s;
  }
  [[nodiscard]] Place end_of(const Leg& leg) const {
    return leg.back ? pool_[leg.segment].from : pool_[leg.segment].to;
  }
  [[nodiscard]] Place place(const Route& route, int agent, std::size_t i) const {
    return i == 0 ? pool_.place_of(agent) : end_of(route.legs[index(agent)][i - 1]);
  }

  // Of the route up to `end_s`: what it would see later is not part of the plan.
  PlanScore exact_score(const Route& route, double end_s) {
    std::vector<std::vector<Point>> points(index(agents_));
    std::vector<WaypointPath> paths;
    for (int m = 0; m < agents_; ++m) {
      const SearchAgent& agent = problem_->agents[index(m)];
      double left_m = end_s * agent.speed_mps;
      Point at = pool_.point_at(pool_.place_of(m));
      points[index(m)].push_back(at);
      for (std::size_t i = 1; i <= route.legs[index(m)].size() && left_m > 0.0; ++i) {
        const Point to = pool_.point_at(place(route, m, i));
        const double leg_m = std::hypot(to.x_m - at.x_m, to.y_m - at.y_m);
        const double share = std::min(1.0, left_m / leg_m);
        at = {at.x_m + (to.x_m - at.x_m) * share, at.y_m + (to.y_m - at.y_m) * share};
        points[index(m)].push_back(at);
        left_m -= leg_m;
      }
      paths.push_back({points[index(m)], agent.speed_mps, agent.sight_radius_m});
    }
    static FirstSightings sightings;
    static PathScorer scorer(sightings);
    const Planner& planner = test::shared_planner();
    return scorer.score(planner.cells(), planner.belief(), paths, problem_->colony.ant.max_unseen_mass);
  }

  SegmentPool& pool() { return pool_; }
  [[nodiscard]] const Route& current() const { return current_; }

 private:
  void open(RouteJudge& judge) const {
    const Planner& planner = test::shared_planner();
    judge.open(planner.cells(), planner.belief(), paces_, problem_->colony.ant.max_unseen_mass);
    for (int m = 0; m < agents_; ++m) {
      judge.set_start(m, starts_[index(m)]);
    }
  }
  static Judgement judge(RouteJudge& judge, const Route& route, Seconds changed_s) {
    (void)judge.start(route, changed_s);
    while (!judge.done()) {
      (void)judge.advance(kRows);
    }
    return judge.judgement();
  }

  SegmentPool pool_{test::shared_planner().world()};
  RouteJudge restarting_{pool_};
  RouteJudge fresh_{pool_};
  const SearchProblem* problem_ = nullptr;
  int agents_ = 0;
  std::array<SecondsAMetre, limits::kAgents> paces_{};
  std::array<std::int32_t, limits::kAgents> starts_{};
  Route current_;
};

// The agent's way kept up to a leg drawn at random, and a new one from there on, of segments that are free.
Seconds change(const SearchProblem& problem, int agent, Route& route, std::mt19937_64& random) {
  Bench& bench = Bench::get();
  Legs& legs = route.legs[index(agent)];
  const std::size_t kept = legs.empty() ? 0 : random() % (legs.size() + 1);
  const Seconds changed_s = bench.time_at(agent, kept);
  const Legs tail = legs;
  legs.resize(kept);
  std::uniform_real_distribution<double> x_m(0.0, problem.map.width_m());
  std::uniform_real_distribution<double> y_m(0.0, problem.map.height_m());
  Place at = bench.place(route, agent, kept);
  const auto go_to = [&](const Place& to) {
    int work = 0;
    const bool back = random() % 2 == 0;
    const std::int32_t id = to.spot == at.spot ? -1
                            : back             ? bench.pool().make(agent, to, at, work)
                                               : bench.pool().make(agent, at, to, work);
    if (id >= 0) {
      (void)legs.push_back({id, back});
      at = to;
    }
    return id >= 0;
  };
  for (std::uint64_t i = 1 + random() % 3; i > 0; --i) {
    (void)go_to({spot_at({x_m(random), y_m(random)}), -1});
  }
  // Then on as before, where that is possible.
  if (kept + 1 < tail.size() && go_to(bench.end_of(tail[kept]))) {
    for (std::size_t i = kept + 1; i < tail.size(); ++i) {
      (void)legs.push_back(tail[i]);
    }
  }
  if (legs.size() > 30) {
    legs.resize(kept);  // as a change that drops the rest
  }
  return changed_s;
}

double cost_of(const PlanScore& score) {
  return test::shared_planner().belief().has_sub_priors ? score.expected_sub_prior_time_s
                                                        : score.expected_time_continuous_s;
}

void expect_same(const Judgement& a, const Judgement& b, int agents) {
  EXPECT_EQ(to_double(a.cost), to_double(b.cost));
  EXPECT_EQ(to_double(a.end_s), to_double(b.end_s));
  EXPECT_EQ(a.complete, b.complete);
  for (std::size_t m = 0; m < index(agents); ++m) {
    EXPECT_EQ(a.legs_used[m], b.legs_used[m]) << "agent " << m;
  }
}

TEST(RouteJudge, JudgesFromAStateItKeptAsItDoesFromTheStart) {
  std::mt19937_64 random(51);
  int searches = 0;
  int late = 0;
  int complete = 0;
  int with_sub_priors = 0;
  for (int draw = 0; searches < 20; ++draw) {
    ASSERT_LT(draw, 400);
    test::RandomSearch search(random);
    const SearchProblem& problem = search.problem();
    if (test::shared_planner().prepare(search.problem()) || !Bench::get().open(problem)) {
      continue;
    }
    ++searches;
    const auto agents = static_cast<int>(problem.agents.size());
    with_sub_priors += test::shared_planner().belief().has_sub_priors ? 1 : 0;
    static Route candidate;
    for (int i = 0; i < 60; ++i) {
      SCOPED_TRACE("draw " + std::to_string(draw) + ", change " + std::to_string(i));
      candidate.assign(Bench::get().current(), agents);
      const auto agent = static_cast<int>(random() % problem.agents.size());
      Seconds changed_s = change(problem, agent, candidate, random);
      if (agents > 1 && random() % 4 == 0) {
        changed_s = std::min(changed_s, change(problem, (agent + 1) % agents, candidate, random));
      }
      const Judgement anew = Bench::get().judge_anew(candidate);
      expect_same(Bench::get().judge_on(candidate, changed_s), anew, agents);
      ASSERT_FALSE(HasFailure());
      if (anew.complete) {
        // On maps of a few sight radii a part is a large share of a plan, and with sub-priors so is a step.
        const bool sub_priors = test::shared_planner().belief().has_sub_priors;
        const double exact_s = cost_of(Bench::get().exact_score(candidate, to_double(anew.end_s)));
        EXPECT_NEAR(to_double(anew.cost), exact_s, (sub_priors ? 0.2 : 0.08) * exact_s + 0.1);
      }
      late += changed_s > Seconds{} ? 1 : 0;
      complete += anew.complete ? 1 : 0;
      if (random() % 3 != 0) {
        Bench::get().accept(candidate);
      }
    }
  }
  EXPECT_GT(late, kFixedPoint ? 200 : 400);  // without libccd fewer changes are proved free
  EXPECT_GT(complete, kFixedPoint ? 25 : 50);
  EXPECT_GT(with_sub_priors, 3);
}

// Lanes up and down a strip for each agent, a waypoint of them shifted here and there.
Route lane_route(const SearchProblem& problem, std::mt19937_64& random) {
  Bench& bench = Bench::get();
  Route route;
  const auto agents = static_cast<int>(problem.agents.size());
  const double width_m = problem.map.width_m() / agents;
  std::uniform_real_distribution<double> shift_m(-0.4, 0.4);
  for (int m = 0; m < agents; ++m) {
    Place at = bench.pool().place_of(m);
    const int lanes = static_cast<int>(width_m / 4.0);
    for (int i = 0; i < 2 * lanes; ++i) {
      const double across_m = (i / 2 + 0.5) / lanes * width_m;
      const bool top = i % 4 == 1 || i % 4 == 2;
      const Point p{m == 0 ? across_m : problem.map.width_m() - across_m, top ? problem.map.height_m() - 1.5 : 1.5};
      const Place to{spot_at({p.x_m + shift_m(random), p.y_m + shift_m(random)}), -1};
      int work = 0;
      const std::int32_t id = bench.pool().make(m, at, to, work);
      EXPECT_GE(id, 0);
      (void)route.legs[index(m)].push_back({id, false});
      at = to;
    }
  }
  return route;
}

void expect_near_exact(test::M1& m1, double share) {
  m1.problem().colony.ant.max_unseen_mass = 0.05;
  ASSERT_FALSE(test::shared_planner().prepare(m1.problem()));
  ASSERT_TRUE(Bench::get().open(m1.problem()));
  std::mt19937_64 random(52);
  int complete = 0;
  for (int i = 0; i < 12; ++i) {
    const Route route = lane_route(m1.problem(), random);
    const Judgement judgement = Bench::get().judge_anew(route);
    if (!judgement.complete) {
      continue;
    }
    ++complete;
    const PlanScore exact = Bench::get().exact_score(route, to_double(judgement.end_s));
    EXPECT_NEAR(exact.unseen_mass, m1.problem().colony.ant.max_unseen_mass, 0.01);
    EXPECT_NEAR(to_double(judgement.cost) / cost_of(exact), 1.0, share);
  }
  EXPECT_GT(complete, 8);
}

TEST(RouteJudge, IsWithinOnePercentOfTheExactScoreOnAUniformPrior) {
  test::M1 m1(1);
  expect_near_exact(m1, 0.01);
}

TEST(RouteJudge, IsWithinOnePercentOfTheExactScoreOnGaussians) {
  test::M1 m1(1);
  const std::vector<GaussianComponent> gaussians = {{{12, 12}, 4.0, 1.0}, {{30, 28}, 4.0, 1.0}};
  m1.problem().prior = std::span<const GaussianComponent>(gaussians);
  expect_near_exact(m1, 0.01);
}

TEST(RouteJudge, IsWithinOnePercentOfTheExactScoreWithSubPriors) {
  test::M1 m1(1);
  ASSERT_TRUE(m1.problem().agents[1].preferred.push_back(test::rectangle(0, 20, 40, 40)));
  expect_near_exact(m1, 0.01);
}

std::int32_t made(const Place& from, const Place& to) {
  int work = 0;
  const std::int32_t id = Bench::get().pool().make(0, from, to, work);
  EXPECT_GE(id, 0);
  return id;
}

Place spot(double x_m, double y_m) { return {spot_at({x_m, y_m}), -1}; }

// From one agent's start to the other's at the same place: a leg that takes no time.
TEST(RouteJudge, DoesNotGoOnFromBehindAChangedLegThatTookNoTime) {
  test::M1 m1(1);
  m1.problem().agents[1].body.start = m1.problem().agents[0].body.start;
  ASSERT_FALSE(test::shared_planner().prepare(m1.problem()));
  Bench& bench = Bench::get();
  ASSERT_TRUE(bench.open(m1.problem()));
  const Place here = bench.pool().place_of(0);
  const Place there = bench.pool().place_of(1);
  ASSERT_EQ(here.spot, there.spot);
  Route route;
  (void)route.legs[0].push_back({made(here, there), false});
  (void)route.legs[0].push_back({made(there, spot(20, 2)), false});
  (void)bench.judge_on(route, Seconds{});
  bench.accept(route);
  Route changed;
  (void)changed.legs[0].push_back({made(here, spot(2, 20)), false});
  const Judgement anew = bench.judge_anew(changed);
  expect_same(bench.judge_on(changed, Seconds{}), anew, 2);
}

TEST(RouteJudge, JudgesAnewWhenItDemandsLess) {
  test::M1 m1(1);
  m1.problem().colony.ant.max_unseen_mass = 0.4;
  ASSERT_FALSE(test::shared_planner().prepare(m1.problem()));
  Bench& bench = Bench::get();
  ASSERT_TRUE(bench.open(m1.problem()));
  std::mt19937_64 random(54);
  const Route route = lane_route(m1.problem(), random);
  bench.demand(0.3);
  Judgement strict = bench.judge_on(route, Seconds{});
  ASSERT_TRUE(strict.complete);
  bench.accept(route);
  strict = bench.judge_on(route, strict.end_s);  // keeps states to its end
  bench.demand(0.0);
  const Judgement anew = bench.judge_anew(route);
  EXPECT_LT(to_double(anew.end_s), to_double(strict.end_s));
  expect_same(bench.judge_on(route, strict.end_s), anew, 2);
}

TEST(RouteJudge, TakesAPlanForCompleteAtOnceWhereTheStartsShowEnough) {
  const test::DrawnMap map(6, 4, 0.25);
  SearchProblem problem;
  problem.map = map.view();
  problem.agents.resize(1);
  problem.agents[0].body.start = {2, 2};
  problem.colony.ant.max_unseen_mass = 0.5;
  ASSERT_FALSE(test::shared_planner().prepare(problem));
  Bench& bench = Bench::get();
  ASSERT_TRUE(bench.open(problem));
  Route route;
  for (int legs = 0; legs < 2; ++legs) {
    const Judgement judgement = bench.judge_anew(route);
    EXPECT_TRUE(judgement.complete);
    EXPECT_EQ(to_double(judgement.end_s), 0.0);
    EXPECT_EQ(to_double(judgement.cost), 0.0);
    EXPECT_EQ(judgement.legs_used[0], 0);
    (void)route.legs[0].push_back({made(bench.pool().place_of(0), spot(4, 2)), false});
  }
}

TEST(RouteJudge, HoldsAPlanThatSeesTooLittleForWorseThanOneThatSeesMoreOfIt) {
  test::M1 m1(1);
  ASSERT_FALSE(test::shared_planner().prepare(m1.problem()));
  ASSERT_TRUE(Bench::get().open(m1.problem()));
  std::mt19937_64 random(53);
  Route route = lane_route(m1.problem(), random);
  Judgement before = Bench::get().judge_anew(route);
  while (route.legs[0].size() > 1) {
    route.legs[0].pop_back();
    const Judgement shorter = Bench::get().judge_anew(route);
    EXPECT_FALSE(shorter.complete);
    EXPECT_GT(to_double(shorter.cost), to_double(before.cost));
    before = shorter;
  }
}

}  // namespace
}  // namespace ivo::planner
