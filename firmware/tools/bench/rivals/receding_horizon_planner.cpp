#include "firmware/tools/bench/rivals/receding_horizon_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/tools/bench/rivals/best_plan.hpp"
#include "firmware/tools/bench/rivals/greedy_planner.hpp"

namespace ivo::firmware::rivals {
namespace {

using planner::Edge;
using planner::Node;

struct Horizon {
  int depth = 2;           // moves
  int width = 4;           // most promising moves followed at each depth
  double tau_steps = 4.0;  // tau in the time that the fastest agent takes for the graph's spacing
};

class Lookahead {
 public:
  Lookahead(const RivalProblem& problem, const Horizon& horizon) : problem_(problem), horizon_(horizon) {
    double fastest_mps = 0.0;
    for (const planner::SearchAgent& agent : problem.search.agents) {
      fastest_mps = std::max(fastest_mps, agent.speed_mps);
    }
    tau_s_ = horizon.tau_steps * problem.prepared.graph().spacing_m() / fastest_mps;
  }

  /// The first edge of the best sequence, -1 when the neighbours show nothing new.
  [[nodiscard]] Edge first_move(const TeamWalk& walk, int agent) {
    agent_ = agent;
    walk_ = &walk;
    seen_ = walk.seen();
    Edge first = -1;
    best_of(walk.at(agent), 0.0, horizon_.depth, first);
    return first;
  }

 private:
  struct Option {
    double rate = 0.0;
    Edge edge = -1;
  };
  struct Undo {
    std::uint32_t word = 0;
    std::uint64_t bits = 0;
  };
  static constexpr std::size_t kMostOptions = 16;

  double best_of(Node here, double from_s, int depth, Edge& chosen) {
    std::array<Option, kMostOptions> options;
    const std::size_t count = promising(here, options);
    double best = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const Edge e = options[i].edge;
      const double seconds = walk_->seconds_along(agent_, e);
      const std::size_t mark = undo_.size();
      double value = see(e, from_s, seconds);
      if (depth > 1) {
        Edge next = -1;
        value += best_of(problem_.prepared.graph().head(e), from_s + seconds, depth - 1, next);
      }
      while (undo_.size() > mark) {
        seen_[undo_.back().word] = undo_.back().bits;
        undo_.pop_back();
      }
      if (value > best) {
        best = value;
        chosen = e;
      }
    }
    return best;
  }

  // By new mass a second, the most first.
  std::size_t promising(Node here, std::array<Option, kMostOptions>& options) const {
    const planner::Graph& graph = problem_.prepared.graph();
    const auto width = static_cast<std::size_t>(horizon_.width);
    std::size_t count = 0;
    for (Edge e = graph.first_edge(here); e < graph.end_edge(here); ++e) {
      if (!walk_->open(agent_, e)) {
        continue;
      }
      const double mass = problem_.coverage.new_mass(problem_.coverage.along(agent_, e), seen_);
      const double rate = mass / walk_->seconds_along(agent_, e);
      if (mass <= 1e-15 || (count == width && rate <= options[count - 1].rate)) {
        continue;
      }
      std::size_t slot = count < width ? count++ : count - 1;
      for (; slot > 0 && options[slot - 1].rate < rate; --slot) {
        options[slot] = options[slot - 1];
      }
      options[slot] = {rate, e};
    }
    return count;
  }

  double see(Edge e, double from_s, double seconds) {
    double value = 0.0;
    float last_at = -1.0F;
    double weight = 0.0;
    for (const CoverageRow& row : problem_.coverage.along(agent_, e)) {
      const std::uint64_t bits = row.bits & ~seen_[row.word];
      if (bits == 0) {
        continue;
      }
      if (row.at != last_at) {
        last_at = row.at;
        weight = std::exp(-(from_s + seconds * static_cast<double>(row.at)) / tau_s_);
      }
      value += weight * problem_.coverage.mass(row.word, bits);
      undo_.push_back({row.word, seen_[row.word]});
      seen_[row.word] |= bits;
    }
    return value;
  }

  const RivalProblem& problem_;
  Horizon horizon_;
  double tau_s_ = 1.0;
  int agent_ = 0;
  const TeamWalk* walk_ = nullptr;
  CellSet seen_;
  std::vector<Undo> undo_;
};

// The cheap ones first: each depth is worth its time only when the time is there.
std::vector<Horizon> horizons() {
  std::vector<Horizon> all;
  for (const auto& [depth, width] :
       {std::pair{2, 4}, {3, 4}, {4, 4}, {3, 10}, {5, 4}, {4, 8}, {6, 4}, {5, 8}, {8, 3}}) {
    for (const double tau_steps : {4.0, 1.5, 10.0, 30.0}) {
      all.push_back({depth, width, tau_steps});
    }
  }
  return all;
}

}  // namespace

RivalPlan plan_with_receding_horizon(const RivalProblem& problem, Effort effort, std::uint64_t /*seed*/) {
  const Stopwatch watch(effort);
  BestPlan best(problem);
  int tries = 0;
  for (const Horizon& horizon : horizons()) {
    if (watch.over(tries)) {
      break;
    }
    ++tries;
    TeamWalk walk(problem);
    Lookahead lookahead(problem, horizon);
    bool cut_short = false;
    while (const std::optional<int> agent = walk.next_agent()) {
      cut_short = watch.out_of_time();
      if (cut_short && !best.empty()) {
        break;
      }
      const Edge e = cut_short ? best_edge(problem, walk, *agent) : lookahead.first_move(walk, *agent);
      if (e >= 0) {
        walk.take(*agent, e);
      } else {
        walk.jump(*agent);
      }
    }
    if (!cut_short || best.empty()) {
      best.offer(walk.waypoints(), cut_short);
    }
  }
  return best.take(tries);
}

}  // namespace ivo::firmware::rivals
