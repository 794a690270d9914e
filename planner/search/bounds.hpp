// Lower bounds on the expected time of any plan of a mission, so that a plan can say how good it is (model.md,
// "Bounds"): ET_c >= integral of 1 - F(t), F the most that can have been seen by t.
//
// LB-A: F is the largest mass on the area that the team can have swept, sum of pi R^2 + 2 R v t.
// LB-B: the same among the cells that some agent can have come near enough to see: by the straight line, and around
// what is on the map by way_field.hpp. What hides is left out: it can only delay.
//
// The integral is a right sum over 8192 instants, t_k in the square of k up to the instant at which everything can have
// been seen: a step grows from microseconds at the start, where a peaked prior is found, to twice the mean at the end
// (M1: 0.04 s; 0.03 s below the exact integral there). It ends before the first instant with F >= 1 - u, u the unseen
// mass of the plan.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "config/limits.hpp"
#include "planner/search/belief.hpp"
#include "planner/search/top_mass.hpp"
#include "planner/search/way_field.hpp"
#include "planner/world/cells.hpp"

namespace ivo::planner {

struct LowerBound {
  double nominal_s = 0.0;  ///< R as it is
  double strict_s = 0.0;   ///< R + res/sqrt(2) for the area: cells count at their centres, so only this one is proved
};

struct Bounds {
  LowerBound area;   ///< LB-A
  LowerBound reach;  ///< LB-B; never below LB-A

  [[nodiscard]] double bound_s() const noexcept { return std::max(area.nominal_s, reach.nominal_s); }
  [[nodiscard]] double bound_strict_s() const noexcept { return std::max(area.strict_s, reach.strict_s); }
};

struct BoundAgent {
  Walker walker;
  double speed_mps = 0.5;       ///< v_m, above 0
  double sight_radius_m = 2.5;  ///< R_m
};

class BoundTable {
 public:
  /// For this map, this prior (not empty) and these agents, whatever their plan. Cost: sorts the cells with mass; for
  /// each agent way_field.hpp, and cells times the rows that R spans; the instants. At start-up.
  void build(const SegmentedMap& map, const Cells& cells, const Belief& belief,
             std::span<const BoundAgent> agents) noexcept;

  /// Of plans that leave `unseen_mass`. Cost: the instants.
  [[nodiscard]] Bounds at(double unseen_mass) const noexcept;

  /// Least time at which some agent can see the cell, a cell with mass.
  [[nodiscard]] double reach_s(Cell c) const noexcept { return reach_s_[index(c)]; }

 private:
  static constexpr int kInstants = 8192;
  using Curve = std::array<double, kInstants + 1>;  // F at each instant
  // Area swept by t: base + rate t.
  struct Sweep {
    double base_m2 = 0.0;
    double rate_m2ps = 0.0;
  };

  void find_reach(const SegmentedMap& map, const Cells& cells, const Belief& belief, const BoundAgent& agent) noexcept;
  void order_by_mass(const Belief& belief) noexcept;
  void order_by_instant() noexcept;
  void integrate(const Belief& belief, double cell_m2, const Sweep& nominal, const Sweep& strict) noexcept;
  /// The first instant at which the cell of this rank can have been seen.
  [[nodiscard]] int instant_of(std::int32_t rank) const noexcept;
  [[nodiscard]] double instant_s(int k) const noexcept;
  [[nodiscard]] double integral_s(const Curve& f, double unseen_mass) const noexcept;

  double whole_ = 1.0;  // the sum of the masses: 1 but for their rounding
  double end_s_ = 0.0;
  Curve area_nominal_{};
  Curve area_strict_{};
  Curve reach_nominal_{};
  Curve reach_strict_{};

  // While building; 16 bytes a cell with the way field.
  int count_ = 0;                                          // cells with mass
  std::array<float, limits::kCells> reach_s_{};            // by cell, rounded down
  std::array<std::int32_t, limits::kCells> by_mass_{};     // cells, largest mass first
  std::array<std::int32_t, limits::kCells> by_instant_{};  // ranks in by_mass_, by the instant they come in
  std::array<std::int32_t, kInstants + 1> end_of_instant_{};
  TopMass available_;
  WayField way_;
};

}  // namespace ivo::planner
