#include "firmware/tools/bench/rivals/team_walk.hpp"

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>

namespace ivo::firmware::rivals {
namespace {

using planner::Edge;
using planner::index;
using planner::Node;

constexpr double kNothing = 1e-15;  // below any cell's mass that matters

}  // namespace

TeamWalk::TeamWalk(const RivalProblem& problem)
    : problem_(&problem),
      most_unseen_(problem.search.colony.ant.max_unseen_mass + 1e-9),
      agents_(problem.search.agents.size()),
      seen_(problem.coverage.words(), 0) {
  for (std::size_t m = 0; m < agents_.size(); ++m) {
    agents_[m].at = static_cast<Node>(m);
    see(problem.coverage.around(static_cast<int>(m), agents_[m].at), 0.0, 0.0);
  }
}

void TeamWalk::resume(CellSet seen, const std::vector<Node>& at, const std::vector<double>& times_s) {
  seen_ = std::move(seen);
  unseen_mass_ = 0.0;
  for (const planner::Cell c : problem_->prepared.belief().cells_with_mass()) {
    if ((seen_[index(c) / 64] >> (index(c) % 64) & 1U) == 0) {
      unseen_mass_ += problem_->prepared.belief().mass[index(c)];
    }
  }
  for (std::size_t m = 0; m < agents_.size(); ++m) {
    agents_[m] = {at[m], times_s[m], at[m] < 0, {}};
    longest_s_ = std::max(longest_s_, times_s[m]);
  }
}

std::optional<int> TeamWalk::next_agent() const {
  std::optional<int> next;
  for (std::size_t m = 0; m < agents_.size() && !complete(); ++m) {
    if (!agents_[m].done && (!next || agents_[m].time_s < agents_[static_cast<std::size_t>(*next)].time_s)) {
      next = static_cast<int>(m);
    }
  }
  return next;
}

double TeamWalk::seconds_along(int agent, Edge e) const {
  // Two starts may share a place.
  constexpr double kShortestM = 1e-6;
  return std::max(problem_->prepared.graph().length_m(e), kShortestM) /
         problem_->search.agents[static_cast<std::size_t>(agent)].speed_mps;
}

bool TeamWalk::open(int agent, Edge e) const { return planner::in(problem_->prepared.graph().open_to(e), agent); }

void TeamWalk::see(std::span<const CoverageRow> rows, double from_s, double seconds) {
  for (const CoverageRow& row : rows) {
    if (const std::uint64_t bits = row.bits & ~seen_[row.word]; bits != 0) {
      const double mass = problem_->coverage.mass(row.word, bits);
      seen_[row.word] |= bits;
      unseen_mass_ -= mass;
      mass_seconds_ += mass * (from_s + seconds * static_cast<double>(row.at));
    }
  }
}

void TeamWalk::take(int agent, Edge e) {
  Agent& walker = agents_[static_cast<std::size_t>(agent)];
  const double seconds = seconds_along(agent, e);
  see(problem_->coverage.along(agent, e), walker.time_s, seconds);
  walker.time_s += seconds;
  walker.at = problem_->prepared.graph().head(e);
  walker.path.push_back(walker.at);
  longest_s_ = std::max(longest_s_, walker.time_s);
  ++moves_;
}

void TeamWalk::jump(int agent) {
  const planner::Graph& graph = problem_->prepared.graph();
  const Coverage& coverage = problem_->coverage;
  std::vector<double> distance_s(index(graph.nodes()), std::numeric_limits<double>::infinity());
  std::vector<Edge> edge_to(index(graph.nodes()), -1);
  std::vector<Node> before(index(graph.nodes()), -1);
  using Entry = std::pair<double, Node>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  distance_s[index(at(agent))] = 0.0;
  queue.push({0.0, at(agent)});
  double best_rate = 0.0;
  double farthest_s = std::numeric_limits<double>::infinity();
  Node goal = -1;
  Edge last = -1;  // an edge beyond the goal, when only that shows anything
  while (!queue.empty() && queue.top().first <= farthest_s) {
    const double here_s = queue.top().first;
    const Node here = queue.top().second;
    queue.pop();
    if (here_s > distance_s[index(here)]) {
      continue;
    }
    const auto consider = [&](double mass, double way_s, Edge beyond) {
      if (mass <= kNothing) {
        return;
      }
      farthest_s = std::min(farthest_s, 2.0 * way_s);
      if (mass / way_s > best_rate) {
        best_rate = mass / way_s;
        goal = here;
        last = beyond;
      }
    };
    if (here_s > 0.0) {
      consider(coverage.new_mass(coverage.around(agent, here), seen_), here_s, -1);
    }
    for (Edge e = graph.first_edge(here); e < graph.end_edge(here); ++e) {
      if (!open(agent, e)) {
        continue;
      }
      const double there_s = here_s + seconds_along(agent, e);
      if (there_s <= farthest_s) {
        consider(coverage.new_mass(coverage.along(agent, e), seen_), there_s, e);
      }
      if (there_s < distance_s[index(graph.head(e))]) {
        distance_s[index(graph.head(e))] = there_s;
        edge_to[index(graph.head(e))] = e;
        before[index(graph.head(e))] = here;
        queue.push({there_s, graph.head(e)});
      }
    }
  }
  if (goal < 0) {
    agents_[static_cast<std::size_t>(agent)].done = true;
    return;
  }
  std::vector<Edge> route;
  if (last >= 0) {
    route.push_back(last);
  }
  for (Node n = goal; edge_to[index(n)] >= 0; n = before[index(n)]) {
    route.push_back(edge_to[index(n)]);
  }
  for (auto e = route.rbegin(); e != route.rend(); ++e) {
    take(agent, *e);
  }
}

void TeamWalk::finish() {
  while (const std::optional<int> agent = next_agent()) {
    jump(*agent);
  }
}

Waypoints TeamWalk::waypoints() const {
  Waypoints all;
  for (std::size_t m = 0; m < agents_.size(); ++m) {
    std::vector<Point> points = {problem_->prepared.graph().position(static_cast<Node>(m))};
    for (const Node n : agents_[m].path) {
      points.push_back(problem_->prepared.graph().position(n));
    }
    all.push_back(std::move(points));
  }
  return all;
}

}  // namespace ivo::firmware::rivals
