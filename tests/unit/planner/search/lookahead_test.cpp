// Against a lookahead that tries its sequences cell by cell.
#include "planner/search/lookahead.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "planner/search/ant.hpp"
#include "tests/support/drawn_map.hpp"
#include "tests/support/m1.hpp"
#include "tests/support/random_search.hpp"
#include "tests/support/shared_planner.hpp"
#include "tests/support/star.hpp"
#include "tests/support/swath_cells.hpp"

namespace ivo::planner {
namespace {

using SeenCells = std::vector<bool>;

constexpr int kWidth = 4;
constexpr double kSameMass = kFixedPoint ? 1e-6 : 1e-12;

class SlowLookahead {
 public:
  /// `most_rows`: Lookahead::kUndo.
  SlowLookahead(const World& world, int agent, double patience, int most_rows = Lookahead::kUndo)
      : world_(world),
        agent_(agent),
        most_rows_(most_rows),
        patience_s_(patience * world.graph.spacing_m() / world.speeds_mps[index(agent)]) {}

  [[nodiscard]] double mass_of(Cell c) const {
    const Belief& belief = world_.belief;
    return to_double(belief.has_sub_priors ? belief.sub_mass[index(agent_)][index(c)] : belief.mass[index(c)]);
  }

  /// Of the edge and the best moves after it, `rows` of the seen map changed before it.
  double value(Edge e, double from_s, int moves, SeenCells seen, int rows = 0) const {
    const SightView view = world_.sight.along_edge(agent_, e);
    const int points = world_.sight.points(e);
    double value = 0.0;
    for (std::size_t i = 0; i < view.size(); ++i) {
      const Swath& swath = view.at(i);
      const int middle = (swath.first_point + swath.last_point) / 2;
      const double time_s = from_s + to_double(world_.pace(agent_, e)) * (view.reversed ? points - middle : middle);
      const double eighths = std::floor(time_s / (patience_s_ / 8.0));
      for (int row = 0; row < swath.rows; ++row) {
        bool changed = false;
        for_each_bit(world_.sight.words(swath)[row], [&](int bit) {
          const Cell c = world_.cells.at(8 * swath.first_byte + bit, swath.first_row + row);
          if (!seen[index(c)]) {
            seen[index(c)] = rows < most_rows_;
            changed = true;
            value += eighths < 64.0 ? mass_of(c) * std::exp(-eighths / 8.0) : 0.0;
          }
        });
        rows += changed && rows < most_rows_ ? 1 : 0;
      }
    }
    if (moves > 1) {
      double best = 0.0;
      for (const Edge next : promising(world_.graph.head(e), seen)) {
        const double then_s = from_s + to_double(world_.seconds_along(agent_, e));
        best = std::max(best, this->value(next, then_s, moves - 1, seen, rows));
      }
      value += best;
    }
    return value;
  }

  [[nodiscard]] std::vector<Edge> promising(Node here, const SeenCells& seen) const {
    struct Option {
      double rate;
      Edge edge;
    };
    std::vector<Option> options;
    for (Edge e = world_.graph.first_edge(here); e < world_.graph.end_edge(here); ++e) {
      if (in(world_.graph.open_to(e), agent_)) {
        double mass = 0.0;  // a cell once for each swath that shows it
        test::for_each_cell(world_.cells, world_.sight, world_.sight.along_edge(agent_, e),
                            [&](Cell c, const Swath&) { mass += seen[index(c)] ? 0.0 : mass_of(c); });
        if (mass > 0.0) {
          options.push_back({mass / world_.graph.length_m(e), e});
        }
      }
    }
    std::stable_sort(options.begin(), options.end(), [](const Option& a, const Option& b) { return a.rate > b.rate; });
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < std::min<std::size_t>(kWidth, options.size()); ++i) {
      // Which of two alike is followed is a matter of rounding: such a search decides nothing here.
      if (i + 1 == kWidth && options.size() > kWidth &&
          options[kWidth].rate > options[i].rate * (1.0 - (kFixedPoint ? 1e-4 : 1e-9))) {
        tied_ = true;
      }
      edges.push_back(options[i].edge);
    }
    return edges;
  }

  [[nodiscard]] bool tied() const { return tied_; }

