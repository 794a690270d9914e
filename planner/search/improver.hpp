// Iterated improvement of a plan, off the graph too: its route is changed (route_change.hpp), and a worse one is
// sometimes kept for a while (simulated annealing, Kirkpatrick et al. 1983), in rounds that double in length: there is
// no time by which it must be asked. The best plan by its exact score is always ready and only gets better.
#pragma once

#include <array>
#include <cstdint>

#include "planner/numeric/rng.hpp"
#include "planner/search/lanes.hpp"
#include "planner/search/path_score.hpp"
#include "planner/search/route.hpp"
#include "planner/search/route_change.hpp"
#include "planner/search/route_judge.hpp"
#include "planner/search/tour.hpp"
#include "planner/search/world.hpp"

namespace ivo::planner {

struct ImproverParameters {
  double max_unseen_mass = 0.014;
  std::uint64_t seed = 1;
  int proposals_a_generation = 500;
};

/// Waypoints as the improver keeps them: exact places of nodes, lattice places elsewhere.
using Waypoints = StaticVector<Place, limits::kWaypoints>;
static_assert(Legs::capacity() + 1 == Waypoints::capacity() && Lanes::capacity() + 1 == Waypoints::capacity());

class Improver {
 public:
  Improver(const World& world, FirstSightings& sightings) noexcept
      : world_(world), pool_(world), judge_(pool_), change_(pool_, judge_), scorer_(sightings) {}

  /// Another mission: tables. False when there is nothing it could do (segment_pool.hpp).
  [[nodiscard]] bool open(const ImproverParameters& parameters) noexcept;

  /// Begins with a tour. Cost: its edges' segments.
  void start(const Tour& tour) noexcept;

  /// Takes over another's best plan when it is better: its next round begins with it.
  void learn_from(const Improver& other) noexcept;

  /// A part of the work, about `rows` rows at most. Returns the work done.
  int advance(int rows) noexcept;
  [[nodiscard]] int generation() const noexcept {
    return static_cast<int>(proposals_ / parameters_.proposals_a_generation);
  }

  /// Changes tried since open().
  [[nodiscard]] std::int64_t proposals() const noexcept { return proposals_; }

  [[nodiscard]] bool has_best() const noexcept { return has_best_; }
  /// Exact score of the best plan so far, and its waypoints.
  [[nodiscard]] const PlanScore& best_score() const noexcept { return best_score_; }
  [[nodiscard]] const Waypoints& best_waypoints(int agent) const noexcept { return best_[index(agent)]; }
  [[nodiscard]] double best_end_s(int agent) const noexcept { return best_end_s_[index(agent)]; }
  [[nodiscard]] Point point_at(const Place& place) const noexcept { return pool_.point_at(place); }

  /// What the next part works on; slices are compared within a kind.
  enum class Phase : std::uint8_t { kRestore, kJudgeFirst, kPropose, kMake, kJudge, kScore };
  [[nodiscard]] Phase phase() const noexcept { return phase_; }

 private:
  void open_field() noexcept;
  void open_judge() noexcept;
  void fill_tables() noexcept;
  void draft_lanes() noexcept;
  void recall() noexcept;
  void make_current() noexcept;
  int take_draft() noexcept;
  int restore_leg(int rows) noexcept;
  int propose() noexcept;
  int make(int rows) noexcept;
  int settle() noexcept;
  void accept() noexcept;
  void remember() noexcept;
  void after_proposal() noexcept;
  int begin_round() noexcept;
  void set_temperature() noexcept;
  void start_score() noexcept;
  int take_score() noexcept;

  [[nodiscard]] bool better(const PlanScore& a, const PlanScore& b) const noexcept;

  const World& world_;
  SegmentPool pool_;
  RouteJudge judge_;
  RouteChange change_;
  PathScorer scorer_;
  ImproverParameters parameters_;
  Rng rng_;
  Phase phase_ = Phase::kPropose;
  int agents_ = 0;
  Route current_;
  Judgement judged_;  // of current_

  std::int64_t proposals_ = 0;
  int round_ = 0;
  int round_length_ = 0;
  int round_done_ = 0;
  MassTime temperature_{};
  MassTime hottest_{};
  std::array<std::int32_t, 256> patience_{};  // quantiles of the exponential distribution, 8 bits behind the point
  std::array<std::int32_t, 65> cooling_{};    // 16 bits behind the point

  LaneTeam lane_team_;
  Lanes lanes_;
  int drafts_ = 0;  // judged
  bool draft_broken_ = false;
  bool learned_ = false;          // the best is another's: the next round begins with it
  bool recalls_learned_ = false;  // its cost here is not known yet
  std::array<Waypoints, limits::kAgents> draft_{};
  int restored_agent_ = 0;
  std::size_t restored_ = 0;
  std::int32_t restoring_ = -1;  // the segment under way
  MassTime remembered_cost_{};
  bool remembered_complete_ = false;
  bool remembered_ = false;  // and not yet scored
  std::array<Waypoints, limits::kAgents> memory_{};
  std::array<StaticVector<Point, limits::kWaypoints>, limits::kAgents> points_{};  // of the memory, while it is scored
  std::int64_t scored_at_ = 0;                                                     // proposals by then

  bool has_best_ = false;
  PlanScore best_score_;
  std::array<Waypoints, limits::kAgents> best_{};
  std::array<double, limits::kAgents> best_end_s_{};
};

}  // namespace ivo::planner
