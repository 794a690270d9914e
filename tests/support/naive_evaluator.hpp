// What paths are worth, the long way: the whole map carried through Eq. 4 to 8 and Eq. 10 step by step, at the sight
// points of model.md ("Sensing and expected time", "Sub-priors"). Slow and simple; shares nothing with the planner's
// evaluator but what a cell and a line of sight are.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "planner/search/plan.hpp"
#include "planner/world/visibility.hpp"

namespace ivo::test {

struct NaivePath {
  std::span<const Point> waypoints;
  double speed_mps = 0.0;
  double sight_radius_m = 0.0;
};

/// Whose observations deplete a sub-prior (model.md, "Sub-priors").
enum class SubPriorReading : std::uint8_t {
  kTeam,  ///< anybody's; found is what w of Eq. 5 sees on its own
  kOwn,   ///< its agent's alone, whatever the others have seen
};

/// Maps have one value a cell. Without sub-priors there is no EST.
struct NaiveMission {
  const planner::Cells& cells;
  std::vector<double> prior;
  std::vector<std::vector<double>> sub_priors;
  int sub_prior_steps = 0;  ///< K
  SubPriorReading reading = SubPriorReading::kTeam;
};

class NaiveEvaluator {
 public:
  NaiveEvaluator(NaiveMission mission, std::span<const NaivePath> paths) : mission_(std::move(mission)) {
    path_ends_s_.assign(paths.size(), 0.0);
    for (std::size_t m = 0; m < paths.size(); ++m) {
      look_along(static_cast<int>(m), paths[m]);
    }
    std::stable_sort(looks_.begin(), looks_.end(), [](const Look& a, const Look& b) { return a.time_s < b.time_s; });
  }

  /// `complete` is left to the caller.
  [[nodiscard]] planner::PlanScore score() const {
    planner::PlanScore score;
    score.horizon_s = horizon_s_;
    score.expected_time_s = expected_time_s();
    score.expected_time_continuous_s = integral_of_the_unseen_s(score.unseen_mass);
    score.expected_sub_prior_time_s =
        mission_.sub_priors.empty() ? 0.0 : expected_sub_prior_time_s(mission_.sub_prior_steps);
    return score;
  }

  /// Eq. 10 with K = `steps`.
  [[nodiscard]] double expected_sub_prior_time_s(int steps) const {
    std::vector<std::vector<double>> left = mission_.sub_priors;
    double found = 0.0;
    double expected_s = 0.0;
    for (int k = 0; k <= steps; ++k) {
      found += mission_.reading == SubPriorReading::kTeam ? found_by_the_team(k, left) : found_on_their_own(k, left);
      expected_s += k >= 1 ? (1.0 - found) * kStep : 0.0;
    }
    return expected_s;
  }

  /// When each agent last sees something new: a cell that nobody saw before, or one with which Eq. 5 credits it.
  [[nodiscard]] std::vector<double> last_new_s() const {
    std::vector<double> last(path_ends_s_.size(), 0.0);
    const std::size_t cells = mission_.prior.size();
    std::vector<const Look*> first(cells, nullptr);
    for (const Look& look : looks_) {
      for (const planner::Cell c : look.seen) {
        const Look*& known = first[static_cast<std::size_t>(c)];
        known = known == nullptr ? &look : known;
      }
    }
    for (std::size_t c = 0; c < cells; ++c) {
      if (first[c] == nullptr || mission_.prior[c] <= 0.0) {
        continue;
      }
      const Look* credited = nullptr;
      for (const Look& look : looks_) {
        const bool sees = std::binary_search(look.seen.begin(), look.seen.end(), static_cast<planner::Cell>(c));
        if (sees && look.step == first[c]->step && (credited == nullptr || look.agent < credited->agent)) {
          credited = &look;
        }
      }
      for (const Look* look : {first[c], credited}) {
        double& agents_last = last[static_cast<std::size_t>(look->agent)];
        agents_last = std::max(agents_last, look->time_s);
      }
    }
    return last;
  }

 private:
  struct Look {
    double time_s;
    int step;
    int agent;
    std::vector<planner::Cell> seen;
  };

  static constexpr double kStep = 1.0;
  static int step_of(double time_s) { return std::max(0, static_cast<int>(std::ceil(time_s / kStep - 1e-6))); }

