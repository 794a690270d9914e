// One ant of the naive planner (naive_planner.hpp): every sight point tests every cell of the map, and what a look-up
// would answer is worked out where it is asked.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "planner/numeric/rng.hpp"
#include "planner/search/planner.hpp"
#include "planner/world/visibility.hpp"

namespace ivo::test {

struct NaiveWorld {
  const planner::Graph& graph;
  const planner::Cells& cells;
  const planner::Belief& belief;
  const planner::SearchProblem& problem;

  [[nodiscard]] int points(planner::Edge e) const { return planner::sight_points(graph.length_m(e), cells.cell_m()); }
  [[nodiscard]] double seconds_a_point(std::size_t agent, planner::Edge e) const {
    return graph.length_m(e) / (points(e) * problem.agents[agent].speed_mps);
  }
};

/// What an ant built: each agent's edges up to where it last sees something new, and when that is.
struct NaiveTour {
  std::vector<std::vector<planner::Edge>> paths;
  std::vector<double> end_s;
  planner::PlanScore score;
  double cost_s = 0.0;  ///< what the paper minimises: ET, or EST to the plan's own end
};

/// tau of each agent and edge.
using NaiveTrails = std::vector<std::vector<double>>;

class NaiveAnt {
 public:
  NaiveAnt(const NaiveWorld& world, const NaiveTrails& tau, planner::Rng& rng) : world_(world), tau_(tau), rng_(rng) {}

  [[nodiscard]] NaiveTour run() {
    agents_.resize(world_.problem.agents.size());
    visited_.assign(planner::index(world_.graph.nodes()), false);
    seen_.assign(planner::index(world_.cells.count()), false);
    for (std::size_t m = 0; m < agents_.size(); ++m) {
      agents_[m].at = static_cast<Node>(m);
      agents_[m].first_seen_s.assign(seen_.size(), kNever);
      visited_[m] = true;
      look(m, world_.graph.position(static_cast<Node>(m)), 0.0);
    }
    while (const std::optional<std::size_t> m = choose_agent()) {
      std::vector<Edge> route = choose_neighbour(*m);
      if (route.empty()) {
        route = jump(*m);
      }
      for (const Edge e : route) {
        move(*m, e);
      }
      agents_[*m].done = route.empty();
    }
    return judge();
  }

 private:
  using Edge = planner::Edge;
  using Node = planner::Node;

  struct Agent {
    Node at = 0;
    double time_s = 0.0;
    bool done = false;
    std::vector<Edge> path;
    std::vector<double> first_seen_s;  // of each cell by this agent alone
  };

  static constexpr double kNever = std::numeric_limits<double>::infinity();
  static int step_of(double time_s) { return std::max(0, static_cast<int>(std::ceil(time_s - 1e-6))); }

  // The whole map is tested, whatever is near.
  void look(std::size_t m, Point from, double time_s) {
    const double size = world_.cells.cell_m();
    const double radius_m = world_.problem.agents[m].sight_radius_m;
    std::size_t c = 0;
    for (int row = 0; row < world_.cells.rows(); ++row) {
      const double dy = (row + 0.5) * size - from.y_m;
      for (int column = 0; column < world_.cells.columns(); ++column, ++c) {
        const double dx = (column + 0.5) * size - from.x_m;
        if (dx * dx + dy * dy > radius_m * radius_m + 1e-9 || planner::to_double(world_.belief.mass[c]) <= 0.0 ||
            !planner::line_of_sight(world_.cells, from, static_cast<planner::Cell>(c))) {
          continue;
        }
        double& first_s = agents_[m].first_seen_s[c];
        first_s = std::min(first_s, time_s);
        if (!seen_[c]) {
          seen_[c] = true;
          unseen_mass_ -= planner::to_double(world_.belief.mass[c]);
        }
      }
    }
  }

  std::optional<std::size_t> choose_agent() {
    std::vector<std::size_t> left;
    for (std::size_t m = 0; m < agents_.size(); ++m) {
      if (!agents_[m].done) {
        left.push_back(m);
      }
    }
    if (left.empty() || unseen_mass_ <= world_.problem.colony.ant.max_unseen_mass + 1e-9) {
      return std::nullopt;
    }
    const auto earliest = std::min_element(
        left.begin(), left.end(), [&](std::size_t a, std::size_t b) { return agents_[a].time_s < agents_[b].time_s; });
    const std::size_t first = *earliest;
    if (left.size() > 1 && rng_.unit() >= world_.problem.colony.ant.shortest_first) {
      left.erase(earliest);
      return left[planner::index(rng_.below(static_cast<int>(left.size())))];
    }
    return first;
  }

