#include "planner/search/ant.hpp"

#include <algorithm>

namespace ivo::planner {

void Ant::start(const AntParameters& parameters) noexcept {
  parameters_ = parameters;
  if (++ant_number_ == 0) {
    visited_.fill(0);
    ant_number_ = 1;
  }
  sightings_.clear();
  unseen_mass_ = 1.0;
  for (int m = 0; m < world_.graph.agents(); ++m) {
    at_[index(m)] = m;
    time_s_[index(m)] = 0.0;
    retired_[index(m)] = false;
    paths_[index(m)].clear();
    visit(m);
    for (const SightEvent event : world_.sight.from_node(m, m)) {
      if (sightings_.see(event.cell(), m, 0.0)) {
        unseen_mass_ -= world_.belief.mass[index(event.cell())];
      }
    }
  }
  phase_ = Phase::kChooseAgent;
}

int Ant::advance(Rng& rng, int rows) noexcept {
  switch (phase_) {
    case Phase::kChooseAgent:
      return choose_agent(rng);
    case Phase::kChooseNode:
      return choose_node(rng);
    case Phase::kJump:
      return jump();
    case Phase::kMove:
      return move(rows);
    case Phase::kScore:
      return score_some(rows);
    case Phase::kDone:
      break;
  }
  return 0;
}

// The agent whose path ends earliest with probability q, else one of the others; a single one left is taken without a
// draw.
int Ant::choose_agent(Rng& rng) noexcept {
  StaticVector<int, limits::kAgents> left;
  for (int m = 0; m < world_.graph.agents(); ++m) {
    if (!retired_[index(m)] && !left.push_back(m)) {
      break;
    }
  }
  if (is_complete(unseen_mass_, parameters_.max_unseen_mass) || left.empty()) {
    expected_.clear();
    row_ = 0;
    phase_ = Phase::kScore;
    return 1;
  }
  std::size_t earliest = 0;
  for (std::size_t i = 1; i < left.size(); ++i) {
    if (time_s_[index(left[i])] < time_s_[index(left[earliest])]) {
      earliest = i;
    }
  }
  std::size_t chosen = earliest;
  if (left.size() > 1 && rng.unit() >= parameters_.shortest_first) {
    const auto other = static_cast<std::size_t>(rng.below(static_cast<int>(left.size()) - 1));
    chosen = other < earliest ? other : other + 1;
  }
  agent_ = left[chosen];
  phase_ = Phase::kChooseNode;
  return 1;
}

// Eq. 2 over the neighbours on which no agent of this ant has been.
int Ant::choose_node(Rng& rng) noexcept {
  const Graph& graph = world_.graph;
  const Node here = at_[index(agent_)];
  const Edge first = graph.first_edge(here);
  const Edge end = graph.end_edge(here);
  double sum = 0.0;
  for (Edge e = first; e < end; ++e) {
    const bool open = in(graph.open_to(e), agent_) && !visited(graph.head(e));
    sum += open ? trails_.attraction(agent_, e) : 0.0;
    weights_[index(e - first)] = sum;
  }
  const int work = end - first + 1;
  if (sum <= 0.0) {
    jump_.start(graph, agent_, here);
    phase_ = Phase::kJump;
    return work;
  }
  const double draw = rng.unit() * sum;
  const auto begin = weights_.begin();
  // The first sum above the draw; a closed edge adds nothing and is never the first. A draw that rounds up to the sum
  // takes the last.
  auto found = std::upper_bound(begin, begin + (end - first), draw);
  if (found == begin + (end - first)) {
    found = std::lower_bound(begin, begin + (end - first), sum);
  }
  route_.clear();
  (void)route_.push_back(first + static_cast<Edge>(found - begin));
  row_ = 0;
  phase_ = Phase::kMove;
  return work;
}

bool Ant::shows_something_new(Node n, int& work) const noexcept {
  for (const SightEvent event : world_.sight.from_node(agent_, n)) {
    ++work;
    if (!sightings_.seen(event.cell())) {
      return true;
    }
  }
  return false;
}

// Without a candidate: to the nearest unvisited node that has unseen mass in sight, along the shortest path.
int Ant::jump() noexcept {
  const int work_before = jump_.work();
  const Node n = jump_.settle_next();
  int work = 1 + jump_.work() - work_before;
  if (n < 0) {
    retire();
    return work;
  }
  if (!visited(n) && shows_something_new(n, work)) {
    route_.clear();
    for (Node step = n; jump_.edge_to(step) >= 0; step = jump_.before(step)) {
      (void)route_.push_back(jump_.edge_to(step));
    }
    row_ = 0;
    phase_ = Phase::kMove;
  }
  return work;
}

void Ant::retire() noexcept {
  retired_[index(agent_)] = true;
  phase_ = Phase::kChooseAgent;
}

double Ant::seconds_a_point(int agent, Edge e) const noexcept {
  return world_.graph.length_m(e) / (world_.sight.points(e) * world_.speeds_mps[index(agent)]);
}

// The time of the edge's last sight point to the last bit, so that a path that ends there does not seem to enter the
// next edge.
double Ant::seconds_along(int agent, Edge e) const noexcept {
  return seconds_a_point(agent, e) * world_.sight.points(e);
}

int Ant::move(int rows) noexcept {
  const Edge e = route_.back();
  const auto events = world_.sight.along_edge(agent_, e);
  const double pace_s = seconds_a_point(agent_, e);
  const std::size_t end = std::min(events.size(), row_ + static_cast<std::size_t>(rows));
  const int work = static_cast<int>(end - row_) + 1;
  for (; row_ < end; ++row_) {
    const SightEvent event = events[row_];
    if (sightings_.see(event.cell(), agent_, time_s_[index(agent_)] + pace_s * event.point())) {
      unseen_mass_ -= world_.belief.mass[index(event.cell())];
    }
  }
  if (row_ == events.size()) {
    take_edge(e);
  }
  return work;
}

void Ant::take_edge(Edge e) noexcept {
  row_ = 0;
  route_.pop_back();
  at_[index(agent_)] = world_.graph.head(e);
  time_s_[index(agent_)] += seconds_along(agent_, e);
  visit(at_[index(agent_)]);
  if (!paths_[index(agent_)].push_back(e) || paths_[index(agent_)].full()) {
    retire();
  } else if (route_.empty()) {
    phase_ = Phase::kChooseAgent;
  }
}

int Ant::score_some(int rows) noexcept {
  const int all = world_.belief.mass_cell_count;
  const int first = static_cast<int>(row_);
  const int count = std::min(rows, all - first);
  expected_.add(world_.belief, sightings_, first, count);
  row_ += static_cast<std::size_t>(count);
  if (first + count == all) {
    score_ = expected_.score(world_.belief, parameters_.max_unseen_mass);
    phase_ = Phase::kDone;
  }
  return count + 1;
}

void Ant::finish(Tour& tour) const noexcept {
  tour.paths.clear();
  tour.score = score_;
  for (int m = 0; m < world_.graph.agents(); ++m) {
    const double end_s = expected_.path_end_s(m);
    tour.end_s[index(m)] = end_s;
    tour.paths.resize(index(m) + 1);
    EdgePath& path = tour.paths[index(m)];
    path.clear();
    double time_s = 0.0;
    for (const Edge e : paths_[index(m)]) {
      if (time_s >= end_s) {
        break;
      }
      (void)path.push_back(e);
      time_s += seconds_along(m, e);
    }
  }
}

}  // namespace ivo::planner
