// The face of the search core: prepare once, then step() in slices inside the loop. All memory is this object's;
// nothing here allocates, throws, waits, or asks for the time. The same input and seed give the same plan, however the
// work is sliced.
#pragma once

#include <cstdint>
#include <variant>

#include "planner/numeric/index.hpp"
#include "planner/prior/preferences.hpp"
#include "planner/prior/prior.hpp"
#include "planner/prior/sub_priors.hpp"
#include "planner/refusal.hpp"
#include "planner/search/bounds.hpp"
#include "planner/search/colony.hpp"
#include "planner/search/improver.hpp"
#include "planner/search/plan.hpp"
#include "planner/world/cells.hpp"
#include "planner/world/graph.hpp"

namespace ivo::planner {

struct SearchAgent {
  GraphAgent body;              ///< start, kind, footprint, restricted areas
  double speed_mps = 0.5;       ///< v_m
  double sight_radius_m = 2.5;  ///< R_m
  Areas preferred;
};

/// Uniform (monostate), a Gaussian mixture, or an image.
using PriorChoice = std::variant<std::monostate, std::span<const GaussianComponent>, GreyView>;

struct SearchProblem {
  SegmentedMap map;
  double cell_m = 0.25;
  GraphParameters graph;
  const GraphTable* graph_table = nullptr;  ///< instead of building one; read by prepare() alone
  PriorChoice prior;
  SubPriorChoice sub_priors;  ///< given ones exclude preferred areas
  StaticVector<SearchAgent, limits::kAgents> agents;
  ColonyParameters colony;
};

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

class Planner {
 public:
  Planner() noexcept = default;
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;

  /// Builds cells, graph, prior, sight table and sub-priors, and readies the search. At start-up: its cost has no small
  /// bound. What it refuses, it names; after a refusal only prepare() may be called.
  [[nodiscard]] Refusal prepare(const SearchProblem& problem) noexcept;

  /// Searches on for at most about `budget.units`; the last part may go over by one part (Colony::kRowsAPart). Nothing
  /// when done.
  Progress step(Budget budget) noexcept;
  [[nodiscard]] Progress progress() const noexcept;

  /// The best plan so far: complete plans by cost (EST with sub-priors, else ET), before incomplete ones by unseen
  /// mass. Cost: the copy of its waypoints.
  void best_plan(Plan& plan) const noexcept;

  /// What no plan that leaves `unseen_mass` can be better than. Cost: bounds.hpp.
  [[nodiscard]] Bounds bounds(double unseen_mass) const noexcept { return bounds_.at(unseen_mass); }
  [[nodiscard]] const BoundTable& bound_table() const noexcept { return bounds_; }

  [[nodiscard]] const Cells& cells() const noexcept { return cells_; }
  [[nodiscard]] const Graph& graph() const noexcept { return graph_; }
  [[nodiscard]] const SightTable& sight() const noexcept { return sight_; }
  [[nodiscard]] const Belief& belief() const noexcept { return belief_; }
  /// Agents whose preferences left them no mass of their own: they search p/M.
  [[nodiscard]] AgentSet left_without_sub_prior() const noexcept { return left_without_sub_prior_; }

  /// A member and its bytes: where this object's memory goes.
  struct Part {
    const char* name;
    std::size_t bytes;
  };
  [[nodiscard]] static std::span<const Part> parts() noexcept;

 private:
  void build_bounds(const SearchProblem& problem) noexcept;
  void fill_paces() noexcept;
  void open_improver(const SearchProblem& problem) noexcept;
  [[nodiscard]] bool improved() const noexcept { return profile_ == Profile::kFast && improver_.has_best(); }
  void cut(AgentPath& path, double end_s, double speed_mps) const noexcept;

  Cells cells_;
  Graph graph_;
  std::array<double, limits::kCells> raw_mass_{};  // while preparing
  Belief belief_;
  SightTable sight_;
  BoundTable bounds_;
  EdgePaces paces_{};
  World world_{cells_, graph_, sight_, belief_, paces_};
  FirstSightings sightings_;  // scratch of whoever scores
  Colony colony_{world_, sightings_};
  std::array<double, limits::kAgents> speeds_mps_{};
  AgentSet left_without_sub_prior_ = 0;
  Improver improver_{world_, sightings_};
  Profile profile_ = Profile::kFast;
  int generations_ = 0;
  bool improvable_ = false;
  bool improving_ = false;
  bool ready_ = false;
};

}  // namespace ivo::planner
