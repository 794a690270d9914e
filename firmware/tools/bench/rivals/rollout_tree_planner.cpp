#include "firmware/tools/bench/rivals/rollout_tree_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "firmware/tools/bench/rivals/best_plan.hpp"
#include "firmware/tools/bench/rivals/team_walk.hpp"
#include "planner/numeric/rng.hpp"

namespace ivo::firmware::rivals {
namespace {

using planner::Edge;
using planner::Node;

constexpr int kTriesARoot = 8;
constexpr Edge kJump = -1;  // nothing new next door: TeamWalk::jump

struct Move {
  Edge edge = kJump;
  double rate = 0.0;
};

struct TreeNode {
  std::vector<Move> moves;  // most promising first; those from children.size() on are untried
  std::vector<std::size_t> children;
  bool expanded = false;
  int visits = 0;
  double sum = 0.0;  // of rewards
  double best = 0.0;
};

class RolloutTree {
 public:
  RolloutTree(const RivalProblem& problem, std::uint64_t seed)
      : problem_(problem), best_(problem), rng_(seed), root_(problem) {
    reset_tree();
  }

  /// One try: a whole plan. False when `watch` stopped it before its end.
  bool grow(const Stopwatch& watch) {
    TeamWalk walk = root_;
    std::vector<std::size_t> path = {0};
    moves_ = taken_;
    bool fresh = false;
    while (!fresh) {
      const std::optional<int> agent = walk.next_agent();
      if (!agent) {
        break;
      }
      const std::size_t child = select(path.back(), walk, *agent, fresh);
      path.push_back(child);
    }
    noise_ = kNoises[static_cast<std::size_t>(rng_.below(static_cast<int>(kNoises.size())))];
    noise_ = first_ ? 0.0 : noise_;  // the first plan is the greedy one
    while (const std::optional<int> agent = walk.next_agent()) {
      if (!best_.empty() && watch.out_of_time()) {
        return false;
      }
      play(walk, *agent, noisy_best(walk, *agent));
    }
    record(walk, path);
    return true;
  }

  /// The root goes one move along the best plan found; at its end back to the start.
  void advance_root() {
    const std::size_t at = taken_.size();
    if (at + 1 >= best_moves_.size()) {
      root_ = TeamWalk(problem_);
      taken_.clear();
    } else if (const std::optional<int> agent = root_.next_agent()) {
      play_on(root_, *agent, best_moves_[at]);
      taken_.push_back(best_moves_[at]);
    }
    reset_tree();
  }

  [[nodiscard]] RivalPlan best(int tries) { return best_.take(tries); }

 private:
  static constexpr std::size_t kMostMoves = 8;
  static constexpr double kExploration = 0.3;
  static constexpr std::array<double, 4> kNoises = {0.08, 0.24, 0.5, 0.95};

  void reset_tree() {
    tree_.clear();
    tree_.emplace_back();
    least_cost_ = std::numeric_limits<double>::infinity();
    most_cost_ = 0.0;
  }

  void expand(std::size_t n, const TeamWalk& walk, int agent) {
    const planner::Graph& graph = problem_.prepared.graph();
    std::vector<Move> moves;
    for (Edge e = graph.first_edge(walk.at(agent)); e < graph.end_edge(walk.at(agent)); ++e) {
      if (walk.open(agent, e)) {
        if (const double rate = walk.rate(agent, e); rate > 1e-15) {
          moves.push_back({e, rate});
        }
      }
    }
    std::sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) { return a.rate > b.rate; });
    moves.resize(std::min(moves.size(), kMostMoves));
    if (moves.empty()) {
      moves.push_back({});
    }
    tree_[n].moves = std::move(moves);
    tree_[n].expanded = true;
  }

