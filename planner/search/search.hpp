// One search on given tables: the paper's colony alone, or a short one and then the improvement of its best plan.
// Several may work on the same tables, each with a seed of its own, and learn of each other's best plans.
#pragma once

#include <array>
#include <cstdint>

#include "planner/search/colony.hpp"
#include "planner/search/improver.hpp"
#include "planner/search/plan.hpp"
#include "planner/search/slice_kind.hpp"

namespace ivo::planner {

/// Work is counted in units: a table row, a candidate edge, a trail. A unit costs a few nanoseconds.
struct Budget {
  int units = 0;
};

struct Progress {
  int generation = 0;
  int generations = 0;
  bool done = false;
  bool has_plan = false;
  PlanScore best;  ///< when has_plan
};

class Search {
 public:
  explicit Search(const World& world) noexcept
      : world_(world), colony_(world, sightings_), improver_(world, sightings_) {}
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  /// Another mission, whose tables are ready. Cost: cells and edges.
  void start(const ColonyParameters& parameters) noexcept;
  void stop() noexcept { ready_ = false; }

  /// Searches on for at most about `budget.units`, of one kind; an indivisible rest may go a little over. Nothing when
  /// done.
  void step(Budget budget) noexcept;
  [[nodiscard]] SliceKind last_slice() const noexcept { return last_slice_; }
  /// The last slice used up its budget: it did not end early, with its kind or with the search.
  [[nodiscard]] bool last_slice_was_full() const noexcept { return last_slice_was_full_; }
  /// What it came to: less than its budget where its kind ended.
  [[nodiscard]] int last_slice_units() const noexcept { return last_slice_units_; }
  /// What was tried since start(): edges walked by ants, changes of a route.
  [[nodiscard]] std::int64_t moves() const noexcept { return colony_.moves() + improver_.proposals(); }
  [[nodiscard]] Progress progress() const noexcept;

  /// The best plan so far; there is one from the first generation on, complete or not. No horizon cuts a plan short: it
  /// ends when little enough is unseen, when nobody can get to more, or when every path is full, and is incomplete in
  /// the last two cases. Complete plans by cost (EST with sub-priors, else ET in the paper's profile and ET_c in the
  /// fast one), before incomplete ones by unseen mass. Cost: the copy of its waypoints.
  void best_plan(Plan& plan) const noexcept;

  /// Takes over another search's best when it is better. Cost: the copy.
  void learn_from(const Search& other) noexcept;

 private:
  [[nodiscard]] bool improves() const noexcept { return parameters_.profile == Profile::kFast && improvable_; }
  [[nodiscard]] bool improved() const noexcept { return improves() && improver_.has_best(); }
  [[nodiscard]] int generation() const noexcept;
  [[nodiscard]] bool done() const noexcept;
  [[nodiscard]] SliceKind kind() const noexcept;
  void cut(AgentPath& path, double end_s, double speed_mps) const noexcept;

  const World& world_;
  FirstSightings sightings_;  // scratch of whoever scores
  Colony colony_;
  Improver improver_;
  ColonyParameters parameters_;
  bool improvable_ = false;
  bool improving_ = false;
  bool ready_ = false;
  int last_slice_units_ = 0;
  SliceKind last_slice_ = SliceKind::kNone;
  bool last_slice_was_full_ = false;

  friend class Planner;  // lists the sizes of its parts
};

}  // namespace ivo::planner
