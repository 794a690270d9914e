// Expected times of a plan from its first sightings (Eq. 8 and 10; model.md, "Sensing and expected time",
// "Sub-priors").
#pragma once

#include <array>
#include <cstdint>

#include "config/limits.hpp"
#include "planner/search/belief.hpp"
#include "planner/search/first_sightings.hpp"
#include "planner/search/plan.hpp"

namespace ivo::planner {

/// The margin is for the rounding of sums: who adds up the same cells in another order must not judge otherwise.
[[nodiscard]] inline bool is_complete(double unseen_mass, double max_unseen_mass) noexcept {
  return unseen_mass <= max_unseen_mass + 1e-9;
}

/// Adds up a plan's cells in any number of slices; then the times are sums' quotients.
class ExpectedTime {
 public:
  void clear() noexcept { *this = ExpectedTime{}; }

  /// Takes cells `first` to `first + count - 1` of belief.cells_with_mass(). Cost: `count`.
  void add(const Belief& belief, const FirstSightings& sightings, int first, int count) noexcept;

  /// When the path of an agent ends: where it last sees something new. 0 when it never does.
  [[nodiscard]] Seconds path_end_s(int agent) const noexcept { return path_end_s_[index(agent)]; }
  [[nodiscard]] Mass unseen() const noexcept;
  /// ET of Eq. 8 as the search compares it.
  [[nodiscard]] Mass expected_time() const noexcept;
  /// EST of Eq. 10 likewise, over K = belief.sub_prior_steps.
  [[nodiscard]] Mass expected_sub_prior_time(const Belief& belief) const noexcept;
  /// The same with K = N, the plan's own end: what the paper minimises.
  [[nodiscard]] Mass expected_sub_prior_time_to_end() const noexcept;
  /// `max_unseen_mass` decides what is complete.
  [[nodiscard]] PlanScore score(const Belief& belief, double max_unseen_mass) const noexcept;

 private:
  void add_sub_priors(const Belief& belief, const FirstSightings& sightings, int first, int count) noexcept;
  [[nodiscard]] Seconds horizon_s() const noexcept;

  Mass whole_ = Mass(1);
  Mass sub_whole_ = Mass(1);
  Mass seen_mass_{};
  MassTime mass_seconds_{};    // sum of p t_c
  Mass mass_steps_{};          // sum of p (max(k, 1) - 1)
  Mass sub_mass_{};            // sum of p_w
  Mass sub_mass_steps_{};      // sum of p_w min(max(k, 1) - 1, K)
  Mass sub_mass_all_steps_{};  // the same without K
  std::array<Seconds, limits::kAgents> path_end_s_{};
};

}  // namespace ivo::planner
