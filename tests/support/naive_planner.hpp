// The paper's colony the long way, as a measure for the planner's speed and a check on its decisions: each sight point
// tests every cell of the map, trails and scores are worked out where they are needed, nothing is kept in tables. Takes
// the decisions of the `paper` profile with eta_TSP in the same order and from the same random numbers (model.md,
// "Search (MMAS)"), so that the same seed gives the same plan. Shares with the planner the graph, the cells and their
// masses, and what a line of sight is.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "tests/support/naive_ant.hpp"

namespace ivo::test {

struct NaivePlan {
  std::vector<std::vector<Point>> waypoints;
  planner::PlanScore score;
};

class NaivePlanner {
 public:
  /// `prepared` has been prepared for `problem`, and both stay as they are. Without capacities: no path is cut for its
  /// length.
  NaivePlanner(const planner::Planner& prepared, const planner::SearchProblem& problem)
      : world_{prepared.graph(), prepared.cells(), prepared.belief(), problem},
        colony_(problem.colony),
        rng_(problem.colony.seed),
        deposit_rng_(~problem.colony.seed),
        tau_(problem.agents.size(), std::vector<double>(planner::index(world_.graph.edges()), 1.0)) {}

  /// All generations. Cost: each ant's sight points times the cells of the map.
  [[nodiscard]] NaivePlan plan() {
    for (int generation = 1;; ++generation) {
      std::optional<NaiveTour> best_of_generation;
      for (int ant = 0; ant < colony_.ants; ++ant) {
        const NaiveTour tour = NaiveAnt(world_, tau_, rng_).run();
        if (!best_of_generation || better(tour, *best_of_generation)) {
          best_of_generation = tour;
        }
      }
      if (!best_ || better(*best_of_generation, *best_)) {
        best_ = best_of_generation;
      }
      if (generation >= colony_.generations || best_->cost_s <= 0.0) {
        return plan_of(*best_);
      }
      update_trails(generation, *best_of_generation);
    }
  }

 private:
  [[nodiscard]] static bool better(const NaiveTour& a, const NaiveTour& b) {
    if (a.score.complete != b.score.complete) {
      return a.score.complete;
    }
    return a.score.complete ? a.cost_s < b.cost_s : a.score.unseen_mass < b.score.unseen_mass;
  }

  // --- trails (Eq. 1 and 3, MAX-MIN limits)

  void update_trails(int generation, const NaiveTour& best_of_generation) {
    const double tau_max = 1.0 / (colony_.rho * std::max(best_->cost_s, 1.0));
    const NaiveTour& depositor = deposit_rng_.unit() < colony_.iteration_best ? best_of_generation : *best_;
    const double amount = 1.0 / std::max(depositor.cost_s, 1.0);
    for (std::size_t m = 0; m < tau_.size(); ++m) {
      const int nodes = world_.graph.nodes_reached_by(static_cast<int>(m));
      const double s = std::pow(0.05, 1.0 / nodes);
      const double a = std::max(2.0, 0.5 * world_.graph.edges_open_to(static_cast<int>(m)) / nodes);
      const double tau_min = std::min(tau_max, tau_max * (1.0 - s) / ((a - 1.0) * s));
      for (double& tau : tau_[m]) {
        tau = (generation == 1 ? tau_max : tau) * (1.0 - colony_.rho);
      }
      for (const planner::Edge e : depositor.paths[m]) {
        tau_[m][planner::index(e)] += amount;
      }
      for (double& tau : tau_[m]) {
        tau = std::clamp(tau, tau_min, tau_max);
      }
    }
  }

  [[nodiscard]] NaivePlan plan_of(const NaiveTour& tour) const {
    NaivePlan plan{{}, tour.score};
    for (std::size_t m = 0; m < tau_.size(); ++m) {
      Point at = world_.graph.position(static_cast<planner::Node>(m));
      std::vector<Point> waypoints = {at};
      double left_m = tour.end_s[m] * world_.problem.agents[m].speed_mps;
      for (const planner::Edge e : tour.paths[m]) {
        const Point to = world_.graph.position(world_.graph.head(e));
        const int n = world_.points(e);
        const int last = static_cast<int>(std::lround(left_m / world_.graph.length_m(e) * n));
        waypoints.push_back(left_m < world_.graph.length_m(e) ? planner::sight_point(at, to, std::min(last, n), n)
                                                              : to);
        left_m -= world_.graph.length_m(e);
        at = to;
      }
      plan.waypoints.push_back(std::move(waypoints));
    }
    return plan;
  }

  const NaiveWorld world_;
  const planner::ColonyParameters colony_;
  planner::Rng rng_;
  planner::Rng deposit_rng_;  // who deposits is drawn apart
  NaiveTrails tau_;
  std::optional<NaiveTour> best_;
};

}  // namespace ivo::test
