// Ants one by one: what they claim of their tours' cost, and what the tours cost.
#include "planner/search/ant.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "planner/search/tour_scorer.hpp"
#include "tests/support/agreement.hpp"
#include "tests/support/m1.hpp"
#include "tests/support/masses.hpp"
#include "tests/support/naive_evaluator.hpp"
#include "tests/support/random_search.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

using test::kAgreement;
using test::kStepAgreement;

class AntTest : public testing::Test {
 protected:
  struct Parts {
    const World& world = test::shared_planner().world();
    Trails trails;
    Ant ant{world, trails};
    FirstSightings sightings;
    TourScorer scorer{world, sightings};
    Tour tour;
  };
  static Parts& parts() {
    static const auto parts = std::make_unique<Parts>();
    return *parts;
  }

  // False when the search is refused.
  static bool open(const SearchProblem& problem, bool to_end = false) {
    if (test::shared_planner().prepare(problem)) {
      return false;
    }
    Parts& p = parts();
    p.trails.start(p.world.graph, problem.colony.rho,
                   problem.colony.heuristic == Heuristic::kTsp ? problem.colony.beta : 0);
    p.ant.open();
    p.scorer.open(to_end);
    return true;
  }
  static const Tour& walk(const SearchProblem& problem, Rng& rng, int rows = 256) {
    Parts& p = parts();
    p.ant.start(problem.colony.ant, problem.colony.heuristic, problem.colony.beta);
    while (!p.ant.done()) {
      EXPECT_GT(p.ant.advance(rng, rows), 0);
    }
    p.ant.finish(p.tour);
    return p.tour;
  }
  static const Tour& score(double max_unseen_mass, int rows = 256) {
    Parts& p = parts();
    p.scorer.start(p.tour, max_unseen_mass);
    while (!p.scorer.done()) {
      EXPECT_GT(p.scorer.advance(rows), 0);
    }
    return p.tour;
  }
};

struct Tally {
  int tours = 0;
  int complete = 0;
  int jumped = 0;
  double width_s = 0.0;
  double cost_s = 0.0;
};

void expect_inside(const CostInterval& interval, bool complete, double exact_s, Tally& tally) {
  ++tally.tours;
  if (!complete) {
    return;  // incomplete tours compare by what they leave unseen
  }
  ++tally.complete;
  ASSERT_LE(to_double(interval.low), exact_s);
  ASSERT_GE(to_double(interval.high), exact_s);
  tally.width_s += to_double(interval.high) - to_double(interval.low);
  tally.cost_s += exact_s;
}

TEST_F(AntTest, KnowsBoundsOfItsCostOnRandomSearches) {
  std::mt19937_64 random(51);
  std::array<Tally, limits::kAgents + 1> tallies{};
  int searches = 0;
  for (int draw = 0; searches < 400; ++draw) {
    ASSERT_LT(draw, 4000);
    test::RandomSearch search(random);
    SearchProblem& problem = search.problem();
    problem.colony.ant.shortest_first = draw % 3 == 0 ? 0.0 : problem.colony.ant.shortest_first;
    problem.colony.ant.completes = draw % 4 < 2;
    if (draw % 2 == 0) {
      problem.colony.beta = 0;  // wild tours: agents cross and follow each other
    }
    if (!open(problem)) {
      continue;
    }
    ++searches;
    SCOPED_TRACE("draw " + std::to_string(draw));
    Rng rng(problem.colony.seed);
    for (int ant = 0; ant < 25; ++ant) {
      const CostInterval claimed = walk(problem, rng).cost;
      const bool complete = parts().tour.complete;
      const double unseen = to_double(parts().tour.unseen);
      const Tour& tour = score(problem.colony.ant.max_unseen_mass);
      ASSERT_EQ(complete, tour.complete);
      const double whole = to_double(parts().world.belief.whole);
      ASSERT_NEAR(unseen / whole, tour.score.unseen_mass, 1e-9);
      expect_inside(claimed, complete, tour.score.expected_time_s * whole, tallies[problem.agents.size()]);
      ASSERT_FALSE(HasFatalFailure());
    }
  }
  for (int agents = 1; agents <= std::min(4, limits::kAgents); ++agents) {
    const Tally& tally = tallies[index(agents)];
    EXPECT_GT(tally.complete, 300) << agents << " agents";
    EXPECT_GT(tally.tours, tally.complete);
    RecordProperty("width_per_cost_" + std::to_string(agents), std::to_string(tally.width_s / tally.cost_s));
  }
  EXPECT_LT(tallies[1].width_s, tallies[1].cost_s);  // bounds that say nothing would pass above
}