  // The next untried move while the node has been visited often enough for another (progressive widening), else UCT.
  std::size_t select(std::size_t n, TeamWalk& walk, int agent, bool& fresh) {
    if (!tree_[n].expanded) {
      expand(n, walk, agent);
    }
    const std::size_t tried = tree_[n].children.size();
    const auto allowed = static_cast<std::size_t>(1.0 + std::sqrt(static_cast<double>(tree_[n].visits)));
    if (tried < tree_[n].moves.size() && tried < allowed) {
      fresh = true;
      const std::size_t child = tree_.size();
      tree_.emplace_back();
      tree_[n].children.push_back(child);
      play(walk, agent, tree_[n].moves[tried].edge);
      return child;
    }
    std::size_t chosen = 0;
    double best_value = -1.0;
    for (std::size_t i = 0; i < tried; ++i) {
      const TreeNode& child = tree_[tree_[n].children[i]];
      const double value = 0.5 * (child.sum / child.visits + child.best) +
                           kExploration * std::sqrt(std::log(1.0 + tree_[n].visits) / child.visits);
      if (value > best_value) {
        best_value = value;
        chosen = i;
      }
    }
    play(walk, agent, tree_[n].moves[chosen].edge);
    return tree_[n].children[chosen];
  }

  // The most new mass a second, each rate taken less by up to `noise_`.
  Edge noisy_best(const TeamWalk& walk, int agent) {
    const planner::Graph& graph = problem_.prepared.graph();
    Edge best = kJump;
    double best_rate = 1e-15;
    for (Edge e = graph.first_edge(walk.at(agent)); e < graph.end_edge(walk.at(agent)); ++e) {
      if (!walk.open(agent, e)) {
        continue;
      }
      const double rate = walk.rate(agent, e) * (noise_ > 0.0 ? 1.0 - noise_ * rng_.unit() : 1.0);
      if (rate > best_rate) {
        best_rate = rate;
        best = e;
      }
    }
    return best;
  }

  void play(TeamWalk& walk, int agent, Edge e) {
    play_on(walk, agent, e);
    moves_.push_back(e);
  }
  static void play_on(TeamWalk& walk, int agent, Edge e) {
    if (e == kJump) {
      walk.jump(agent);
    } else {
      walk.take(agent, e);
    }
  }

  // Rewards are scaled to what this tree has seen: 1 for the cheapest plan.
  void record(const TeamWalk& walk, const std::vector<std::size_t>& path) {
    const double cost = walk.cost() + (walk.complete() ? 0.0 : kIncomplete);
    first_ = false;
    if (cost < best_cost_) {
      best_cost_ = cost;
      best_moves_ = moves_;
      best_.offer(walk.waypoints(), false);
    }
    least_cost_ = std::min(least_cost_, cost);
    most_cost_ = std::max(most_cost_, cost);
    const double range = std::max(most_cost_ - least_cost_, 1e-9);
    const double reward = (most_cost_ - cost) / range;
    for (const std::size_t n : path) {
      ++tree_[n].visits;
      tree_[n].sum += reward;
      tree_[n].best = std::max(tree_[n].best, reward);
    }
  }

  static constexpr double kIncomplete = 1e9;

  const RivalProblem& problem_;
  BestPlan best_;
  planner::Rng rng_;
  TeamWalk root_;
  std::vector<Edge> taken_;  // from the start to the root
  std::vector<Edge> moves_;  // of the try under way, the root's with them
  std::vector<Edge> best_moves_;
  double best_cost_ = std::numeric_limits<double>::infinity();
  std::vector<TreeNode> tree_;
  double least_cost_ = 0.0;
  double most_cost_ = 0.0;
  double noise_ = 0.0;
  bool first_ = true;
};

}  // namespace

RivalPlan plan_by_rollouts(const RivalProblem& problem, Effort effort, std::uint64_t seed) {
  const Stopwatch watch(effort);
  RolloutTree tree(problem, seed);
  int tries = 0;
  for (int at_root = 0; !watch.over(tries);) {
    ++tries;
    if (!tree.grow(watch)) {
      break;
    }
    if (++at_root >= kTriesARoot) {
      at_root = 0;
      tree.advance_root();
    }
  }
  return tree.best(tries);
}

}  // namespace ivo::firmware::rivals
