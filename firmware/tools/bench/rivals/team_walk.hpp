// A plan under way on the graph: where each agent stands and when, what the team has seen, and what that is worth. The
// worth is within half a piece of an edge (coverage.hpp) of the exact ET_c; the exact one is scored at the end.
#pragma once

#include <optional>
#include <vector>

#include "firmware/tools/bench/rivals/rivals.hpp"

namespace ivo::firmware::rivals {

class TeamWalk {
 public:
  /// Everybody on their starts.
  explicit TeamWalk(const RivalProblem& problem);

  [[nodiscard]] bool complete() const { return unseen_mass_ <= most_unseen_; }
  /// The agent whose path ends earliest, lowest number on a tie; nobody when all are done or the plan is complete.
  [[nodiscard]] std::optional<int> next_agent() const;
  [[nodiscard]] planner::Node at(int agent) const { return agents_[static_cast<std::size_t>(agent)].at; }
  [[nodiscard]] const CellSet& seen() const { return seen_; }
  [[nodiscard]] double seconds_along(int agent, planner::Edge e) const;
  [[nodiscard]] bool open(int agent, planner::Edge e) const;

  /// New mass a second along the edge.
  [[nodiscard]] double rate(int agent, planner::Edge e) const {
    return problem_->coverage.new_mass(problem_->coverage.along(agent, e), seen_) / seconds_along(agent, e);
  }

  void take(int agent, planner::Edge e);
  /// To where nothing new is in reach of one edge: along a shortest path to the node or edge with the most new mass a
  /// second of way, among those at most twice as far as the nearest that shows anything new. An agent that can get to
  /// nothing new is done.
  void jump(int agent);
  /// Jumps until the plan is complete or nobody sees anything new.
  void finish();

  /// mass seconds so far, and what is unseen for as long as the longest path.
  [[nodiscard]] double cost() const { return mass_seconds_ + unseen_mass_ * longest_s_; }
  [[nodiscard]] double unseen_mass() const { return unseen_mass_; }
  [[nodiscard]] std::size_t moves() const { return moves_; }
  [[nodiscard]] Waypoints waypoints() const;

  /// Goes on from a plan made elsewhere: `seen` by the end of `times_s`, everybody moved to a node of the graph.
  void resume(CellSet seen, const std::vector<planner::Node>& at, const std::vector<double>& times_s);

 private:
  struct Agent {
    planner::Node at = 0;
    double time_s = 0.0;
    bool done = false;
    std::vector<planner::Node> path;
  };
  void see(std::span<const CoverageRow> rows, double from_s, double seconds);

  const RivalProblem* problem_;  // to be copied
  double most_unseen_;
  std::vector<Agent> agents_;
  CellSet seen_;
  double unseen_mass_ = 1.0;
  double mass_seconds_ = 0.0;
  double longest_s_ = 0.0;
  std::size_t moves_ = 0;
};

}  // namespace ivo::firmware::rivals