  void look(int agent, const NaivePath& path, Point from, double time_s) {
    Look look{time_s, step_of(time_s), agent, {}};
    for (planner::Cell c = 0; c < mission_.cells.count(); ++c) {
      if (planner::within_radius(mission_.cells, from, c, path.sight_radius_m) &&
          planner::line_of_sight(mission_.cells, from, c)) {
        look.seen.push_back(c);
      }
    }
    looks_.push_back(std::move(look));
  }

  void look_along(int agent, const NaivePath& path) {
    double time_s = 0.0;
    look(agent, path, path.waypoints[0], time_s);
    for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
      const Point a = path.waypoints[i - 1];
      const Point b = path.waypoints[i];
      const double length_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
      const int n = planner::sight_points(length_m, mission_.cells.cell_m());
      for (int k = 1; k <= n; ++k) {
        look(agent, path, planner::sight_point(a, b, k, n), time_s + length_m / path.speed_mps * k / n);
      }
      time_s += length_m / path.speed_mps;
    }
    path_ends_s_[static_cast<std::size_t>(agent)] = time_s;
    horizon_s_ = std::max(horizon_s_, time_s);
  }

  // Lowest-numbered agent that sees each cell in step k (Eq. 5), -1 where nobody does; of all agents, or `alone`.
  [[nodiscard]] std::vector<int> seers(int step, int alone = -1) const {
    std::vector<int> who(mission_.prior.size(), -1);
    for (const Look& look : looks_) {
      if (look.step != step || (alone >= 0 && look.agent != alone)) {
        continue;
      }
      for (const planner::Cell c : look.seen) {
        int& w = who[static_cast<std::size_t>(c)];
        w = w < 0 || look.agent < w ? look.agent : w;
      }
    }
    return who;
  }

  // Eq. 4, 7 and 8: the posterior is carried normalised, and the chance that nobody has found anything beside it.
  [[nodiscard]] double expected_time_s() const {
    std::vector<double> posterior = mission_.prior;
    double not_found = 1.0;
    double found = 0.0;
    double expected_s = 0.0;
    const int last = step_of(horizon_s_);
    for (int k = 0; k <= last; ++k) {
      const std::vector<int> who = seers(k);
      double detected = 0.0;
      double missed = 0.0;
      for (std::size_t c = 0; c < posterior.size(); ++c) {
        (who[c] >= 0 ? detected : missed) += posterior[c];
      }
      found += not_found * detected;
      not_found *= missed;
      for (std::size_t c = 0; c < posterior.size(); ++c) {
        posterior[c] = who[c] >= 0 || missed <= 0.0 ? 0.0 : posterior[c] / missed;
      }
      expected_s += k >= 1 ? (1.0 - found) * kStep : 0.0;
    }
    return expected_s;
  }

  // What w sees is found on its own sub-prior and gone from all.
  [[nodiscard]] double found_by_the_team(int step, std::vector<std::vector<double>>& left) const {
    const std::vector<int> who = seers(step);
    double found = 0.0;
    for (std::size_t c = 0; c < who.size(); ++c) {
      if (who[c] >= 0) {
        found += left[static_cast<std::size_t>(who[c])][c];
        for (std::vector<double>& sub_prior : left) {
          sub_prior[c] = 0.0;
        }
      }
    }
    return found;
  }

  [[nodiscard]] double found_on_their_own(int step, std::vector<std::vector<double>>& left) const {
    double found = 0.0;
    for (std::size_t m = 0; m < left.size(); ++m) {
      const std::vector<int> who = seers(step, static_cast<int>(m));
      for (std::size_t c = 0; c < who.size(); ++c) {
        found += who[c] >= 0 ? std::exchange(left[m][c], 0.0) : 0.0;
      }
    }
    return found;
  }

  // ET_c: 1 - P(t) from look to look up to the horizon.
  [[nodiscard]] double integral_of_the_unseen_s(double& unseen_mass) const {
    std::vector<double> left = mission_.prior;
    double integral = 0.0;
    double since_s = 0.0;
    for (const Look& look : looks_) {
      unseen_mass = std::accumulate(left.begin(), left.end(), 0.0);
      integral += unseen_mass * (look.time_s - since_s);
      since_s = look.time_s;
      for (const planner::Cell c : look.seen) {
        left[static_cast<std::size_t>(c)] = 0.0;
      }
    }
    unseen_mass = std::accumulate(left.begin(), left.end(), 0.0);
    return integral + unseen_mass * (horizon_s_ - since_s);
  }

  NaiveMission mission_;
  std::vector<Look> looks_;  // by time
  std::vector<double> path_ends_s_;
  double horizon_s_ = 0.0;
};

}  // namespace ivo::test