// Two that start side by side see the same cells, in turns.
TEST_F(AntTest, KnowsBoundsOfItsCostWhereAgentsWalkTogether) {
  std::mt19937_64 random(52);
  std::uniform_real_distribution<double> speed(0.2, 2.0);
  std::uniform_real_distribution<double> radius(0.8, 4.0);
  Tally tally;
  for (int i = 0; i < 60; ++i) {
    const test::DrawnMap map(16.0, 12.0, 0.25);
    SearchProblem problem;
    problem.map = map.view();
    problem.cell_m = 0.5;
    problem.graph.spacing_m = 2.0;
    problem.colony.beta = static_cast<int>(random() % 4);
    problem.colony.ant.shortest_first = i % 4 == 0 ? 0.0 : 0.5;
    problem.colony.ant.max_unseen_mass = i % 2 == 0 ? 0.014 : 0.2;
    problem.colony.ant.completes = i % 3 == 0;
    problem.agents.resize(static_cast<std::size_t>(std::min(2 + i % 3, limits::kAgents)));
    for (SearchAgent& agent : problem.agents) {
      agent.body.start = {7.9, 6.1};
      agent.speed_mps = speed(random);
      agent.sight_radius_m = radius(random);
    }
    ASSERT_TRUE(open(problem));
    Rng rng(random());
    for (int ant = 0; ant < 40; ++ant) {
      const CostInterval claimed = walk(problem, rng).cost;
      const bool complete = parts().tour.complete;
      expect_inside(
          claimed, complete,
          score(problem.colony.ant.max_unseen_mass).score.expected_time_s * to_double(parts().world.belief.whole),
          tally);
      ASSERT_FALSE(HasFatalFailure()) << "search " << i << ", ant " << ant;
    }
  }
  EXPECT_GT(tally.complete, 1000);
}