  // Eq. 2 with alpha 1 and eta = h / d.
  [[nodiscard]] double attraction(std::size_t m, Edge e) const {
    const double eta = world_.graph.spacing_m() / std::max(world_.graph.length_m(e), world_.graph.spacing_m() * 1e-3);
    double power = 1.0;
    for (int i = 0; i < world_.problem.colony.beta; ++i) {
      power *= eta;
    }
    return tau_[m][planner::index(e)] * power;
  }

  std::vector<Edge> choose_neighbour(std::size_t m) {
    const Node here = agents_[m].at;
    std::vector<Edge> candidates;
    std::vector<double> sums;
    double sum = 0.0;
    for (Edge e = world_.graph.first_edge(here); e < world_.graph.end_edge(here); ++e) {
      if (planner::in(world_.graph.open_to(e), static_cast<int>(m)) &&
          !visited_[planner::index(world_.graph.head(e))]) {
        sum += attraction(m, e);
        candidates.push_back(e);
        sums.push_back(sum);
      }
    }
    if (sum <= 0.0) {
      return {};
    }
    const double draw = rng_.unit() * sum;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (draw < sums[i]) {
        return {candidates[i]};
      }
    }
    return {candidates.back()};
  }

  // Dijkstra without a heap, to the nearest node worth it; nothing when there is none.
  [[nodiscard]] std::vector<Edge> jump(std::size_t m) const {
    const auto nodes = planner::index(world_.graph.nodes());
    std::vector<double> distance_m(nodes, kNever);
    std::vector<bool> settled(nodes, false);
    std::vector<Edge> edge_to(nodes, -1);
    std::vector<Node> before(nodes, -1);
    distance_m[planner::index(agents_[m].at)] = 0.0;
    while (true) {
      Node nearest = -1;
      for (Node n = 0; n < world_.graph.nodes(); ++n) {
        const double known_m = distance_m[planner::index(n)];
        if (!settled[planner::index(n)] && known_m < kNever &&
            (nearest < 0 || known_m < distance_m[planner::index(nearest)])) {
          nearest = n;
        }
      }
      if (nearest < 0) {
        return {};
      }
      settled[planner::index(nearest)] = true;
      if (!visited_[planner::index(nearest)] && shows_something_new(m, world_.graph.position(nearest))) {
        std::vector<Edge> route;
        for (Node n = nearest; edge_to[planner::index(n)] >= 0; n = before[planner::index(n)]) {
          route.insert(route.begin(), edge_to[planner::index(n)]);
        }
        return route;
      }
      for (Edge e = world_.graph.first_edge(nearest); e < world_.graph.end_edge(nearest); ++e) {
        const auto head = planner::index(world_.graph.head(e));
        const double by_here_m = distance_m[planner::index(nearest)] + world_.graph.length_m(e);
        if (planner::in(world_.graph.open_to(e), static_cast<int>(m)) && !settled[head] &&
            by_here_m < distance_m[head]) {
          distance_m[head] = by_here_m;
          edge_to[head] = e;
          before[head] = nearest;
        }
      }
    }
  }

  [[nodiscard]] bool shows_something_new(std::size_t m, Point from) const {
    for (planner::Cell c = 0; c < world_.cells.count(); ++c) {
      if (!seen_[planner::index(c)] && planner::to_double(world_.belief.mass[planner::index(c)]) > 0.0 &&
          planner::within_radius(world_.cells, from, c, world_.problem.agents[m].sight_radius_m) &&
          planner::line_of_sight(world_.cells, from, c)) {
        return true;
      }
    }
    return false;
  }