 private:
  const World& world_;
  int agent_;
  int most_rows_;
  double patience_s_;
  mutable bool tied_ = false;
};

// What some random moves of the agent have shown.
void wander(const World& world, int agent, std::mt19937_64& random, Node& here, SeenMap& seen, SeenCells& cells) {
  for (int i = 0; i < 6; ++i) {
    std::vector<Edge> open;
    for (Edge e = world.graph.first_edge(here); e < world.graph.end_edge(here); ++e) {
      if (in(world.graph.open_to(e), agent)) {
        open.push_back(e);
      }
    }
    if (open.empty()) {
      return;
    }
    const Edge e = open[random() % open.size()];
    for (const Swath& swath : world.sight.along_edge(agent, e).swaths) {
      seen.look(swath, world.sight.words(swath), [](int, std::uint64_t) {});
    }
    test::for_each_cell(world.cells, world.sight, world.sight.along_edge(agent, e),
                        [&](Cell c, const Swath&) { cells[index(c)] = true; });
    here = world.graph.head(e);
  }
}

void expect_alike(const World& world, const SeenMap& a, const SeenMap& b) {
  for (int row = 0; row < world.cells.rows(); ++row) {
    for (int byte = 0; 8 * byte < world.cells.columns(); ++byte) {
      ASSERT_EQ(a.window(row, byte), b.window(row, byte)) << "row " << row;
    }
  }
}

TEST(Lookahead, TakesTheFirstMoveOfTheBestSequence) {
  std::mt19937_64 random(81);
  const auto lookahead = std::make_unique<Lookahead>(test::shared_planner().world());
  const auto seen = std::make_unique<SeenMap>();
  const auto before = std::make_unique<SeenMap>();
  int decided = 0;
  int nothing_new = 0;
  for (int draw = 0; draw < 120; ++draw) {
    SCOPED_TRACE("draw " + std::to_string(draw));
    test::RandomSearch search(random);
    if (test::shared_planner().prepare(search.problem())) {
      continue;
    }
    const World& world = test::shared_planner().world();
    const auto agent = static_cast<int>(random() % index(world.graph.agents()));
    const int moves = 1 + draw % Lookahead::kMostMoves;
    const double patience = draw % 2 == 0 ? 4.0 : 10.0;
    Node here = agent;
    seen->copy(world.belief.without_mass);
    SeenCells cells(index(world.cells.count()));
    wander(world, agent, random, here, *seen, cells);
    before->copy(*seen);
    lookahead->open();
    lookahead->start(moves, patience);
    lookahead->begin(agent, here);
    while (!lookahead->done()) {
      ASSERT_GT(lookahead->advance(*seen, 1 + draw % 50), 0);
    }
    expect_alike(world, *seen, *before);
    ASSERT_FALSE(HasFatalFailure());
    const SlowLookahead slow(world, agent, patience);
    double best = 0.0;
    for (const Edge e : slow.promising(here, cells)) {
      best = std::max(best, slow.value(e, 0.0, moves, cells));
    }
    if (best == 0.0) {
      ++nothing_new;
      EXPECT_EQ(lookahead->first_move(), -1);
    } else if (!slow.tied()) {
      ++decided;
      ASSERT_GE(lookahead->first_move(), 0);
      EXPECT_NEAR(slow.value(lookahead->first_move(), 0.0, moves, cells), best, kSameMass);
    }
  }
  EXPECT_GT(decided, 40);
  EXPECT_GT(nothing_new, 0);
}

// Discs of 600 rows: a move changes more rows than can be undone, and the way back shows what stayed unseen.
TEST(Lookahead, LeavesTheSeenMapAsItWasAlsoWhereItRunsOutOfUndo) {
  const test::DrawnMap map(250.0, 250.0, 0.25);
  const test::Star star({125.0, 125.0}, 5, 100.0);
  const GraphTable table = star.table();
  const std::vector<GaussianComponent> gaussians = {{{150.0, 200.0}, 60.0, 1.0}};
  SearchProblem problem;
  problem.map = map.view();
  problem.cell_m = 0.25;
  problem.graph_table = &table;
  problem.prior = std::span<const GaussianComponent>(gaussians);
  problem.agents.resize(1);
  problem.agents[0].body.start = {125.0, 125.0};
  problem.agents[0].sight_radius_m = 75.0;
  ASSERT_FALSE(test::shared_planner().prepare(problem));
  const World& world = test::shared_planner().world();
  const auto lookahead = std::make_unique<Lookahead>(world);
  const auto seen = std::make_unique<SeenMap>();
  for (const int moves : {2, Lookahead::kMostMoves}) {
    SCOPED_TRACE(moves);
    seen->copy(world.belief.without_mass);
    lookahead->open();
    lookahead->start(moves, 10.0);
    lookahead->begin(0, 0);
    while (!lookahead->done()) {
      ASSERT_GT(lookahead->advance(*seen, 5000), 0);
    }
    expect_alike(world, *seen, world.belief.without_mass);
    ASSERT_FALSE(HasFatalFailure());

    const SlowLookahead slow(world, 0, 10.0);
    const SlowLookahead with_room(world, 0, 10.0, std::numeric_limits<int>::max());
    const SeenCells cells(index(world.cells.count()));
    double best = 0.0;
    double best_with_room = 0.0;
    for (const Edge e : slow.promising(0, cells)) {
      best = std::max(best, slow.value(e, 0.0, moves, cells));
      best_with_room = std::max(best_with_room, with_room.value(e, 0.0, moves, cells));
    }
    ASSERT_FALSE(slow.tied());
    EXPECT_GT(best, best_with_room + 0.001);  // there is more to undo than room for it
    ASSERT_GE(lookahead->first_move(), 0);
    EXPECT_NEAR(slow.value(lookahead->first_move(), 0.0, moves, cells), best, kSameMass);
  }
}

TEST(Lookahead, SeesFurtherThanAGreedyStep) {
  // Whole plans for two Gaussians: an ant that looks three moves ahead against a greedy one.
  test::M1 m1(1);
  const std::vector<GaussianComponent> gaussians = {{{12.0, 12.0}, 4.0, 1.0}, {{30.0, 28.0}, 4.0, 1.0}};
  m1.problem().prior = std::span<const GaussianComponent>(gaussians);
  Planner& planner = test::shared_planner();
  ASSERT_FALSE(planner.prepare(m1.problem()));
  const World& world = planner.world();
  const auto trails = std::make_unique<Trails>();
  const auto ant = std::make_unique<Ant>(world, *trails);
  trails->start(world.graph, 0.02, 0);
  ant->open();
  Rng rng(1);
  std::array<double, 2> cost_s{};
  for (const int moves : {1, 3}) {
    AntParameters parameters = m1.problem().colony.ant;
    parameters.looks_ahead = moves;
    parameters.patience = 10.0;
    ant->start(parameters, Heuristic::kUnseen, 6);
    while (!ant->done()) {
      (void)ant->advance(rng, 1000);
    }
    EXPECT_TRUE(ant->complete());
    cost_s[moves == 1 ? 0 : 1] = to_double(ant->cost().high);
  }
  EXPECT_LT(cost_s[1], cost_s[0] - 1.0);
  EXPECT_EQ(rng.next(), Rng(1).next());  // and draws nothing
}

}  // namespace
}  // namespace ivo::planner