TEST_F(AntTest, BoundsItsCostTightlyEnoughToSpareMostScoresOnM1) {
  test::M1 m1(1);
  ASSERT_TRUE(open(m1.problem()));
  Rng rng(1);
  Tally tally;
  for (int ant = 0; ant < 40; ++ant) {
    const CostInterval claimed = walk(m1.problem(), rng).cost;
    const bool complete = parts().tour.complete;
    expect_inside(claimed, complete, score(0.014).score.expected_time_s * to_double(parts().world.belief.whole), tally);
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_EQ(tally.complete, 40);
  EXPECT_LT(tally.width_s, 0.1 * tally.cost_s);
}

TEST_F(AntTest, WalksTheSameHoweverTheWorkIsSliced) {
  std::mt19937_64 random(53);
  int searches = 0;
  for (int draw = 0; searches < 20; ++draw) {
    ASSERT_LT(draw, 300);
    test::RandomSearch search(random);
    search.problem().colony.heuristic = draw % 2 == 0 ? Heuristic::kTsp : Heuristic::kMts;
    search.problem().colony.ant.completes = draw % 3 == 0;
    if (!open(search.problem())) {
      continue;
    }
    ++searches;
    Rng rng(7);
    static Tour whole;
    whole.assign(walk(search.problem(), rng, 1'000'000));
    for (const int rows : {1, 5, 64}) {
      Rng again(7);
      const Tour& tour = walk(search.problem(), again, rows);
      for (std::size_t m = 0; m < whole.paths.size(); ++m) {
        ASSERT_TRUE(
            std::equal(tour.paths[m].begin(), tour.paths[m].end(), whole.paths[m].begin(), whole.paths[m].end()))
            << "in parts of " << rows;
      }
      ASSERT_EQ(tour.unseen, whole.unseen);
    }
  }
}

// --- the jumps of an ant that looks ahead

struct SlowJump {
  Node to = -1;
  double way_m = 0.0;
  bool past_the_nearest = false;    // to another than the nearest node that shows anything
  bool stopped_by_the_way = false;  // one more than twice as far would show more for its way
};

// Of the nodes up to twice as far as the nearest that shows anything, that which shows most for its way.
SlowJump slow_jump(const World& world, int agent, Node from, const SeenMap& seen) {
  const Graph& graph = world.graph;
  const Belief& belief = world.belief;
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  std::vector<double> way_m(index(graph.nodes()), kNowhere);
  way_m[index(from)] = 0.0;
  for (bool shorter = true; shorter;) {
    shorter = false;
    for (Node n = 0; n < graph.nodes(); ++n) {
      for (Edge e = graph.first_edge(n); e < graph.end_edge(n); ++e) {
        const double by_here_m = way_m[index(n)] + graph.length_m(e);
        if (in(graph.open_to(e), agent) && by_here_m < way_m[index(graph.head(e))]) {
          way_m[index(graph.head(e))] = by_here_m;
          shorter = true;
        }
      }
    }
  }
  std::vector<Mass> shown(index(graph.nodes()));
  double nearest_m = kNowhere;
  for (Node n = 0; n < graph.nodes(); ++n) {
    if (n == from || way_m[index(n)] == kNowhere) {
      continue;
    }
    for_each_seen(world.cells, graph.position(n), world.sight.radius_m(agent), [&](Cell c) {
      if (!seen.test(world.cells.column(c), world.cells.row(c))) {
        shown[index(n)] += belief.has_sub_priors ? belief.sub_mass[index(agent)][index(c)] : belief.mass[index(c)];
      }
    });
    if (shown[index(n)] > Mass{}) {
      nearest_m = std::min(nearest_m, way_m[index(n)]);
    }
  }
  SlowJump jump;
  Eta best{};
  Eta best_anywhere{};
  for (Node n = 0; n < graph.nodes(); ++n) {
    if (shown[index(n)] <= Mass{}) {
      continue;
    }
    const double m = way_m[index(n)];
    const Eta rate = eta_of(shown[index(n)], m);
    best_anywhere = std::max(best_anywhere, rate);
    if (m <= 2.0 * nearest_m && (jump.to < 0 || rate > best || (rate == best && m < jump.way_m))) {
      jump = {.to = n, .way_m = m, .past_the_nearest = m > nearest_m, .stopped_by_the_way = false};
      best = rate;
    }
  }
  jump.stopped_by_the_way = best_anywhere > best;
  return jump;
}

struct JumpTally {
  int moves = 0;
  int jumps = 0;
  int past_the_nearest = 0;
  int stopped_by_the_way = 0;
  int given_up = 0;
};

// Walks a tour turn by turn, and asks at each whether the agent should have gone there.
class LookingAhead {
 public:
  LookingAhead(const World& world, const AntParameters& parameters)
      : world_(world), parameters_(parameters), lookahead_(std::make_unique<Lookahead>(world)) {
    lookahead_->open();
    lookahead_->start(parameters.looks_ahead, parameters.patience);
    seen_->copy(world.belief.without_mass);
    unseen_ = world.belief.whole;
    for (int m = 0; m < world.graph.agents(); ++m) {
      at_.push_back(m);
      look(world.sight.from_node(m, m));
    }
    time_s_.resize(at_.size());
    taken_.resize(at_.size());
    given_up_.resize(at_.size());
  }

  void expect(const Tour& tour, JumpTally& tally) {
    for (std::optional<int> agent = next_agent(); agent; agent = next_agent()) {
      const EdgePath& path = tour.paths[index(*agent)];
      lookahead_->begin(*agent, at_[index(*agent)]);
      while (!lookahead_->done()) {
        (void)lookahead_->advance(*seen_, 1000);
      }
      if (lookahead_->first_move() >= 0) {
        ++tally.moves;
        ASSERT_LT(taken_[index(*agent)], path.size());
        ASSERT_EQ(path[taken_[index(*agent)]], lookahead_->first_move());
        take(*agent, path);
        continue;
      }
      const SlowJump jump = slow_jump(world_, *agent, at_[index(*agent)], *seen_);
      if (jump.to < 0) {
        ++tally.given_up;
        given_up_[index(*agent)] = true;
        continue;
      }
      ++tally.jumps;
      tally.past_the_nearest += jump.past_the_nearest ? 1 : 0;
      tally.stopped_by_the_way += jump.stopped_by_the_way ? 1 : 0;
      double way_m = 0.0;
      do {
        ASSERT_LT(taken_[index(*agent)], path.size());
        way_m += world_.graph.length_m(path[taken_[index(*agent)]]);
        take(*agent, path);
      } while (at_[index(*agent)] != jump.to && way_m < jump.way_m);
      ASSERT_EQ(at_[index(*agent)], jump.to);
      ASSERT_NEAR(way_m, jump.way_m, 1e-9);
    }
    for (std::size_t m = 0; m < at_.size(); ++m) {
      ASSERT_EQ(taken_[m], tour.paths[m].size());
    }
    ASSERT_EQ(tour.unseen, unseen_);
  }

 private:
  // The one whose path ends earliest.
  [[nodiscard]] std::optional<int> next_agent() const {
    std::optional<int> next;
    for (int m = 0; m < world_.graph.agents(); ++m) {
      if (!given_up_[index(m)] && (!next || time_s_[index(m)] < time_s_[index(*next)])) {
        next = m;
      }
    }
    const bool complete = is_complete(to_double(unseen_) / to_double(world_.belief.whole), parameters_.max_unseen_mass);
    return complete ? std::nullopt : next;
  }
  void look(const SightView& view) {
    for (const Swath& swath : view.swaths) {
      seen_->look(swath, world_.sight.words(swath), [&](int row, std::uint64_t fresh) {
        for_each_bit(fresh,
                     [&](int bit) { unseen_ -= world_.belief.mass[index(seen_->cell(row, swath.first_byte, bit))]; });
      });
    }
  }
  void take(int agent, const EdgePath& path) {
    const Edge e = path[taken_[index(agent)]++];
    look(world_.sight.along_edge(agent, e));
    time_s_[index(agent)] += world_.seconds_along(agent, e);
    at_[index(agent)] = world_.graph.head(e);
  }

  const World& world_;
  AntParameters parameters_;
  std::unique_ptr<Lookahead> lookahead_;
  std::unique_ptr<SeenMap> seen_ = std::make_unique<SeenMap>();
  Mass unseen_{};
  std::vector<Node> at_;
  std::vector<Seconds> time_s_;
  std::vector<std::size_t> taken_;  // edges
  std::vector<bool> given_up_;
};

// A dense graph and a prior of a few spots, so that there is often nothing new in a node's neighbourhood.
TEST_F(AntTest, JumpsToWhatShowsMostForItsWayWhenItLooksAhead) {
  std::mt19937_64 random(55);
  JumpTally tally;
  int searches = 0;
  for (int draw = 0; searches < 100; ++draw) {
    ASSERT_LT(draw, 2000);
    test::RandomSearch search(random);
    SearchProblem& problem = search.problem();
    std::vector<std::uint16_t> spots(16 * 12);
    for (std::uint16_t& spot : spots) {
      spot = random() % 12 == 0 ? static_cast<std::uint16_t>(1 + random() % 65'535) : std::uint16_t{0};
    }
    problem.prior = GreyView{spots, 16, 12, 1.0};
    problem.graph.spacing_m = 0.9;
    problem.colony.heuristic = Heuristic::kUnseen;
    problem.colony.ant.looks_ahead = 1 + draw % Lookahead::kMostMoves;
    for (SearchAgent& agent : problem.agents) {
      agent.sight_radius_m = std::min(agent.sight_radius_m, 1.0);
    }
    if (!open(problem)) {
      continue;
    }
    ++searches;
    SCOPED_TRACE("draw " + std::to_string(draw));
    Rng rng(1);
    const Tour& tour = walk(problem, rng, 1 + draw % 300);
    LookingAhead(parts().world, problem.colony.ant).expect(tour, tally);
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_GT(tally.moves, 300);
  EXPECT_GT(tally.jumps, 100);
  EXPECT_GT(tally.past_the_nearest, 20);
  EXPECT_GT(tally.stopped_by_the_way, 10);
  EXPECT_GT(tally.given_up, 5);
}

// --- the tour's exact score

std::vector<Point> waypoints_of(const Graph& graph, const Tour& tour, int agent, double speed_mps, double cell_m) {
  std::vector<Point> waypoints = {graph.position(agent)};
  double left_m = to_double(tour.end_s[index(agent)]) * speed_mps;
  for (const Edge e : tour.paths[index(agent)]) {
    const Point from = waypoints.back();
    const Point to = graph.position(graph.head(e));
    const double length_m = graph.length_m(e);
    const int n = sight_points(length_m, cell_m);
    const int last = std::min(n, static_cast<int>(std::lround(left_m / length_m * n)));
    waypoints.push_back(last < n ? sight_point(from, to, last, n) : to);
    left_m -= length_m;
  }
  return waypoints;
}

TEST_F(AntTest, IsScoredAsTheNaiveEvaluatorScoresIt) {
  std::mt19937_64 random(54);
  int searches = 0;
  int with_sub_priors = 0;
  for (int draw = 0; searches < 60; ++draw) {
    ASSERT_LT(draw, 600);
    test::RandomSearch search(random);
    const SearchProblem& problem = search.problem();
    const bool to_end = draw % 2 == 0;
    search.problem().colony.ant.completes = draw % 3 == 0;
    if (!open(problem, to_end)) {
      continue;
    }
    ++searches;
    SCOPED_TRACE("draw " + std::to_string(draw));
    const Planner& planner = test::shared_planner();
    const Belief& belief = planner.belief();
    with_sub_priors += belief.has_sub_priors ? 1 : 0;
    Rng rng(problem.colony.seed);
    for (int ant = 0; ant < 2; ++ant) {
      (void)walk(problem, rng);
      const Tour& tour = score(problem.colony.ant.max_unseen_mass, ant == 0 ? 256 : 3);
      test::NaiveMission mission{planner.cells(), test::as_doubles(belief.mass, belief.cells), {}};
      mission.sub_prior_steps = belief.sub_prior_steps;
      std::vector<std::vector<Point>> waypoints;
      std::vector<test::NaivePath> paths;
      for (std::size_t m = 0; m < problem.agents.size(); ++m) {
        const SearchAgent& agent = problem.agents[m];
        waypoints.push_back(waypoints_of(planner.graph(), tour, static_cast<int>(m), agent.speed_mps, problem.cell_m));
        if (belief.has_sub_priors) {
          mission.sub_priors.push_back(test::as_doubles(belief.sub_mass[m], belief.cells));
        }
      }
      for (std::size_t m = 0; m < problem.agents.size(); ++m) {
        paths.push_back({waypoints[m], problem.agents[m].speed_mps, problem.agents[m].sight_radius_m});
      }
      const test::NaiveEvaluator evaluator(std::move(mission), paths);
      const PlanScore expected = evaluator.score();
      ASSERT_NEAR(tour.score.expected_time_s, expected.expected_time_s, kStepAgreement);
      ASSERT_NEAR(tour.score.expected_time_continuous_s, expected.expected_time_continuous_s, kAgreement);
      ASSERT_NEAR(tour.score.expected_sub_prior_time_s, expected.expected_sub_prior_time_s, kStepAgreement);
      ASSERT_NEAR(tour.score.unseen_mass, expected.unseen_mass,
                  1e-9 + (kFixedPoint ? kMassUnit * belief.mass_cell_count : 0.0));
      ASSERT_NEAR(tour.score.horizon_s, expected.horizon_s, kAgreement);
      ASSERT_EQ(tour.cost.low, tour.cost.high);
      if (!belief.has_sub_priors) {
        ASSERT_NEAR(to_double(tour.cost.low), expected.expected_time_s, kStepAgreement);
      } else if (to_end) {
        ASSERT_NEAR(to_double(tour.cost.low), evaluator.expected_sub_prior_time_s(step_of(tour.score.horizon_s)),
                    kStepAgreement);
      } else {
        ASSERT_NEAR(to_double(tour.cost.low), expected.expected_sub_prior_time_s, kStepAgreement);
      }
      const std::vector<double> last_new_s = evaluator.last_new_s();
      for (std::size_t m = 0; m < last_new_s.size(); ++m) {
        ASSERT_NEAR(to_double(tour.end_s[m]), last_new_s[m], kAgreement);
      }
    }
  }
  EXPECT_GT(with_sub_priors, 10);
}

}  // namespace
}  // namespace ivo::planner
