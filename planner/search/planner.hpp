// The face of the search core: prepare once, then step() in slices inside the loop. All memory is this object's;
// nothing here allocates, throws, waits, or asks for the time. The same input and seed give the same plan, however the
// work is sliced.
#pragma once

#include <cstdint>
#include <variant>

#include "planner/numeric/index.hpp"
#include "planner/prior/preferences.hpp"
#include "planner/prior/prior.hpp"
#include "planner/refusal.hpp"
#include "planner/search/ant.hpp"
#include "planner/search/bounds.hpp"
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

enum class Profile : std::uint8_t {
  kPaper,  ///< the paper's MAX-MIN ant system
  kFast,   ///< the same with iterated improvement
};

/// eta of Eq. 2 (model.md, "Search (MMAS)").
enum class Heuristic : std::uint8_t { kTsp, kMts };

/// Symbols as in model.md, "Search (MMAS)"; alpha is 1.
struct ColonyParameters {
  Profile profile = Profile::kFast;
  Heuristic heuristic = Heuristic::kTsp;
  int generations = 300;
  int ants = 10;
  int beta = 6;
  double rho = 0.002;
  double iteration_best = 0.5;  ///< probability that the generation's best deposits, not the best so far
  AntParameters ant;
  std::uint64_t seed = 1;
};

/// Uniform (monostate), a Gaussian mixture, or an image.
using PriorChoice = std::variant<std::monostate, std::span<const GaussianComponent>, GreyView>;
using PriorChoices = StaticVector<PriorChoice, limits::kAgents>;

struct SearchProblem {
  SegmentedMap map;
  double cell_m = 0.25;
  GraphParameters graph;
  PriorChoice prior;
  PriorChoices sub_priors;  ///< one an agent, given; empty: from the agents' preferred areas
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
  Planner() noexcept : ant_({graph_, sight_, belief_, speeds_mps_}, trails_) {}
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;

  /// Builds cells, graph, prior, sight table and sub-priors, and readies the colony. At start-up: its cost has no small
  /// bound. What it refuses, it names; after a refusal only prepare() may be called.
  [[nodiscard]] Refusal prepare(const SearchProblem& problem) noexcept;

  /// Searches on for at most about `budget.units`; the last part may go over by one part (kRowsAPart rows). Nothing
  /// when done.
  Progress step(Budget budget) noexcept;
  [[nodiscard]] Progress progress() const noexcept;

  /// The best plan so far: complete plans by cost (EST with sub-priors, else ET), before incomplete ones by unseen
  /// mass. Cost: the copy of its waypoints.
  void best_plan(Plan& plan) const noexcept;

  /// What no plan that leaves `unseen_mass` can have a smaller ET_c than (bounds.hpp).
  [[nodiscard]] Bounds bounds(double unseen_mass) const noexcept;

  [[nodiscard]] const Cells& cells() const noexcept { return cells_; }
  [[nodiscard]] const Graph& graph() const noexcept { return graph_; }
  [[nodiscard]] const SightTable& sight() const noexcept { return sight_; }
  [[nodiscard]] const Belief& belief() const noexcept { return belief_; }
  /// Agents whose preferences left them no mass of their own: they search p/M.
  [[nodiscard]] AgentSet left_without_sub_prior() const noexcept { return left_without_sub_prior_; }

 private:
  static constexpr int kRowsAPart = 256;
  enum class Phase : std::uint8_t { kAnts, kRaise, kEvaporate, kClamp, kDone };

  void start_colony() noexcept;
  int advance() noexcept;
  int end_ant() noexcept;
  int end_ants() noexcept;
  int deposit() noexcept;
  int sweep_trails() noexcept;
  [[nodiscard]] double cost(const PlanScore& score) const noexcept;
  [[nodiscard]] bool better(const PlanScore& a, const PlanScore& b) const noexcept;

  Cells cells_;
  Graph graph_;
  Belief belief_;
  SightTable sight_;
  Trails trails_;
  Ant ant_;
  std::array<double, limits::kAgents> speeds_mps_{};
  AgentSet left_without_sub_prior_ = 0;

  ColonyParameters parameters_;
  Rng rng_;
  Phase phase_ = Phase::kDone;
  int generation_ = 0;  // finished
  int ants_done_ = 0;   // of this generation
  int sweep_agent_ = 0;
  Edge sweep_edge_ = 0;
  bool has_best_ = false;
  Tour generation_best_;
  Tour best_;
};

}  // namespace ivo::planner
