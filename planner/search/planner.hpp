// The face of the search core: prepare once, then step() in slices inside the loop. All memory is this object's;
// nothing here allocates, throws, waits, or asks for the time. The same input and seed give the same plan, however the
// work is sliced.
#pragma once

#include <cstdint>
#include <variant>

#include "config/base/realtime.hpp"
#include "planner/numeric/index.hpp"
#include "planner/prior/preferences.hpp"
#include "planner/prior/prior.hpp"
#include "planner/prior/sub_priors.hpp"
#include "planner/refusal.hpp"
#include "planner/search/bounds.hpp"
#include "planner/search/plan.hpp"
#include "planner/search/search.hpp"
#include "planner/world/cell_set.hpp"
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
  /// Where somebody has looked and not found it: the prior is 0 there (Eq. 4 with the ideal sensor); none: nowhere.
  /// Read by prepare() alone.
  const CellSet* searched = nullptr;
  StaticVector<SearchAgent, limits::kAgents> agents;
  ColonyParameters colony;
};

class Planner {
 public:
  Planner() noexcept = default;
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;

  /// Builds cells, graph, prior, sight table and sub-priors, and readies the search. At start-up: its cost has no small
  /// bound. What it refuses, it names; after a refusal only prepare() may be called. The map's pixels outlive the
  /// search.
  [[nodiscard]] Refusal prepare(const SearchProblem& problem) noexcept;

  /// As Search has them.
  Progress step(Budget budget) noexcept IVO_REALTIME {
    search_.step(budget);
    return search_.progress();
  }
  [[nodiscard]] Progress progress() const noexcept { return search_.progress(); }
  [[nodiscard]] SliceKind last_slice_kind() const noexcept { return search_.last_slice(); }
  [[nodiscard]] bool last_slice_was_full() const noexcept { return search_.last_slice_was_full(); }
  [[nodiscard]] int last_slice_units() const noexcept { return search_.last_slice_units(); }
  [[nodiscard]] std::int64_t moves() const noexcept { return search_.moves(); }
  void best_plan(Plan& plan) const noexcept { search_.best_plan(plan); }

  /// The first of the searches on these tables; others may be made on world() and started with parameters().
  [[nodiscard]] Search& search() noexcept { return search_; }
  [[nodiscard]] const World& world() const noexcept { return world_; }
  [[nodiscard]] const ColonyParameters& parameters() const noexcept { return parameters_; }

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

  Cells cells_;
  Graph graph_;
  std::array<double, limits::kCells> raw_mass_{};  // while preparing
  Belief belief_;
  SightTable sight_;
  BoundTable bounds_;
  EdgePaces paces_{};
  std::array<double, limits::kAgents> speeds_mps_{};
  SegmentedMap map_;
  Bodies bodies_;
  double clearance_m_ = 0.0;
  World world_{cells_, graph_, sight_, belief_, paces_, speeds_mps_, map_, bodies_, clearance_m_};
  Search search_{world_};
  ColonyParameters parameters_;
  AgentSet left_without_sub_prior_ = 0;
};

}  // namespace ivo::planner