  void move(std::size_t m, Edge e) {
    Agent& agent = agents_[m];
    const Point a = world_.graph.position(agent.at);
    const Point b = world_.graph.position(world_.graph.head(e));
    const double pace_s = world_.seconds_a_point(m, e);
    const int n = world_.points(e);
    for (int k = 1; k <= n; ++k) {
      look(m, planner::sight_point(a, b, k, n), agent.time_s + pace_s * k);
    }
    agent.time_s += pace_s * n;
    agent.at = world_.graph.head(e);
    agent.path.push_back(e);
    visited_[planner::index(agent.at)] = true;
  }

  // --- what it is worth (Eq. 5, 8 and 10 from first sightings)

  [[nodiscard]] NaiveTour judge() const {
    NaiveTour tour;
    tour.end_s.assign(agents_.size(), 0.0);
    double seen = 0.0;
    double mass_seconds = 0.0;
    double mass_steps = 0.0;
    double sub_mass = 0.0;
    double sub_mass_steps = 0.0;
    double sub_mass_all_steps = 0.0;
    for (std::size_t c = 0; c < seen_.size(); ++c) {
      if (!seen_[c]) {
        continue;
      }
      std::size_t first = 0;
      for (std::size_t m = 1; m < agents_.size(); ++m) {
        first = agents_[m].first_seen_s[c] < agents_[first].first_seen_s[c] ? m : first;
      }
      const double time_s = agents_[first].first_seen_s[c];
      std::size_t credited = 0;  // w of Eq. 5
      while (agents_[credited].first_seen_s[c] == kNever ||
             step_of(agents_[credited].first_seen_s[c]) != step_of(time_s)) {
        ++credited;
      }
      tour.end_s[first] = std::max(tour.end_s[first], time_s);
      tour.end_s[credited] = std::max(tour.end_s[credited], agents_[credited].first_seen_s[c]);
      const double terms = std::max(step_of(time_s), 1) - 1;  // of Eq. 8 in which the cell is still unseen
      seen += planner::to_double(world_.belief.mass[c]);
      mass_seconds += planner::to_double(world_.belief.mass[c]) * time_s;
      mass_steps += planner::to_double(world_.belief.mass[c]) * terms;
      if (world_.belief.has_sub_priors) {
        sub_mass += planner::to_double(world_.belief.sub_mass[credited][c]);
        sub_mass_all_steps += planner::to_double(world_.belief.sub_mass[credited][c]) * terms;
        sub_mass_steps += planner::to_double(world_.belief.sub_mass[credited][c]) *
                          std::min<double>(terms, world_.belief.sub_prior_steps);
      }
    }
    planner::PlanScore& score = tour.score;
    score.horizon_s = *std::max_element(tour.end_s.begin(), tour.end_s.end());
    score.unseen_mass = std::max(0.0, 1.0 - seen);
    score.complete = score.unseen_mass <= world_.problem.colony.ant.max_unseen_mass + 1e-9;
    score.expected_time_s = mass_steps + score.unseen_mass * step_of(score.horizon_s);
    score.expected_time_continuous_s = mass_seconds + score.unseen_mass * score.horizon_s;
    if (world_.belief.has_sub_priors) {
      score.expected_sub_prior_time_s = sub_mass_steps + std::max(0.0, 1.0 - sub_mass) * world_.belief.sub_prior_steps;
    }
    tour.cost_s = world_.belief.has_sub_priors
                      ? sub_mass_all_steps + std::max(0.0, 1.0 - sub_mass) * step_of(score.horizon_s)
                      : score.expected_time_s;
    for (std::size_t m = 0; m < agents_.size(); ++m) {
      tour.paths.push_back(up_to(m, agents_[m].path, tour.end_s[m]));
    }
    return tour;
  }

  // A path ends where its agent last sees something new.
  [[nodiscard]] std::vector<Edge> up_to(std::size_t m, const std::vector<Edge>& path, double end_s) const {
    std::vector<Edge> kept;
    double time_s = 0.0;
    for (const Edge e : path) {
      if (time_s >= end_s) {
        break;
      }
      kept.push_back(e);
      time_s += world_.seconds_a_point(m, e) * world_.points(e);
    }
    return kept;
  }

  const NaiveWorld& world_;
  const NaiveTrails& tau_;
  planner::Rng& rng_;
  std::vector<Agent> agents_;
  std::vector<bool> visited_;
  std::vector<bool> seen_;
  double unseen_mass_ = 1.0;
};

}  // namespace ivo::test
